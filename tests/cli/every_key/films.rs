//! The case with a film against the film put together by hand, where its journal stands in equilibrium.

use std::f64::consts::TAU;

use whirl_solver::film::{Balance, Journal, JournalMotion, Oil, OilFilm, Reach};
use whirl_specs::{CLEARANCES, FILMS};

use crate::workbench::Workbench;

#[test]
fn a_film_of_a_case_is_that_of_its_keys() {
    let bench = Workbench::new()
        .file("films.toml", include_str!("films.toml"))
        .file("bore.csv", include_str!("bore.csv"));
    let outcome = bench.whirl(&["run", "films.toml", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("out");
    let kernel = FILMS.iter().find(|film| film.origin.name == "jfo").expect("a shipped film");
    let mut film = OilFilm::new(kernel, [48, 9], [0.021, 0.023], 0.0).expect("a film");
    film.set("mu_0", 0.013).expect("a parameter");
    film.set("sigma", 0.3e-6).expect("a parameter");
    film.flood(0, 0.3e5).expect("an end");
    film.close(1);
    let (middle, half) = (100_f64.to_radians(), 0.5 * 0.007 / 0.021);
    film.supply("hole", middle - half..middle + half, -0.0085..0.0005, 1.7e5).expect("a hole");
    let (middle, half) = (200_f64.to_radians(), 12.5_f64.to_radians());
    film.supply("groove", middle - half..middle + half, -0.0115..0.0115, 0.9e5).expect("a groove");
    let mut journal = Journal::new(film, &CLEARANCES[0], 31e-6).expect("a journal");
    journal.shape(|angle, z| {
        let degrees = angle.to_degrees().rem_euclid(360.0);
        // The lobes are from −20° to 160° and from 160° to 340°, narrowest at six tenths of each.
        let within = (degrees + 20.0).rem_euclid(180.0) - 108.0;
        let lobe = 31.0 * 0.3 / 0.7 * (1.0 - within.to_radians().cos());
        let profile = match degrees {
            own if own < 20.0 => 3.0 - 1.5 * (own + 60.0) / 80.0,
            own if own < 140.0 => 1.5 - 3.5 * (own - 20.0) / 120.0,
            own if own < 300.0 => -2.0 + 5.0 * (own - 140.0) / 160.0,
            own => 3.0 - 1.5 * (own - 300.0) / 80.0,
        };
        let from = |middle: f64| ((degrees - middle + 180.0).rem_euclid(360.0) - 180.0).abs();
        let step = from(-30.0) <= 20.0 + 1e-9 && (z - 3e-3).abs() <= 4e-3 + 1e-12;
        let slot = from(150.0) <= (4.5_f64 / 21.0).to_degrees();
        1e-6 * (lobe + profile + if step { 4.0 } else { 0.0 } + if slot { 2.5 } else { 0.0 })
    });
    let (mut oil, mut balance) = (Oil::full(&journal.film), Balance::new(&journal.film));
    let last = |name: &str| history.last(name);
    let motion = JournalMotion {
        displacement: [1e-6 * last("EX_b_um"), 1e-6 * last("EY_b_um")],
        omega: TAU * 2900.0 / 60.0,
        ..JournalMotion::default()
    };
    let reaction = journal.react(&motion, &mut oil, &mut balance, &mut [0.0]).expect("a film");
    for (found, load) in reaction.forces.iter().zip([700.0, -150.0]) {
        assert!((found - load).abs() < 1e-3, "{found} N under {load} N");
    }
    assert!((last("mz_f_Nm") / reaction.forces[4] - 1.0).abs() < 1e-6, "{:?}", reaction.forces);
    let flows = ["left", "right", "hole", "groove"].map(|own| last(&format!("q_{own}_f_mL_s")));
    for (opening, flow) in flows.into_iter().enumerate() {
        let found = 1e6 * balance.inflow(&journal.film, opening);
        assert!((found - flow).abs() < 1e-5, "{opening}: {found} {flow}");
    }
    assert!(flows[1] == 0.0 && flows[2] != 0.0 && flows[3] != 0.0, "{flows:?}");
    let said = bench.whirl(&["check", "films.toml"]);
    assert!(said.stdout.contains("film of 48 × 9 nodes"), "{}", said.stdout);
    assert!(said.stdout.contains("opening hole: 2 × 3 nodes"), "{}", said.stdout);
}

#[test]
fn a_pad_of_a_case_is_that_of_its_keys() {
    let bench = Workbench::new().file("pads.toml", include_str!("pads.toml"));
    let outcome = bench.whirl(&["run", "pads.toml", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("out");
    let kernel = FILMS.iter().find(|film| film.origin.name == "jfo").expect("a shipped film");
    let [start, arc, middle] = [100.0_f64, 100.0, 125.0].map(f64::to_radians);
    let reach = Reach { first: start, arc: Some(arc) };
    let mut film = OilFilm::reaching(kernel, [25, 5], [0.021, 0.023], reach).expect("a film");
    film.set("mu_0", 0.013).expect("a parameter");
    film.set("sigma", 0.3e-6).expect("a parameter");
    film.flood(2, 0.7e5).expect("an edge");
    film.flood(3, 0.2e5).expect("an edge");
    let half = 0.5 * 0.004 / 0.021;
    film.supply("hole", middle - half..middle + half, -0.00575..0.00575, 2e5).expect("a hole");
    let mut journal = Journal::new(film, &CLEARANCES[0], 31e-6).expect("a journal");
    journal.shape(|angle, _| 31e-6 * 0.3 / 0.7 * (1.0 - (angle - start - 0.6 * arc).cos()));
    let (mut oil, mut balance) = (Oil::full(&journal.film), Balance::new(&journal.film));
    let last = |name: &str| history.last(name);
    // The film turns with its pad: by what the middle of its bore moves about the pivot.
    let of = |letter: &str, joint: &str| {
        ["X", "Y"].map(|axis| 1e-6 * last(&format!("{letter}{axis}_{joint}_um")))
    };
    let (journal_at, eccentric, pivot) = (of("", "b"), of("E", "b"), of("E", "pivot"));
    let bore = [0, 1].map(|axis| journal_at[axis] - eccentric[axis] - pivot[axis]);
    let [x, y] = [-0.026, 0.015];
    let (sin, cos) = ((bore[0] * y - bore[1] * x) / (x * x + y * y)).sin_cos();
    let [x, y] = eccentric;
    let motion = JournalMotion {
        displacement: [cos * x + sin * y, cos * y - sin * x],
        omega: TAU * 2900.0 / 60.0,
        ..JournalMotion::default()
    };
    let mut reaction = journal.react(&motion, &mut oil, &mut balance, &mut [0.0]).expect("a film");
    let [x, y, ..] = reaction.forces;
    reaction.forces[0] = cos * x - sin * y;
    reaction.forces[1] = cos * y + sin * x;
    let size = last("RX_b_N").hypot(last("RY_b_N"));
    assert!(size > 50.0, "{size}");
    for (found, name) in reaction.forces.iter().zip(["RX_b_N", "RY_b_N"]) {
        assert!((found - last(name)).abs() < 1e-5 * size, "{found} N against {} N", last(name));
    }
    for (opening, own) in ["left", "right", "start", "end", "hole"].into_iter().enumerate() {
        let found = 1e6 * balance.inflow(&journal.film, opening);
        let flow = last(&format!("q_{own}_f_mL_s"));
        assert!((found - flow).abs() < 1e-4 * flow.abs(), "{own}: {found} {flow}");
        assert!(flow != 0.0, "{own}");
    }
    let said = bench.whirl(&["check", "pads.toml"]);
    for word in [
        "film of 25 × 5 nodes",
        "arc from 100° to 200°",
        "preload 0.3, narrowest at 160°",
        "opening hole: 3 × 3 nodes",
    ] {
        assert!(said.stdout.contains(word), "{word}: {}", said.stdout);
    }
}

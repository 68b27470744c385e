//! Coefficients out of an analysis and into a bushing.

use std::fs;

use num_complex::Complex64;

use super::{column, numbers, ran};
use crate::workbench::Workbench;

/// A rotor of 10 kg on a joint.
fn rotor(joint: &str) -> String {
    format!(
        "title = \"a rotor on a joint\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n[body.rotor]\n\
         turns = \"prescribed\"\nspeed = \"6000 rpm\"\nmass = \"10 kg\"\npolar_inertia = \"0.05 kg*m^2\"\n\
         unbalance.u = {{ mass = \"1 g\", radius = \"100 mm\" }}\n[joint.seat]\n{joint}"
    )
}

const FILM: &str = "kind = \"bearing\"\njournal = { body = \"rotor\" }\nlaw = \"ocvirk\"\nparameters = { mu = \"20 mPa*s\" }\n\
                    radial_clearance = \"60 um\"\njournal_radius = \"30 mm\"\nlength = \"30 mm\"\n";
const BUSHING: &str =
    "kind = \"bushing\"\nfirst = { body = \"rotor\" }\ntable = \"coefficients.seat.csv\"\n";

/// The table of a film that a bushing reads back is the same linear machine at each of its speeds: modes and response. What is left is
/// rounding, as files hold all digits.
#[test]
fn a_bushing_with_the_table_of_a_film_is_the_same_linear_machine() {
    const SPEEDS: &str = "2000 rpm .. 6000 rpm, 5";
    let film = Workbench::new().file("case.toml", &rotor(FILM));
    ran(&film, &["coefficients", "case.toml", "--speeds", SPEEDS, "--out", "out", "--no-figures"]);
    let table = fs::read_to_string(film.path("out/coefficients.seat.csv")).expect("a table");
    let bushing =
        Workbench::new().file("coefficients.seat.csv", &table).file("case.toml", &rotor(BUSHING));
    let of = |bench: &Workbench, kind: &str, names: &[&str]| -> Vec<Vec<f64>> {
        ran(bench, &[kind, "case.toml", "--speeds", SPEEDS, "--out", "out", "--no-figures"]);
        names.iter().map(|name| numbers(bench, &format!("out/{kind}.csv"), name)).collect()
    };
    for (kind, names) in [
        ("modes", &["real_1_s", "imaginary_1_s", "sense"][..]),
        ("response", &["x_um", "y_um", "x_phase_deg", "y_phase_deg"]),
    ] {
        let [known, found] = [of(&film, kind, names), of(&bushing, kind, names)];
        assert!(known[0].len() >= 5, "{kind}: {known:?}");
        for (name, (known, found)) in names.iter().zip(known.iter().zip(&found)) {
            assert_eq!(known.len(), found.len(), "{kind}, {name}");
            let largest = known.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
            let apart = known.iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart <= 1e-9 * largest, "{kind}, {name}: {apart} of {largest}");
        }
    }
}

/// Balls that have turned on by half a pitch hold a rotor with another stiffness: the table says for which angle it is. A film has no angle.
#[test]
fn a_table_of_balls_says_where_they_stand() {
    const BALLS: &str = "kind = \"bearing\"\njournal = { body = \"rotor\" }\nlaw = \"ball-bearing\"\n\
                         radial_clearance = \"10 um\"\n";
    for (joint, varies) in [(BALLS, true), (FILM, false)] {
        let bench = Workbench::new().file("case.toml", &rotor(joint));
        let said = ran(&bench, &["coefficients", "case.toml", "--speed", "6000 rpm"]).stdout;
        let words = "with the angle of rotor: the table holds where that is 0";
        assert_eq!(
            said.contains("note: stiffness and damping of bearing seat vary by"),
            varies,
            "{said}"
        );
        assert_eq!(said.contains(words), varies, "{said}");
    }
}

/// What was given in whole rpm is written in whole rpm, and reads back to the same speed.
#[test]
fn speeds_are_written_as_they_were_given() {
    let bench = Workbench::new().file("case.toml", &rotor(FILM));
    let out = ["--out", "out", "--no-figures"];
    let speeds = "1000.7 rpm .. 8000.7 rpm, 11";
    ran(&bench, &[&["coefficients", "case.toml", "--speeds", speeds][..], &out].concat());
    let found = column(&bench, "out/coefficients.csv", "speed_rpm");
    let expected: Vec<String> = (0..11).map(|k| format!("{}.7", 1000 + 700 * k)).collect();
    assert_eq!(found, expected);
    let found = column(&bench, "out/coefficients.seat.csv", "speed [rpm]");
    assert_eq!(found, expected);
    ran(
        &bench,
        &[&["modes", "case.toml", "--speeds", "1100 rpm .. 2200 rpm, 12"][..], &out].concat(),
    );
    let mut found = column(&bench, "out/modes.csv", "speed_rpm");
    found.dedup();
    assert!(found.iter().all(|own| own.ends_with("00")), "{found:?}");
}

/// A ring of 2 kg between two bushings: z₁ z₂/(z₁ + z₂), z₁ = k₁ + iωc₁ towards the shaft, z₂ = k₂ + iωc₂ − mω² towards the ground, at
/// once and half the speed.
#[test]
fn a_shaft_feels_what_holds_its_bearing() {
    let case = "title = \"a shaft in a ring\"\n\
             [body.shaft]\nturns = \"prescribed\"\nspeed = \"6000 rpm\"\nmass = \"10 kg\"\npolar_inertia = \"0.1 kg*m^2\"\n\
             [body.ring]\nturns = \"no\"\nmass = \"2 kg\"\n\
             [joint.inner]\nkind = \"bushing\"\nfirst = { body = \"shaft\" }\nsecond = { body = \"ring\" }\n\
             stiffness = { xx = \"1e7 N/m\", yy = \"2e7 N/m\" }\ndamping = { xx = \"1000 N*s/m\", yy = \"3000 N*s/m\" }\n\
             [joint.outer]\nkind = \"bushing\"\nfirst = { body = \"ring\" }\n\
             stiffness = { xx = \"5e7 N/m\", yy = \"4e6 N/m\" }\ndamping = { xx = \"2000 N*s/m\", yy = \"500 N*s/m\" }\n\
             [analysis.k]\nkind = \"coefficients\"\nspeeds = \"6000 rpm\"\norders = [0.5, 1]\n";
    let workbench = Workbench::new().file("case.toml", case);
    ran(&workbench, &["analyse", "case.toml", "--out", "out", "--no-figures"]);
    let of = |name: &str| numbers(&workbench, "out/k.through.csv", name);
    assert_eq!(of("order"), [0.5, 1.0]);
    assert_eq!(super::column(&workbench, "out/k.through.csv", "bodies"), ["ring", "ring"]);
    for (row, order) in [0.5, 1.0].into_iter().enumerate() {
        let omega = order * 200.0 * std::f64::consts::PI;
        for (axis, k1, c1, k2, c2) in [("xx", 1e7, 1e3, 5e7, 2e3), ("yy", 2e7, 3e3, 4e6, 5e2)] {
            let first = Complex64::new(k1, omega * c1);
            let second = Complex64::new(k2 - 2.0 * omega * omega, omega * c2);
            let both = first * second / (first + second);
            let k = of(&format!("k_{axis}_N_m"))[row];
            let c = of(&format!("c_{axis}_Ns_m"))[row];
            assert!((k / both.re - 1.0).abs() < 1e-9, "{axis} {order}: {k} {both}");
            assert!((c * omega / both.im - 1.0).abs() < 1e-9, "{axis} {order}: {c} {both}");
        }
    }
}

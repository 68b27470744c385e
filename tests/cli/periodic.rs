//! `kind = "periodic"`: motions that repeat themselves against closed forms, other programs and marches.
//!
//! Numbers without another source are those of an independent program on the same equations (harmonic balance and shooting).

mod branches;
mod harmonic;
mod multipliers;
mod states;

use std::f64::consts::TAU;

use serde_json::Value;

use crate::workbench::{Outcome, Workbench};

/// A radial wall beyond a gap: Hooke's law along the eccentricity.
const WALL: &str = include_str!("../../specs/cases/annular-rub.law.toml");

/// An unbalanced mass in a ring (rad/s, m).
fn rub(speed: f64, eccentricity: f64, keys: &str) -> String {
    format!(
        "title = \"a rub\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\ndamping = \"20 N*s/m\"\n\
         [mass.unbalance]\neccentricity = \"{eccentricity} m\"\nspeed = \"{speed:?} rad/s\"\n\
         [[stop]]\nside = \"around\"\ngap = \"1 mm\"\nlaw = \"wall.law.toml\"\n\
         [analysis.cycle]\nkind = \"periodic\"\n{keys}"
    )
}

/// A rigid rotor of 20 kg in a film of Ocvirk under its weight, with an unbalance as a share of the clearance.
fn film(speed: f64, unbalance: f64, keys: &str) -> String {
    let unbalance = match unbalance == 0.0 {
        true => String::new(),
        // e of the centre of mass is U/m.
        false => format!(
            "[body.rotor.unbalance.u]\nmass = \"{} g\"\nradius = \"100 mm\"\n",
            1e3 * 20.0 * unbalance * 100e-6 / 0.1
        ),
    };
    format!(
        "title = \"a film\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n\
         [body.rotor]\nturns = \"prescribed\"\nspeed = \"{speed:?} rad/s\"\nmass = \"20 kg\"\n\
         polar_inertia = \"0.1 kg*m^2\"\n{unbalance}\
         [joint.film]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\nlaw = \"ocvirk\"\n\
         parameters = {{ mu = \"5 mPa*s\" }}\nradial_clearance = \"100 um\"\njournal_radius = \"25 mm\"\n\
         length = \"20 mm\"\n[analysis.cycle]\nkind = \"periodic\"\n{keys}"
    )
}

fn analysed(bench: &Workbench) -> Outcome {
    let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    outcome
}

/// The motions of a case.
fn motions(case: &str) -> (Workbench, Vec<Value>) {
    let bench = Workbench::new().file("case.toml", case).file("wall.law.toml", WALL);
    analysed(&bench);
    let text = std::fs::read_to_string(bench.path("out/cycle.json")).expect("a summary");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    let motions = whole["motions"].as_array().expect("motions").clone();
    (bench, motions)
}

/// A table of a bench by the names of its columns.
fn column(bench: &Workbench, file: &str, name: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(bench.path(&format!("out/{file}"))).expect("a table");
    let mut lines = text.lines();
    let place = lines.next().expect("a head").split(',').position(|own| own == name);
    let place = place.expect("a column");
    let cell = |line: &str| line.split(',').nth(place).expect("a cell").parse();
    lines.map(|line| cell(line).unwrap_or(f64::NAN)).collect()
}

fn number(motion: &Value, key: &str) -> f64 {
    motion[key].as_f64().unwrap_or_else(|| panic!("no {key} in {motion}"))
}

/// |k + k_c (1 − c/r) − mω̃² + idω̃| r = meΩ², ω̃ = (2/Δt) tan(π/N): the motion of N steps is that of ω̃, exactly. Its multipliers
/// are those of the exponents −10 ± 384.596982i and −10 ± 57.849268i in the turning frame, to O(Δt²).
#[test]
fn a_full_rub_of_n_steps_is_that_of_the_speed_that_steps_have() {
    let known = [
        (90, 1.0784025330854517),
        (180, 1.0783251499021755),
        (360, 1.0783058182433107),
        (720, 1.0783009862115234),
    ];
    let exact = (-10.0 * TAU / 110.0_f64).exp();
    assert!((exact - 0.5648479697).abs() < 1e-10);
    let mut apart = Vec::new();
    // The accelerated search ends at 1e-10 of the motion, which multipliers amplify.
    for (method, bound) in [("accelerated", 1e-10 / (1.0 - exact)), ("shooting", 1e-12)] {
        for (steps, radius) in known {
            let keys = format!("steps = {steps}\nmethod = \"{method}\"\n");
            let (bench, motions) = motions(&rub(110.0, 0.5e-3, &keys));
            let motion = &motions[0];
            assert_eq!(motion["stability"], "stable");
            let [x, y] = ["X1_um", "Y1_um"].map(|own| column(&bench, "cycle.csv", own));
            assert_eq!(x.len(), steps);
            for (x, y) in x.iter().zip(&y) {
                let found = x.hypot(*y) / 1e3;
                assert!((found / radius - 1.0).abs() < bound, "{method} {steps}: {found}");
            }
            let [own, finer] = ["modulus", "modulus_of_half_steps"]
                .map(|own| column(&bench, "cycle.multipliers.csv", own));
            assert_eq!(own.len(), 4);
            for (own, finer) in own.iter().zip(&finer) {
                // The trapezoidal rule is of second order, and its error even in Δt.
                let limit = (4.0 * finer - own) / 3.0;
                let bound = 0.1 * (90.0 / steps as f64).powi(4) * (own - exact).abs().max(1e-6);
                assert!((limit - exact).abs() < bound.max(2e-7), "{steps}: {limit} for {exact}");
            }
            apart.push((own[0] - exact).abs());
        }
    }
    let ratios = apart.windows(2).map(|pair| pair[0] / pair[1]);
    let fall: Vec<f64> = ratios.take(3).collect();
    assert!(fall.iter().all(|own| (own - 4.0).abs() < 0.1), "{fall:?}");
}

/// Between 109.85 and 287.75 rad/s a disc of e = ¼ mm turns freely or rubs all around: a beginning in contact finds the other
/// motion. The linear motion is r = meΩ²/|k − mω̃² + idω̃|.
#[test]
fn of_two_motions_the_beginning_decides() {
    let speed = 200.0;
    let steps = 360.0;
    let w = 2.0 * speed * steps / TAU * (TAU / 2.0 / steps).tan();
    let free = 0.25e-3 * speed * speed / f64::hypot(1e4 - w * w, 20.0 * w);
    let (bench, motions) = motions(&rub(speed, 0.25e-3, "steps = 360\nbegin = \"rest\"\n"));
    let [x, y] = ["X1_um", "Y1_um"].map(|own| column(&bench, "cycle.csv", own));
    let found = x[7].hypot(y[7]) / 1e6;
    assert!((found / free - 1.0).abs() < 1e-10, "{found} for {free}");
    // Exponents of mẍ + dẋ + kx = 0.
    let size = (-10.0 * TAU / speed).exp();
    assert!((number(&motions[0], "largest_multiplier") - size).abs() < 1e-3);
}

/// The equilibrium of a rotor in a film is a motion of one turn in the frame of the rotor. It loses its stability at 989.2785 rad/s
/// to a whirl of 0.398503 of the speed.
#[test]
fn a_film_loses_its_equilibrium_to_a_whirl() {
    for (speed, said) in
        [(960.0, "stable"), (1020.0, "unstable: pair of multipliers outside the unit circle")]
    {
        let (_, motions) = motions(&film(speed, 0.0, "steps = 240\n"));
        assert_eq!(motions[0]["stability"], said, "{speed}");
    }
    let (bench, _) = motions(&film(989.2785456447, 0.0, "steps = 240\n"));
    let [own, finer] = ["modulus", "modulus_of_half_steps"]
        .map(|own| column(&bench, "cycle.multipliers.csv", own));
    let limit = (4.0 * finer[0] - own[0]) / 3.0;
    assert!((limit - 1.0).abs() < 2e-5, "{limit}: {own:?} {finer:?}");
    // In the turning frame the whirl is at (0.3985 − 1) Ω.
    let [re, im] = ["real", "imaginary"].map(|own| column(&bench, "cycle.multipliers.csv", own));
    let ratio = (im[0].atan2(re[0]) / TAU).abs();
    assert!((ratio - 0.398503).abs() < 2e-4, "{ratio}");
}

/// With an unbalance of 0.2 c the motion doubles its period at 670.33 rad/s; the motion of two turns is stable beyond.
#[test]
fn a_film_with_unbalance_doubles_its_period() {
    let of = |speed: f64, keys: &str| {
        let (_, motions) = motions(&film(speed, 0.2, keys));
        motions[0]["stability"].as_str().expect("a word").to_owned()
    };
    assert_eq!(of(660.0, "steps = 240\n"), "stable");
    assert_eq!(of(680.0, "steps = 240\n"), "unstable: real multiplier below -1");
    assert_eq!(of(680.0, "steps = 480\nperiods = 2\nmarched = 60\n"), "stable");
}

/// With 0.05 c a second frequency appears at 933.42 rad/s.
#[test]
fn a_film_with_little_unbalance_wanders() {
    for (speed, said) in
        [(925.0, "stable"), (942.0, "unstable: pair of multipliers outside the unit circle")]
    {
        let (_, motions) = motions(&film(speed, 0.05, "steps = 240\n"));
        assert_eq!(motions[0]["stability"], said, "{speed}");
    }
}

/// The answer is where a march with the same step ends.
#[test]
fn a_motion_is_where_the_march_ends() {
    let steps = 200;
    let step = TAU / 600.0 / f64::from(steps);
    let turns = 120;
    let case = film(600.0, 0.1, &format!("steps = {steps}\n"));
    let case = format!(
        "{case}[march]\ntime_step = \"{step:e} s\"\nsteps = {}\nforce_tolerance = \"1e-9 N\"\n",
        turns * steps
    );
    let (bench, _) = motions(&case);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "run", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let marched = bench.history("run");
    for name in ["X_film_um", "Y_film_um", "RX_film_N", "RY_film_N"] {
        let own = column(&bench, "cycle.csv", name);
        let all = marched.column(name);
        let last = &all[all.len() - own.len()..];
        let size = own.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        for (own, last) in own.iter().zip(last) {
            assert!((own - last).abs() < 1e-9 * size, "{name}: {own} for {last}");
        }
    }
}

#[test]
fn what_does_not_repeat_is_refused_at_its_place() {
    let free = film(600.0, 0.1, "")
        .replace("turns = \"prescribed\"\nspeed = \"600.0 rad/s\"", "turns = \"free\"");
    let faster = film(600.0, 0.1, "")
        .replace("mass = \"20 kg\"", "mass = \"20 kg\"\nacceleration = \"5 rad/s^2\"");
    let load = |rest: &str| {
        format!("{}[loads.push]\nbody = \"rotor\"\nforce = \"3 N\"\n{rest}", film(600.0, 0.1, ""))
    };
    let once = load("table = \"once.csv\"\n").replace("force = \"3 N\"\n", "");
    let apart = load("frequency = \"61.7 Hz\"\n");
    let steps =
        film(600.0, 0.1, "steps = 360\n").replace("kind = \"periodic\"", "kind = \"modes\"");
    for (case, place, words) in [
        (free, "case.toml", "turns freely"),
        (faster, "case.toml", "the speed of rotor changes"),
        (once, "case.toml", "does not repeat"),
        (apart, "case.toml", "no common period"),
        (steps, "case.toml", "is of an analysis of the kind `periodic`"),
        (rub(110.0, 1e-4, "speeds = \"300 rpm\"\n"), "", "no body of `case` turns"),
    ] {
        let bench = Workbench::new()
            .file("case.toml", &case)
            .file("wall.law.toml", WALL)
            .file("once.csv", "time [s],force [N]\n0,0\n1,5\n");
        let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out", "--no-figures"]);
        assert_eq!(outcome.status, 2, "{words}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(words), "{words}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(place), "{words}: {}", outcome.stderr);
        assert!(outcome.stderr.contains("help"), "{words}: {}", outcome.stderr);
        assert!(!bench.path("out").exists() || bench.listing_of("out").is_empty());
    }
}

/// The branch of a case: its table and its events by kind and value.
fn followed(case: &str, more: &[(&str, &str)]) -> (Workbench, Vec<(String, f64)>) {
    let mut bench = Workbench::new().file("case.toml", case).file("wall.law.toml", WALL);
    for (name, text) in more {
        bench = bench.file(name, text);
    }
    analysed(&bench);
    let text = std::fs::read_to_string(bench.path("out/cycle.events.csv")).expect("events");
    let event = |line: &str| {
        let mut cells = line.split(',');
        let kind = cells.next().expect("a kind").to_owned();
        (kind, cells.next().expect("a value").parse().expect("a number"))
    };
    let events = text.lines().skip(1).map(event).collect();
    (bench, events)
}

/// The reference machine at 4500 rpm with 360 steps a cycle of its loads, against shooting of an independent model; eight modes that
/// steps do not resolve have the largest multipliers, 0.792 to 0.797, before the first pair of the motion, 0.39333.
#[test]
fn the_reference_machine_is_that_of_another_program() {
    let case = "include = \"hu2003-5.toml\"\ntitle = \"at constant speed\"\n\
                [analysis.cycle]\nkind = \"periodic\"\nspeeds = \"4500 rpm\"\nsteps = 360\ncount = 12\n";
    let bench = Workbench::new().file("case.toml", case);
    let outcome = bench.whirl(&["analyse", "case.toml", "cycle", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let text = std::fs::read_to_string(bench.path("out/cycle.json")).expect("a summary");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    let motion = &whole["motions"][0];
    assert_eq!(motion["stability"], "stable");
    let peak = |quantity: &str, unit: &str| {
        let all = (1..=4).flat_map(|support| {
            column(&bench, "cycle.csv", &format!("{quantity}{support}_{unit}"))
        });
        all.fold(0.0, |most: f64, own| most.max(own.abs()))
    };
    for (found, exact, digits) in [
        (peak("RX", "N"), 1119.7844806, 1e-9),
        (peak("RY", "N"), 1.9467131549, 1e-7),
        (peak("X", "um"), 24.1020825, 1e-7),
        (peak("Y", "um"), 0.0723453, 1e-5),
    ] {
        assert!((found / exact - 1.0).abs() < digits, "{found} for {exact}");
    }
    let (text, size) = (
        std::fs::read_to_string(bench.path("out/cycle.multipliers.csv")).expect("a table"),
        column(&bench, "cycle.multipliers.csv", "modulus"),
    );
    let unresolved: Vec<bool> =
        text.lines().skip(1).map(|line| line.ends_with("unresolved")).collect();
    assert!((size[0] - 0.79732).abs() < 1e-4, "{size:?}");
    let of_motion: Vec<f64> =
        size.iter().zip(&unresolved).filter(|own| !own.1).map(|own| *own.0).collect();
    assert!((of_motion[0] - 0.39333).abs() < 1e-4, "{size:?} {unresolved:?}");
    assert!(unresolved[..8].iter().all(|own| *own), "{size:?} {unresolved:?}");
}

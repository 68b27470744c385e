//! `kind = "periodic"`: motions that repeat themselves against closed forms, other programs and marches.
//!
//! Numbers without another source are those of an independent program on the same equations (harmonic balance and shooting).

mod harmonic;
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

/// Where contact all around begins and ends in rub A with N = 48 steps a turn, by the closed form with ω̃.
const CORNERS: [f64; 2] = [93.9316738679, 109.6170957619];

/// Rub A from one speed to another, in so many points.
fn branch_of_rub(ends: [f64; 2], points: usize) -> (Workbench, Vec<(String, f64)>) {
    let [from, to] = ends;
    let rest = format!(
        "steps = 48\nvary = \"mass.unbalance.speed = {from} rad/s .. {to} rad/s\"\npoints = {points}\n"
    );
    followed(&rub(from, 0.25e-3, &rest), &[])
}

/// The motion in contact folds at 287.17 rad/s and is unstable back to 109.62, where contact ends all around; the motion without contact
/// goes on from there, up to the end of the range.
#[test]
fn a_rub_is_followed_through_its_fold_and_beyond_where_contact_ends() {
    let (bench, events) = branch_of_rub([80.0, 320.0], 400);
    let of = |kind: &str| -> Vec<f64> {
        events.iter().filter(|own| own.0 == kind).map(|own| own.1).collect()
    };
    let folds = of("fold");
    assert_eq!(folds.len(), 1, "{events:?}");
    assert!((folds[0] / 287.1673208443 - 1.0).abs() < 1e-8, "{folds:?}");
    let corners = of("corner");
    assert_eq!(corners.len(), 2, "{events:?}");
    for (corner, exact) in corners.iter().zip(CORNERS) {
        assert!((corner / exact - 1.0).abs() < 1e-5, "{corner} for {exact}");
    }
    let value = column(&bench, "cycle.csv", "value");
    let most = column(&bench, "cycle.csv", "X1_um.max");
    assert_eq!(value.last(), Some(&320.0));
    let text = std::fs::read_to_string(bench.path("out/cycle.csv")).expect("a table");
    let unstable: Vec<bool> = text.lines().skip(1).map(|line| line.contains("unstable")).collect();
    // What is unstable is in contact, between the corner and the fold.
    let mut count = 0;
    for ((value, most), unstable) in value.iter().zip(&most).zip(&unstable) {
        if *unstable {
            count += 1;
            assert!((109.6..287.2).contains(value) && *most > 999.0, "{value}: {most}");
        }
    }
    assert!(count > 20, "{count}");
    let least = value.iter().zip(&unstable).filter(|own| *own.1).map(|own| *own.0);
    assert!(least.fold(f64::INFINITY, f64::min) < 112.0);
}

/// From any speed below and from above: contact begins where the closed form has it, and the branch goes on in contact.
#[test]
fn a_rub_is_followed_into_contact_from_either_side() {
    for (ends, exact) in
        [([60.0, 320.0], CORNERS[0]), ([85.0, 110.0], CORNERS[0]), ([320.0, 60.0], CORNERS[1])]
    {
        let (bench, events) = branch_of_rub(ends, 90);
        let corners: Vec<f64> =
            events.iter().filter(|own| own.0 == "corner").map(|own| own.1).collect();
        assert_eq!(corners.len(), 1, "{ends:?}: {events:?}");
        assert!((corners[0] / exact - 1.0).abs() < 1e-5, "{ends:?}: {corners:?} for {exact}");
        let most = column(&bench, "cycle.csv", "X1_um.max");
        assert!(most.last().is_some_and(|last| *last > 1001.0), "{ends:?}: {:?}", most.last());
        let value = column(&bench, "cycle.csv", "value");
        assert!(
            value.iter().all(|own| (ends[0].min(ends[1])..=ends[0].max(ends[1])).contains(own))
        );
    }
}

/// The last point is the end of the range, which a key need not outlive: there is no damping below zero. Of an undamped oscillator
/// nothing but the range ends the branch.
/// The film with unbalance doubles its period at 670.33 rad/s, in steps of 1/240 turn; the branch of two turns that begins there comes
/// to the motion of 680 rad/s that a search of its own finds, which is stable.
#[test]
fn a_branch_is_left_where_the_period_doubles() {
    let keys = "steps = 240\nvary = \"body.rotor.speed = 660 rad/s .. 680 rad/s\"\ndoublings = 1\n";
    let (bench, events) = followed(&film(660.0, 0.2, keys), &[]);
    assert_eq!(events.len(), 1, "{events:?}");
    assert_eq!(events[0].0, "period doubling");
    assert!((events[0].1 - 670.33).abs() < 0.3, "{events:?}");
    let of = |name: &str| column(&bench, "cycle.doubled-1.csv", name);
    let (values, periods) = (of("value"), of("period_s"));
    assert_eq!((values[0], values[values.len() - 1]), (events[0].1, 680.0));
    assert!((periods[periods.len() - 1] - 2.0 * TAU / 680.0).abs() < 1e-12);
    let words = std::fs::read_to_string(bench.path("out/cycle.doubled-1.csv")).expect("a table");
    assert!(words.lines().last().expect("a row").contains(",stable,"), "{words}");
    let (_, own) = motions(&film(680.0, 0.2, "steps = 480\nperiods = 2\nmarched = 60\n"));
    let columns = &own[0]["columns"];
    for name in ["RX_film_N", "EX_film_um", "EY_film_um"] {
        for end in ["min", "max"] {
            let value = number(&columns[name], end);
            let followed = of(&format!("{name}.{end}"));
            let last = followed[followed.len() - 1];
            assert!((last - value).abs() < 1e-6 * value.abs(), "{name}.{end}: {last}, {value}");
            // Of the doubling itself it is the motion of one turn.
            assert!((followed[0] - value).abs() > 1e-2 * value.abs(), "{name}.{end}: {followed:?}");
        }
    }
    let text = std::fs::read_to_string(bench.path("out/cycle.json")).expect("a summary");
    let whole: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(whole["doubled"][0]["periods"], 2);
    assert_eq!(whole["doubled"][0]["end"], "the end of the range");
}

#[test]
fn a_branch_ends_at_the_end_of_its_range() {
    let rest = "steps = 48\nvary = \"mass.damping = 30 N*s/m .. 0 N*s/m\"\n";
    let (bench, events) = followed(&rub(60.0, 0.05e-3, rest), &[]);
    let value = column(&bench, "cycle.csv", "value");
    assert_eq!(value.last(), Some(&0.0));
    assert!(value.windows(2).all(|own| own[0] > own[1]), "{value:?}");
    assert!(events.iter().all(|own| own.0 == "second frequency"), "{events:?}");
    // r = m e Ω²/(k − m Ω²), Ω that of the steps.
    let omega = 60.0 * (std::f64::consts::PI / 48.0).tan() / (std::f64::consts::PI / 48.0);
    let exact = 1e6 * 0.05e-3 * omega * omega / (1e4 - omega * omega);
    let most = column(&bench, "cycle.csv", "X1_um.max");
    let last = most.last().expect("points");
    assert!((last / exact - 1.0).abs() < 3e-3, "{last} for {exact}");
}

/// x″ + 0.05 x′ + x + 0.1 x³ = 0.18 cos Ωt (Krack and Gross, Harmonic Balance for Nonlinear Vibration Problems, 2019, example 01): it
/// folds at 1.2696019555 and 1.1157002518.
#[test]
fn a_duffing_oscillator_folds_where_others_find_it() {
    const CUBIC: &str = "kind = \"law\"\nname = \"cubic\"\ntitle = \"a cubic spring\"\nsource = \"Duffing\"\n\
        [inputs.e_x]\nunit = \"m\"\ntitle = \"x\"\nrange = [-5, 5]\n[inputs.e_y]\nunit = \"m\"\ntitle = \"y\"\nrange = [-5, 5]\n\
        [parameters.k]\nvalue = 0.1\nunit = \"N/m^3\"\ntitle = \"of the cube\"\n\
        [outputs.F_x]\nunit = \"N\"\ntitle = \"force\"\nvalue = '-k*e_x^3'\n\
        [outputs.F_y]\nunit = \"N\"\ntitle = \"force\"\nvalue = '-k*e_y^3'\n";
    let folds = |steps: usize| {
        let case = format!(
            "title = \"a Duffing oscillator\"\n[body.block]\nturns = \"no\"\nmass = \"1 kg\"\n\
             stiffness = {{ x = \"1 N/m\", y = \"1 N/m\" }}\ndamping = {{ x = \"0.05 N*s/m\", y = \"0.05 N*s/m\" }}\n\
             [joint.spring]\nkind = \"stop\"\njournal = {{ body = \"block\" }}\nside = \"around\"\n\
             law = \"cubic.law.toml\"\n\
             [loads.push]\nbody = \"block\"\nforce = \"0.18 N\"\nfrequency = \"0.11 Hz\"\n\
             [analysis.cycle]\nkind = \"periodic\"\nsteps = {steps}\npoints = 400\n\
             vary = \"loads.push.frequency = 0.11 Hz .. 0.24 Hz\"\n"
        );
        let (_, events) = followed(&case, &[("cubic.law.toml", CUBIC)]);
        let own = events.iter().filter(|own| own.0 == "fold").map(|own| TAU * own.1);
        let own: Vec<f64> = own.collect();
        assert_eq!(own.len(), 2, "{events:?}");
        own
    };
    let (coarse, fine) = (folds(80), folds(160));
    for ((coarse, fine), exact) in coarse.iter().zip(&fine).zip([1.2696019555, 1.1157002518]) {
        let limit = (4.0 * fine - coarse) / 3.0;
        assert!((limit - exact).abs() < 2e-6, "{limit} for {exact}: {coarse}, {fine}");
    }
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

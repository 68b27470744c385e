//! `kind = "periodic"`: motions that repeat themselves against closed forms, other programs and marches.
//!
//! Numbers without another source are those of an independent program on the same equations (harmonic balance and shooting).

use std::f64::consts::TAU;

use serde_json::Value;
use whirl_tests::validation::Section;

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

/// Without steps the radius is that of the closed form, |k + k_c (1 − c/r) − mω² + idω| r = meΩ², whatever the number of harmonics.
#[test]
fn harmonics_have_the_rub_of_the_closed_form() {
    let radius = {
        let [k, wall, gap, speed] = [1e4, 1e5, 1e-3, 110.0_f64];
        let left = |r: f64| {
            f64::hypot(k + wall * (1.0 - gap / r) - speed * speed, 20.0 * speed) * r
                - 0.5e-3 * speed * speed
        };
        let (mut low, mut high) = (1e-3, 2e-3);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if left(middle) < 0.0 { low = middle } else { high = middle }
        }
        1e6 * low
    };
    assert!((radius - 1078.2993756).abs() < 1e-6, "{radius}");
    for harmonics in [2, 7] {
        let keys = format!("steps = 90\nmethod = \"harmonic\"\nharmonics = {harmonics}\n");
        let (bench, motions) = motions(&rub(110.0, 0.5e-3, &keys));
        assert_eq!(motions[0]["stability"], "stable");
        assert_eq!(motions[0]["harmonics"]["count"], harmonics);
        let [x, y] = ["X1_um", "Y1_um"].map(|own| column(&bench, "cycle.csv", own));
        assert_eq!(x.len(), 90);
        for (x, y) in x.iter().zip(&y) {
            assert!((x.hypot(*y) / radius - 1.0).abs() < 1e-9, "{harmonics}: {}", x.hypot(*y));
        }
    }
}

/// An unbalanced rotor in a film, below its threshold: the march approaches the harmonics as Δt², and these do not change with
/// their number, which is chosen.
#[test]
fn the_march_of_a_film_approaches_its_harmonics() {
    let of = |keys: &str| {
        let (bench, motions) = motions(&film(900.0, 0.2, keys));
        let x = column(&bench, "cycle.csv", "X_film_um");
        let part = x.len() / 60;
        let x: Vec<f64> = x.into_iter().skip(part - 1).step_by(part).collect();
        (x, motions[0].clone())
    };
    let (exact, motion) = of("steps = 60\nmethod = \"harmonic\"\n");
    assert_eq!(motion["method"], "harmonic");
    assert!(number(&motion["harmonics"]["twice_as_many_change"], "displacement") < 1e-6);
    let (whole, _) = of("steps = 60\nmethod = \"harmonic\"\nharmonics = 45\n");
    let apart =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart(&exact, &whole) < 1e-6, "{}", apart(&exact, &whole));
    let steps = [120, 240].map(|steps| of(&format!("steps = {steps}\nmethod = \"shooting\"\n")).0);
    let errors = steps.each_ref().map(|own| apart(own, &exact));
    let fall = errors[0] / errors[1];
    assert!((fall - 4.0).abs() < 0.2, "{errors:?}");
    let limit: Vec<f64> =
        steps[0].iter().zip(&steps[1]).map(|(coarse, fine)| (4.0 * fine - coarse) / 3.0).collect();
    // What the fourth power of the step leaves.
    assert!(apart(&limit, &exact) < 0.02 * errors[1], "{errors:?} {}", apart(&limit, &exact));
}

/// A load 45 times a turn on a mass m between springs and dampers: F/|k − mω² + icω| at 45 times the speed. Fewer harmonics leave it
/// out, which is noted.
#[test]
fn harmonics_reach_up_to_the_loads() {
    let case = |keys: &str| {
        format!(
            "title = \"a ripple\"\ngravity = [\"0 m/s^2\", \"-9.81 m/s^2\", \"0 m/s^2\"]\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"50 rad/s\"\nmass = \"10 kg\"\n\
             polar_inertia = \"0.01 kg*m^2\"\n[joint.spring]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\ndamping = {{ xx = \"100 N*s/m\", yy = \"100 N*s/m\" }}\n\
             [loads.ripple]\nbody = \"rotor\"\ndirection = \"x\"\nforce = \"200 N\"\norder = 45\n\
             [analysis.cycle]\nkind = \"periodic\"\nsteps = 3600\nmethod = \"harmonic\"\n{keys}"
        )
    };
    let amplitude = |bench: &Workbench| {
        let x = column(bench, "cycle.csv", "X_spring_um");
        let [least, most] = [f64::min, f64::max].map(|own| x.iter().copied().fold(x[0], own));
        0.5 * (most - least)
    };
    let omega = 45.0 * 50.0_f64;
    let exact = 1e6 * 200.0 / f64::hypot(1e6 - 10.0 * omega * omega, 100.0 * omega);
    let (bench, found) = motions(&case(""));
    assert_eq!(found[0]["harmonics"]["count"], 65);
    // 80 rows a period of the load see its peak to (π/80)²/2.
    assert!((amplitude(&bench) / exact - 1.0).abs() < 1e-3, "{} {exact}", amplitude(&bench));
    let bench = Workbench::new().file("case.toml", &case("harmonics = 20\n"));
    let said = analysed(&bench).stdout;
    assert!(said.contains("20 harmonics leave out load.ripple"), "{said}");
    assert!(said.contains("differs from its harmonics by"), "{said}");
}

#[test]
fn harmonics_of_other_methods_are_refused() {
    for (keys, words) in [
        ("harmonics = 9\n", ["those of the method `harmonic`", "method = \"harmonic\""]),
        (
            "method = \"harmonic\"\nvary = \"mass.unbalance.speed = 80 rad/s .. 90 rad/s\"\n",
            ["followed over `vary` by shooting", "leave out `method`"],
        ),
    ] {
        let case = rub(110.0, 0.5e-3, keys);
        let bench = Workbench::new().file("case.toml", &case).file("wall.law.toml", WALL);
        let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        assert!(words.iter().all(|own| outcome.stderr.contains(own)), "{}", outcome.stderr);
    }
}

/// Oil whirl beyond its threshold of 989.28 rad/s as a limit cycle: period, largest and smallest eccentricity, multipliers, by another
/// program (harmonic balance with 10 and 20 harmonics, shooting extrapolated).
#[test]
fn oil_whirl_has_a_period_of_its_own() {
    let mut section = Section::new(
        "Oil whirl of a rotor in a half film: its period, and by how much changes last from one to the next",
        "Harmonic balance and shooting of our own on the same equations, extrapolated",
        "cargo test -p whirl-cli --test cli -- oil_whirl_has_a_period_of_its_own",
    );
    for (speed, period, eccentricity, multipliers) in [
        (1009.0641165576, 0.0158418320, [0.640012, 0.691919520], Some(0.96927814)),
        (1236.5981820558, 0.010188045685, [0.96455229, 0.96813862], None),
    ] {
        // Near the wall forces have corners; where the film hardly gives way the side of the half film is that of `v_0`.
        let harmonics = if eccentricity[0] < 0.9 { 20 } else { 80 };
        let keys = format!("self_excited = true\nsteps = 480\nharmonics = {harmonics}\n");
        let (bench, motions) =
            motions(&film(speed, 0.0, &keys).replace("mu = ", "v_0 = \"1e-9 mm/s\", mu = "));
        let motion = &motions[0];
        let what = format!("{speed:.3} rad/s");
        let found = number(motion, "period_s");
        section.compare(&format!("{what}: period (s)"), period, found, 1e-7);
        assert_eq!(motion["stability"], "stable");
        let [x, y] = ["X_film_um", "Y_film_um"].map(|own| column(&bench, "cycle.csv", own));
        let ratio: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x.hypot(*y) / 100.0).collect();
        let [least, most] =
            [f64::min, f64::max].map(|own| ratio.iter().copied().fold(ratio[0], own));
        // Between rows the extremes are (π/480)²/2 of what varies away at most.
        for (found, exact) in [least, most].into_iter().zip(eccentricity) {
            assert!(
                (found - exact).abs() < 1e-4 * (eccentricity[1] - eccentricity[0]) + 1e-7,
                "{found} {exact}"
            );
        }
        let file = "cycle.multipliers.csv";
        let [own, finer] =
            ["modulus", "modulus_of_half_steps"].map(|own| column(&bench, file, own));
        let of = std::fs::read_to_string(bench.path("out/cycle.multipliers.csv")).expect("a table");
        let phase = of.lines().skip(1).position(|own| own.ends_with("phase")).expect("its phase");
        let extrapolated = |k: usize| (4.0 * finer[k] - own[k]) / 3.0;
        assert!((extrapolated(phase) - 1.0).abs() < 1e-5, "{own:?} {finer:?}");
        if let Some(exact) = multipliers {
            let other = (0..own.len()).filter(|k| *k != phase).map(extrapolated);
            let largest = other.fold(0.0, f64::max);
            section.compare(&format!("{what}: multiplier"), exact, largest, 1e-5);
        }
    }
    section.finish();
}

/// ẍ − (1 − x²) ẋ + x = 0 in space, at 3 rad/s and an amplitude of a millimetre in place of one.
#[test]
fn an_oscillator_of_van_der_pol_has_its_period() {
    let mut section = Section::new(
        "Van der Pol's oscillator, µ = 1, as a mass in a bearing",
        "Amore, arXiv 2111.12198 (period); amplitude and multiplier by an integrator of eighth order",
        "cargo test -p whirl-cli --test cli -- an_oscillator_of_van_der_pol_has_its_period",
    );
    let law = "kind = \"law\"\nname = \"own\"\ntitle = \"van der Pol\"\nsource = \"closed form\"\n\
               [inputs.e_x]\nunit = \"mm\"\nrange = [-3, 3]\n[inputs.e_x_dot]\nunit = \"mm/s\"\nrange = [-9, 9]\n\
               [inputs.e_y]\nunit = \"mm\"\nrange = [-3, 3]\n[inputs.e_y_dot]\nunit = \"mm/s\"\nrange = [-9, 9]\n\
               [parameters.a]\nvalue = 1\nunit = \"mm\"\n[parameters.c]\nvalue = 3\nunit = \"N*s/m\"\n\
               [parameters.k]\nvalue = 9\nunit = \"N/m\"\n\
               [outputs.F_x]\nunit = \"mN\"\nvalue = 'c*(1 - e_x^2/a^2)*e_x_dot - k*e_x'\n\
               [outputs.F_y]\nunit = \"mN\"\nvalue = '-c*e_y_dot - k*e_y'\n";
    let case = |keys: &str| {
        format!(
            "title = \"van der Pol\"\n[body.mass]\nturns = \"no\"\nmass = \"1 kg\"\n[joint.own]\nkind = \"bearing\"\n\
             journal = {{ body = \"mass\" }}\nlaw = \"own.toml\"\n\
             [analysis.cycle]\nkind = \"periodic\"\nself_excited = true\nsteps = 360\n{keys}"
        )
    };
    let bench = Workbench::new()
        .file("own.toml", law)
        .file("case.toml", &case("near = \"0.4 Hz\"\nharmonics = 40\n"));
    analysed(&bench);
    let text = std::fs::read_to_string(bench.path("out/cycle.json")).expect("a summary");
    let motion = serde_json::from_str::<Value>(&text).expect("JSON")["motions"][0].clone();
    let period = 3.0 * number(&motion, "period_s");
    section.compare("period, over that of small motions times 2π", 6.66328685932313, period, 1e-9);
    let range = &motion["columns"]["X_own_um"];
    let amplitude = 0.5 * (number(range, "max") - number(range, "min")) / 1e3;
    // Between 360 rows the maximum is seen to (π/360)²/2.
    section.compare("amplitude", 2.008619860874837, amplitude, 1e-4);
    // Beside the phase and what y does, e^{−cT/2} twice.
    let [own, finer] = ["modulus", "modulus_of_half_steps"]
        .map(|own| column(&bench, "cycle.multipliers.csv", own));
    let exact = |k: usize| (4.0 * finer[k] - own[k]) / 3.0;
    assert!((exact(0) - 1.0).abs() < 1e-6, "{own:?} {finer:?}");
    section.compare("multiplier", 8.59695064e-4, exact(3), 1e-4);
    let across = (-0.5 * 3.0 * number(&motion, "period_s")).exp();
    assert!((exact(1) / across - 1.0).abs() < 1e-4, "{own:?} {across}");
    // Without a rotation the frequency must be told.
    let bench = Workbench::new().file("own.toml", law).file("case.toml", &case(""));
    let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("`near = "), "{}", outcome.stderr);
    section.finish();
}

#[test]
fn what_drives_a_machine_or_lets_it_die_has_no_motion_of_its_own() {
    let keys = "self_excited = true\nsteps = 120\n";
    for (speed, unbalance, keys, status, words) in [
        (
            1009.0,
            0.1,
            keys,
            2,
            ["the unbalance of rotor drives the machine", "leave out `self_excited`"],
        ),
        (900.0, 0.0, keys, 1, ["the motion dies out", "beyond the threshold"]),
        (
            900.0,
            0.0,
            "near = \"80 Hz\"\n",
            2,
            ["of a motion that is `self_excited`", "leave it out"],
        ),
        (
            900.0,
            0.0,
            "self_excited = true\nmethod = \"shooting\"\n",
            2,
            ["found by their harmonics", "leave out `method`"],
        ),
    ] {
        let bench = Workbench::new().file("case.toml", &film(speed, unbalance, keys));
        let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, status, "{}", outcome.stderr);
        assert!(
            words.iter().all(|own| outcome.stderr.contains(own)),
            "{words:?}: {}",
            outcome.stderr
        );
    }
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

/// Rub A: contact all around begins at 93.93 rad/s, the motion in contact folds at 287.17 and is unstable back to 109.62, where contact
/// ends all around and the branch with it, of N = 48 steps a turn, by the closed form with ω̃.
#[test]
fn a_rub_is_followed_through_its_fold_to_where_contact_ends() {
    let case = rub(
        80.0,
        0.25e-3,
        "steps = 48\nvary = \"mass.unbalance.speed = 80 rad/s .. 320 rad/s\"\npoints = 400\n",
    );
    let (bench, events) = followed(&case, &[]);
    let folds: Vec<f64> = events.iter().filter(|own| own.0 == "fold").map(|own| own.1).collect();
    assert_eq!(folds.len(), 1, "{events:?}");
    assert!((folds[0] / 287.1673208443 - 1.0).abs() < 1e-8, "{folds:?}");
    let value = column(&bench, "cycle.csv", "value");
    let most = column(&bench, "cycle.csv", "X1_um.max");
    let last = value.last().expect("points");
    assert!((last / 109.6170957619 - 1.0).abs() < 1e-5, "{last}");
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
    assert!(least.fold(f64::INFINITY, f64::min) < 110.5);
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

/// Without steps: 44 harmonics of the reference machine, peaks over 720 rows.
#[test]
fn the_reference_machine_has_the_harmonics_of_another_program() {
    let mut section = Section::new(
        "The reference machine at 4500 rpm without steps: 44 harmonics",
        "Harmonic balance of our own on the same equations, 240 harmonics at 720 instants; its peaks to 1e-4, those along y to 2e-4",
        "cargo test -p whirl-cli --test cli -- the_reference_machine_has_the_harmonics_of_another_program",
    );
    let case = "include = \"hu2003-5.toml\"\ntitle = \"at constant speed\"\n\
                [analysis.cycle]\nkind = \"periodic\"\nspeeds = \"4500 rpm\"\nsteps = 720\ncount = 12\n\
                method = \"harmonic\"\nharmonics = 44\n";
    let bench = Workbench::new().file("case.toml", case);
    let outcome = bench.whirl(&["analyse", "case.toml", "cycle", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    for (column_of, unit, all, tolerance) in [
        ("RX", "N", [402.197, 1119.600, 1119.600, 402.195], 1e-3),
        ("RY", "N", [1.8814, 1.9572, 1.9579, 1.8785], 1e-3),
        ("X", "um", [6.812, 24.094, 24.094, 6.812], 2e-3),
    ] {
        for (place, exact) in all.into_iter().enumerate() {
            let name = format!("{column_of}{}_{unit}", place + 1);
            let own = column(&bench, "cycle.csv", &name);
            let most = own.into_iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            section.compare(&format!("largest magnitude of {name}"), exact, most, tolerance);
        }
    }
    section.finish();
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

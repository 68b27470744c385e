//! Motions as sums of harmonics, and those with a period of their own: against closed forms, other programs and the march.

use serde_json::Value;
use whirl_tests::validation::Section;

use super::{WALL, analysed, column, film, motions, number, rub};
use crate::workbench::Workbench;

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
/// out and are refused.
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
    for command in ["analyse", "check"] {
        let said = bench.whirl(&[command, "case.toml"]);
        assert_eq!(said.status, if command == "check" { 0 } else { 2 }, "{}", said.stderr);
        for words in ["20 harmonics leave out load.ripple", "45 times", "`harmonics = 45`"] {
            assert!(said.stderr.contains(words), "{command}, {words}: {}", said.stderr);
        }
    }
}

/// One harmonic is all that a mass with an unbalance on linear springs has: e r²/|1 − r² + 2iζr|, r = ω/ω_n.
#[test]
fn one_harmonic_is_enough_for_a_linear_mass() {
    let case = "title = \"linear\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\ndamping = \"20 N*s/m\"\n\
                [mass.unbalance]\neccentricity = \"0.1 mm\"\nspeed = \"50 rad/s\"\n\
                [output.mass]\nquantity = \"displacement\"\nbody = \"mass\"\n\
                [analysis.cycle]\nkind = \"periodic\"\nmethod = \"harmonic\"\nharmonics = 1\nsteps = 400\n";
    let (bench, found) = motions(case);
    assert_eq!(found[0]["harmonics"]["count"], 1);
    let most = column(&bench, "cycle.csv", "x_mass_um").into_iter().fold(0.0, f64::max);
    let exact = 100.0 * 0.25 / f64::hypot(1.0 - 0.25, 2.0 * 0.1 * 0.5);
    assert!((most / exact - 1.0).abs() < 1e-4, "{most} {exact}");
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
        // What acts on the machine is seen before a search.
        let said = bench.whirl(&["check", "case.toml"]);
        assert_eq!(said.stderr.contains(words[0]), status == 2, "{}", said.stderr);
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

/// A rigid rotor of 10 kg in a half film at 14,000 rpm, beyond its threshold of 11,652 rpm: the march grows slowly into a whirl near the
/// wall, of 8.5717 ms by an integrator of another program.
#[test]
fn a_whirl_that_grows_slowly_is_waited_for() {
    let case = "title = \"a film\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n\
         [body.rotor]\nturns = \"prescribed\"\nspeed = \"14000 rpm\"\nmass = \"10 kg\"\npolar_inertia = \"0.02 kg*m^2\"\n\
         [joint.film]\nkind = \"bearing\"\njournal = { body = \"rotor\" }\nlaw = \"ocvirk\"\nradial_clearance = \"50 um\"\n\
         journal_radius = \"25 mm\"\nlength = \"20 mm\"\n[analysis.cycle]\nkind = \"periodic\"\nself_excited = true\ncycles = 2000\n";
    let (_, motions) = motions(case);
    let period = number(&motions[0], "period_s");
    assert!((period / 8.5717e-3 - 1.0).abs() < 2e-5, "{period}");
}

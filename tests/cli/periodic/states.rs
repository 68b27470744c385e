//! Motions of machines whose laws remember: states and films close with the cycle.

use std::f64::consts::{PI, TAU};

use super::{column, followed, motions};
#[cfg(unix)]
use crate::lost_work::Running;
use crate::workbench::Workbench;

/// A mass on a mount that relaxes, shaken at 120 Hz.
fn mount(keys: &str) -> String {
    format!(
        "title = \"a mass on a mount\"\n[body.p]\nturns = \"no\"\nmass = \"2 kg\"\n[joint.m]\nkind = \"bearing\"\n\
         journal = {{ body = \"p\" }}\nlaw = \"zener-mount\"\n[loads.f]\nbody = \"p\"\n\
         force = [\"50 N\", \"0 N\", \"0 N\"]\nfrequency = \"120 Hz\"\n[analysis.cycle]\nkind = \"periodic\"\n{keys}"
    )
}

/// A rotor of 6 kg in a magnetic bearing, with an unbalance (g at 20 mm).
fn magnetic(unbalance: f64, derivative: f64, keys: &str) -> String {
    format!(
        "title = \"a magnetic bearing\"\n[body.r]\nturns = \"prescribed\"\nspeed = \"6000 rpm\"\nmass = \"6 kg\"\n\
         polar_inertia = \"0.01 kg*m^2\"\nunbalance.u = {{ mass = \"{unbalance} g\", radius = \"20 mm\" }}\n[joint.b]\n\
         kind = \"bearing\"\njournal = {{ body = \"r\" }}\nlaw = \"magnetic-bearing\"\n\
         parameters = {{ D = \"{derivative} ms/mm\" }}\n[analysis.cycle]\n{keys}"
    )
}

/// A rotor of 30 kg in a film that carries its fill, at 3000 rpm.
fn oiled(rest: &str) -> String {
    format!(
        "title = \"a film\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n[body.r]\nturns = \"prescribed\"\n\
         speed = \"3000 rpm\"\nmass = \"30 kg\"\npolar_inertia = \"0.1 kg*m^2\"\n\
         unbalance.u = {{ mass = \"20 g\", radius = \"30 mm\" }}\n[joint.b]\nkind = \"bearing\"\njournal = {{ body = \"r\" }}\n\
         law = \"jfo\"\nradial_clearance = \"60 um\"\njournal_radius = \"25 mm\"\nlength = \"25 mm\"\n\
         film = {{ grid = [24, 5], left = \"1 bar\", right = \"1 bar\" }}\n[start]\nkind = \"equilibrium\"\n{rest}"
    )
}

/// Trapezoidal steps of a linear machine have the amplitude of ω̃ = (2/Δt) tan(π/N), and multipliers ((1 + sΔt/2)/(1 − sΔt/2))ᴺ of the
/// roots s of (ms² + k)(1 + τs) + k_m τs = 0, exactly.
#[test]
fn a_mount_that_relaxes_is_that_of_the_closed_form() {
    const STEPS: usize = 90;
    let [m, k, k_m, tau, force] = [2.0, 2e6, 1e6, 2e-3, 50.0];
    let dt = 1.0 / 120.0 / STEPS as f64;
    let speed = 2.0 / dt * (PI / STEPS as f64).tan();
    // k_m iωτ/(1 + iωτ), real and imaginary.
    let turn = speed * tau;
    let relaxing = [turn * turn, turn].map(|own| k_m * own / (1.0 + turn * turn));
    let amplitude = force / f64::hypot(k + relaxing[0] - m * speed * speed, relaxing[1]);
    for method in ["shooting", "accelerated"] {
        let keys = format!("steps = {STEPS}\nmethod = \"{method}\"\n");
        let (bench, found) = motions(&mount(&keys));
        assert_eq!(found[0]["stability"], "stable", "{method}");
        let x = column(&bench, "cycle.csv", "X_m_um");
        let wave = |shift: f64| -> f64 {
            let turned = |n: usize| (TAU * n as f64 / STEPS as f64 + shift).cos();
            x.iter().enumerate().map(|(n, x)| x * turned(n)).sum::<f64>() * 2.0 / STEPS as f64
        };
        let own = 1e-6 * wave(0.0).hypot(wave(0.5 * PI));
        assert!((own / amplitude - 1.0).abs() < 1e-9, "{method}: {own} for {amplitude}");
        // The real root by Newton's method; what is left of the polynomial is s² + ps + q.
        let [a, b, c, d] = [m * tau, m, (k + k_m) * tau, k];
        let root = (0..50).fold(-d / c, |s, _| {
            s - (((a * s + b) * s + c) * s + d) / ((3.0 * a * s + 2.0 * b) * s + c)
        });
        let p = b / a + root;
        let q = -d / a / root;
        let [real, imaginary] = [-0.5 * p, (q - 0.25 * p * p).sqrt()].map(|own| 0.5 * dt * own);
        let of_pair = ((1.0 + real).hypot(imaginary) / (1.0 - real).hypot(imaginary)).powi(90);
        let of_root = ((1.0 + 0.5 * dt * root) / (1.0 - 0.5 * dt * root)).powi(90);
        let moduli = column(&bench, "cycle.multipliers.csv", "modulus");
        assert_eq!(moduli.len(), 6, "{moduli:?}");
        for (own, exact) in moduli.iter().zip([[of_pair; 4].as_slice(), &[of_root; 2]].concat()) {
            assert!((own - exact).abs() < 1e-8, "{method}: {own} for {exact}");
        }
    }
}

/// With little unbalance the cycle loses its stability where the linear analysis says, to a second frequency: trapezoidal steps have
/// multipliers on the unit circle where exponents are imaginary.
#[test]
fn a_magnetic_bearing_wanders_from_its_linear_threshold_on() {
    let keys =
        "kind = \"periodic\"\nsteps = 60\nvary = \"joint.b.parameters.D = 2 ms/mm .. 0.8 ms/mm\"\n";
    let (_, events) = followed(&magnetic(0.01, 5.0, keys), &[]);
    assert_eq!(events.len(), 1, "{events:?}");
    let (kind, threshold) = &events[0];
    assert_eq!(kind, "second frequency");
    let decrement = |derivative: f64| {
        let case = magnetic(0.01, derivative, "kind = \"modes\"\n");
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["analyse", "case.toml"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let first = |line: &&str| line.split_whitespace().next() == Some("1");
        let mode = outcome.stdout.lines().find(first).expect("a mode");
        mode.split_whitespace().nth(3).expect("a decrement").parse::<f64>().expect("a number")
    };
    let [below, above] = [0.999, 1.001].map(|part| decrement(part * threshold));
    assert!(below < 0.0 && above > 0.0, "{threshold}: {below} and {above}");
}

/// The cycle of a film with cavities is that in which its march ends.
#[test]
fn a_film_closes_its_cycle_where_the_march_ends() {
    let rest =
        "[march]\ntime_step = \"0.25 ms\"\nsteps = 2400\n[analysis.cycle]\nkind = \"periodic\"\n";
    let (bench, found) = motions(&oiled(rest));
    assert_eq!(found[0]["stability"], "stable");
    let outcome = bench.whirl(&["run", "case.toml", "--out", "marched", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let text = std::fs::read_to_string(bench.path("marched/history.csv")).expect("a history");
    for name in ["X_b_um", "Y_b_um"] {
        let place = text.lines().next().expect("a head").split(',').position(|own| own == name);
        let place = place.expect("a column");
        let cell = |line: &str| line.split(',').nth(place).expect("a cell").parse::<f64>();
        let marched: Vec<f64> =
            text.lines().skip(1).map(|line| cell(line).expect("a number")).collect();
        let own = column(&bench, "cycle.csv", name);
        let last = &marched[marched.len() - own.len()..];
        let size = own.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        let apart = own.iter().zip(last).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(own.len() == 80 && apart < 1e-6 * size, "{name}: {apart} of {size}");
    }
}

#[test]
fn where_states_do_not_close_is_said() {
    let refused = |case: &str, words: [&str; 2]| {
        let bench = Workbench::new().file("case.toml", case);
        let before = bench.listing();
        let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 2, "{} {}", outcome.stdout, outcome.stderr);
        for word in words {
            assert!(outcome.stderr.contains(word), "{word}: {}", outcome.stderr);
        }
        assert_eq!(bench.listing(), before);
    };
    let remembers = "zener-mount, which has states: harmonics are balanced of motions only";
    refused(&mount("method = \"harmonic\"\n"), [remembers, "`method = \"accelerated\"`"]);
    let balanced = magnetic(0.0, 5.0, "kind = \"periodic\"\nself_excited = true\n");
    refused(
        &balanced.replace("unbalance.u = { mass = \"0 g\", radius = \"20 mm\" }\n", ""),
        ["which has states", "march it until it repeats itself"],
    );
    let keys =
        "[analysis.cycle]\nkind = \"periodic\"\nvary = \"body.r.speed = 3000 rpm .. 4000 rpm\"\n";
    let fine = oiled(keys).replace("[24, 5]", "[48, 7]");
    refused(&fine, ["remember 336 values", "`speeds`"]);
}

/// An analysis that is ended before it came to anything has failed by no fault of its case, and leaves nothing.
#[cfg(unix)]
#[test]
fn what_is_interrupted_before_anything_is_found_says_so() {
    let keys = "[analysis.cycle]\nkind = \"periodic\"\nsteps = 3600\n";
    let case = oiled(keys).replace("[24, 5]", "[96, 9]");
    let bench = Workbench::new().file("case.toml", &case);
    let before = bench.listing();
    let running = Running::start(&bench, &["analyse", "case.toml", "--out", "out"]);
    std::thread::sleep(std::time::Duration::from_secs(3));
    running.signal("INT");
    let (status, said) = running.end();
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("interrupted before anything was found"), "{said}");
    assert!(!said.contains("E004"), "{said}");
    assert_eq!(bench.listing(), before);
}

/// In the middle of its film nothing tilts a rotor that could: the moment is what rounding leaves of its pressures.
#[test]
fn a_rotor_that_nothing_tilts_has_its_cycle() {
    let case = "title = \"a rotor that could tilt\"\ngravity = [\"-40 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n[body.rotor]\n\
                turns = \"prescribed\"\nspeed = \"1000 rpm\"\nmass = \"60 kg\"\npolar_inertia = \"0.3 kg*m^2\"\n\
                transverse_inertia = \"2.5 kg*m^2\"\nz = \"0 mm\"\n\
                unbalance.disc = { mass = \"5 g\", radius = \"50 mm\", z = \"0 mm\" }\n[joint.b]\nkind = \"bearing\"\n\
                journal = { body = \"rotor\", z = \"0 mm\" }\nlaw = \"reynolds\"\nparameters = { mu_0 = \"20 mPa*s\" }\n\
                radial_clearance = \"75 um\"\njournal_radius = \"30 mm\"\nlength = \"30 mm\"\n\
                film = { grid = [24, 5], left = \"open\", right = \"open\" }\n[start]\nkind = \"equilibrium\"\n\
                [analysis.pe]\nkind = \"periodic\"\nsteps = 60\n";
    let bench = Workbench::new().file("case.toml", case);
    let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("verdict: sound"), "{}", outcome.stdout);
}

/// A law that counts the time: nothing closes that, however little of it a cycle is.
#[test]
fn a_clock_has_no_cycle() {
    let law = "kind = \"law\"\nname = \"clock\"\ntitle = \"a spring and a clock\"\nsource = \"own\"\nstored = 'k*e_x^2/2 + p*t'\n\
               [inputs.e_x]\nunit = \"m\"\nrange = [-1e-3, 1e-3]\n[inputs.e_y]\nunit = \"m\"\nrange = [-1e-3, 1e-3]\n\
               [parameters.k]\nvalue = 1e5\nunit = \"N/m\"\n[parameters.p]\nvalue = 1\nunit = \"J/s\"\n[states.t]\nunit = \"s\"\nstart = 0\nrange = [0, 1]\n[rates]\nt = '1'\n\
               [outputs.F_x]\nunit = \"N\"\nvalue = '-k*e_x'\n[outputs.F_y]\nunit = \"N\"\nvalue = '-k*e_y'\n";
    let case = "title = \"a clock\"\n[body.r]\nturns = \"prescribed\"\nspeed = \"6000 rpm\"\nmass = \"4 kg\"\n\
                polar_inertia = \"0.01 kg*m^2\"\nunbalance.u = { mass = \"1 g\", radius = \"20 mm\" }\n\
                [joint.k]\nkind = \"bushing\"\nfirst = { body = \"r\" }\nstiffness = { xx = \"1e6 N/m\", yy = \"1e6 N/m\" }\n\
                damping = { xx = \"400 N*s/m\", yy = \"400 N*s/m\" }\n\
                [joint.b]\nkind = \"bearing\"\njournal = { body = \"r\" }\nlaw = \"clock.toml\"\nradial_clearance = \"1 mm\"\n\
                [analysis.cycle]\nkind = \"periodic\"\ncycles = 60\n";
    let bench = Workbench::new().file("case.toml", case).file("clock.toml", law);
    let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out"]);
    assert_eq!(outcome.status, 1, "{} {}", outcome.stdout, outcome.stderr);
    assert!(outcome.stderr.contains("no periodic motion was found"), "{}", outcome.stderr);
}

//! Whether the results of a run can be believed, and whether it is steady.

use std::fs;

use crate::workbench::{SHORT, Workbench};

#[test]
fn shipped_masses_are_sound() {
    for case in ["sdnd101", "sdnd108", "annular-rub"] {
        let bench = Workbench::new();
        let outcome = bench.whirl(&["run", case, "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let verdict = &bench.summary(&format!("results/{case}"))["verdict"];
        assert_eq!(verdict["sound"], true, "{case}: {verdict}");
    }
}

/// The case of `steps` of a mass between two stops of 1e9 N/m at 50 mm.
fn between_stops(time_step: &str) -> String {
    let stop = |side: &str| {
        format!("[[stop]]\nside = \"{side}\"\ngap = \"50 mm\"\nlaw = \"stiff.toml\"\n")
    };
    format!(
        "title = \"a mass between stops\"\n[mass]\nmass = \"1 kg\"\nvelocity = \"-1 m/s\"\nforce = \"-10 N\"\n\
         {}{}[march]\ntime_step = \"{time_step}\"\nduration = \"0.2 s\"\n",
        stop("above"),
        stop("below")
    )
}

const STIFF: &str = "kind = \"law\"\nname = \"stiff\"\ntitle = \"A stiff stop\"\nsource = \"a test\"\n\
     [inputs.h]\nunit = \"mm\"\nrange = [-0.1, 1]\n[parameters.k]\nvalue = 1e9\nunit = \"N/m\"\n\
     [outputs.Q]\nunit = \"N\"\npieces = [{ when = 'h < 0', value = '-k*h' }, { value = '0' }]\n";

#[test]
fn a_stop_that_the_step_does_not_resolve_is_reported_with_a_remedy_that_serves() {
    let bench =
        Workbench::new().file("stiff.toml", STIFF).file("case.toml", &between_stops("1e-3 s"));
    let outcome = bench.whirl(&["run", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("verdict: NOT SOUND"), "{}", outcome.stdout);
    let verdict = &bench.summary("results/case")["verdict"];
    assert_eq!(verdict["sound"], false);
    let found = &verdict["findings"][0];
    let number = |key: &str| found[key].as_f64().expect("a number");
    assert!(number("value") > number("limit"), "{found}");
    assert!(found["what"].as_str().expect("a text").contains("energy"), "{found}");
    let svg = fs::read_to_string(bench.path("results/case/displacement.svg")).expect("a figure");
    assert!(svg.contains("NOT SOUND"));
    // The step that the remedy names.
    let remedy = found["remedy"].as_str().expect("a text");
    let step = remedy.split('"').nth(1).expect("a step");
    let bench = bench.file("case.toml", &between_stops(step));
    let outcome = bench.whirl(&["run", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("verdict: sound"), "{}", outcome.stdout);
    assert_eq!(bench.summary("results/case")["verdict"]["sound"], true);
    let svg = fs::read_to_string(bench.path("results/case/displacement.svg")).expect("a figure");
    assert!(!svg.contains("NOT SOUND"));
}

/// A cycle that never ends twice, by its own frequency or by the shortness of the steps, is not searched for: of its
/// forces, which would take terabytes, none are kept.
#[test]
fn a_run_of_too_few_cycles_is_not_checked_for_a_steady_state() {
    let mass = "title = \"a long cycle\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\nforce = \"1 N\"\n\
                [[stop]]\nside = \"above\"\ngap = \"0.1 mm\"\nlaw = \"gap-linear-1e6\"\n\
                [march]\ntime_step = \"1e-4 s\"\nsteps = 20\ncycle_frequency = \"1e-9 Hz\"\n";
    let short = SHORT.replace("[march]", "[march]\ntime_step = \"1e-9 s\"");
    let bench = Workbench::new().file("mass.toml", mass).file("short.toml", &short);
    for name in ["mass", "short"] {
        let file = format!("{name}.toml");
        let outcome = bench.whirl(&["run", &file, "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let cycles = if name == "mass" { "17 cycles" } else { "two cycles" };
        let words = format!("for a steady state: the run is shorter than {cycles}");
        assert!(outcome.stdout.contains(&words), "{}", outcome.stdout);
        let steady = &bench.summary(&format!("results/{name}"))["steady_state"];
        assert_eq!((&steady["checked"], &steady["reached"]), (&false.into(), &false.into()));
        let checked = bench.whirl(&["check", &file]).stdout;
        assert!(checked.contains(&format!("shorter than {cycles}")), "{checked}");
    }
    // So many can be compared, or two.
    let long = mass.replace("1e-9 Hz", "1000 Hz").replace("1e-4 s", "1e-5 s");
    for (steps, test) in [(1700, ""), (200, "steady_test = \"one-cycle\"\n")] {
        let case = long.replace("steps = 20\n", &format!("steps = {steps}\n")) + test;
        let bench = Workbench::new().file("long.toml", &case);
        let outcome = bench.whirl(&["run", "long.toml", "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let steady = &bench.summary("results/long")["steady_state"];
        assert_eq!(steady["checked"], true);
        assert_eq!(steady.get("left").is_some(), test.is_empty(), "{steady}");
        let short = case.replace(&format!("steps = {steps}"), &format!("steps = {}", steps - 1));
        let bench = Workbench::new().file("long.toml", &short);
        assert!(bench.whirl(&["check", "long.toml"]).stdout.contains("not checked"), "{short}");
    }
}

/// A rotor at its resonance, whose amplitude grows to e/2ζ: a cycle repeats the one before to 1 % long before.
#[test]
fn a_resonance_that_still_grows_is_not_steady() {
    for (damping, zeta) in [("0.6 N*s/m", 3e-3_f64), ("2 N*s/m", 1e-2), ("10 N*s/m", 0.05)] {
        let case = |more: &str| {
            format!(
                "title = \"m\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\ndamping = \"{damping}\"\n\
                 unbalance = {{ eccentricity = \"1 um\", speed = \"100 rad/s\" }}\n\
                 [[stop]]\nside = \"above\"\ngap = \"100 mm\"\nlaw = \"gap-linear-1e6\"\n\
                 [march]\ntime_step = \"1e-3 s\"\nduration = \"60 s\"\nstop_when_steady = true\n{more}"
            )
        };
        let bench = Workbench::new()
            .file("case.toml", &case(""))
            .file("paper.toml", &case("steady_test = \"one-cycle\"\n"));
        let ends = ["case", "paper"].map(|name| {
            let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--no-figures"]);
            assert_eq!(outcome.status, 0, "{}", outcome.stderr);
            let history = bench.history(&format!("results/{name}"));
            let place = history.column("X1_um");
            // The last sixty-three steps are a cycle.
            place[place.len() - 63..].iter().fold(0.0_f64, |most, x| most.max(x.abs()))
        });
        let summary = bench.summary("results/case");
        let left = summary["steady_state"]["left"].as_f64().expect("left");
        assert!(left < 0.01 && summary["march"]["complete"] == true, "{summary}");
        // The trapezoidal rule turns 100 rad/s into tan(0.05)/0.05 of it.
        let detuned = (0.05_f64.tan() / 0.05).powi(2) - 1.0;
        let exact = 1.0 / (detuned.powi(2) + (2.0 * zeta).powi(2)).sqrt();
        assert!((ends[0] / exact - 1.0).abs() < 0.02, "ζ = {zeta}: {} for {exact}", ends[0]);
        assert!(zeta > 0.02 || ends[1] < 0.9 * exact, "ζ = {zeta}: {} for {exact}", ends[1]);
    }
}

/// A body near its resonance that no joint sees: its own motion tells that it still changes.
#[test]
fn a_body_without_joints_is_steady_when_its_motion_is() {
    let case = "title = \"m\"\n[body.m]\nturns = \"no\"\nmass = \"1 kg\"\n\
                stiffness = { x = \"98696 N/m\", y = \"1e5 N/m\" }\ndamping = { x = \"3 N*s/m\", y = \"3 N*s/m\" }\n\
                [loads.p]\nbody = \"m\"\nforce = \"1 N\"\nfrequency = \"51 Hz\"\n\
                [output.p]\nquantity = \"displacement\"\nbody = \"m\"\n\
                [march]\ntime_step = \"1e-4 s\"\nduration = \"40 s\"\nstop_when_steady = true\n";
    let bench = Workbench::new().file("case.toml", case);
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("results/case");
    let (time, moved) = (history.column("t_s"), history.column("x_p_um"));
    // 51 Hz of 1e-4 s, and what the trapezoidal rule makes of it.
    let omega = 2e4 * (51.0 * std::f64::consts::PI * 1e-4).tan();
    let exact = 1e6 / (98696.0 - omega * omega).hypot(3.0 * omega);
    let last = moved[moved.len() - 200..].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!((last / exact - 1.0).abs() < 0.02, "{last} for {exact}");
    // e^{−1.5 t} is 1 % after 3 s.
    let end = time.last().copied().unwrap_or(0.0);
    assert!((2.0..10.0).contains(&end), "{end}");
    let left = bench.summary("results/case")["steady_state"]["left"].as_f64().expect("left");
    assert!(left > 0.0 && left < 0.01, "{left}");
}

/// A ring of 10 mg on a bushing that would stop it in a nanosecond, pushed by 10 N: the bushing carries 10 N, and Newmark's method
/// swings about that for ever.
#[test]
fn ringing_is_a_finding_and_has_a_cure() {
    let case = |more: &str| {
        format!(
            "title = \"x\"\n[body.ring]\nturns = \"no\"\nmass = \"1e-5 kg\"\n[joint.d]\nkind = \"bushing\"\n\
             first = {{ body = \"ring\" }}\nstiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n\
             damping = {{ xx = \"1e4 N*s/m\", yy = \"1e4 N*s/m\" }}\n[loads.f]\nbody = \"ring\"\nforce = \"10 N\"\n\
             [march]\n{more}"
        )
    };
    let damped = "integrator = \"generalized-alpha\"\n";
    let fixed = "time_step = \"1e-4 s\"\nsteps = 2000\n";
    let bench = Workbench::new()
        .file("rings.toml", &case(fixed))
        .file("damped.toml", &case(&format!("{fixed}{damped}")))
        .file("soft.toml", &case(&format!("{fixed}{damped}spectral_radius = 0.5\n")));
    let run = |name: &str| {
        let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let summary = bench.summary(&format!("results/{name}"));
        let history = bench.history(&format!("results/{name}"));
        (outcome.stdout, summary, history.column("RX_d_N").to_vec())
    };
    let (said, summary, force) = run("rings");
    assert_eq!(summary["verdict"]["sound"], false, "{said}");
    assert!(said.contains("part of a force that alternates from step to step"), "{said}");
    assert!(
        said.contains("(at joint d)") && said.contains("integrator = \"generalized-alpha\""),
        "{said}"
    );
    assert!(summary["verdict"]["measures"]["ringing"].as_f64().expect("a share") > 0.3);
    assert!((force[1999] - force[1998]).abs() > 10.0, "{} {}", force[1998], force[1999]);
    for (name, radius) in [("damped", 0.9), ("soft", 0.5)] {
        let (said, summary, force) = run(name);
        assert_eq!(summary["verdict"]["sound"], true, "{said}");
        assert_eq!(summary["march"]["spectral_radius"], radius);
        // What is left of the first swing of 10 N after 300 steps, and what a row may have, 5e-7 of its largest term.
        let left = 10.0 * f64::powi(radius, 300) + 1e-5;
        assert!(force[300..].iter().all(|own| (own + 10.0).abs() <= left), "{name}");
    }
    let refused = bench.file("wrong.toml", &case(&format!("{fixed}spectral_radius = 0.5\n")));
    let outcome = refused.whirl(&["check", "wrong.toml"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("has no effect on Newmark's method"), "{}", outcome.stderr);
}

/// A rotor on a motor whose couple falls by 95.5 N·m a rad/s, under a load of 50 N·m: it slips by half of what it has, and the
/// motor swings by kilowatts about that.
#[test]
fn a_stiff_table_of_speeds_rings() {
    let case = |more: &str| {
        format!(
            "title = \"x\"\n[body.r]\nturns = \"free\"\ninitial_speed = \"3000 rpm\"\nmass = \"1 kg\"\n\
             polar_inertia = \"0.001 kg*m^2\"\n[joint.b]\nkind = \"bushing\"\nfirst = {{ body = \"r\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n[drives.d]\nbody = \"r\"\ntable = \"t.csv\"\n\
             [loads.q]\nbody = \"r\"\ncouple = \"-50 N*m\"\n[march]\ntime_step = \"1e-3 s\"\nsteps = 500\n{more}"
        )
    };
    let bench = Workbench::new()
        .file("t.csv", "speed [rpm], couple [N*m]\n0,10\n2900,1000\n3100,-1000\n")
        .file("rings.toml", &case(""))
        .file("damped.toml", &case("integrator = \"generalized-alpha\"\n"));
    for (name, sound) in [("rings", false), ("damped", true)] {
        let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let summary = bench.summary(&format!("results/{name}"));
        assert_eq!(summary["verdict"]["sound"], sound, "{}", outcome.stdout);
        if sound {
            let speed = bench.history(&format!("results/{name}")).last("omega_rad_s");
            // 2995 rpm, by the slope of the table.
            let exact = std::f64::consts::TAU / 60.0 * 2995.0;
            assert!((speed / exact - 1.0).abs() < 1e-8, "{speed} for {exact}");
        } else {
            assert!(outcome.stdout.contains("(rotation of r)"), "{}", outcome.stdout);
        }
    }
}

//! Ranges of few speeds: critical speeds and thresholds are those of many.

use super::{column, numbers, ran};
use crate::workbench::Workbench;

/// A rigid rotor with a disc's inertia in two bushings of unlike stiffness.
fn rotor(scale: f64) -> String {
    let joint = |name: &str, z: f64, [kx, ky, cx, cy]: [f64; 4]| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"r\", z = \"{z} mm\" }}\n\
             stiffness = {{ xx = \"{kx:?} N/m\", yy = \"{ky:?} N/m\" }}\n\
             damping = {{ xx = \"{cx:?} N*s/m\", yy = \"{cy:?} N*s/m\" }}\n"
        )
    };
    let stiff = |k: f64| k * scale;
    let damp = |c: f64| c * scale.sqrt();
    format!(
        "title = \"a rotor\"\n[body.r]\nturns = \"prescribed\"\nspeed = \"6000 rpm\"\nmass = \"10 kg\"\n\
         polar_inertia = \"0.2 kg*m^2\"\ntransverse_inertia = \"0.12 kg*m^2\"\nz = \"100 mm\"\n{}{}",
        joint("l", 0.0, [stiff(2e6), stiff(3e6), damp(300.0), damp(500.0)]),
        joint("r", 250.0, [stiff(3e6), stiff(2e6), damp(200.0), damp(350.0)])
    )
}

/// Critical speeds (rpm), ascending.
fn criticals(bench: &Workbench, speeds: &str) -> Vec<f64> {
    let arguments = ["--speeds", speeds, "--orders", "0.5,1,2", "--out", "out", "--no-figures"];
    ran(bench, &[&["campbell", "case.toml"][..], &arguments].concat());
    let what = column(bench, "out/campbell.critical.csv", "what");
    let speeds = numbers(bench, "out/campbell.critical.csv", "speed_rpm");
    let critical = what.iter().zip(speeds).filter(|own| own.0 == "critical speed");
    let mut all: Vec<f64> = critical.map(|own| own.1).collect();
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn few_speeds_show_the_critical_speeds_of_many() {
    for (scale, last) in [(1.0, 30_000.0), (1.0, 100_000.0), (0.01, 75_000.0)] {
        let bench = Workbench::new().file("case.toml", &rotor(scale));
        let fine = criticals(&bench, &format!("0 rpm .. {last} rpm, 301"));
        assert!(fine.len() >= 7, "{fine:?}");
        for count in [2, 3, 6, 31] {
            let coarse = criticals(&bench, &format!("0 rpm .. {last} rpm, {count}"));
            assert_eq!(coarse.len(), fine.len(), "{count} speeds: {coarse:?}, not {fine:?}");
            for (own, known) in coarse.iter().zip(&fine) {
                assert!((own / known - 1.0).abs() < 1e-7, "{count} speeds: {own}, not {known}");
            }
        }
    }
}

/// Between speeds at which it is stable a mode grows where it is critical: then it is not stable from one to the other.
#[test]
fn a_mode_that_grows_where_it_is_critical_has_thresholds() {
    let case = "title = \"a fan\"\n[body.r]\nturns = \"prescribed\"\nspeed = \"27622 rpm\"\nmass = \"15.2 kg\"\n\
                polar_inertia = \"0.2078 kg*m^2\"\ntransverse_inertia = \"0.1789 kg*m^2\"\nz = \"100 mm\"\n\
                [joint.j0]\nkind = \"bushing\"\nfirst = { body = \"r\", z = \"-32.62 mm\" }\n\
                stiffness = { xx = \"1.48128e6 N/m\", xy = \"-100696 N/m\", yx = \"62976.3 N/m\", yy = \"1.11199e6 N/m\" }\n\
                damping = { xx = \"213.96 N*s/m\", yy = \"261.271 N*s/m\" }\n\
                [joint.j1]\nkind = \"bushing\"\nfirst = { body = \"r\", z = \"317.3 mm\" }\n\
                stiffness = { xx = \"1.96291e6 N/m\", xy = \"-37695.4 N/m\", yx = \"38741.4 N/m\", yy = \"1.18165e6 N/m\" }\n\
                damping = { xx = \"29.0817 N*s/m\", yy = \"23.4936 N*s/m\" }\n";
    let bench = Workbench::new().file("case.toml", case);
    let thresholds = |count: usize| {
        let speeds = format!("0 rpm .. 27622 rpm, {count}");
        criticals(&bench, &speeds);
        let what = column(&bench, "out/campbell.critical.csv", "what");
        let speeds = numbers(&bench, "out/campbell.critical.csv", "speed_rpm");
        let mut all: Vec<(f64, String)> =
            (speeds.into_iter().zip(what)).filter(|own| own.1 != "critical speed").collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    };
    let fine = thresholds(31);
    assert_eq!(fine.len(), 3, "{fine:?}");
    let coarse = thresholds(3);
    assert_eq!(coarse.len(), 3, "{coarse:?}");
    for (own, known) in coarse.iter().zip(&fine) {
        assert!((own.0 / known.0 - 1.0).abs() < 1e-7 && own.1 == known.1, "{coarse:?} {fine:?}");
    }
}

/// What is fixed in one body and goes by the angle of another has orders of neither: it is left out, and said to be.
#[test]
fn a_load_of_two_angles_is_left_out_of_a_response() {
    let body = |name: &str, rpm: f64| {
        format!(
            "[body.{name}]\nturns = \"prescribed\"\nspeed = \"{rpm} rpm\"\nmass = \"10 kg\"\npolar_inertia = \"0.2 kg*m^2\"\n\
             [joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\n\
             stiffness = {{ xx = \"4e6 N/m\", yy = \"4e6 N/m\" }}\ndamping = {{ xx = \"300 N*s/m\", yy = \"300 N*s/m\" }}\n"
        )
    };
    let case = format!(
        "title = \"two\"\n{}{}[loads.spray]\nbody = \"high\"\nforce = [\"13 N\", \"-20 N\", \"0 N\"]\nframe = \"body\"\n\
         order = 1\nof = \"low\"\n[body.low.unbalance]\nu = {{ mass = \"1 g\", radius = \"10 mm\" }}\n",
        body("low", 4000.0),
        body("high", -6000.0)
    );
    let bench = Workbench::new().file("case.toml", &case);
    let said = ran(
        &bench,
        &["response", "case.toml", "--of", "low", "--speeds", "4000 rpm", "--out", "out"],
    );
    assert!(said.stdout.contains("spray is left out: it is fixed in a body"), "{}", said.stdout);
    let points = column(&bench, "out/response.csv", "point");
    let major = numbers(&bench, "out/response.csv", "major_um");
    let moved = points.iter().zip(major).filter(|own| own.0 == "joint.high");
    moved.for_each(|own| assert_eq!(own.1, 0.0, "high moves"));
}

/// Keys that other kinds take do nothing.
#[test]
fn keys_of_one_kind_are_refused_in_others() {
    for (kind, key, of) in [
        ("campbell", "margin = 0.2", "torsion"),
        ("modes", "stiffness = \"1e6 N/m .. 1e8 N/m, 5\"", "map"),
        ("response", "stations = 9", "forces"),
        ("campbell", "format = \"mat\"", "matrices"),
    ] {
        let case = format!("{}[analysis.a]\nkind = \"{kind}\"\n{key}\n", rotor(1.0));
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 2, "{key}: {}", outcome.stderr);
        let says = format!("is of analyses of `kind = \"{of}\"`");
        assert!(outcome.stderr.contains(&says), "{}", outcome.stderr);
        assert!(outcome.stderr.contains("case.toml:2"), "{}", outcome.stderr);
        assert!(!bench.path("out").exists());
    }
}

//! `whirl stability` and `whirl map`, against closed forms and `whirl campbell`.

use std::f64::consts::TAU;

use crate::analyses::{column, numbers, ran};
use crate::workbench::Workbench;

/// The threshold is that of the Campbell diagram, and the decrement changes its sign there.
#[test]
fn stability_is_that_of_the_campbell_diagram() {
    let workbench = Workbench::new();
    let speeds = ["--speeds", "5000 rpm .. 7000 rpm, 5", "--out", "out"];
    let said = ran(&workbench, &[&["stability", "weight"][..], &speeds].concat()).stdout;
    assert!(said.contains("UNSTABLE above 6183.28 rpm"), "{said}");
    assert!(workbench.path("out/stability.svg").is_file());
    ran(&workbench, &[&["campbell", "weight", "--no-figures"][..], &speeds].concat());
    let what = column(&workbench, "out/campbell.critical.csv", "what");
    let place = what.iter().position(|own| own == "unstable above").expect("a threshold");
    let theirs = numbers(&workbench, "out/campbell.critical.csv", "speed_rpm")[place];
    let own = numbers(&workbench, "out/stability.thresholds.csv", "speed_rpm");
    assert!(own.len() == 1 && (own[0] / theirs - 1.0).abs() < 1e-12, "{own:?} {theirs}");
    let speeds = numbers(&workbench, "out/stability.csv", "speed_rpm");
    let least = numbers(&workbench, "out/stability.csv", "least_log_decrement");
    let stable = column(&workbench, "out/stability.csv", "stable");
    assert_eq!(speeds.len(), 5);
    for ((speed, least), stable) in speeds.iter().zip(least).zip(stable) {
        assert_eq!((least > 0.0, stable == "true"), (*speed < theirs, *speed < theirs), "{speed}");
    }
}

/// A rigid rotor with its middle at the middle of two springs: shifts at √(2k/m) in both senses; tilts at
/// √(2ka²/(I_d − I_p)) forward, if I_d > I_p, and √(2ka²/(I_d + I_p)) backward.
#[test]
fn critical_speeds_of_a_rigid_rotor_are_those_of_closed_forms() {
    let (m, polar, transverse, arm): (f64, f64, f64, f64) = (12.0, 0.05, 0.4, 0.3);
    let joint = |name: &str, z: &str| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", z = \"{z}\" }}\n\
             stiffness = {{ xx = \"1 N/m\", yy = \"2 N/m\" }}\ndamping = {{ xx = \"30 N*s/m\", yy = \"30 N*s/m\" }}\n"
        )
    };
    let case = format!(
        "title = \"a rigid rotor\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"{m} kg\"\nz = \"0 m\"\n\
         polar_inertia = \"{polar} kg*m^2\"\ntransverse_inertia = \"{transverse} kg*m^2\"\n{}{}",
        joint("left", "-0.3 m"),
        joint("right", "0.3 m")
    );
    let workbench = Workbench::new().file("case.toml", &case);
    let range = "1e4 N/m .. 1e8 N/m, 5, log";
    ran(&workbench, &["map", "case.toml", "--stiffness", range, "--count", "4", "--out", "out"]);
    assert!(workbench.path("out/map.svg").is_file());
    let stiffness = numbers(&workbench, "out/map.csv", "stiffness_N_m");
    let speeds = numbers(&workbench, "out/map.csv", "speed_rpm");
    let whirl = column(&workbench, "out/map.csv", "whirl");
    assert_eq!(stiffness.len(), 20);
    let mut compared = 0;
    for k in [1e4, 1e5, 1e6, 1e7, 1e8] {
        let tilt = |inertia: f64| (2.0 * k * arm * arm / inertia).sqrt();
        let shift = (2.0 * k / m).sqrt();
        for (sense, omega) in [
            ("forward", shift),
            ("backward", shift),
            ("forward", tilt(transverse - polar)),
            ("backward", tilt(transverse + polar)),
        ] {
            let rows = stiffness.iter().zip(&speeds).zip(&whirl);
            let fits = |((own, rpm), whirl): ((&f64, &f64), &String)| {
                (own / k - 1.0).abs() < 1e-12
                    && (rpm * TAU / 60.0 / omega - 1.0).abs() < 1e-9
                    && whirl == sense
            };
            assert!(rows.into_iter().any(fits), "{k}, {sense} {omega}: {speeds:?} {whirl:?}");
            compared += 1;
        }
    }
    assert_eq!(compared, 20);
    // Branches are the motions themselves, shifts crossing tilts: each goes as √k.
    let branch = numbers(&workbench, "out/map.csv", "branch");
    for own in [1.0, 2.0, 3.0, 4.0] {
        let of = (0..20).filter(|&row| branch[row] == own);
        let of: Vec<f64> = of.map(|row| speeds[row] / stiffness[row].sqrt()).collect();
        assert!(of.len() == 5 && of.iter().all(|one| (one / of[0] - 1.0).abs() < 1e-9), "{of:?}");
    }
    assert!(column(&workbench, "out/map.csv", "motion").iter().all(|own| own == "lateral"));
}

#[test]
fn maps_refuse_what_holds_nothing() {
    let workbench = Workbench::new();
    for (arguments, message) in [
        (vec!["map", "weight", "--stiffness", "0 N/m .. 1 N/m, 3"], "do not hold the machine"),
        (vec!["map", "weight", "--stiffness", "3 rpm"], "stiffness of joints"),
        (vec!["map", "sdnd101"], "nothing turns in `sdnd101`"),
        (vec!["matrices", "crank"], "vary with the angle of crank"),
    ] {
        let outcome = workbench.whirl(&arguments);
        assert_eq!(outcome.status, 2, "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
    }
}

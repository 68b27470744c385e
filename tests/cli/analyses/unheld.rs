//! Motions that nothing holds, and what analyses leave out: each is said.

use std::f64::consts::TAU;

use super::{column, numbers, ran};
use crate::workbench::Workbench;

/// A shaft in the middle of its clearances, which no load presses on its springs.
const FLOATING: &str = r#"
title = "a rotor centred in its clearance"
[material.steel]
youngs_modulus = "211 GPa"
poissons_ratio = 0.3
density = "7810 kg/m^3"
[body.rotor]
turns = "prescribed"
speed = "3000 rpm"
material = "steel"
modes = 8
axial_restraint = "JOURNAL1_MIDDLE"
[body.rotor.dimensions]
length = "1000 mm"
diameter = "50 mm"
supports = ["200 mm", "900 mm"]
support_length = "20 mm"
cells = { sectors = 8, rings = 2 }
[joint.a]
kind = "bearing"
springs = 24
law = "gap-linear"
journal = { body = "rotor", sets = "JOURNAL1_MIDDLE" }
radial_clearance = "30 um"
[joint.b]
kind = "bearing"
springs = 24
law = "gap-linear"
journal = { body = "rotor", sets = "JOURNAL2_MIDDLE" }
radial_clearance = "30 um"
"#;

/// Nothing but its own gyroscopic couples holds a shaft that floats: of its four rigid motions the precession with I_p/I_d of the
/// speed is left, 0.187 Hz of a slender one. What rounding makes of the others is neither listed nor said to grow.
#[test]
fn motions_that_nothing_holds_are_not_listed_but_said() {
    let workbench = Workbench::new().file("case.toml", FLOATING);
    for (speed, slow) in [("0 rpm", 0), ("3000 rpm", 1), ("-20000 rpm", 1)] {
        let outcome = ran(&workbench, &["modes", "case.toml", "--speed", speed, "--out", "out"]);
        let text = &outcome.stdout;
        let hertz = numbers(&workbench, "out/modes.csv", "frequency_hz");
        let found: Vec<f64> = hertz.into_iter().filter(|own| *own < 100.0).collect();
        assert_eq!(found.len(), slow, "{speed}: {found:?}");
        assert!(!text.contains("grows") && !text.contains("NOT STABLE"), "{speed}: {text}");
        assert!(text.contains("note: nothing holds rotor where the machine stands"), "{text}");
        assert!(text.contains("add a load, such as the weight"), "{text}");
    }
    // I_p/I_d = ½r²/(¼r² + l²/12).
    let (r, l) = (0.025_f64, 1.0_f64);
    let share = 0.5 * r * r / (0.25 * r * r + l * l / 12.0);
    let hertz = numbers(&workbench, "out/modes.csv", "frequency_hz")[0];
    assert!((hertz / (share * 20000.0 / 60.0) - 1.0).abs() < 0.02, "{hertz} Hz");
    // What is held by little is listed: 1 N/m on 15 kg.
    let soft = "kind = \"bushing\"\nstiffness = { xx = \"1 N/m\", yy = \"1 N/m\" }\nfirst";
    let hard = "kind = \"bearing\"\nsprings = 24\nlaw = \"gap-linear\"\njournal";
    let held = FLOATING.replace(hard, soft).replace("radial_clearance = \"30 um\"\n", "");
    let workbench = Workbench::new().file("case.toml", &held);
    let outcome = ran(&workbench, &["modes", "case.toml", "--speed", "0 rpm", "--out", "out"]);
    assert!(!outcome.stdout.contains("nothing holds"), "{}", outcome.stdout);
    let hertz = numbers(&workbench, "out/modes.csv", "frequency_hz");
    let mass = 7810.0 * 0.25 * std::f64::consts::PI * 0.05_f64.powi(2);
    assert!(hertz[3] < 1.0 && hertz[4] > 100.0, "{hertz:?}");
    let about = (2.0 / mass).sqrt() / TAU;
    assert!(hertz[..4].iter().all(|own| (own / about).ln().abs() < 1.0), "{hertz:?} {about}");
}

/// Seen by a body at rest nothing is forward, whatever the sense in which pairs of equal frequency are written.
#[test]
fn at_rest_nothing_whirls_forward() {
    let case = FLOATING.replace(
        "kind = \"bearing\"\nsprings = 24\nlaw = \"gap-linear\"\njournal",
        "kind = \"bushing\"\nstiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\nfirst",
    );
    let case = case.replace("radial_clearance = \"30 um\"\n", "");
    let workbench = Workbench::new().file("case.toml", &case);
    ran(&workbench, &["modes", "case.toml", "--speed", "0 rpm", "--out", "out"]);
    let whirls = column(&workbench, "out/modes.csv", "whirl");
    assert!(whirls.len() == 10 && whirls.iter().all(|own| own == "-"), "{whirls:?}");
    let speeds = "0 rpm .. 9000 rpm, 3";
    ran(&workbench, &["campbell", "case.toml", "--speeds", speeds, "--out", "out"]);
    let whirls = column(&workbench, "out/campbell.csv", "whirl");
    let rpm = numbers(&workbench, "out/campbell.csv", "speed_rpm");
    for (whirl, rpm) in whirls.iter().zip(&rpm) {
        assert!(*rpm != 0.0 || whirl == "-", "{whirl} at {rpm} rpm");
    }
    assert!(whirls.iter().any(|own| own == "forward"), "{whirls:?}");
}

#[test]
fn what_an_analysis_leaves_out_is_said() {
    let outcome = ran(&Workbench::new(), &["torsion", "geared", "--of", "motor", "--out", "out"]);
    for word in ["the unbalance of wheel", "load.ripple", "has no amplitudes"] {
        assert!(outcome.stdout.contains(word), "{word}: {}", outcome.stdout);
    }
    let soft = "kind = \"bushing\"\nstiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\nfirst";
    let hard = "kind = \"bearing\"\nsprings = 24\nlaw = \"gap-linear\"\njournal";
    let plain = FLOATING.replace(hard, soft).replace("radial_clearance = \"30 um\"\n", "");
    let tilting = plain.replace(
        "[joint.b]\n",
        "[joint.b]\ntilting_stiffness = { xx = \"1e4 N*m/rad\", yy = \"1e4 N*m/rad\" }\n",
    );
    let said = |case: &str| {
        let workbench = Workbench::new().file("case.toml", case);
        ran(&workbench, &["map", "case.toml", "--count", "4", "--out", "out"]).stdout
    };
    assert!(!said(&plain).contains("left out"), "{}", said(&plain));
    let text = said(&tilting);
    assert!(text.contains("left out is what joints do otherwise"), "{text}");
    assert!(text.contains("b against tilting"), "{text}");
}

#[test]
fn a_count_below_zero_says_what_to_write() {
    let workbench = Workbench::new();
    for arguments in [
        ["modes", "weight", "--count", "-1"],
        ["map", "weight", "--count", "-1"],
        ["modes", "weight", "--count", "ten"],
    ] {
        let outcome = workbench.whirl(&arguments);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        assert!(outcome.stderr.contains("write a whole number of modes"), "{}", outcome.stderr);
        assert!(!outcome.stderr.contains("'-- -1'"), "{}", outcome.stderr);
    }
}

/// What grows is said with its rate and the body that moves, whether it oscillates or is listed or not.
#[test]
fn what_grows_is_named_though_it_is_not_listed() {
    let body = |name: &str, x: &str, y: &str, damping: &str| {
        format!(
            "[body.{name}]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"2 kg\"\npolar_inertia = \"0.01 kg*m^2\"\n\
             [joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\nstiffness = {{ xx = \"{x} N/m\", yy = \"{y} N/m\" }}\n\
             damping = {{ xx = \"{damping} N*s/m\", yy = \"{damping} N*s/m\" }}\n"
        )
    };
    let case = |second: &str| {
        format!("title = \"two masses\"\n{}{second}", body("slow", "1e4", "1e4", "10"))
    };
    // d/2m beside √(k/m − (d/2m)²), twice, as both directions are alike.
    let (rate, hertz) = (3.0_f64, (5e5_f64 - 9.0).sqrt() / TAU);
    let hertz_of = format!("{hertz:.3}");
    let fast = Workbench::new().file("case.toml", &case(&body("fast", "1e6", "1e6", "-12")));
    let said = ran(&fast, &["modes", "case.toml", "--count", "2", "--out", "out"]).stdout;
    let words = format!("NOT STABLE in this state: a motion of {} Hz", hertz_of);
    assert!(said.contains(&words), "{words}: {said}");
    let words = format!("grows by {rate} 1/s (fast 100 %), and another one grows");
    assert!(said.contains(&words), "{words}: {said}");
    let speeds = "1000 rpm .. 3000 rpm, 3";
    let all = ["stability", "case.toml", "--count", "2", "--speeds", speeds, "--out", "out"];
    let said = ran(&fast, &all).stdout;
    let words = format!("rpm a motion of {hertz_of} Hz grows by 3 1/s");
    assert!(said.contains("UNSTABLE at all these speeds: at ") && said.contains(&words), "{said}");
    assert_eq!(said.matches("UNSTABLE: a motion of").count(), 3, "{said}");
    // −k in one direction: e^{λt} with λ = √(k/m) and no damping.
    let falls = body("falls", "1e6", "-5e3", "0");
    let falls = Workbench::new().file("case.toml", &case(&falls));
    let said = ran(&falls, &["modes", "case.toml", "--out", "out"]).stdout;
    assert!(said.contains("a motion without oscillation grows by 50 1/s (falls 100 %)"), "{said}");
    let said = ran(&falls, &["campbell", "case.toml", "--speeds", speeds, "--out", "out"]).stdout;
    let words = "rpm a motion without oscillation grows by 50 1/s";
    assert!(said.contains("UNSTABLE at all these speeds: at ") && said.contains(words), "{said}");
}

/// Laws with states elsewhere change nothing of what holds a body; a mount that creeps holds none.
#[test]
fn what_creeps_holds_nothing() {
    let case = |law: &str| {
        format!(
            "title = \"a cage in a full film\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"10 kg\"\n\
             polar_inertia = \"0.3 kg*m^2\"\n[joint.mount]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\n{law}\n\
             radial_clearance = \"500 um\"\n[body.cage]\nturns = \"no\"\nmass = \"2 kg\"\n[joint.damper]\nkind = \"bearing\"\n\
             journal = {{ body = \"cage\" }}\nlaw = \"squeeze-film-damper-full\"\nradial_clearance = \"75 um\"\n\
             journal_radius = \"60 mm\"\nlength = \"30 mm\"\n"
        )
    };
    for (law, held) in [
        ("law = \"zener-mount\"", "nothing holds cage where"),
        ("law = \"magnetic-bearing-linear\"", "nothing holds cage where"),
        (
            "law = \"zener-mount\"\nparameters = { k = \"0 N/m\" }",
            "nothing holds cage, rotor where",
        ),
    ] {
        let bench = Workbench::new().file("case.toml", &case(law));
        let said = ran(&bench, &["modes", "case.toml", "--out", "out"]).stdout;
        assert!(said.contains(held), "{law}: {said}");
    }
}

/// A body on one pivot has no equilibrium under a couple: it is not looked for until rounding balances what is a thousand
/// kilometres away.
#[test]
fn what_runs_away_has_no_equilibrium() {
    let case = "title = \"a housing on one pivot\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"60 kg\"\n\
                polar_inertia = \"0.3 kg*m^2\"\n[body.pad]\nturns = \"no\"\nrocks = true\nmass = \"1 kg\"\n\
                polar_inertia = \"1e-3 kg*m^2\"\n[joint.pivot]\nkind = \"bushing\"\nfirst = { body = \"pad\", at = [\"40 mm\", \"0 mm\"] }\n\
                stiffness = { xx = \"1e8 N/m\", yy = \"1e8 N/m\" }\n[joint.left]\nkind = \"bearing\"\njournal = { body = \"rotor\" }\n\
                bore = { body = \"pad\" }\nlaw = \"ocvirk\"\nradial_clearance = \"75 um\"\njournal_radius = \"30 mm\"\n\
                length = \"30 mm\"\n[loads.w]\nbody = \"rotor\"\nforce = \"-600 N\"\n";
    let bench = Workbench::new().file("case.toml", case);
    let mut refused = 0;
    for (kind, speeds) in [
        ("coefficients", "1000 rpm .. 12000 rpm, 12"),
        ("stability", "1000 rpm .. 12000 rpm, 12"),
        ("modes", "3000 rpm"),
    ] {
        let key = if kind == "modes" { "--speed" } else { "--speeds" };
        let outcome = bench.whirl(&[kind, "case.toml", key, speeds, "--out", "out"]);
        assert!(outcome.status == 2, "{kind}: {}{}", outcome.stdout, outcome.stderr);
        let words = ["run away", "no equilibrium was found"];
        let said = words.into_iter().any(|own| outcome.stderr.contains(own));
        assert!(said && !outcome.stderr.contains("are  (N"), "{kind}: {}", outcome.stderr);
        refused += 1;
    }
    assert_eq!(refused, 3);
}

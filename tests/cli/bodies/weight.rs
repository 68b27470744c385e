//! Weights of named bodies, as a run shows them.

use crate::workbench::Workbench;

const CASE: &str = r#"
title = "a heavy rotor on a heavy frame"
gravity = ["-9.81 m/s^2", "2 m/s^2", "-3 m/s^2"]

[body.rotor]
turns = "prescribed"
speed = "600 rpm"
mass = "3 kg"
polar_inertia = "2e-3 kg*m^2"
transverse_inertia = "4e-3 kg*m^2"
z = "20 mm"

[body.frame]
turns = "no"
mass = "5 kg"

[joint.left]
kind = "bushing"
first = { body = "rotor", z = "-50 mm" }
second = { body = "frame", z = "-50 mm" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }
damping = { xx = "2e3 N*s/m", yy = "2e3 N*s/m" }

[joint.right]
kind = "bushing"
first = { body = "rotor", z = "100 mm" }
second = { body = "frame", z = "100 mm" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }
damping = { xx = "2e3 N*s/m", yy = "2e3 N*s/m" }

[joint.foot]
kind = "bushing"
first = { body = "frame" }
stiffness = { xx = "2e6 N/m", yy = "2e6 N/m" }
damping = { xx = "3e3 N*s/m", yy = "3e3 N*s/m" }

[march]
time_step = "1e-4 s"
duration = "0.4 s"
"#;

#[test]
fn reactions_of_a_settled_machine_carry_its_weight() {
    let bench = Workbench::new().file("heavy.toml", CASE);
    let outcome = bench.whirl(&["run", "heavy.toml", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let said = "the part of `gravity` along z has no effect on `rotor`, `frame`, which do not move along z";
    assert!(outcome.stderr.contains(said), "{}", outcome.stderr);
    let history = bench.history("out");
    for (axis, g) in [("X", -9.81), ("Y", 2.0)] {
        let on = |joint: &str| history.last(&format!("R{axis}_{joint}_N"));
        let (rotor, all) = (on("left") + on("right"), on("foot"));
        assert!((rotor / (-3.0 * g) - 1.0).abs() < 1e-4, "{axis}: {rotor}");
        assert!((all / (-8.0 * g) - 1.0).abs() < 1e-4, "{axis}: {all}");
        // The centre of the rotor is 70 mm from the left bushing and 80 mm from the right one.
        assert!((on("left") / on("right") - 80.0 / 70.0).abs() < 1e-3, "{axis}");
    }
    // Nothing brakes it but the lag of a whirl that has settled: no couple is left.
    assert!(history.last("M_rotor_Nm").abs() < 1e-3);
}

/// A wheel with a mass beside its axis is a pendulum: its weight is all that turns it. From 120° above its lowest place it gets
/// to ω = √(2 m g r (1 + sin 30°)/J) there, and as far up on the other side.
#[test]
fn a_mass_off_the_axis_swings_by_its_weight() {
    let case = "title = \"a pendulum\"\ngravity = [\"0 m/s^2\", \"-9.81 m/s^2\", \"0 m/s^2\"]\n\
        [body.wheel]\nturns = \"free\"\nmass = \"1 kg\"\npolar_inertia = \"1e-3 kg*m^2\"\n\
        added.bob = { mass = \"1 kg\", radius = \"100 mm\", angle = \"30 deg\" }\n\
        [joint.pivot]\nkind = \"bushing\"\nfirst = { body = \"wheel\" }\n\
        stiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\ndamping = { xx = \"5e3 N*s/m\", yy = \"5e3 N*s/m\" }\n\
        [march]\ntime_step = \"1e-4 s\"\nduration = \"2 s\"\n";
    let bench = Workbench::new().file("case.toml", case);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(bench.summary("out")["verdict"]["sound"], true);
    let history = bench.history("out");
    let largest = |name: &str| {
        let values = history.column(name).iter();
        values.fold(0.0, |most: f64, own| most.max(own.abs()))
    };
    let speed = (2.0 * 9.81 * 0.1 * 1.5 / 11e-3_f64).sqrt();
    // The pivot gives by weight and swing (5 µm of 100 mm), and takes a little of the energy.
    assert!((largest("omega_rad_s") / speed - 1.0).abs() < 1e-3, "{}", largest("omega_rad_s"));
    let other_side = 240_f64.to_radians();
    assert!((largest("theta_rad") / other_side - 1.0).abs() < 1e-3, "{}", largest("theta_rad"));
    // Without its weight nothing turns it.
    let bench = bench.file("case.toml", &case.replace("\"-9.81 m/s^2\"", "\"0 m/s^2\""));
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("nothing acts on the rotation of `wheel`"),
        "{}",
        outcome.stderr
    );
}

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

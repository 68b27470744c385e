//! Machines on laws of whole joints: a pair of bearings that hold a flexible shaft, the short form, and what is said of errors.

use std::fs::read_to_string;

use crate::workbench::Workbench;

use super::run;
use super::whole_joints::body;

const START: &str = "[start]\nkind = \"equilibrium\"\n";

/// A flexible shaft on a pair of bearings back to back, one in a casing that deforms, one in a sleeve that turns; nothing else
/// holds the shaft along z. What goes on from its state has the bytes of one run.
const PAIR: &str = r#"title = "x"
[material]
steel = { youngs_modulus = "200 GPa", poissons_ratio = 0.3, density = "7860 kg/m^3" }

[body.shaft]
turns = "prescribed"
speed = "6000 rpm"
material = "steel"
modes = 6
damping = "5e-6 s"
unbalance.u = { mass = "1 g", radius = "20 mm", z = "200 mm" }

[body.shaft.dimensions]
length = "400 mm"
diameter = "30 mm"
supports = ["50 mm", "350 mm"]
support_length = "16 mm"
layers_in_support = 2
layers_between = 4
cells = { sectors = 8, rings = 2, order = 1 }

[body.casing]
turns = "no"
material = "steel"
modes = 6
damping = "5e-5 s"
held = ["MOUNTS", "GROUND_SPRINGS"]

[body.casing.dimensions]
start = "30 mm"
length = "100 mm"
height = "40 mm"
width = "90 mm"
pedestal_height = "10 mm"
rings = ["50 mm"]
ring_length = "16 mm"
ring_thickness = "20 mm"
bore_radius = "31 mm"
layers_in_ring = 2
layers_between = 2
cells = { order = 1 }

[body.sleeve]
turns = "prescribed"
speed = "-1000 rpm"
mass = "3 kg"
polar_inertia = "0.01 kg*m^2"
transverse_inertia = "0.008 kg*m^2"
z = "350 mm"
moves_along_z = true

[joint.front]
kind = "bearing"
journal = { body = "shaft", sets = ["JOURNAL1_LEFT", "JOURNAL1_MIDDLE", "JOURNAL1_RIGHT"] }
bore = { body = "casing", sets = ["BORE1_LEFT", "BORE1_MIDDLE", "BORE1_RIGHT"] }
law = "angular-contact-ball"
parameters = { R_p = "23 mm", Z = 16 }

[joint.rear]
kind = "bearing"
journal = { body = "shaft", sets = "JOURNAL2_MIDDLE" }
bore = { body = "sleeve" }
law = "angular-contact-ball"
parameters = { R_p = "23 mm", Z = 16, alpha_0 = "-25 deg", z_0 = "-10 um" }

[joint.mount]
kind = "bushing"
first = { body = "sleeve", z = "350 mm" }
stiffness = { xx = "1e8 N/m", yy = "1e8 N/m" }
damping = { xx = "2e3 N*s/m", yy = "2e3 N*s/m" }
tilting_stiffness = { xx = "1e5 N*m/rad", yy = "1e5 N*m/rad" }
tilting_damping = { xx = "5 N*m*s/rad", yy = "5 N*m*s/rad" }
axial_stiffness = "5e7 N/m"
axial_damping = "1e3 N*s/m"

[loads.pull]
body = "shaft"
sets = ["JOURNAL1_LEFT"]
force = ["-300 N", "100 N", "250 N"]

[output.front]
quantity = "power"
joint = "front"

[march]
time_step = "2e-5 s"
"#;

#[test]
fn a_shaft_on_a_pair_of_bearings_back_to_back_is_sound_and_goes_on() {
    let bench = Workbench::new()
        .file("whole.toml", &format!("{PAIR}steps = 600\n{START}"))
        .file("first.toml", &format!("{PAIR}steps = 250\n{START}"))
        .file("second.toml", &format!("{PAIR}steps = 350\n[start]\nfrom = \"first\"\n"));
    for (case, out) in [("whole.toml", "whole"), ("first.toml", "first"), ("second.toml", "second")]
    {
        let outcome = bench.whirl(&["run", case, "--no-figures", "--out", out]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    }
    let lines = |folder: &str| -> Vec<String> {
        let text = read_to_string(bench.path(&format!("{folder}/history.csv"))).expect("a history");
        text.lines().map(str::to_owned).collect()
    };
    let whole = lines("whole");
    assert_eq!(whole.len(), 601);
    assert_eq!(whole[251..], lines("second")[1..]);
    let history = bench.history("whole");
    let mean = |column: &str| {
        let values = history.column(column);
        values.iter().sum::<f64>() / values.len() as f64
    };
    // The thrust is carried by both, and the preload by each against the other.
    let (front, rear, mount) = (mean("RZ_front_N"), mean("RZ_rear_N"), mean("RZ_mount_N"));
    assert!((front + rear + 250.0).abs() < 0.5, "{front} and {rear}");
    assert!(front < -250.0 && rear > 50.0, "{front} and {rear}");
    assert!((mount - rear).abs() < 0.5, "the sleeve hands {rear} on: {mount}");
    assert!(mean("MX_front_Nm").hypot(mean("MY_front_Nm")) > 0.1, "tilts are held");
    let summary = read_to_string(bench.path("whole/summary.json")).expect("a summary");
    assert!(summary.contains("\"sound\": true"), "{summary}");
}

/// The short form of a machine: two bearings face the weight in the middle, and each other along z.
const SHORT: &str = r#"title = "x"
[material]
steel = { youngs_modulus = "200 GPa", poissons_ratio = 0.3, density = "7860 kg/m^3" }

[shaft]
material = "steel"
modes = 6
damping = "5e-6 s"
axial_restraint = "JOURNAL1_MIDDLE"

[shaft.dimensions]
length = "400 mm"
diameter = "30 mm"
supports = ["50 mm", "350 mm"]
support_length = "16 mm"
layers_in_support = 2
layers_between = 4
loads = ["200 mm"]
cells = { sectors = 8, rings = 2, order = 1 }

[support]
material = "steel"
modes = 6
damping = "5e-5 s"
mounts = "MOUNTS"

[support.dimensions]
start = "30 mm"
length = "340 mm"
height = "40 mm"
width = "90 mm"
pedestal_height = "10 mm"
rings = ["50 mm", "350 mm"]
ring_length = "16 mm"
ring_thickness = "20 mm"
bore_radius = "31 mm"
layers_in_ring = 2
layers_between = 4
cells = { order = 1 }

[[support.ground_spring]]
set = "GROUND_SPRINGS"
direction = "y"
stiffness = "1e8 N/m"

[springs]
law = "angular-contact-ball"
number = 24
radial_clearance = "50 um"

[[bearing]]
journal = ["JOURNAL1_LEFT", "JOURNAL1_MIDDLE", "JOURNAL1_RIGHT"]
bore = ["BORE1_LEFT", "BORE1_MIDDLE", "BORE1_RIGHT"]

[[bearing]]
journal = ["JOURNAL2_LEFT", "JOURNAL2_MIDDLE", "JOURNAL2_RIGHT"]
bore = ["BORE2_LEFT", "BORE2_MIDDLE", "BORE2_RIGHT"]
parameters = { alpha_0 = "-25 deg", z_0 = "-10 um" }

[[load]]
sets = ["LOAD1"]
force = "-500 N"

[drive]
top = "DRIVE_TOP"
bottom = "DRIVE_BOTTOM"
torque = "1 N*m"
target_speed = "3000 rpm"
acts = false

[start]
kind = "equilibrium"
speed = "3000 rpm"

[march]
time_step = "2e-5 s"
steps = 50
"#;

#[test]
fn the_short_form_of_a_machine_takes_laws_of_joints() {
    let done = run(SHORT, &[]);
    let both = |column: &str| [1, 2].map(|k| done.last(&format!("{column}{k}_N")));
    let [one, other] = both("RX");
    assert!((one + other - 500.0).abs() < 1e-3, "{one} and {other}");
    assert!((one - other).abs() < 0.1, "{one} and {other}");
    // What the preload leaves beside its balance is held by the `axial_restraint`.
    let [one, other] = both("RZ");
    assert!(one < -100.0 && other > 100.0, "{one} and {other}");
    let [one, other] = [1, 2].map(|k| done.last(&format!("MY{k}_Nm")));
    assert!(one < -1.0 && other > 1.0 && (one + other).abs() < 0.01, "{one} and {other}");
}

/// What is wrong around laws of joints, each with its place and its remedy.
#[test]
fn errors_of_laws_of_joints_say_what_to_do() {
    let law = "law = \"angular-contact-ball\"";
    let march = "[march]\ntime_step = \"1e-5 s\"\nsteps = 2\n";
    let said = |case: &str| {
        let bench = Workbench::new().file("case.toml", case);
        let outcome = bench.whirl(&["check", "case.toml"]);
        (outcome.status, outcome.stderr)
    };
    let says = |case: &str, status: i32, texts: &[&str]| {
        let (found, text) = said(case);
        assert_eq!(found, status, "{text}");
        for wanted in texts {
            assert!(text.contains(wanted), "{wanted} is not in {text}");
        }
    };
    let stations = format!("{law}\nstations = [\"0 mm\", \"10 mm\"]");
    says(
        &body("turns = \"no\"", &stations, march),
        2,
        &["acts once a joint, not in several planes", "leave `stations` out"],
    );
    let ring = "law = \"bushing\"";
    says(
        &body("turns = \"no\"", ring, march),
        2,
        &["the joint `b` gives no force on tilts, such as M_x", "gives no force along z, F_z"],
    );
    let still = body("turns = \"no\"", law, march).replace("moves_along_z = true\n", "");
    let still = still.replace("\"900 N\"]", "\"0 N\"]");
    says(
        &still,
        0,
        &["neither side of `b` moves along z: the force along z", "`moves_along_z = true`"],
    );
    let stop = body("turns = \"no\"", law, march)
        .replace("kind = \"bearing\"\n", "kind = \"stop\"\nside = \"around\"\n");
    says(&stop, 2, &["is a law of a joint, not a law of a ring"]);
    let unit = format!("{law}\nparameters = {{ K = \"3 N/mm\" }}");
    says(&body("turns = \"no\"", &unit, march), 2, &["N/mm^1.5"]);
}

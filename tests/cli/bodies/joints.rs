//! Bushings, couplings, stops and drives between rigid bodies, against what can be worked out by hand.

use crate::workbench::Workbench;
use std::f64::consts::TAU;

use super::{march, run};

const MOTOR: &str = r#"
[body.motor]
turns = "free"
mass = "2 kg"
polar_inertia = "3e-3 kg*m^2"
transverse_inertia = "4e-3 kg*m^2"
z = "100 mm"

[joint.near]
kind = "bushing"
first = { body = "motor", z = "0 mm" }
stiffness = { xx = "1e6 N/m", yy = "2e6 N/m" }
damping = { xx = "400 N*s/m", yy = "400 N*s/m" }

[joint.far]
kind = "bushing"
first = { body = "motor", z = "200 mm" }
stiffness = { xx = "1e6 N/m", yy = "2e6 N/m" }
damping = { xx = "400 N*s/m", yy = "400 N*s/m" }
"#;

/// A load off the middle tilts the body: each bushing takes its share of it.
#[test]
fn bushings_share_a_load_by_its_lever() {
    let load =
        "[loads.pull]\nbody = \"motor\"\nz = \"150 mm\"\ndirection = \"y\"\nforce = \"100 N\"\n";
    let speed = "turns = \"free\"\ninitial_speed = \"60 rpm\"";
    let case = format!("title = \"x\"\n{MOTOR}{load}{}", march("1e-4 s", 4000));
    let done = run(&case.replace("turns = \"free\"", speed), &[]);
    for (joint, force) in [("near", 25.0), ("far", 75.0)] {
        let found = -done.last(&format!("RY_{joint}_N"));
        assert!((found - force).abs() < 0.01 * force, "{joint}: {found}");
        let moved = 1e-6 * done.last(&format!("EY_{joint}_um"));
        assert!((2e6 * moved - force).abs() < 0.01 * force, "{joint}: {moved}");
        assert!(done.last(&format!("RX_{joint}_N")).abs() < 1.0);
    }
}

/// Cross terms act across: F_x = −k_xy e_y.
#[test]
fn cross_terms_of_a_bushing_act_across() {
    let case = format!(
        r#"title = "x"
[body.block]
turns = "no"
mass = "2 kg"
damping = {{ x = "2e3 N*s/m", y = "2e3 N*s/m" }}

[joint.pad]
kind = "bushing"
first = {{ body = "block" }}
stiffness = {{ xx = "1e6 N/m", xy = "3e5 N/m", yx = "-2e5 N/m", yy = "2e6 N/m" }}

[loads.pull]
body = "block"
direction = "y"
force = "100 N"

{}"#,
        march("1e-4 s", 2000)
    );
    let done = run(&case, &[]);
    // K e = (0, 100): det = 2e12 + 6e10.
    let determinant = 1e6 * 2e6 + 3e5 * 2e5;
    let (x, y) = (-3e5 * 100.0 / determinant, 1e6 * 100.0 / determinant);
    assert!((1e-6 * done.last("EX_pad_um") / x - 1.0).abs() < 1e-3);
    assert!((1e-6 * done.last("EY_pad_um") / y - 1.0).abs() < 1e-3);
}

/// Two rotors and a spring between them: ω² = k (1/J1 + 1/J2); what the drive gives, both have.
#[test]
fn a_coupling_lets_two_rotations_swing_at_their_frequency() {
    let case = format!(
        r#"title = "x"
{MOTOR}
[body.fan]
turns = "free"
initial_speed = "10 rpm"
mass = "1 kg"
polar_inertia = "6e-3 kg*m^2"

[joint.hub]
kind = "coupling"
first = {{ body = "motor" }}
second = {{ body = "fan" }}
stiffness = "50 N*m/rad"

[joint.mount]
kind = "bushing"
first = {{ body = "fan" }}
stiffness = {{ xx = "1e6 N/m", yy = "1e6 N/m" }}

{}"#,
        march("1e-4 s", 4000)
    );
    let done = run(&case, &[]);
    let (motor, fan) = (done.history.column("omega_rad_s"), done.history.column("omega_fan_rad_s"));
    let momentum = 6e-3 * 10.0 * TAU / 60.0;
    let mut crossings = Vec::new();
    for row in 1..motor.len() {
        let total = 3e-3 * motor[row] + 6e-3 * fan[row];
        assert!((total / momentum - 1.0).abs() < 1e-6, "{row}: {total} for {momentum}");
        let [before, after] = [row - 1, row].map(|row| motor[row] - fan[row]);
        if before < 0.0 && after >= 0.0 {
            crossings.push(1e-4 * (row as f64 + before / (before - after)));
        }
    }
    let periods = crossings.len() as f64 - 1.0;
    let period = (crossings[crossings.len() - 1] - crossings[0]) / periods;
    let exact = TAU / (50.0 * (1.0 / 3e-3 + 1.0 / 6e-3_f64)).sqrt();
    assert!((period / exact - 1.0).abs() < 1e-3, "{period} for {exact}");
    let torque = done.history.column("MZ_hub_Nm");
    assert!(torque.iter().any(|torque| torque.abs() > 0.1));
}

/// θ̈ = M/J until the target is reached.
#[test]
fn a_drive_turns_a_rigid_body_up_to_its_target() {
    let drive =
        "[drives.mains]\nbody = \"motor\"\ntorque = \"-3 N*m\"\ntarget_speed = \"-600 rpm\"\n";
    let case = format!("title = \"x\"\n{MOTOR}{drive}{}", march("1e-4 s", 1000));
    let done = run(&case, &[]);
    let speed = done.history.column("omega_rad_s");
    assert!((speed[99] / (-3.0 / 3e-3 * 100.0 * 1e-4) - 1.0).abs() < 1e-6, "{}", speed[99]);
    let target = -600.0 * TAU / 60.0;
    assert!((done.last("omega_rad_s") - target).abs() < 0.16, "{}", done.last("omega_rad_s"));
}

/// A block that falls on a stop comes to rest where the stop carries it.
#[test]
fn a_stop_carries_what_leans_on_it() {
    let case = format!(
        r#"title = "x"
[body.block]
turns = "no"
mass = "2 kg"
damping = {{ x = "2e3 N*s/m", y = "2e3 N*s/m" }}
stiffness = {{ x = "1e3 N/m", y = "1e3 N/m" }}

[joint.pad]
kind = "stop"
journal = {{ body = "block" }}
side = "below"
gap = "10 um"
law = "gap-linear"
parameters = {{ k = "1e6 N/m" }}

[loads.pull]
body = "block"
force = "-100 N"

{}"#,
        march("1e-4 s", 4000)
    );
    let done = run(&case, &[]);
    // 1e3 x + 1e6 (x − 1e-5) = 100.
    let x = (100.0 + 10.0) / (1e6 + 1e3);
    assert!((1e-6 * done.last("X_pad_um") / -x - 1.0).abs() < 1e-3, "{}", done.last("X_pad_um"));
}

/// A bore that does not turn stands about the axis of its body, as one that turns at 0 rpm: the pull of the misalignment
/// is the same. Without an axis it stands about its journal.
#[test]
fn a_bore_that_does_not_turn_stands_about_its_own_axis() {
    let pull = |ring: &str| {
        let mounts = ["rotor", "ring"].map(|body| {
            format!(
                r#"[joint.{body}_mount]
kind = "bushing"
first = {{ body = "{body}" }}
stiffness = {{ xx = "1e6 N/m", yy = "1e6 N/m" }}
damping = {{ xx = "1e3 N*s/m", yy = "1e3 N*s/m" }}
"#
            )
        });
        let case = format!(
            r#"title = "x"
[body.rotor]
turns = "prescribed"
speed = "3000 rpm"
mass = "1 kg"
polar_inertia = "0.01 kg*m^2"

[body.ring]
{ring}
mass = "1 kg"

[joint.race]
kind = "bearing"
journal = {{ body = "rotor" }}
bore = {{ body = "ring" }}
law = "ball-bearing"
radial_clearance = "20 um"

{}
[loads.weight]
body = "rotor"
force = "-30 N"

{}"#,
            mounts.concat(),
            march("2e-5 s", 2000)
        );
        let done = run(&case, &[]);
        ["RX_race_N", "RY_race_N", "EX_race_um"].map(|column| done.last(column))
    };
    let axis = "axis = [\"12 um\", \"-9 um\"]\n";
    let standing = pull(&format!("turns = \"no\"\n{axis}"));
    let inertia = "polar_inertia = \"1e-4 kg*m^2\"";
    let held = pull(&format!("turns = \"prescribed\"\nspeed = \"0 rpm\"\n{inertia}\n{axis}"));
    for (standing, held) in standing.iter().zip(held) {
        // To the force tolerance of the steps, over 1 N or 1 µm.
        assert!((standing - held).abs() < 1e-5 * held.abs().max(1.0), "{standing} for {held}");
    }
    let about_journal = pull("turns = \"no\"\n");
    assert!((standing[0] - about_journal[0]).abs() > 1.0, "{standing:?}, {about_journal:?}");
}

/// A run-up: speed and angle are those that are prescribed.
#[test]
fn a_prescribed_rotation_is_the_integral_of_its_speed() {
    let given = "turns = \"prescribed\"\nspeed = \"60 rpm\"\nacceleration = \"600 rpm/s\"";
    let case = format!("title = \"x\"\n{MOTOR}{}", march("1e-3 s", 500));
    let done = run(&case.replace("turns = \"free\"", given), &[]);
    let turn = TAU / 60.0;
    assert!((done.last("omega_rad_s") / (turn * 360.0) - 1.0).abs() < 1e-9);
    assert!((done.last("theta_rad") / (turn * (30.0 + 0.5 * 600.0 * 0.25)) - 1.0).abs() < 1e-9);
}

/// A bushing shows all its values, and is warned of where it pushes away; a beam has two transverse inertias.
#[test]
fn a_check_shows_bushings_and_both_inertias() {
    let case = r#"title = "x"
[material.steel]
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
density = "7860 kg/m^3"

[body.beam]
turns = "no"
rigid = true
material = "steel"

[body.beam.dimensions]
start = "0 mm"
length = "500 mm"
height = "20 mm"
width = "30 mm"
pedestal_height = "20 mm"
rings = ["50 mm", "450 mm"]
ring_length = "20 mm"
ring_thickness = "8 mm"
bore_radius = "10 mm"
layers_in_ring = 2
layers_between = 6
cells = { order = 1 }

[joint.left]
kind = "bushing"
first = { body = "beam", sets = "BORE1_MIDDLE" }
stiffness = { xx = "1e7 N/m", yy = "1e7 N/m" }

[joint.right]
kind = "bushing"
first = { body = "beam", sets = "BORE2_MIDDLE" }
stiffness = { xx = "-1e6 N/m", yy = "1e7 N/m" }

[march]
time_step = "1e-5 s"
steps = 100
"#;
    let outcome = Workbench::new().file("case.toml", case).whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let wanted = "bushing left: first beam, second ground, stiffness xx 1e7, yy 1e7 N/m, damping xx 0, yy 0 N s/m, z = 50 mm\n";
    assert!(outcome.stdout.contains(wanted), "{}", outcome.stdout);
    assert!(outcome.stdout.contains(" about x, "), "{}", outcome.stdout);
    assert!(!outcome.stderr.contains("`left`"), "{}", outcome.stderr);
    let warning = "the stiffness of the bushing `right` is negative along one direction";
    assert!(outcome.stderr.contains(warning), "{}", outcome.stderr);
}

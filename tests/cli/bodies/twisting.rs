//! Torques on bodies that deform: where they act, what they twist, and which section turns with the frame.

use super::matrices::bar_with;
use super::{march, run};
use crate::workbench::Workbench;

/// A shaft of steel, driven at its left end.
const SHAFT: &str = r#"title = "a shaft that is twisted"
[material.steel]
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
density = "7860 kg/m^3"

[body.rotor]
turns = "prescribed"
speed = "1000 rpm"
material = "steel"
modes = 8
damping = "1e-4 s"
axial_restraint = "JOURNAL1_MIDDLE"
[body.rotor.dimensions]
length = "500 mm"
diameter = "20 mm"
supports = ["50 mm", "450 mm"]
support_length = "20 mm"
layers_in_support = 2
layers_between = 10
cells = { order = 1 }

[body.other]
turns = "OTHER"
SPEED = "1000 rpm"
mass = "1 kg"
polar_inertia = "1e-3 kg*m^2"

[joint.other]
kind = "bushing"
first = { body = "other" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }
damping = { xx = "100 N*s/m", yy = "100 N*s/m" }
[joint.near]
kind = "bushing"
first = { body = "rotor", sets = "JOURNAL1_MIDDLE" }
stiffness = { xx = "1e7 N/m", yy = "1e7 N/m" }
[joint.meter]
kind = "coupling"
first = { body = "rotor", sets = "JOURNAL2_MIDDLE" }
second = { body = "other" }
stiffness = "STIFF N*m/rad"
damping = "DAMP N*m*s/rad"
[output.meter]
quantity = "deformation"
joint = "meter"
[output.rate]
quantity = "rate"
joint = "meter"
"#;

fn shaft([turns, speed]: [&str; 2], [stiffness, damping]: [&str; 2]) -> String {
    SHAFT
        .replace("OTHER", turns)
        .replace("SPEED", speed)
        .replace("STIFF", stiffness)
        .replace("DAMP", damping)
}

/// What a coupling shows of itself is what its law takes: the twist of the sections on which it acts.
#[test]
fn a_coupling_shows_the_twist_of_its_sections() {
    let rest = r#"
[joint.far]
kind = "bushing"
first = { body = "rotor", sets = "JOURNAL2_MIDDLE" }
stiffness = { xx = "1e7 N/m", yy = "1e7 N/m" }
[loads.brake]
body = "other"
couple = "-5 N*m"
"#;
    let case = shaft(["free", "initial_speed"], ["500", "0.05"]) + rest + &march("1e-4 s", 400);
    let done = run(&case, &[]);
    let [twist, rate, torque] = ["twist_meter_rad", "twist_rate_rate_rad_s", "MZ_meter_Nm"]
        .map(|name| done.history.column(name).to_vec());
    let largest = torque.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    assert!(largest > 5.0, "{largest}");
    for ((twist, rate), torque) in twist.iter().zip(&rate).zip(&torque) {
        let law = -500.0 * twist - 0.05 * rate;
        // Columns have ten digits, twist of a difference of angles near 70 rad.
        assert!((law - torque).abs() <= 1e-6 * largest, "{law} {torque}");
    }
}

/// The torque of a law on a journal twists the shaft between the section of its frame and its own as a couple that
/// a coupling brings to the same section does: M L / (G J) of the theory of torsion.
#[test]
fn the_torque_of_a_joint_twists_the_shaft() {
    let law = r#"kind = "law"
name = "drag"
title = "constant drag torque on a journal"
source = "a test"
[inputs.omega]
unit = "rad/s"
range = [-500, 500]
[inputs.e_x]
unit = "m"
range = [-0.001, 0.001]
[inputs.e_y]
unit = "m"
range = [-0.001, 0.001]
[parameters]
M0 = { value = 20, unit = "N*m" }
k = { value = 1e6, unit = "N/m" }
w0 = { value = 1, unit = "rad/s" }
[outputs.F_x]
unit = "N"
value = '-k*e_x'
[outputs.F_y]
unit = "N"
value = '-k*e_y'
[outputs.M_z]
unit = "N*m"
value = '-M0*tanh(omega/w0)'
"#;
    let by_law = r#"
[joint.far]
kind = "bearing"
journal = { body = "rotor", sets = "JOURNAL2_MIDDLE" }
law = "drag.toml"
radial_clearance = "1 mm"
journal_radius = "10 mm"
length = "20 mm"
"#;
    let by_couple = r#"
[joint.far]
kind = "bushing"
first = { body = "rotor", sets = "JOURNAL2_MIDDLE" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }
[body.brake]
turns = "free"
initial_speed = "1000 rpm"
mass = "1 kg"
polar_inertia = "1e-3 kg*m^2"
[joint.holder]
kind = "bushing"
first = { body = "brake" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }
[joint.brake]
kind = "coupling"
first = { body = "rotor", sets = "JOURNAL2_MIDDLE" }
second = { body = "brake" }
stiffness = "1000 N*m/rad"
damping = "1 N*m*s/rad"
[loads.brake]
body = "brake"
couple = "-20 N*m"
"#;
    let twist = |rest: &str| {
        let case = shaft(["prescribed", "speed"], ["1e-3", "0"]) + rest + &march("1e-4 s", 1000);
        run(&case, &[("drag.toml", law)]).last("twist_meter_rad")
    };
    let by_law = twist(by_law);
    let g = 200e9 / 2.6;
    let j = std::f64::consts::PI * 0.02_f64.powi(4) / 32.0;
    let exact = -20.0 * 0.4 / (g * j);
    // The octagon of the mesh has the radius of gyration of the circle, and is 2 % softer in torsion than it.
    assert!((by_law / exact - 1.0).abs() < 0.04, "{by_law} {exact}");
    let by_couple = twist(by_couple);
    // What is left of the start has decayed by e^-50.
    assert!((by_law / by_couple - 1.0).abs() < 1e-6, "{by_law} {by_couple}");
}

/// Which section turns with the frame follows from where nodes are: with other labels, or turned about the axis, the same
/// rotor has the same frequencies.
#[test]
fn the_frame_does_not_depend_on_labels_nor_on_where_x_points() {
    let case = |held: &str| {
        format!(
            r#"title = "x"
[body.rotor]
turns = "prescribed"
speed = "600 rpm"
mesh = "bar.inp"
units = "m, N, kg"
modes = 10
damping = "1e-6 s"
{held}
[joint.a]
kind = "bushing"
first = {{ body = "rotor", sets = "LEFT" }}
stiffness = {{ xx = "1e7 N/m", yy = "1e7 N/m" }}
axial_stiffness = "1e7 N/m"
[joint.b]
kind = "bushing"
first = {{ body = "rotor", sets = "RIGHT" }}
stiffness = {{ xx = "1e7 N/m", yy = "1e7 N/m" }}
{}"#,
            march("1e-5 s", 10)
        )
    };
    for (held, frame) in [
        (
            "axial_restraint = \"RIGHT\"",
            "the section of its `axial_restraint` RIGHT, 9 nodes at z = 160 mm",
        ),
        ("", "the mean rotation of the whole body"),
    ] {
        let said = |label: fn(usize) -> usize, angle: f64| {
            let bench = Workbench::new()
                .file("bar.inp", &bar_with(label, angle))
                .file("case.toml", &case(held));
            let outcome = bench.whirl(&["check", "case.toml"]);
            assert_eq!(outcome.status, 0, "{}", outcome.stderr);
            let line = |of: &str| {
                let found = outcome.stdout.lines().find(|line| line.contains(of));
                found.unwrap_or_else(|| panic!("{of}: {}", outcome.stdout)).to_owned()
            };
            assert!(line("the frame of rotor").contains(frame), "{}", outcome.stdout);
            line("rotor, at rest")
        };
        let plain = said(|label| label, 0.0);
        assert_eq!(plain, said(|label| 100 - label, 0.0));
        assert_eq!(plain, said(|label| label, 0.5));
    }
}

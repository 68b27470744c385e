//! Single terms of joints, loads and bodies, at values that nothing else has: each is seen by itself.

use std::f64::consts::{PI, TAU};

use whirl_tests::History;

use super::{Run, march, run};
use crate::workbench::Workbench;

/// The largest |value| of a column over its last `count` rows.
fn largest(history: &History, column: &str, count: usize) -> f64 {
    let values = history.column(column);
    values[values.len() - count..].iter().fold(0.0, |most: f64, own| most.max(own.abs()))
}

/// Two rotors at other speeds, and a mass that stands: its acceleration shows the loads on it.
const FOLLOWED: &str = r#"title = "loads that follow the second rotor"

[body.slow]
turns = "prescribed"
speed = "7000 deg/s"
mass = "1 kg"
polar_inertia = "1e-3 kg*m^2"

[body.fast]
turns = "prescribed"
speed = "20000 deg/s"
mass = "1 kg"
polar_inertia = "1e-3 kg*m^2"

[body.block]
turns = "no"
mass = "2 kg"
stiffness = { x = "1 N/m", y = "1 N/m" }

[joint.slow]
kind = "bushing"
first = { body = "slow" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }

[joint.fast]
kind = "bushing"
first = { body = "fast" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }

[loads.order]
body = "block"
direction = "x"
force = "10 N"
order = 2
phase = "40 deg"
of = "fast"

[loads.table]
body = "block"
direction = "y"
table = "gas.csv"
period = "720 deg"
of = "fast"

[output.shown]
quantity = "acceleration"
body = "block"

"#;

/// A table whose rows begin and end in the middle of its period.
const GAS: &str = "angle [deg], force [N]\n30, 5\n150, 40\n400, -20\n600, 10\n750, 5\n";

#[test]
fn loads_follow_the_body_that_they_name() {
    // 5° of the fast rotor a step, so that rows of the table are met.
    let Run { history, .. } =
        run(&format!("{FOLLOWED}{}", march("2.5e-4 s", 600)), &[("gas.csv", GAS)]);
    let column = |name: &str| history.column(name).to_vec();
    let (theta, ax, ay) =
        (column("theta_fast_rad"), column("ax_shown_m_s2"), column("ay_shown_m_s2"));
    let mut met = 0;
    for ((theta, ax), ay) in theta.iter().zip(&ax).zip(&ay) {
        // The spring takes less than 1 N/m · 0.1 mm. A load that is spread over two steps is less by (nΔθ)²/12.
        let force = 10.0 * (2.0 * theta + 40.0_f64.to_radians()).sin();
        assert!((2.0 * ax - force).abs() < 0.03, "{theta}: {ax} for {force}");
        let degrees = (theta.to_degrees() % 720.0).round();
        let rows = [(30.0, 5.0), (150.0, 40.0), (400.0, -20.0), (600.0, 10.0)];
        if let Some((_, force)) = rows.iter().find(|(own, _)| *own == degrees) {
            met += 1;
            // The same of the smooth curve through rows that are 24 steps apart or more.
            assert!((2.0 * ay - force).abs() < 0.5, "{degrees}: {ay} for {force}");
        }
    }
    assert!(met >= 16, "{met} rows were met");
}

#[test]
fn the_cycle_is_of_the_body_that_loads_follow() {
    // A load over four revolutions of the body that it follows, beside one that turns with no whole number of them.
    let case = FOLLOWED
        .replace("order = 2", "order = 0.25")
        .replace("speed = \"7000 deg/s\"", "speed = \"20000 deg/s\"");
    let (head, rest) = case.split_once("[loads.table]").expect("a table");
    let (_, rest) = rest.split_once("[output.shown]").expect("an output");
    let case = format!("{head}[output.shown]{rest}{}", march("2.5e-4 s", 600));
    let cycle = |case: &str| {
        let bench = Workbench::new().file("case.toml", case);
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let (_, rest) = outcome.stdout.split_once("a cycle is ").expect("a cycle");
        rest.split(' ').next().expect("a number").parse::<f64>().expect("a number")
    };
    assert!((cycle(&case) - 4.0 * 360.0 / 20_000.0).abs() < 1e-9, "{}", cycle(&case));
    let slower = case.replacen("20000 deg/s", "10000 deg/s", 1);
    assert!((cycle(&slower) - 4.0 * 360.0 / 20_000.0).abs() < 1e-9, "{}", cycle(&slower));
}

/// Orders of what belongs to a body count by its own angle.
#[test]
fn orders_count_by_the_angle_of_the_own_body() {
    let rotor = |name: &str, speed: f64, mass: &str| {
        format!(
            "[body.{name}]\nturns = \"prescribed\"\nspeed = \"{speed} rpm\"\nmass = \"2 kg\"\npolar_inertia = \"2e-3 kg*m^2\"\n\
             [body.{name}.unbalance.one]\nmass = \"{mass}\"\nradius = \"20 mm\"\nangle = \"30 deg\"\n\
             [joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"1.2e6 N/m\" }}\ndamping = {{ xx = \"400 N*s/m\", yy = \"400 N*s/m\" }}\n"
        )
    };
    let case = format!(
        "title = \"two rotors\"\n{}{}{}",
        rotor("slow", 1700.0, "3 g"),
        rotor("fast", 3000.0, "1 g"),
        march("5e-5 s", 16_000)
    );
    let found = run(&case, &[]);
    let summary = found.bench.summary("out");
    let signals = summary["orders"]["signals"].as_array().expect("a list");
    for (name, speed, unbalance) in [("slow", 1700.0, 6e-5), ("fast", 3000.0, 2e-5)] {
        let omega = TAU * speed / 60.0;
        let (elastic, damper) = (1e6 - 2.0 * omega * omega, 400.0 * omega);
        let amplitude = 1e6 * unbalance * omega * omega / elastic.hypot(damper);
        let column = format!("X_{name}_um");
        let signal = signals.iter().find(|own| own["signal"] == *column).expect("a signal");
        let said = signal["1X"]["amplitude"].as_f64().expect("a number");
        assert!((said / amplitude - 1.0).abs() < 2e-3, "{name}: {said} for {amplitude}");
    }
}

/// A wheel on one joint, under a force and a couple that stand in space.
fn wheel(joint: &str) -> String {
    format!(
        r#"title = "x"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[body.wheel]
turns = "prescribed"
speed = "60 rpm"
mass = "4 kg"
polar_inertia = "0.5 kg*m^2"
transverse_inertia = "0.3 kg*m^2"
z = "20 mm"
moves_along_z = true

[joint.mount]
{joint}
[loads.push]
body = "wheel"
force = ["30 N", "-20 N", "-60 N"]

[loads.turn]
body = "wheel"
couple = ["10 N*m", "3 N*m", "0 N*m"]
frame = "space"

[output.mount]
quantity = "power"
joint = "mount"

[output.wheel]
quantity = "power"
body = "wheel"

[output.own]
quantity = "energy"
body = "wheel"

"#
    )
}

/// The kinetic energy of a wheel changes by the power of its joint, which has tilts and an axial part, and that of its loads.
fn powers_change_the_kinetic_energy(joint: &str, files: &[(&str, &str)]) {
    let step = 1e-5;
    let Run { history, .. } = run(&format!("{}{}", wheel(joint), march("1e-5 s", 3000)), files);
    let [kinetic, loads, joint] =
        ["kinetic_own_J", "power_wheel_W", "power_mount_W"].map(|name| history.column(name));
    let most = joint.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    for i in 1..kinetic.len() - 1 {
        let rate = (kinetic[i + 1] - kinetic[i - 1]) / (2.0 * step);
        let power = loads[i] + joint[i];
        // Differences of motions at up to 500 rad/s, of the energy twice that: (ωΔt)²/6; both energies are rounded to ten digits.
        let wrong = (rate - power).abs();
        assert!(
            wrong < 1e-4 * most + 1e-9 * kinetic[i] / (2.0 * step),
            "{i}: {rate} for {power} of {most}"
        );
    }
}

#[test]
fn the_power_of_a_joint_has_its_tilts_and_its_axial_part() {
    let bushing = r#"kind = "bushing"
first = { body = "wheel", z = "20 mm" }
stiffness = { xx = "1e6 N/m", xy = "2e4 N/m", yx = "-1e4 N/m", yy = "8e5 N/m" }
damping = { xx = "300 N*s/m", yy = "200 N*s/m" }
tilting_stiffness = { xx = "2e4 N*m/rad", xy = "1e3 N*m/rad", yx = "-2e3 N*m/rad", yy = "3e4 N*m/rad" }
tilting_damping = { xx = "20 N*m*s/rad", yy = "30 N*m*s/rad" }
axial_stiffness = "5e5 N/m"
axial_damping = "300 N*s/m"
"#;
    powers_change_the_kinetic_energy(bushing, &[]);
}

/// A spring between displacements and tilts of the whole joint: k along and t about x and y, a along z, and b between them.
const WHOLE: &str = r#"kind = "law"
name = "whole"
title = "A spring of a whole joint"
source = "a test"
[inputs]
e_x = { unit = "m" }
e_y = { unit = "m" }
e_z = { unit = "m" }
alpha_x = { unit = "rad" }
alpha_y = { unit = "rad" }
[outputs]
F_x = { unit = "N", value = '-k*e_x + b*alpha_y' }
F_y = { unit = "N", value = '-0.8*k*e_y - b*alpha_x' }
F_z = { unit = "N", value = '-a*e_z' }
M_x = { unit = "N*m", value = '-t*alpha_x - b*e_y' }
M_y = { unit = "N*m", value = '-1.5*t*alpha_y + b*e_x' }
[parameters]
k = { value = 1e6, unit = "N/m" }
a = { value = 5e5, unit = "N/m" }
t = { value = 2e4, unit = "N*m" }
b = { value = 3e3, unit = "N" }
"#;

#[test]
fn the_power_of_a_law_of_a_whole_joint_has_its_moments_and_its_axial_part() {
    let joint =
        "kind = \"bearing\"\njournal = { body = \"wheel\", z = \"20 mm\" }\nlaw = \"whole.toml\"\n";
    powers_change_the_kinetic_energy(joint, &[("whole.toml", WHOLE)]);
}

/// A law that acts once a plane, 1 N/µm in all directions.
const RING: &str = r#"kind = "law"
name = "ring"
title = "A spring in every plane"
source = "a test"
[inputs.e_x]
unit = "m"
[inputs.e_y]
unit = "m"
[outputs.F_x]
unit = "N"
value = '-k*e_x'
[outputs.F_y]
unit = "N"
value = '-k*e_y'
[parameters.k]
value = 1e6
unit = "N/m"
"#;

/// A journal whose axis is apart from that of the bore that turns around it is eccentric by that before anything moves.
#[test]
fn the_deformation_of_a_joint_has_the_distance_of_the_axes() {
    let body = |name: &str, speed: &str, axis: &str| {
        format!(
            "[body.{name}]\nturns = \"prescribed\"\nspeed = \"{speed}\"\naxis = {axis}\nmass = \"1e6 kg\"\n\
             polar_inertia = \"1e6 kg*m^2\"\n"
        )
    };
    let case = format!(
        "title = \"x\"\n{}{}[joint.mount]\nkind = \"bearing\"\njournal = {{ body = \"inner\" }}\nbore = {{ body = \"outer\" }}\n\
         law = \"ring.toml\"\nradial_clearance = \"1 mm\"\n[output.own]\nquantity = \"deformation\"\njoint = \"mount\"\n{}",
        body("inner", "600 rpm", "[\"0.03 mm\", \"-0.01 mm\"]"),
        body("outer", "900 rpm", "[\"0.01 mm\", \"0.005 mm\"]"),
        march("1e-7 s", 1)
    );
    let found = run(&case, &[("ring.toml", RING)]);
    for (column, exact) in [
        ("dx_own_um", 20.0),
        ("dy_own_um", -15.0),
        ("EX_mount_um", 20.0),
        ("EY_mount_um", -15.0),
        ("RX_mount_N", -20.0),
        ("RY_mount_N", 15.0),
    ] {
        // The frame of the outer one has turned by 10⁻⁵, in which the law acts.
        assert!((found.last(column) - exact).abs() < 1e-3, "{column}: {}", found.last(column));
    }
}

/// Three offsets of a bore, of which a law at three planes takes each.
#[test]
fn every_offset_of_a_bore_counts() {
    let case = r#"title = "x"
[body.rotor]
turns = "prescribed"
speed = "600 rpm"
mass = "1e6 kg"
polar_inertia = "1e6 kg*m^2"
transverse_inertia = "1e6 kg*m^2"
z = "0 mm"

[body.frame]
turns = "no"
mass = "1e6 kg"
transverse_inertia = "1e6 kg*m^2"
z = "0 mm"

[joint.mount]
kind = "bearing"
journal = { body = "rotor" }
bore = { body = "frame" }
law = "ring.toml"
radial_clearance = "1 mm"
stations = ["-10 mm", "0 mm", "10 mm"]
run_out = [["1 um", "2 um"], ["-3 um", "5 um"], ["7 um", "-11 um"]]
offset = [["13 um", "0 um"], ["20 um", "10 um"], ["40 um", "30 um"]]

"#;
    // The rotor stands at 0 at t = 0, but for 10⁻⁵ of a turn of its run-out.
    let found = run(&format!("{case}{}", march("1e-7 s", 1)), &[("ring.toml", RING)]);
    for (column, exact) in
        [("RX_mount_N", 13.0 + 20.0 + 40.0 - 5.0), ("RY_mount_N", 0.0 + 10.0 + 30.0 + 4.0)]
    {
        assert!((found.last(column) - exact).abs() < 1e-3, "{column}: {}", found.last(column));
    }
}

/// Tilting stiffness with cross terms that are not alike: (α, β) = K⁻¹ M.
#[test]
fn cross_terms_of_tilting_stiffness_stand_in_their_places() {
    let case = r#"title = "x"
[body.wheel]
turns = "no"
mass = "4 kg"
transverse_inertia = "0.3 kg*m^2"
z = "20 mm"

[joint.mount]
kind = "bushing"
first = { body = "wheel", z = "20 mm" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }
tilting_stiffness = { xx = "2e4 N*m/rad", xy = "5e3 N*m/rad", yx = "-3e3 N*m/rad", yy = "4e4 N*m/rad" }

[loads.turn]
body = "wheel"
couple = ["10 N*m", "3 N*m", "0 N*m"]

[output.rim]
quantity = "displacement"
body = "wheel"
z = "120 mm"

[start]
kind = "equilibrium"

"#;
    let found = run(&format!("{case}{}", march("1e-5 s", 3)), &[]);
    let ([xx, xy, yx, yy], [mx, my]) = ([2e4, 5e3, -3e3, 4e4], [10.0, 3.0]);
    let determinant: f64 = xx * yy - xy * yx;
    let (alpha, beta) = ((yy * mx - xy * my) / determinant, (xx * my - yx * mx) / determinant);
    for (column, exact) in [("x_rim_um", 1e6 * beta * 0.1), ("y_rim_um", -1e6 * alpha * 0.1)] {
        let wrong = (found.last(column) / exact - 1.0).abs();
        assert!(wrong < 1e-6, "{column}: {} for {exact}", found.last(column));
    }
}

/// An added mass at a radius pulls with m r ω², on a rigid body and on a mesh.
#[test]
fn added_masses_stand_at_their_radius() {
    let bushing = |name: &str, side: &str| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", {side} }}\n\
             stiffness = {{ xx = \"1e8 N/m\", yy = \"1e8 N/m\" }}\ndamping = {{ xx = \"2e4 N*s/m\", yy = \"2e4 N*s/m\" }}\n"
        )
    };
    let rigid = "mass = \"2 kg\"\npolar_inertia = \"2e-3 kg*m^2\"\ntransverse_inertia = \"3e-3 kg*m^2\"\nz = \"0 mm\"\n";
    let rigid_joints = bushing("near", "z = \"-50 mm\"") + &bushing("far", "z = \"50 mm\"");
    let meshed = "material = \"steel\"\nmodes = 4\ndamping = \"1e-5 s\"\naxial_restraint = \"JOURNAL1_MIDDLE\"\n[body.rotor.dimensions]\n\
                  length = \"100 mm\"\ndiameter = \"60 mm\"\nsupports = [\"20 mm\", \"80 mm\"]\nsupport_length = \"10 mm\"\n\
                  layers_in_support = 2\nlayers_between = 4\ncells = { sectors = 8, rings = 2, order = 1 }\n\
                  [material.steel]\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\ndensity = \"7860 kg/m^3\"\n";
    let meshed_joints = bushing("near", "sets = \"JOURNAL1_MIDDLE\"")
        + &bushing("far", "sets = \"JOURNAL2_MIDDLE\"");
    let force = 0.01 * 0.1 * (100.0 * PI).powi(2);
    for (form, joints, z) in [(rigid, rigid_joints, "0 mm"), (meshed, meshed_joints, "50 mm")] {
        let case = format!(
            "title = \"x\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\n{form}\
             [body.rotor.added.one]\nmass = \"10 g\"\nradius = \"100 mm\"\nangle = \"30 deg\"\nz = \"{z}\"\n{joints}{}",
            march("1e-4 s", 2000)
        );
        let Run { history, .. } = run(&case, &[]);
        let both = ["RX_near_N", "RX_far_N"].map(|name| largest(&history, name, 400));
        let sum = both[0] + both[1];
        // ω is a thirtieth of what the bushings hold the rotor with, or less.
        assert!((sum / force - 1.0).abs() < 5e-3, "{sum} for {force}: {form}");
    }
}

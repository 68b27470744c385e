//! Thin bodies: a drum that ovalises, and a liner with many modes at nearly one frequency.

use super::march;
use crate::analyses::{numbers, ran};
use crate::workbench::Workbench;

/// Cells of one layer of a ring, `around` of them, as an input file (m).
fn ring(radii: [f64; 2], length: f64, (around, layers): (usize, usize)) -> String {
    let node = |k: usize, i: usize, r: usize| 2 * (k * around + i % around) + r + 1;
    let mut text = "*NODE\n".to_owned();
    for k in 0..=layers {
        for i in 0..around {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / around as f64).sin_cos();
            let z = length * k as f64 / layers as f64;
            for (r, radius) in radii.iter().enumerate() {
                text += &format!("{}, {}, {}, {z}\n", node(k, i, r), radius * cos, radius * sin);
            }
        }
    }
    text += "*ELEMENT, TYPE=C3D8I, ELSET=RING\n";
    for k in 0..layers {
        for i in 0..around {
            let face = |k| [node(k, i, 0), node(k, i, 1), node(k, i + 1, 1), node(k, i + 1, 0)];
            let nodes: Vec<String> =
                face(k).iter().chain(&face(k + 1)).map(ToString::to_string).collect();
            text += &format!("{}, {}\n", k * around + i + 1, nodes.join(", "));
        }
    }
    text
}

/// A thin drum whose rotation is prescribed ovalises as one that is free: with n waves around at
/// n(n² − 1)/√(n² + 1) · √(EI/(ρA))/R² (Love). Two nodes of a diameter that turn with the frame would stiffen it.
#[test]
fn the_frame_does_not_stiffen_a_thin_drum() {
    let case = format!(
        r#"title = "x"
[material.steel]
youngs_modulus = "206 GPa"
poissons_ratio = 0.3
density = "7850 kg/m^3"
[body.drum]
turns = "prescribed"
speed = "1 rpm"
mesh = "drum.inp"
units = "m, N, kg"
material = "steel"
modes = 20
damping = "0 s"
axial_restraint = "END"
[body.drum.sets]
END = {{ plane = "0 mm" }}
OTHER = {{ plane = "3 mm" }}
[joint.soft]
kind = "bushing"
first = {{ body = "drum", sets = "END" }}
stiffness = {{ xx = "1 N/m", yy = "1 N/m" }}
[joint.other]
kind = "bushing"
first = {{ body = "drum", sets = "OTHER" }}
stiffness = {{ xx = "1 N/m", yy = "1 N/m" }}
{}"#,
        march("1e-5 s", 10)
    );
    let bench = Workbench::new()
        .file("drum.inp", &ring([0.0495, 0.0505], 0.003, (96, 1)))
        .file("case.toml", &case);
    ran(&bench, &["modes", "case.toml", "--speeds", "1 rpm", "--out", "out", "--no-figures"]);
    let found = numbers(&bench, "out/modes.csv", "frequency_hz");
    let (n, bending) = (2.0_f64, 206e9_f64 * 0.001 * 0.001 / 12.0 / 7850.0);
    let exact = n * (n * n - 1.0) / (n * n + 1.0).sqrt() * bending.sqrt() / 0.05_f64.powi(2);
    let exact = exact / std::f64::consts::TAU;
    // On its springs the drum moves as a whole far below.
    let ovals: Vec<f64> = found.into_iter().filter(|own| *own > 0.1 * exact).take(2).collect();
    for own in ovals {
        assert!((own / exact - 1.0).abs() < 5e-3, "{own} Hz for {exact} Hz");
    }
}

/// A liner held on its outside has hundreds of modes within a thousandth, of which as many are found as are asked for.
#[test]
fn modes_of_a_thin_shell_that_is_held_are_found() {
    let said = |modes: usize| {
        let case = format!(
            r#"title = "x"
[material.bronze]
youngs_modulus = "110 GPa"
poissons_ratio = 0.34
density = "8800 kg/m^3"
[body.liner]
turns = "no"
mesh = "liner.inp"
units = "m, N, kg"
material = "bronze"
modes = {modes}
damping = "1e-7 s"
held = ["OUTSIDE"]
[body.liner.sets]
OUTSIDE = {{ radius = "51 mm", within = "0.1 mm" }}
BORE = {{ radius = "50 mm", within = "0.1 mm" }}
[body.rotor]
turns = "prescribed"
speed = "3000 rpm"
mass = "10 kg"
polar_inertia = "0.02 kg*m^2"
[joint.bearing]
kind = "bearing"
journal = {{ body = "rotor" }}
bore = {{ body = "liner", surface = "BORE" }}
law = "hu2003-nonlinear"
springs = 24
length = "60 mm"
radial_clearance = "35 um"
{}"#,
            march("1e-6 s", 10)
        );
        let bench = Workbench::new()
            .file("liner.inp", &ring([0.05, 0.051], 0.06, (120, 16)))
            .file("case.toml", &case);
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 0, "{modes}: {}", outcome.stderr);
        let line =
            outcome.stdout.lines().find(|line| line.starts_with("liner") && line.ends_with('…'));
        line.map(str::to_owned)
    };
    assert_eq!(said(0), None);
    let few = said(10).expect("frequencies");
    assert_eq!(Some(&few), said(40).as_ref());
    let hertz: Vec<f64> = few.split_whitespace().filter_map(|own| own.parse().ok()).collect();
    let cluster = hertz[4] / hertz[0] - 1.0;
    assert!((0.0..1e-3).contains(&cluster), "{few}");
}

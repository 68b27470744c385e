//! Bodies of matrices whose nodes turn: a beam of two nodes with six dofs each.

use std::fmt::Write;

use super::{Run, march, run};
use crate::workbench::Workbench;

const LENGTH: f64 = 0.4;
const BENDING: f64 = 400.0;
const TORSION: f64 = 300.0;
const ALONG: f64 = 4e6;
/// Of each node (kg, kg·m²), alike about all axes.
const MASS: f64 = 1.5;
const INERTIA: f64 = 2e-3;

const AXES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// A full matrix of the twelve dofs, in the order of the nodes.
fn array(name: &str, value: impl Fn(usize, usize) -> f64) -> (String, String) {
    let mut text = "%%MatrixMarket matrix array real general\n12 12\n".to_owned();
    for j in 0..12 {
        (0..12).for_each(|i| writeln!(text, "{:e}", value(i, j)).expect("text"));
    }
    (name.to_owned(), text)
}

/// K of a beam along z of Euler and Bernoulli.
fn stiffness() -> Vec<Vec<f64>> {
    let mut k = vec![vec![0.0; 12]; 12];
    let (l, b) = (LENGTH, BENDING / LENGTH.powi(3));
    let beam = [
        [12.0, 6.0 * l, -12.0, 6.0 * l],
        [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
        [-12.0, -6.0 * l, 12.0, -6.0 * l],
        [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
    ];
    // u with its slope, the turn about y; v with its slope, the turn about −x.
    for (dofs, sign) in [([0, 4, 6, 10], 1.0), ([1, 3, 7, 9], -1.0)] {
        for (i, &row) in dofs.iter().enumerate() {
            for (j, &column) in dofs.iter().enumerate() {
                let signs = |n: usize| if n % 2 == 1 { sign } else { 1.0 };
                k[row][column] += b * beam[i][j] * signs(i) * signs(j);
            }
        }
    }
    for (first, value) in [(2, ALONG / LENGTH), (5, TORSION / LENGTH)] {
        for (i, j, sign) in [(0, 0, 1.0), (0, 6, -1.0), (6, 0, -1.0), (6, 6, 1.0)] {
            k[first + i][first + j] += sign * value;
        }
    }
    k
}

/// The files of the beam, its masses off the axis along x by so much, and what `spin_load` says of that (m).
fn files(off: f64, said: f64) -> Vec<(String, String)> {
    let (k, diagonal) = (stiffness(), |i: usize| if i % 6 < 3 { MASS } else { INERTIA });
    // A mass off its node: M couples y with rz and z with ry.
    let mass = |i: usize, j: usize| {
        let pair = (i.min(j) % 6, i.max(j) % 6);
        match (i == j, i / 6 == j / 6, pair) {
            (true, ..) => diagonal(i) + if i % 6 > 3 { MASS * off * off } else { 0.0 },
            (_, true, (1, 5)) => MASS * off,
            (_, true, (2, 4)) => -MASS * off,
            _ => 0.0,
        }
    };
    // ∫ρ Nᵀ diag(1, 1, 0) N: of an inertia alike about all axes half for each tilt, all for the turn.
    let inertia = |i: usize, j: usize| {
        let pair = (i.min(j) % 6, i.max(j) % 6);
        match (i == j, i / 6 == j / 6, pair) {
            (true, ..) => match i % 6 {
                0 | 1 => MASS,
                2 => 0.0,
                5 => INERTIA + MASS * off * off,
                _ => 0.5 * INERTIA,
            },
            (_, true, (1, 5)) => MASS * off,
            _ => 0.0,
        }
    };
    let coupling = |i: usize, j: usize| match (i / 6 == j / 6, i % 6, j % 6) {
        (true, 0, 1) => MASS,
        (true, 1, 0) => -MASS,
        (true, 3, 4) => 0.5 * INERTIA,
        (true, 4, 3) => -0.5 * INERTIA,
        (true, 0, 5) => MASS * off,
        (true, 5, 0) => -MASS * off,
        _ => 0.0,
    };
    let mut dofs = "node, direction, x, y, z\n".to_owned();
    let mut load = "%%MatrixMarket matrix array real general\n12 1\n".to_owned();
    for node in 0..2 {
        for (k, axis) in AXES.iter().enumerate() {
            writeln!(dofs, "{}, {axis}, 0, 0, {}", node + 1, LENGTH * node as f64).expect("text");
            writeln!(load, "{:e}", if k == 0 { MASS * said } else { 0.0 }).expect("text");
        }
    }
    vec![
        array("K.mtx", |i, j| k[i][j]),
        array("M.mtx", mass),
        array("Y.mtx", inertia),
        array("H.mtx", coupling),
        ("load.mtx".to_owned(), load),
        ("dofs.csv".to_owned(), dofs),
    ]
}

const BEAM: &str = r#"title = "a beam of matrices"
[body.beam]
turns = "prescribed"
speed = "SPEED"
stiffening = false
damping = "2e-2 s"
section = "NODE_1"
matrices = { stiffness = "K.mtx", mass = "M.mtx", dofs = "dofs.csv", spin_inertia = "Y.mtx", spin_coupling = "H.mtx", spin_load = "load.mtx" }
axial_restraint = "NODE_1"
[joint.left]
kind = "bushing"
first = { body = "beam", sets = "NODE_1" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }
tilting_stiffness = { xx = "1e4 N*m/rad", yy = "1e4 N*m/rad" }
"#;

fn of_beam(speed: &str, rest: &str, all: &[(String, String)]) -> Run {
    let files: Vec<(&str, &str)> =
        all.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    run(&(BEAM.replace("SPEED", speed) + rest), &files)
}

/// A couple on a node twists the beam between it and the section of the frame, and a coupling on the node shows it.
#[test]
fn couples_and_couplings_act_on_the_turns_of_nodes() {
    let rest = r#"
[loads.twist]
body = "beam"
sets = ["NODE_2"]
couple = "30 N*m"
[body.other]
turns = "prescribed"
speed = "1 rpm"
mass = "1 kg"
polar_inertia = "1e-3 kg*m^2"
[joint.other]
kind = "bushing"
first = { body = "other" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }
[joint.meter]
kind = "coupling"
first = { body = "beam", sets = "NODE_2" }
second = { body = "other" }
stiffness = "1e-3 N*m/rad"
[output.meter]
quantity = "deformation"
joint = "meter"
[start]
kind = "equilibrium"
"#;
    let done = of_beam("1 rpm", &(rest.to_owned() + &march("1e-4 s", 20)), &files(0.0, 0.0));
    // The meter takes its part.
    let exact = 30.0 / (TORSION / LENGTH + 1e-3);
    let found = done.last("twist_meter_rad");
    assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
}

/// A cantilever of one beam element, on which a force, a disc and an unbalance act: F l³/(3 EI), beside what the spring and the
/// tilting spring at its foot yield.
#[test]
fn discs_unbalance_and_tilting_bushings_act_on_nodes_that_turn() {
    let rest = r#"
[body.beam.disc.wheel]
mass = "2 kg"
polar_inertia = "4e-3 kg*m^2"
transverse_inertia = "2e-3 kg*m^2"
z = "400 mm"
[body.beam.unbalance.grub]
mass = "10 g"
radius = "50 mm"
z = "400 mm"
[output.tip]
quantity = "displacement"
body = "beam"
set = "NODE_2"
frame = "body"
components = ["x"]
"#;
    let done = of_beam("300 rpm", &(rest.to_owned() + &march("5e-4 s", 2000)), &files(0.0, 0.0));
    let omega = 300.0 * std::f64::consts::TAU / 60.0;
    // The force m e ω² of the unbalance on the tip: u and slope at the foot by its springs, then the beam; the masses follow
    // with ω²; I_p − I_d of the disc stiffens its tilts, ½ I of the beam's own softens them, as `stiffening = false` has it.
    let (l, ei, square) = (LENGTH, BENDING, omega * omega);
    let (m, tip) = (MASS + 2.0, 0.01 * 0.05 * square);
    let matrix = [
        // Unknown: u1, slope 1, u2, slope 2.
        [
            12.0 * ei / l.powi(3) + 1e6 - MASS * square,
            6.0 * ei / (l * l),
            -12.0 * ei / l.powi(3),
            6.0 * ei / (l * l),
        ],
        [
            6.0 * ei / (l * l),
            4.0 * ei / l + 1e4 - 0.5 * INERTIA * square,
            -6.0 * ei / (l * l),
            2.0 * ei / l,
        ],
        [
            -12.0 * ei / l.powi(3),
            -6.0 * ei / (l * l),
            12.0 * ei / l.powi(3) - m * square,
            -6.0 * ei / (l * l),
        ],
        [
            6.0 * ei / (l * l),
            2.0 * ei / l,
            -6.0 * ei / (l * l),
            4.0 * ei / l - 0.5 * INERTIA * square + (4e-3 - 2e-3) * square,
        ],
    ];
    let exact = 1e6 * solve(matrix, [0.0, 0.0, tip, 0.0])[2];
    let found = done.last("x_tip_um");
    assert!((found / exact - 1.0).abs() < 1e-4, "{found} {exact}");
}

/// Gauss without pivots, of a matrix that is positive definite.
fn solve(mut a: [[f64; 4]; 4], mut b: [f64; 4]) -> [f64; 4] {
    for k in 0..4 {
        for i in k + 1..4 {
            let factor = a[i][k] / a[k][k];
            (0..4).for_each(|j| a[i][j] -= factor * a[k][j]);
            b[i] -= factor * b[k];
        }
    }
    for k in (0..4).rev() {
        let known: f64 = (k + 1..4).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}

/// M knows where the centre of mass is: a load that says otherwise is refused, one that agrees is taken.
#[test]
fn a_spin_load_is_that_of_the_centre_of_mass() {
    let check = |off: f64, said: f64| {
        let all = files(off, said);
        let bench = all.iter().fold(Workbench::new(), |bench, (name, text)| bench.file(name, text));
        let bench =
            bench.file("case.toml", &(BEAM.replace("SPEED", "600 rpm") + &march("1e-4 s", 5)));
        bench.whirl(&["check", "case.toml"])
    };
    let right = check(1e-4, 1e-4);
    assert_eq!(right.status, 0, "{}", right.stderr);
    let wrong = check(1e-4, 0.0);
    assert_eq!(wrong.status, 2, "{}", wrong.stdout);
    let said = "`spin_load` is that of a centre of mass at x = 0 mm, y = 0 mm from the axis of the body; by M it is at x = 0.1 mm";
    assert!(wrong.stderr.contains(said), "{}", wrong.stderr);
}

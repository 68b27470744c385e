//! Laws of whole joints, on displacements and tilts at once, against solutions that share nothing with the program.

use std::f64::consts::TAU;
use std::fs::{read, read_to_string};

use crate::workbench::Workbench;

use super::run;

const BALLS: &str = include_str!("../../../specs/laws/angular-contact-ball.toml");

/// A rotor or a block on one joint, under a force and a couple that stand in space.
pub(super) fn body(turns: &str, joint: &str, rest: &str) -> String {
    format!(
        r#"title = "x"
[body.rotor]
{turns}
mass = "5 kg"
transverse_inertia = "0.02 kg*m^2"
z = "0 mm"
moves_along_z = true

[joint.b]
kind = "bearing"
journal = {{ body = "rotor", z = "0 mm" }}
{joint}

[loads.pull]
body = "rotor"
force = ["300 N", "-120 N", "900 N"]

[loads.tilt]
body = "rotor"
couple = ["1 N*m", "-0.6 N*m", "0 N*m"]

[output.f]
quantity = "force"
joint = "b"
[output.z]
quantity = "axial_force"
joint = "b"
[output.m]
quantity = "moment"
joint = "b"
[output.e]
quantity = "deformation"
joint = "b"
[output.e_z]
quantity = "axial_deformation"
joint = "b"
[output.a]
quantity = "tilt"
joint = "b"
{rest}"#
    )
}

const LOAD: [f64; 5] = [300.0, -120.0, 900.0, 1.0, -0.6];
const TURNING: &str =
    "turns = \"prescribed\"\nspeed = \"3000 rpm\"\npolar_inertia = \"0.01 kg*m^2\"";
const START: &str = "[start]\nkind = \"equilibrium\"\n";

/// What the history shows of the joint in its last row: forces and moments, displacements and tilts (SI).
fn last(done: &super::Run) -> [[f64; 5]; 2] {
    let at = |columns: [&str; 5], scales: [f64; 5]| {
        let mut scales = scales.into_iter();
        columns.map(|column| done.last(column) * scales.next().expect("five"))
    };
    [
        at(["fx_f_N", "fy_f_N", "fz_z_N", "mx_m_Nm", "my_m_Nm"], [1.0; 5]),
        at(
            ["dx_e_um", "dy_e_um", "dz_e_z_um", "tilt_x_a_rad", "tilt_y_a_rad"],
            [1e-6, 1e-6, 1e-6, 1.0, 1.0],
        ),
    ]
}

/// x of A x = b by elimination with pivots.
fn solve(mut a: [[f64; 5]; 5], mut b: [f64; 5]) -> [f64; 5] {
    for k in 0..5 {
        let pivot = (k..5).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).expect("rows");
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..5 {
            let factor = a[i][k] / a[k][k];
            let row = a[k];
            a[i].iter_mut().zip(row).skip(k).for_each(|(own, pivot)| *own -= factor * pivot);
            b[i] -= factor * b[k];
        }
    }
    for k in (0..5).rev() {
        let known: f64 = (k + 1..5).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}

/// The bearing as shipped, SI: gradient and Hessian of its potential 0.4 K Σ δ^2.5.
fn balls(u: [f64; 5]) -> ([f64; 5], [[f64; 5]; 5]) {
    let (count, k, alpha, a, radius, preload) =
        (10, 2.9e5 * 1e3_f64.powf(1.5), 0.4363323_f64, 0.27e-3, 14.25e-3, 10e-6);
    let (mut gradient, mut hessian) = ([0.0; 5], [[0.0; 5]; 5]);
    for ball in 1..=count {
        let (sin, cos) = (TAU * f64::from(ball) / f64::from(count)).sin_cos();
        let by_r = [cos, sin, 0.0, 0.0, 0.0];
        let by_z = [0.0, 0.0, 1.0, radius * sin, -radius * cos];
        let along = |by: &[f64; 5]| by.iter().zip(&u).map(|(by, u)| by * u).sum::<f64>();
        let r = a * alpha.cos() + along(&by_r);
        let z = a * alpha.sin() + preload + along(&by_z);
        let s = r.hypot(z);
        let pressed = (s - a).max(0.0);
        let by_s: [f64; 5] = std::array::from_fn(|i| (r * by_r[i] + z * by_z[i]) / s);
        for i in 0..5 {
            gradient[i] += k * pressed.powf(1.5) * by_s[i];
            for j in 0..5 {
                let curved = (by_r[i] * by_r[j] + by_z[i] * by_z[j] - by_s[i] * by_s[j]) / s;
                hessian[i][j] +=
                    1.5 * k * pressed.sqrt() * by_s[i] * by_s[j] + k * pressed.powf(1.5) * curved;
            }
        }
    }
    (gradient, hessian)
}

/// Where the bearing carries the load, by Newton's method.
fn balanced() -> [f64; 5] {
    let mut u = [0.0; 5];
    for iteration in 0..60 {
        let (gradient, hessian) = balls(u);
        let step = solve(hessian, std::array::from_fn(|i| LOAD[i] - gradient[i]));
        let part = if iteration < 40 { 0.5 } else { 1.0 };
        u = std::array::from_fn(|i| u[i] + part * step[i]);
    }
    let (gradient, _) = balls(u);
    for (found, load) in gradient.iter().zip(LOAD) {
        assert!((found - load).abs() < 1e-9 * 900.0, "{found} for {load}");
    }
    u
}

fn close(found: [f64; 5], exact: [f64; 5], share: f64, what: &str) {
    // Of displacements, and of tilts, the largest.
    let size = |range: std::ops::Range<usize>| {
        exact[range].iter().fold(0.0, |most: f64, own| most.max(own.abs()))
    };
    let sizes = [size(0..3), size(3..5)];
    for (i, (found, exact)) in found.into_iter().zip(exact).enumerate() {
        let size = sizes[usize::from(i > 2)];
        assert!((found - exact).abs() < share * size, "{what} {i}: {found} for {exact}");
    }
}

/// A block at rest that its damping brings there, to the digits of the history; and a rotor that starts there.
#[test]
fn balls_carry_force_thrust_and_moment_where_an_independent_solution_has_it() {
    let exact = balanced();
    let damped = "law = \"angular-contact-ball\"\n\
                  parameters = { c_r = \"1e5 N*s/m\", c_a = \"1e5 N*s/m\" }";
    let march = "[march]\ntime_step = \"1e-4 s\"\nsteps = 4000\n";
    let done = run(&body("turns = \"no\"", damped, march), &[]);
    let [forces, moved] = last(&done);
    close(forces, LOAD.map(|own| -own), 1e-9, "force");
    close(moved, exact, 1e-8, "displacement");
    let plain = "law = \"angular-contact-ball\"";
    let march = format!("{START}[march]\ntime_step = \"1e-5 s\"\nsteps = 200\n");
    let done = run(&body(TURNING, plain, &march), &[]);
    let [forces, moved] = last(&done);
    // A start in equilibrium is balanced to 1e-6 of the largest term of a row.
    close(forces, LOAD.map(|own| -own), 4e-6, "force at speed");
    close(moved, exact, 4e-6, "displacement at speed");
    let summary = read_to_string(done.bench.path("out/summary.json")).expect("a summary");
    assert!(summary.contains("\"sound\": true"), "{summary}");
}

/// The law as a file is the one that is compiled, and steps that the program chooses go to the same place.
#[test]
fn a_law_of_a_joint_from_a_file_gives_the_bytes_of_the_compiled_one() {
    let march = format!("{START}[march]\ntime_step = \"1e-5 s\"\nsteps = 200\n");
    let history = |law: &str| {
        let case = body(TURNING, &format!("law = \"{law}\""), &march);
        let done = run(&case, &[("mine.toml", BALLS)]);
        read(done.bench.path("out/history.csv")).expect("a history")
    };
    assert!(history("angular-contact-ball") == history("mine.toml"));
    let damped = "law = \"mine.toml\"\nparameters = { c_r = \"1e5 N*s/m\", c_a = \"1e5 N*s/m\" }";
    let march = "[march]\ntime_step = \"auto\"\noutput_step = \"1 ms\"\nduration = \"0.4 s\"\n";
    let done = run(&body("turns = \"no\"", damped, march), &[("mine.toml", BALLS)]);
    let [_, moved] = last(&done);
    close(moved, balanced(), 1e-6, "automatic steps");
}

/// K and C of the linear joint, row after row; neither is symmetric.
const K: [[f64; 5]; 5] = [
    [9e7, 2e7, -1e7, 1e5, -8e5],
    [-1.5e7, 7e7, 3e6, 6e5, 2e5],
    [5e6, -4e6, 4e7, -1e5, 3e5],
    [2e5, 5e5, -3e5, 2.1e4, 1.2e3],
    [-7e5, 1e5, 2e5, -900.0, 2.6e4],
];
const C: [[f64; 5]; 5] = [
    [900.0, 120.0, -50.0, 3.0, -6.0],
    [-80.0, 700.0, 40.0, 5.0, 1.0],
    [30.0, -20.0, 600.0, -2.0, 4.0],
    [1.0, 4.0, -3.0, 0.5, 0.04],
    [-5.0, 2.0, 1.0, -0.03, 0.6],
];
const NAMES: [&str; 5] = ["x", "y", "z", "ax", "ay"];

/// The joint with these matrices.
fn linear() -> String {
    let mut parameters = Vec::new();
    for (letter, matrix, time) in [("k", K, ""), ("c", C, "*s")] {
        for (row, values) in NAMES.iter().zip(matrix) {
            for (column, value) in NAMES.iter().zip(values) {
                let force = if row.starts_with('a') { "N*m" } else { "N" };
                let per = if column.starts_with('a') { "rad" } else { "m" };
                let unit = format!("{force}{time}/{per}");
                parameters.push(format!("{letter}_{row}_{column} = \"{value:e} {unit}\""));
            }
        }
    }
    format!("law = \"linear-5x5\"\nparameters = {{ {} }}", parameters.join(", "))
}

#[test]
fn a_linear_joint_deflects_by_the_inverse_of_its_stiffness() {
    let march = format!("{START}[march]\ntime_step = \"1e-5 s\"\nsteps = 20\n");
    let done = run(&body("turns = \"no\"", &linear(), &march), &[]);
    let [forces, moved] = last(&done);
    close(forces, LOAD.map(|own| -own), 1e-9, "force");
    close(moved, solve(K, LOAD), 1e-9, "displacement");
}

type Complex = [f64; 2];

fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

/// The least pivot over the largest of a complex matrix whose rows and columns are of one size.
fn singularity(mut m: [[Complex; 5]; 5]) -> f64 {
    let size = |own: Complex| own[0].hypot(own[1]);
    let mut pivots = Vec::new();
    for k in 0..5 {
        let places = (k..5).flat_map(|i| (k..5).map(move |j| (i, j)));
        let at = |&(i, j): &(usize, usize)| size(m[i][j]);
        let (i, j) = places.max_by(|a, b| at(a).total_cmp(&at(b))).expect("a pivot");
        m.swap(k, i);
        m.iter_mut().for_each(|row| row.swap(k, j));
        let own = m[k][k];
        pivots.push(size(own));
        let square = own[0] * own[0] + own[1] * own[1];
        let inverse = [own[0] / square, -own[1] / square];
        for i in k + 1..5 {
            let factor = times(m[i][k], inverse);
            let row = m[k];
            for (own, pivot) in m[i].iter_mut().zip(row).skip(k) {
                let part = times(factor, pivot);
                *own = [own[0] - part[0], own[1] - part[1]];
            }
        }
    }
    pivots[4] / pivots[0]
}

/// λ of every mode at speed makes λ²M + λ(C + ΩG) + K singular; `whirl coefficients` gives K and C back.
#[test]
fn modes_and_coefficients_of_a_linear_joint_are_those_of_its_matrices() {
    let analysis = "[analysis.k]\nkind = \"coefficients\"\nspeeds = \"3000 rpm\"\n";
    let case = body(TURNING, &linear(), analysis);
    let bench = Workbench::new().file("case.toml", &case);
    for arguments in [
        ["modes", "case.toml", "--speeds", "3000 rpm", "--out", "modes"].as_slice(),
        ["analyse", "case.toml", "k", "--out", "joints"].as_slice(),
    ] {
        let outcome = bench.whirl(arguments);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    }
    let rows = |path: &str| -> Vec<Vec<String>> {
        let text = read_to_string(bench.path(path)).expect("a file of results");
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
    };
    let modes = rows("modes/modes.csv");
    let place = |name: &str| modes[0].iter().position(|own| own == name).expect("a column");
    let (real, imaginary) = (place("real_1_s"), place("imaginary_1_s"));
    assert_eq!(modes.len(), 1 + 5, "five modes");
    let (mass, across, spin) = (5.0, 0.02, 0.01 * TAU * 50.0);
    // Lengths count as their product with the wave number of a tilt: entries of one size.
    let scale = |i: usize| if i > 2 { 1.0 } else { f64::sqrt(across / mass) };
    for row in &modes[1..] {
        let number = |place: usize| row[place].parse::<f64>().expect("a number");
        let value = [number(real), number(imaginary)];
        let square = times(value, value);
        let dynamic = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let gyroscopic = match (i, j) {
                    (3, 4) => spin,
                    (4, 3) => -spin,
                    _ => 0.0,
                };
                let inertia = if i != j {
                    0.0
                } else if i > 2 {
                    across
                } else {
                    mass
                };
                let damping = C[i][j] + gyroscopic;
                let scale = scale(i) * scale(j);
                let entry = |part: usize| {
                    let own = inertia * square[part] + damping * value[part];
                    scale * (own + if part == 0 { K[i][j] } else { 0.0 })
                };
                [entry(0), entry(1)]
            })
        });
        let left = singularity(dynamic);
        assert!(left < 1e-9, "{value:?}: {left:e}");
        assert!(singularity_off(dynamic) > 1e-4, "a root stands out");
    }
    let found = rows("joints/k.5x5.csv");
    for (letter, matrix) in [("k", K), ("c", C)] {
        for (row, values) in NAMES.iter().zip(matrix) {
            for (column, value) in NAMES.iter().zip(values) {
                let begin = format!("{letter}_{row}_{column}_");
                let place = found[0].iter().position(|own| own.starts_with(&begin));
                let own: f64 = found[1][place.expect("a column")].parse().expect("a number");
                assert!((own - value).abs() < 1e-7 * value.abs(), "{begin}: {own} for {value}");
            }
        }
    }
}

/// The same a little beside the root.
fn singularity_off(mut matrix: [[Complex; 5]; 5]) -> f64 {
    (0..5).for_each(|i| matrix[i][i][0] *= 1.01);
    singularity(matrix)
}

//! `whirl matrices`: what the files hold against modes, response and coefficients of the same case.

use std::collections::HashMap;
use std::fs;
use std::process::Command;

use num_complex::Complex64;

use super::{column, numbers, ran};
use crate::workbench::Workbench;

/// A matrix as its file has it, column after column.
struct Matrix {
    rows: usize,
    cols: usize,
    values: Vec<f64>,
}

impl Matrix {
    fn at(&self, i: usize, j: usize) -> f64 {
        self.values[j * self.rows + i]
    }
}

/// A Matrix Market file.
fn market(workbench: &Workbench, name: &str) -> Matrix {
    let text = fs::read_to_string(workbench.path(name)).expect("a matrix");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("%%MatrixMarket matrix array real general"));
    let size: Vec<usize> =
        lines.next().expect("a size").split(' ').map(|own| own.parse().expect("a count")).collect();
    let values: Vec<f64> = lines.map(|own| own.parse().expect("a number")).collect();
    assert_eq!(values.len(), size[0] * size[1], "{name}");
    Matrix { rows: size[0], cols: size[1], values }
}

/// Names of rows and columns, by what they are of.
fn names(workbench: &Workbench, path: &str) -> HashMap<String, Vec<String>> {
    let text = fs::read_to_string(workbench.path(path)).expect("names");
    let mut all: HashMap<String, Vec<String>> = HashMap::new();
    for line in text.lines().skip(1) {
        let (of, rest) = line.split_once(',').expect("what it is of");
        let (place, name) = rest.split_once(',').expect("a place");
        let own = all.entry(of.to_owned()).or_default();
        own.push(name.trim_matches('"').to_owned());
        assert_eq!(place, own.len().to_string());
    }
    all
}

/// x of (A − σ) x = b, A with its lower half and the right one in a scale in which all entries are of the size of λ.
fn solved(a: &Matrix, sigma: Complex64, b: &[Complex64]) -> Vec<Complex64> {
    let n = a.rows;
    let largest = a.values.iter().fold(1.0_f64, |most, own| most.max(own.abs()));
    let scale = |i: usize| if i < n / 2 { 1.0 } else { 1.0 / largest.sqrt() };
    let entry = |i: usize, j: usize| {
        let shift = if i == j { sigma } else { Complex64::ZERO };
        Complex64::from(a.at(i, j) * scale(i) / scale(j)) - shift
    };
    let mut rows: Vec<Vec<Complex64>> =
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).chain([b[i] * scale(i)]).collect()).collect();
    for k in 0..n {
        let size = |i: &usize| rows[*i][k].norm();
        let pivot = (k..n).max_by(|i, j| size(i).total_cmp(&size(j))).expect("a row");
        rows.swap(k, pivot);
        let (above, below) = rows.split_at_mut(k + 1);
        for row in below {
            let factor = row[k] / above[k][k];
            for (own, other) in row[k..].iter_mut().zip(&above[k][k..]) {
                *own -= factor * other;
            }
        }
    }
    let mut x = vec![Complex64::ZERO; n];
    for k in (0..n).rev() {
        let sum: Complex64 = (k + 1..n).map(|j| rows[k][j] * x[j]).sum();
        x[k] = (rows[k][n] - sum) / rows[k][k];
    }
    x.iter().enumerate().map(|(i, own)| own / scale(i)).collect()
}

/// The eigenvalue of A that is nearest to another number, by inverse iteration.
fn nearest(a: &Matrix, to: Complex64) -> Complex64 {
    let sigma = to * (1.0 + 1e-5);
    let mut x: Vec<Complex64> =
        (0..a.rows).map(|i| Complex64::new(1.0 + (i % 7) as f64, (i % 5) as f64)).collect();
    let mut value = to;
    for _ in 0..8 {
        let next = solved(a, sigma, &x);
        let (mut along, mut square) = (Complex64::ZERO, 0.0);
        for (old, new) in x.iter().zip(&next) {
            along += new.conj() * old;
            square += new.norm_sqr();
        }
        value = sigma + along / square;
        let size = square.sqrt();
        x = next.into_iter().map(|own| own / size).collect();
    }
    value
}

const RING: &str = include_str!("floating-ring.toml");
const THREE_DISCS: &str = include_str!("lalanne-response.toml");

/// Flexible and rigid bodies, one of them with an angle of its own.
#[test]
fn eigenvalues_of_the_written_states_are_those_of_modes() {
    for (case, speed) in [(THREE_DISCS, "10000 rpm"), (RING, "6000 rad/s"), (RING, "2000 rad/s")] {
        let workbench = Workbench::new().file("case.toml", case);
        let at = ["case.toml", "--speed", speed, "--out", "out"];
        let said = ran(&workbench, &[&["matrices", "--format", "mtx"][..], &at].concat());
        ran(&workbench, &[&["modes", "--count", "12"][..], &at].concat());
        let a = market(&workbench, "out/matrices.A.mtx");
        let [re, im] =
            ["real_1_s", "imaginary_1_s"].map(|own| numbers(&workbench, "out/modes.csv", own));
        assert!(re.len() >= 2, "{speed}");
        for (re, im) in re.iter().zip(&im) {
            let value = Complex64::new(*re, *im);
            let found = nearest(&a, value);
            assert!((found - value).norm() <= 1e-9 * value.norm(), "{speed}: {value} {found}");
        }
        // Every matrix has the rows and columns that names are given of.
        let names = names(&workbench, "out/matrices.names.csv");
        let of = |name: &str| names[name].len();
        for (name, rows, cols) in [
            ("mass", "coordinates", "coordinates"),
            ("damping", "coordinates", "coordinates"),
            ("stiffness", "coordinates", "coordinates"),
            ("input", "coordinates", "inputs"),
            ("output", "outputs", "coordinates"),
            ("A", "states", "states"),
            ("B", "states", "inputs"),
            ("C", "outputs", "states"),
            ("D", "outputs", "inputs"),
        ] {
            let own = market(&workbench, &format!("out/matrices.{name}.mtx"));
            assert_eq!([own.rows, own.cols], [of(rows), of(cols)], "{name}");
        }
        let counts = format!(
            "{} coordinates, {} inputs, {} outputs",
            of("coordinates"),
            of("inputs"),
            of("outputs")
        );
        assert!(said.stdout.contains(&counts), "{}", said.stdout);
    }
}

/// x of every output by one input at a frequency: C (iω − A)⁻¹ B u.
fn transferred(
    workbench: &Workbench,
    omega: f64,
    u: &dyn Fn(&str) -> Complex64,
) -> Vec<(String, Complex64)> {
    let [a, b, c] =
        ["A", "B", "C"].map(|own| market(workbench, &format!("out/matrices.{own}.mtx")));
    let names = names(workbench, "out/matrices.names.csv");
    let inputs = &names["inputs"];
    let force: Vec<Complex64> =
        (0..b.rows).map(|i| (0..b.cols).map(|j| -b.at(i, j) * u(&inputs[j])).sum()).collect();
    let x = solved(&a, Complex64::new(0.0, omega), &force);
    let outputs = names["outputs"].iter().enumerate();
    outputs.map(|(i, name)| (name.clone(), (0..c.cols).map(|j| c.at(i, j) * x[j]).sum())).collect()
}

/// cos and sin of the rotation as inputs give the orbits of `whirl response`.
#[test]
fn the_written_states_respond_to_unbalance_as_the_machine_does() {
    let workbench = Workbench::new().file("case.toml", THREE_DISCS);
    let at = ["case.toml", "--speed", "5000 rpm", "--out", "out"];
    ran(&workbench, &[&["matrices", "--format", "mtx"][..], &at].concat());
    ran(&workbench, &[&["response", "--no-figures"][..], &at].concat());
    let omega = 5000.0 * std::f64::consts::PI / 30.0;
    let found = transferred(&workbench, omega, &|name| match name {
        "unbalance.rotor.cos" => Complex64::ONE,
        "unbalance.rotor.sin" => -Complex64::i(),
        _ => Complex64::ZERO,
    });
    let points = column(&workbench, "out/response.csv", "point");
    assert_eq!(2 * points.len(), found.len());
    for axis in ["x", "y"] {
        let size = numbers(&workbench, "out/response.csv", &format!("{axis}_um"));
        let phase = numbers(&workbench, "out/response.csv", &format!("{axis}_phase_deg"));
        for ((point, size), phase) in points.iter().zip(size).zip(phase) {
            let known = Complex64::from_polar(1e-6 * size, phase.to_radians());
            let name = format!("{point}.{axis}");
            let own = found.iter().find(|own| own.0 == name).expect("an output").1;
            assert!((own - known).norm() <= 1e-8 * known.norm(), "{name}: {own} {known}");
        }
    }
}

/// Under a slow force a journal moves in its film by K⁻¹ F.
#[test]
fn the_written_states_move_in_films_by_their_coefficients() {
    let case = "title = \"a film\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"6000 rad/s\"\nmass = \"1 kg\"\n\
                polar_inertia = \"1e-3 kg*m^2\"\n[joint.film]\nkind = \"bearing\"\njournal = { body = \"rotor\" }\n\
                law = \"ocvirk\"\nparameters = { mu = \"20 mPa*s\" }\nradial_clearance = \"60 um\"\n\
                journal_radius = \"30 mm\"\nlength = \"30 mm\"\n[loads.weight]\nbody = \"rotor\"\ndirection = \"x\"\n\
                force = \"-5000 N\"\n";
    let workbench = Workbench::new().file("case.toml", case);
    let at = ["case.toml", "--out", "out"];
    ran(&workbench, &[&["matrices", "--format", "mtx"][..], &at].concat());
    ran(&workbench, &[&["coefficients"][..], &at].concat());
    let k = |name: &str| numbers(&workbench, "out/coefficients.csv", &format!("k_{name}_N_m"))[0];
    let [xx, xy, yx, yy] = ["xx", "xy", "yx", "yy"].map(k);
    let det = xx * yy - xy * yx;
    // The load as the case has it, and a force of 1 N on the journal along y.
    for (input, known) in [
        ("load.weight", [-5000.0 * yy / det, 5000.0 * yx / det]),
        ("joint.film.y", [-xy / det, xx / det]),
    ] {
        let of = |name: &str| Complex64::from(f64::from(u8::from(name == input)));
        let found = transferred(&workbench, 0.0, &of);
        let names: Vec<&str> = found.iter().map(|own| own.0.as_str()).collect();
        assert_eq!(names, ["joint.film.x", "joint.film.y"]);
        for (own, known) in found.iter().zip(known) {
            assert!((own.1.re - known).abs() <= 1e-9 * known.abs(), "{input}: {} {known}", own.1);
        }
    }
}

/// A free ring that turns a little more takes the place with it in which it stands.
#[test]
fn the_angle_of_a_ring_moves_what_stands_off_its_middle() {
    let workbench = Workbench::new().file("case.toml", RING);
    let at = ["case.toml", "--speed", "6000 rad/s", "--out", "out"];
    ran(&workbench, &[&["matrices", "--format", "mtx"][..], &at].concat());
    ran(&workbench, &[&["coefficients"][..], &at].concat());
    let output = market(&workbench, "out/matrices.output.mtx");
    let names = names(&workbench, "out/matrices.names.csv");
    assert_eq!(names["coordinates"][0], "rotation angle of the ring");
    assert_eq!(names["outputs"][2..], ["joint.outer.x", "joint.outer.y"]);
    // The ring is the journal of the second joint, and the bore of the first.
    let [x, y] =
        ["e_x_um", "e_y_um"].map(|own| 1e-6 * numbers(&workbench, "out/coefficients.csv", own)[1]);
    for (row, known) in [y, -x, -y, x].into_iter().enumerate() {
        assert!((output.at(row, 0) / known - 1.0).abs() < 1e-12, "{row}: {known}");
    }
}

/// A number of some bytes.
fn number(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize
}

/// Variables of doubles in a file of MATLAB 5, by name; what else there is, as its bytes.
fn variables(bytes: &[u8]) -> Vec<(String, Option<Matrix>, Vec<u8>)> {
    assert_eq!(bytes[124..128], [0, 1, b'I', b'M']);
    let mut at = 128;
    let mut all = Vec::new();
    while at < bytes.len() {
        assert_eq!(number(bytes, at), 14);
        let own = &bytes[at + 8..at + 8 + number(bytes, at + 4)];
        let class = number(own, 8);
        let (rows, cols, letters) = (number(own, 24), number(own, 28), number(own, 36));
        let name = String::from_utf8(own[40..40 + letters].to_vec()).expect("a name");
        let values = &own[40 + letters.next_multiple_of(8)..];
        let matrix = (class == 6).then(|| {
            assert_eq!((number(values, 0), number(values, 4)), (9, 8 * rows * cols));
            let doubles = values[8..].chunks_exact(8);
            let doubles = doubles.map(|own| f64::from_le_bytes(own.try_into().expect("a double")));
            Matrix { rows, cols, values: doubles.collect() }
        });
        all.push((name, matrix, values.to_vec()));
        at += 8 + own.len();
    }
    all
}

/// Cells of letters, one after the other.
fn cells(mut bytes: &[u8]) -> Vec<String> {
    let mut all = Vec::new();
    while !bytes.is_empty() {
        let (own, rest) = bytes[8..].split_at(number(bytes, 4));
        let letters = number(own, 28);
        assert_eq!(
            [number(bytes, 0), number(own, 8), number(own, 24), number(own, 36)],
            [14, 4, 1, 0]
        );
        assert_eq!([number(own, 40), number(own, 44)], [4, 2 * letters]);
        let units = own[48..48 + 2 * letters].chunks_exact(2);
        let units: Vec<u16> = units.map(|own| u16::from_le_bytes([own[0], own[1]])).collect();
        all.push(String::from_utf16(&units).expect("letters"));
        bytes = rest;
    }
    all
}

#[test]
fn all_formats_hold_the_same() {
    let table = "[analysis.plant]\nkind = \"matrices\"\nformat = \"mat\"\nspeeds = \"2000 rad/s .. 6000 rad/s, 3\"\n";
    let workbench = Workbench::new().file("case.toml", &format!("{RING}{table}"));
    ran(&workbench, &["analyse", "case.toml", "--out", "out"]);
    let speeds = numbers(&workbench, "out/plant.csv", "speed_rpm");
    assert_eq!(column(&workbench, "out/plant.csv", "name"), ["plant.1", "plant.2", "plant.3"]);
    assert!((speeds[2] * std::f64::consts::PI / 30.0 - 6000.0).abs() < 1e-9);
    let all = ["--speeds", "2000 rad/s .. 6000 rad/s, 3", "--out", "out"];
    for format in ["mtx", "npz"] {
        ran(&workbench, &[&["matrices", "case.toml", "--format", format][..], &all].concat());
    }
    let bytes = fs::read(workbench.path("out/plant.3.mat")).expect("a file");
    let mut compared = 0;
    for (name, matrix, values) in variables(&bytes) {
        let Some(matrix) = matrix else {
            let known = names(&workbench, "out/matrices.3.names.csv");
            assert_eq!(cells(&values), known[&name], "{name}");
            continue;
        };
        if name == "speeds" {
            // The shaft and the ring.
            assert_eq!([matrix.rows, matrix.cols], [2, 1]);
            assert!((matrix.values[0] - 6000.0).abs() < 1e-9);
            assert!((matrix.values[1] / 6000.0 / 0.246416449 - 1.0).abs() < 1e-6);
            continue;
        }
        let known = market(&workbench, &format!("out/matrices.3.{name}.mtx"));
        assert_eq!([matrix.rows, matrix.cols], [known.rows, known.cols], "{name}");
        // To the bit.
        assert_eq!(matrix.values, known.values, "{name}");
        compared += 1;
    }
    assert_eq!(compared, 9);
    in_python(&workbench);
}

/// The same as SciPy reads it, where there is one.
fn in_python(workbench: &Workbench) {
    let python = |script: &str| {
        let mut command = Command::new("python3");
        command.current_dir(workbench.path("")).args(["-c", script]).output()
    };
    if !python("import scipy.io").is_ok_and(|own| own.status.success()) {
        return;
    }
    let script = r#"
import csv, numpy, scipy.io
mat = scipy.io.loadmat("out/plant.3.mat")
npz = numpy.load("out/matrices.3.npz")
for name in ["mass", "damping", "stiffness", "input", "output", "A", "B", "C", "D"]:
    mtx = scipy.io.mmread(f"out/matrices.3.{name}.mtx")
    assert npz[name].shape == mat[name].shape == mtx.shape, name
    assert (npz[name] == mat[name]).all() and (npz[name] == mtx).all(), name
assert abs(mat["speeds"][0, 0] - 6000) < 1e-9 and (npz["speeds"] == mat["speeds"][:, 0]).all()
rows = list(csv.DictReader(open("out/matrices.3.names.csv")))
for name in ["coordinates", "states", "inputs", "outputs", "bodies"]:
    own = [row["name"] for row in rows if row["of"] == name]
    assert list(npz[name]) == own and [str(cell[0][0]) for cell in mat[name]] == own, name
values = numpy.linalg.eigvals(npz["A"])
for known in -634.941272 + 3741.73328j, -871.948524 + 1086.75385j:
    assert abs(values - known).min() < 1e-6 * abs(known), known
"#;
    let said = python(script).expect("it was there");
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
}

/// Nothing acts and nothing is seen: matrices without columns or rows, in every format.
#[test]
fn a_machine_without_inputs_and_outputs_has_its_matrices() {
    let case = "title = \"a mass\"\n[body.mass]\nturns = \"no\"\nmass = \"2 kg\"\n\
                stiffness = { x = \"800 N/m\", y = \"200 N/m\" }\n";
    let workbench = Workbench::new().file("case.toml", case);
    for format in ["mtx", "npz", "mat"] {
        let said = ran(&workbench, &["matrices", "case.toml", "--format", format, "--out", "out"]);
        assert!(said.stdout.contains("2 coordinates, 0 inputs, 0 outputs"), "{}", said.stdout);
    }
    // Its coordinates are modes of mass 1.
    for (name, known) in [("mass", [1.0, 0.0, 0.0, 1.0]), ("stiffness", [400.0, 0.0, 0.0, 100.0])] {
        assert_eq!(market(&workbench, &format!("out/matrices.{name}.mtx")).values, known);
    }
    for (name, size) in [("B", "4 0 0"), ("C", "0 4 0"), ("D", "0 0 0")] {
        let text = fs::read_to_string(workbench.path(&format!("out/matrices.{name}.mtx")));
        let known = format!("%%MatrixMarket matrix coordinate real general\n{size}\n");
        assert_eq!(text.expect("a matrix"), known);
    }
}

#[test]
fn what_is_no_format_is_refused() {
    let table = "[analysis.plant]\nkind = \"matrices\"\nformat = \"csv\"\n";
    let workbench = Workbench::new().file("case.toml", &format!("{RING}{table}"));
    for arguments in [&["analyse", "case.toml"][..], &["matrices", "weight", "--format", "csv"]] {
        let found = workbench.whirl(arguments);
        assert!(found.status == 2 && found.stderr.contains("npz"), "{}", found.stderr);
    }
    assert_eq!(workbench.listing(), ["case.toml"]);
}

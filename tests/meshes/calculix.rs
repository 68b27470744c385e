//! A cantilever of distorted cells of every element that CalculiX has, too, in its input: frequencies, displacements and
//! stresses against what CalculiX 2.20 printed (`tests/data/calculix/make.py`).

use std::f64::consts::PI;

use nalgebra::{Cholesky, DMatrix, DVector, Matrix3};
use whirl_solver::assembly::assemble;
use whirl_solver::body::{BodySpec, Rayleigh};
use whirl_solver::constraints::Constraints;
use whirl_solver::linalg::{Matrix, generalised_symmetric_eigen};
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::{ReadMesh, ReadOptions, read};
use whirl_solver::stress::{Stress, at_points};
use whirl_solver::support::Support;

use crate::elements;
use crate::packed::data;

/// What was printed: numbers of seven digits.
struct Printed {
    hertz: Vec<f64>,
    /// Node and displacement (m).
    displacements: Vec<(u64, [f64; 3])>,
    /// Cell and the stress at one of its points (Pa).
    stresses: Vec<(u64, Stress)>,
}

impl Printed {
    fn read(name: &str) -> Printed {
        let text = String::from_utf8(data(&format!("calculix/{name}.csv"))).expect("text");
        let mut parts = text.split("# ").skip(1).map(|part| {
            let lines = part.lines().skip(1);
            let numbers = |line: &str| -> Vec<f64> {
                line.split(',').map(|value| value.parse().expect("a number")).collect()
            };
            lines.map(numbers).collect::<Vec<_>>()
        });
        let mut part = || parts.next().expect("three parts");
        let hertz = part().concat();
        let displacements = part().into_iter().map(|row| (row[0] as u64, [row[1], row[2], row[3]]));
        let displacements = displacements.collect();
        // xx, yy, zz, xy, xz, yz.
        let stress =
            |row: &Vec<f64>| (row[0] as u64, [row[2], row[3], row[4], row[5], row[7], row[6]]);
        Printed { hertz, displacements, stresses: part().iter().map(stress).collect() }
    }
}

fn cantilever(name: &str) -> Mesh {
    let path = format!("calculix/{name}.inp");
    let elements = elements();
    let read = read(data(&path), &path, &ReadOptions::new(&elements));
    read.unwrap_or_else(|errors| panic!("{errors}")).mesh
}

fn held(mesh: &Mesh) -> Vec<usize> {
    let base = mesh.node_set("BASE").expect("the clamped end");
    base.iter().flat_map(|node| (0..3).map(move |i| 3 * node + i)).collect()
}

fn frequencies(mesh: &Mesh) -> Vec<f64> {
    let spec = BodySpec {
        retained: Vec::new(),
        held: held(mesh),
        modes: 10,
        constraints: Constraints::default(),
        springs: Vec::new(),
        damping: Rayleigh::default(),
        nodes: Vec::new(),
        stiffening: false,
        means: Vec::new(),
        corrections: Vec::new(),
        sections: Vec::new(),
        memory: usize::MAX,
    };
    Support::from_mesh(mesh, &spec).expect("a body").hertz
}

fn stiffness(mesh: &Mesh) -> DMatrix<f64> {
    let size = mesh.dof_count();
    let columns = assemble(mesh, "stiffness").expect("K").to_columns();
    let mut stiffness = DMatrix::zeros(size, size);
    for j in 0..size {
        columns.column(j).for_each(|(i, value)| stiffness[(i, j)] = value);
    }
    stiffness
}

/// Under the load of the file, by a dense solution.
fn displacement(mesh: &Mesh) -> Vec<f64> {
    let (size, mut stiffness) = (mesh.dof_count(), stiffness(mesh));
    let mut load = DVector::zeros(size);
    let tip = mesh.node_set("TIP").expect("a corner")[0];
    for (i, force) in [900.0, 400.0, -700.0].into_iter().enumerate() {
        load[3 * tip + i] = force;
    }
    for dof in held(mesh) {
        stiffness.row_mut(dof).fill(0.0);
        stiffness.column_mut(dof).fill(0.0);
        stiffness[(dof, dof)] = 1.0;
    }
    Cholesky::new(stiffness).expect("definite").solve(&load).as_slice().to_vec()
}

/// Largest difference of the lowest frequencies (relative).
fn apart(hertz: &[f64], printed: &Printed) -> f64 {
    assert_eq!(hertz.len(), printed.hertz.len());
    hertz
        .iter()
        .zip(&printed.hertz)
        .map(|(own, known)| (own / known - 1.0).abs())
        .fold(0.0, f64::max)
}

/// Largest difference of displacements, and of the stresses at the points of all cells, of the largest of each.
fn under_load(mesh: &Mesh, printed: &Printed) -> [f64; 2] {
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |a: f64, b| a.max(b.abs()));
    let found = displacement(mesh);
    assert_eq!(printed.displacements.len(), mesh.nodes().len());
    let node = |label: &u64| mesh.labels().iter().position(|own| own == label).expect("a node");
    let beside = printed.displacements.iter().flat_map(|(label, known)| {
        let own = &found[3 * node(label)..][..3];
        own.iter().zip(known).map(|(own, known)| own - known).collect::<Vec<_>>()
    });
    let displacements = largest(&mut beside.into_iter()) / largest(&mut found.iter().copied());

    let stresses = at_points(mesh, &found).expect("stresses");
    let scale = largest(&mut printed.stresses.iter().flat_map(|(_, own)| *own));
    let mut worst = 0.0_f64;
    for (cell, label) in mesh.blocks()[0].labels.iter().enumerate() {
        // Each program has its own order of the points.
        let mut own = stresses[0][cell].clone();
        for (_, known) in printed.stresses.iter().filter(|(other, _)| other == label) {
            let far = |own: &Stress| largest(&mut own.iter().zip(known).map(|(a, b)| a - b));
            let nearest = (0..own.len()).min_by(|a, b| far(&own[*a]).total_cmp(&far(&own[*b])));
            worst = worst.max(far(&own.remove(nearest.expect("as many points"))) / scale);
        }
        assert!(own.is_empty(), "as many points");
    }
    [displacements, worst]
}

#[test]
fn cells_with_the_same_rules_have_the_same_frequencies_displacements_and_stresses() {
    // C3D20: 3 x 3 x 3 points for K and M.
    let (mesh, printed) = (cantilever("c3d20"), Printed::read("c3d20"));
    let frequencies = apart(&frequencies(&mesh), &printed);
    assert!(frequencies < 1e-6, "{frequencies:.1e}");
    for name in ["c3d20", "c3d10", "c3d4", "c3d8i-box"] {
        let [displacements, stresses] = under_load(&cantilever(name), &Printed::read(name));
        assert!(
            displacements < 1e-6 && stresses < 1e-6,
            "{name}: {displacements:.1e} {stresses:.1e}"
        );
    }
}

/// The mass of one cell at the points of its stiffness, N_a N_b of the nodes.
fn mass_at_few_points(mesh: &Mesh, cell: &[usize]) -> DMatrix<f64> {
    let element = mesh.blocks()[0].element;
    let (mut values, mut slopes) = (vec![0.0; element.nodes], vec![[0.0; 3]; element.nodes]);
    let mut mass = DMatrix::zeros(element.nodes, element.nodes);
    for (point, weight) in element.stress_of("stiffness").expect("a stress").points {
        (element.shape)(*point, &mut values, &mut slopes);
        let jacobian = Matrix3::from_fn(|i, j| {
            let along = cell.iter().zip(&slopes);
            along.map(|(&node, slope)| mesh.nodes()[node][i] * slope[j]).sum::<f64>()
        });
        let at = DVector::from_column_slice(&values);
        let density: f64 = 7860.0 * weight * jacobian.determinant();
        mass += &at * at.transpose() * density;
    }
    mass
}

#[test]
fn masses_at_the_points_of_the_stiffness_make_the_frequencies_of_its_tetrahedra() {
    for (name, worst) in [("c3d10", 4e-3), ("c3d4", 0.1)] {
        let (mesh, printed) = (cantilever(name), Printed::read(name));
        // Ours are exact integrals.
        let exact = apart(&frequencies(&mesh), &printed);
        assert!((1e-3..worst).contains(&exact), "{name}: {exact:.1e}");
        let held = held(&mesh);
        let free: Vec<usize> = (0..mesh.dof_count()).filter(|dof| !held.contains(dof)).collect();
        let mut mass = DMatrix::zeros(mesh.dof_count(), mesh.dof_count());
        for cell in mesh.blocks()[0].cells() {
            let own = mass_at_few_points(&mesh, cell);
            for (a, b) in (0..cell.len()).flat_map(|a| (0..cell.len()).map(move |b| (a, b))) {
                for i in 0..3 {
                    mass[(3 * cell[a] + i, 3 * cell[b] + i)] += own[(a, b)];
                }
            }
        }
        let stiffness = stiffness(&mesh);
        let only_free = |of: &DMatrix<f64>| {
            Matrix::from_fn(free.len(), free.len(), |i, j| of[(free[i], free[j])])
        };
        // 1/omega^2, as the mass may be singular.
        let values = generalised_symmetric_eigen(&only_free(&mass), &only_free(&stiffness));
        let values = values.expect("definite").values;
        let hertz: Vec<f64> =
            values.iter().rev().take(10).map(|value| 0.5 / PI / value.sqrt()).collect();
        let found = apart(&hertz, &printed);
        assert!(found < 1e-6, "{name}: {found:.1e}");
    }
}

/// CalculiX gives the incompatible modes of C3D8I inertia, and changes them on distorted cells; its C3D15 has fewer points.
#[test]
fn cells_with_other_rules_have_the_same_limit() {
    for name in ["c3d8i", "c3d15"] {
        let difference = |name: &str| {
            let hertz = frequencies(&cantilever(name));
            let printed = Printed::read(name);
            let each = hertz.iter().zip(&printed.hertz).map(|(own, known)| own / known - 1.0);
            each.collect::<Vec<f64>>()
        };
        let (coarse, fine) = (difference(name), difference(&format!("{name}-fine")));
        let mean = |of: &[f64]| of.iter().map(|own| own.abs()).sum::<f64>() / of.len() as f64;
        let fall = mean(&coarse) / mean(&fine);
        // Cells of half the size: at least second order for C3D8I, and the lower modes below 1e-3.
        assert!(fall > 2.5, "{name}: {coarse:?} {fine:?}");
        assert!(fine[..3].iter().all(|own| own.abs() < 1e-3), "{name}: {fine:?}");
    }
}

/// A steel cantilever of 300 × 60 × 50 mm: so many cells along and across, of a type.
fn bar(kind: &str, [along, wide, high]: [usize; 3]) -> ReadMesh {
    let label = |i: usize, j: usize, k: usize| 1 + i + (wide + 1) * (j + (high + 1) * k);
    let mut text = "*NODE\n".to_owned();
    for k in 0..=along {
        for j in 0..=high {
            for i in 0..=wide {
                let part =
                    |size: f64, place: usize, count: usize| size * place as f64 / count as f64;
                let [x, y, z] = [part(0.06, i, wide), part(0.05, j, high), part(0.3, k, along)];
                text += &format!("{}, {x}, {y}, {z}\n", label(i, j, k));
            }
        }
    }
    text += &format!("*ELEMENT, TYPE={kind}, ELSET=BAR\n");
    for cell in 0..along * high * wide {
        let (i, j, k) = (cell % wide, cell / wide % high, cell / (wide * high));
        let face = |k: usize| {
            let nodes = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            nodes.map(|(i, j)| label(i, j, k).to_string()).join(", ")
        };
        text += &format!("{}, {}, {}\n", cell + 1, face(k), face(k + 1));
    }
    text += &format!("*NSET, NSET=BASE, GENERATE\n1, {}\n", (wide + 1) * (high + 1));
    text += "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7850\n*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL\n";
    let elements = elements();
    let read = read(text.into_bytes(), "bar.inp", &ReadOptions::new(&elements));
    read.unwrap_or_else(|errors| panic!("{errors}"))
}

/// What docs/meshes.md and a warning of the reader say of C3D8.
#[test]
fn hexahedra_without_incompatible_modes_bend_too_stiffly_and_are_warned_of() {
    let mut found = Vec::new();
    for (counts, higher) in [([6, 1, 1], 0.24), ([6, 2, 2], 0.18), ([12, 4, 4], 0.05)] {
        let [plain, better] = ["C3D8", "C3D8I"].map(|kind| bar(kind, counts));
        let said: Vec<&str> = plain.warnings.iter().map(|own| own.what.as_str()).collect();
        let cells: usize = counts.iter().product();
        assert_eq!(said, [format!("{cells} cells of C3D8 without incompatible modes")]);
        let help = &plain.warnings[0].help;
        assert!(help.contains("18 % higher") && help.contains("`TYPE=C3D8I`"), "{help}");
        assert!(better.warnings.is_empty(), "{:?}", better.warnings);
        let [stiff, soft] = [&plain, &better].map(|own| frequencies(&own.mesh)[0]);
        // To the whole percents that are said.
        assert!((stiff / soft - 1.0 - higher).abs() < 0.005, "{counts:?}: {stiff} {soft}");
        found.push(soft);
    }
    // The limit by quadratic cells is 459 Hz or a little less.
    assert!(found.iter().all(|own| (own / 459.0 - 1.0).abs() < 0.02), "{found:?}");
}

//! Forms under a stress: the theorem of the virial on distorted cells, and textbook integrals.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use whirl_benches::hand;
use whirl_specs::{ELEMENTS, Element};

use whirl_solver::mesh::{Block, Material, Mesh, MeshParts};
use whirl_solver::stress::{Stress, at_nodes, at_points, von_mises};

use super::{displaced, displacement, element, generated, property};
use crate::reference_kernels::{self, Shapes};

/// The matrix of one component of u, rows and columns over nodes.
fn scalar(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let nodes = matrix.nrows() / 3;
    DMatrix::from_fn(nodes, nodes, |a, b| matrix[(3 * a, 3 * b)])
}

/// Σ G_ab x_a y_b = ∫σ_xy dV, which is the work of the forces K w on the displacement y e_x: whatever the element, its modes
/// and its rule.
#[test]
fn stress_balances_the_forces_that_made_it() {
    for element in ELEMENTS {
        let nodes = displaced(element, &[0.05, -0.1, 0.02, 0.08, -0.04, 0.07, -0.09]);
        let g = scalar(&generated(element, "stiffening", &nodes).0);
        let w = displacement(&nodes);
        let k = generated(element, "stiffness", &nodes).0;
        let force = k * DVector::from_column_slice(w.as_flattened());
        let component = |i: usize| DVector::from_fn(nodes.len(), |a, _| nodes[a][i]);
        let scale = force.amax();
        for (i, j) in (0..9).map(|n| (n / 3, n % 3)) {
            let stress = component(i).dot(&(&g * component(j)));
            let work: f64 = (0..nodes.len()).map(|a| force[3 * a + i] * nodes[a][j]).sum();
            let error = (stress - work).abs() / scale;
            assert!(error < 1e-11, "{} {i} {j}: {stress} {work}", element.origin.name);
        }
    }
}

#[test]
fn cells_without_modes_have_the_textbook_integral() {
    let references: [(&str, &whirl_specs::Element, Shapes); 2] = [
        ("hex8", &hand::elements::HEX8, reference_kernels::hexahedron),
        ("wedge6", &hand::elements::WEDGE6, reference_kernels::wedge),
    ];
    let (e, nu) = (property("E"), property("nu"));
    let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
    for (name, reference, shapes) in references {
        let element = element(name);
        let nodes = displaced(element, &[0.05, -0.1, 0.02, 0.08, -0.04, 0.07, -0.09]);
        let w = displacement(&nodes);
        let mut expected = DMatrix::zeros(nodes.len(), nodes.len());
        for (point, weight) in reference_kernels::points(reference) {
            let values = shapes(point);
            let jacobian = reference_kernels::jacobian(nodes.as_flattened(), &values);
            let inverse = jacobian.try_inverse().expect("a cell");
            let gradients: Vec<Vector3<f64>> =
                values.iter().map(|(_, slope)| inverse.transpose() * slope).collect();
            let slopes = gradients.iter().zip(&w).fold(Matrix3::zeros(), |sum, (gradient, w)| {
                sum + Vector3::from(*w) * gradient.transpose()
            });
            let strain = (slopes + slopes.transpose()) * 0.5;
            let stress = Matrix3::identity() * (lambda * strain.trace()) + strain * (2.0 * mu);
            for (a, b) in (0..nodes.len()).flat_map(|a| (0..nodes.len()).map(move |b| (a, b))) {
                expected[(a, b)] +=
                    weight * jacobian.determinant() * gradients[a].dot(&(stress * gradients[b]));
            }
        }
        let found = generated(element, "stiffening", &nodes).0;
        let error = (scalar(&found) - &expected).amax() / expected.amax();
        assert!(error < 1e-12, "{name}: {error:.1e}");
        assert!((0..nodes.len()).all(|a| found[(3 * a, 3 * a + 1)] == 0.0));
    }
}

/// One cell of steel.
fn cell(element: &'static Element, nodes: &[[f64; 3]]) -> Mesh {
    let properties = ["E", "nu", "rho"].map(|name| (name.to_owned(), property(name)));
    let material = Material { name: "steel".to_owned(), properties: properties.into() };
    let block =
        Block { element, material: 0, labels: vec![1], connectivity: (0..nodes.len()).collect() };
    Mesh::new(MeshParts {
        origin: "cell".into(),
        nodes: nodes.to_vec(),
        labels: (1..=nodes.len() as u64).collect(),
        blocks: vec![block],
        materials: vec![material],
        ..MeshParts::default()
    })
    .expect("a cell")
}

/// Two bars of other materials, one on the other, stretched alike: where they meet the stress is that of the stiffer one, whichever
/// of the materials comes first.
#[test]
fn where_materials_meet_the_larger_stress_counts() {
    let nodes: Vec<[f64; 3]> = (0..12_usize)
        .map(|node| {
            let corner = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][node % 4];
            [corner[0], corner[1], (node / 4) as f64]
        })
        .collect();
    let strain = 1e-4;
    let displacement: Vec<f64> = nodes.iter().flat_map(|x| [0.0, 0.0, strain * x[2]]).collect();
    for moduli in [[3e9, 2e11], [2e11, 3e9]] {
        let material = |e: f64| Material::isotropic("m", e, 0.3, 1000.0).expect("a material");
        let block = |place: usize| Block {
            element: element("hex8"),
            material: place,
            labels: vec![place as u64 + 1],
            connectivity: (4 * place..4 * place + 8).collect(),
        };
        let mesh = Mesh::new(MeshParts {
            origin: "bars".into(),
            nodes: nodes.clone(),
            labels: (1..=12).collect(),
            blocks: vec![block(0), block(1)],
            materials: moduli.map(material).into(),
            ..MeshParts::default()
        });
        let found = at_nodes(&mesh.expect("a mesh"), &displacement).expect("stresses");
        let largest = f64::max(moduli[0], moduli[1]);
        for (node, stress) in found.iter().enumerate() {
            let e = [moduli[0], largest, moduli[1]][node / 4];
            // σ_zz = (λ + 2μ) ε, to rounding.
            let exact = e * 0.7 / (1.3 * 0.4) * strain;
            assert!((stress[2] / exact - 1.0).abs() < 1e-12, "{node}: {} {exact}", stress[2]);
        }
    }
}

fn matrix([xx, yy, zz, xy, yz, zx]: Stress) -> Matrix3<f64> {
    Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz)
}

/// Σ w det J σ ∇N_a over the points is K w at node a: also where the cell's own modes follow w.
#[test]
fn stresses_at_the_points_are_in_balance_with_the_forces_of_the_stiffness() {
    for element in ELEMENTS {
        let nodes = displaced(element, &[0.05, -0.1, 0.02, 0.08, -0.04, 0.07, -0.09]);
        let w = displacement(&nodes);
        let found = at_points(&cell(element, &nodes), w.as_flattened()).expect("stresses");
        let mut forces = DVector::zeros(3 * nodes.len());
        let (mut values, mut slopes) = (vec![0.0; nodes.len()], vec![[0.0; 3]; nodes.len()]);
        let kernel = element.stress_of("stiffness").expect("a kernel");
        for ((point, weight), stress) in kernel.points.iter().zip(&found[0][0]) {
            (element.shape)(*point, &mut values, &mut slopes);
            let jacobian = Matrix3::from_fn(|i, j| {
                nodes.iter().zip(&slopes).map(|(x, slope)| x[i] * slope[j]).sum::<f64>()
            });
            let inverse = jacobian.try_inverse().expect("a cell").transpose();
            for (a, slope) in slopes.iter().enumerate() {
                let gradient = inverse * Vector3::from(*slope);
                let force = matrix(*stress) * gradient * (*weight * jacobian.determinant());
                (0..3).for_each(|i| forces[3 * a + i] += force[i]);
            }
        }
        let k = generated(element, "stiffness", &nodes).0;
        let known = k * DVector::from_column_slice(w.as_flattened());
        let error = (&forces - &known).amax() / known.amax();
        assert!(error < 1e-11, "{}: {error:.1e}", element.origin.name);
    }
}

/// Of a constant strain everywhere; of pure bending, where a cell can bend, at its corners, too.
#[test]
fn stresses_at_nodes_are_those_of_textbooks() {
    let (e, nu) = (property("E"), property("nu"));
    for element in ELEMENTS {
        let name = element.origin.name;
        let nodes = displaced(element, &[0.05, -0.1, 0.02, 0.08, -0.04, 0.07, -0.09]);
        let strain = Matrix3::new(3.0, 1.0, -2.0, 1.0, 0.5, 0.7, -2.0, 0.7, -1.0) * 1e-4;
        let turn = Matrix3::new(0.0, -2.0, 1.0, 2.0, 0.0, 3.0, -1.0, -3.0, 0.0) * 1e-3;
        let move_by = |x: &[f64; 3]| (strain + turn) * Vector3::from(*x);
        let w: Vec<f64> = nodes.iter().flat_map(|x| <[f64; 3]>::from(move_by(x))).collect();
        let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
        let known = Matrix3::identity() * (lambda * strain.trace()) + strain * (2.0 * mu);
        for stress in at_nodes(&cell(element, &nodes), &w).expect("stresses") {
            let error = (matrix(stress) - known).amax() / known.amax();
            assert!(error < 1e-11, "{name}: {error:.1e}");
        }

        // sigma_xx = k E y, and nothing else; straight cells.
        if !["tet10", "hex8i", "hex20", "wedge15"].contains(&name) {
            continue;
        }
        let k = 2e-4;
        let bent = |[x, y, z]: &[f64; 3]| {
            [k * x * y, -0.5 * k * (x * x + nu * (y * y - z * z)), -nu * k * y * z]
        };
        let w: Vec<f64> = element.reference_nodes.iter().flat_map(bent).collect();
        let found = at_nodes(&cell(element, element.reference_nodes), &w).expect("stresses");
        for (stress, [_, y, _]) in found.into_iter().zip(element.reference_nodes) {
            let known = Matrix3::from_diagonal(&Vector3::new(k * e * y, 0.0, 0.0));
            let error = (matrix(stress) - known).amax() / (k * e);
            assert!(error < 1e-11, "{name}: {error:.1e}");
            assert!((von_mises(&stress) - k * e * y.abs()).abs() < 1e-11 * k * e, "{name}");
        }
    }
}

/// A bar of two materials under one strain: at the nodes between them the larger stress, not a mean.
#[test]
fn stresses_of_different_materials_are_not_mixed() {
    let element = element("hex8");
    let mut nodes: Vec<[f64; 3]> = element.reference_nodes.to_vec();
    nodes.extend(element.reference_nodes[4..].iter().map(|[x, y, z]| [*x, *y, z + 2.0]));
    let material = |name: &str, modulus: f64| {
        Material::isotropic(name, modulus, 0.0, 1000.0).expect("a material")
    };
    let block = |material, label, nodes: [usize; 8]| Block {
        element,
        material,
        labels: vec![label],
        connectivity: nodes.to_vec(),
    };
    let mesh = Mesh::new(MeshParts {
        origin: "bar".into(),
        labels: (1..=12).collect(),
        blocks: vec![
            block(0, 1, [0, 1, 2, 3, 4, 5, 6, 7]),
            block(1, 2, [4, 5, 6, 7, 8, 9, 10, 11]),
        ],
        materials: vec![material("soft", 1e9), material("hard", 3e9)],
        nodes,
        ..MeshParts::default()
    })
    .expect("a bar");
    let w: Vec<f64> = mesh.nodes().iter().flat_map(|[_, _, z]| [0.0, 0.0, 1e-3 * z]).collect();
    let found = at_nodes(&mesh, &w).expect("stresses");
    for (node, stress) in found.iter().enumerate() {
        let known = if node < 4 { 1e6 } else { 3e6 };
        assert!((stress[2] / known - 1.0).abs() < 1e-12, "{node}: {stress:?}");
    }
}

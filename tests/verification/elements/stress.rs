//! Forms under a stress: the theorem of the virial on distorted cells, and textbook integrals.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use whirl_benches::hand;
use whirl_specs::ELEMENTS;

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

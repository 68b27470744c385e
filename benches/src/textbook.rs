//! The trilinear hexahedron's stiffness as textbooks write it: ∫BᵀDB dV with matrices of a linear algebra library,
//! nothing exploited.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use whirl_specs::Element;

type Strains = SMatrix<f64, 6, 24>;

/// K (24 × 24) of one cell with 8 nodes at `x` in m, 2 × 2 × 2 Gauss points, Young's modulus `e` in Pa.
pub fn stiffness(element: &Element, x: &[f64], e: f64, nu: f64) -> SMatrix<f64, 24, 24> {
    let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
    let mut d = SMatrix::<f64, 6, 6>::zeros();
    d.fixed_view_mut::<3, 3>(0, 0).fill(lambda);
    d += SMatrix::from_diagonal(&SVector::from([2.0 * mu, 2.0 * mu, 2.0 * mu, mu, mu, mu]));
    let gauss = 1.0 / 3.0_f64.sqrt();
    let mut k = SMatrix::<f64, 24, 24>::zeros();
    for q in 0..8 {
        let point: [f64; 3] = [0, 1, 2].map(|i| if q >> i & 1 == 0 { -gauss } else { gauss });
        let slope = |node: &[f64; 3]| {
            let f = [0, 1, 2].map(|i| 1.0 + node[i] * point[i]);
            Vector3::new(node[0] * f[1] * f[2], f[0] * node[1] * f[2], f[0] * f[1] * node[2]) / 8.0
        };
        let mut jacobian = Matrix3::zeros();
        for (node, x) in element.reference_nodes.iter().zip(x.chunks_exact(3)) {
            jacobian += Vector3::from_column_slice(x) * slope(node).transpose();
        }
        let Some(inverse) = jacobian.try_inverse() else { continue };
        let mut b = Strains::zeros();
        for (a, node) in element.reference_nodes.iter().enumerate() {
            let [x, y, z] = (inverse.transpose() * slope(node)).into();
            #[rustfmt::skip]
            let strains = SMatrix::<f64, 6, 3>::from_row_slice(&[
                x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z, y, x, 0.0, 0.0, z, y, z, 0.0, x,
            ]);
            b.fixed_view_mut::<6, 3>(0, 3 * a).copy_from(&strains);
        }
        k += b.transpose() * d * b * jacobian.determinant();
    }
    k
}

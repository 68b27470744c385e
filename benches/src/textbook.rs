//! The trilinear hexahedron's stiffness as textbooks write it: ∫BᵀDB dV with matrices of fixed size of nalgebra, one
//! cell after the other, nothing exploited. It is compiled as `cargo build --release` compiles it, for any
//! processor of the family.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use whirl_specs::Element;

/// D (6 × 6) of an isotropic material.
pub type Elasticity = SMatrix<f64, 6, 6>;
/// K (24 × 24).
pub type Stiffness = SMatrix<f64, 24, 24>;
type Strains = SMatrix<f64, 6, 24>;
/// ∂N/∂ξ or ∂N/∂x, or positions: a column a node.
type Nodal = SMatrix<f64, 3, 8>;

/// K of one cell with 8 nodes at `x` in m, 2 × 2 × 2 Gauss points, Young's modulus `e` in Pa: in operators,
/// K += Bᵀ (D det J) B.
pub fn stiffness(element: &Element, x: &[f64], e: f64, nu: f64) -> Stiffness {
    sum::<false>(element, x, e, nu)
}

/// The same where the last product is added to K as it is made, which nalgebra does fastest.
pub fn accumulated_stiffness(element: &Element, x: &[f64], e: f64, nu: f64) -> Stiffness {
    sum::<true>(element, x, e, nu)
}

fn elasticity(e: f64, nu: f64) -> Elasticity {
    let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
    let mut d = Elasticity::zeros();
    d.fixed_view_mut::<3, 3>(0, 0).fill(lambda);
    d + SMatrix::from_diagonal(&SVector::from([2.0 * mu, 2.0 * mu, 2.0 * mu, mu, mu, mu]))
}

fn sum<const ACCUMULATED: bool>(element: &Element, x: &[f64], e: f64, nu: f64) -> Stiffness {
    let d = elasticity(e, nu);
    let mut k = Stiffness::zeros();
    let gauss = 1.0 / 3.0_f64.sqrt();
    let nodes = Nodal::from_column_slice(x);
    for q in 0..8 {
        let point: [f64; 3] = [0, 1, 2].map(|i| if q >> i & 1 == 0 { -gauss } else { gauss });
        let mut slopes = Nodal::zeros();
        for (a, node) in element.reference_nodes.iter().enumerate() {
            let f = [0, 1, 2].map(|i| 1.0 + node[i] * point[i]);
            let slope =
                Vector3::new(node[0] * f[1] * f[2], f[0] * node[1] * f[2], f[0] * f[1] * node[2]);
            slopes.set_column(a, &(slope / 8.0));
        }
        let jacobian: Matrix3<f64> = nodes * slopes.transpose();
        let Some(inverse) = jacobian.try_inverse() else { continue };
        let gradients = inverse.transpose() * slopes;
        let mut b = Strains::zeros();
        for a in 0..8 {
            let [x, y, z] = [0, 1, 2].map(|i| gradients[(i, a)]);
            let at = 3 * a;
            (b[(0, at)], b[(1, at + 1)], b[(2, at + 2)]) = (x, y, z);
            (b[(3, at)], b[(3, at + 1)]) = (y, x);
            (b[(4, at + 1)], b[(4, at + 2)]) = (z, y);
            (b[(5, at)], b[(5, at + 2)]) = (z, x);
        }
        let right = (d * jacobian.determinant()) * b;
        if ACCUMULATED {
            k.gemm(1.0, &b.transpose(), &right, 1.0);
        } else {
            k += b.transpose() * right;
        }
    }
    k
}

#[cfg(test)]
mod tests {
    use whirl_specs::ELEMENTS;

    use super::*;

    #[test]
    fn both_are_the_generated_stiffness() {
        let element = ELEMENTS.iter().find(|e| e.origin.name == "hex8").expect("shipped");
        let nodes = element.reference_nodes.iter().flatten().enumerate();
        let x: Vec<f64> = nodes.map(|(i, x)| x + 0.2 * (1.3 * i as f64 + 0.7).sin()).collect();
        let kernel = element.form("stiffness").expect("shipped");
        let (packed, _) = kernel.of_cell(&x, &[200e9, 0.3]);
        let largest = packed.iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
        for k in [stiffness, accumulated_stiffness].map(|k| k(element, &x, 200e9, 0.3)) {
            let entries = (0..24).flat_map(|i| (i..24).map(move |j| (i, j)));
            for ((i, j), packed) in entries.zip(&packed) {
                // Some hundred roundings of terms that are no larger than the largest entry.
                let allowed = 300.0 * f64::EPSILON * largest;
                assert!((k[(i, j)] - packed).abs() < allowed, "{i} {j}: {} {packed}", k[(i, j)]);
                assert!((k[(j, i)] - packed).abs() < allowed);
            }
        }
    }
}

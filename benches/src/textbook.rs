//! The stiffness of a cell as textbooks write it: ∫BᵀDB dV with matrices of fixed size of nalgebra, one cell after the
//! other, nothing exploited. It is compiled as `cargo build --release` compiles it, for any processor of the family.

use nalgebra::{Matrix3, SMatrix, SVector};
use whirl_specs::Element;

/// D (6 × 6) of an isotropic material.
pub type Elasticity = SMatrix<f64, 6, 6>;
/// K, with three rows a node.
pub type Stiffness<const ROWS: usize> = SMatrix<f64, ROWS, ROWS>;
/// ∂N/∂ξ or ∂N/∂x, or positions: a column a node.
type Nodal<const NODES: usize> = SMatrix<f64, 3, NODES>;
/// A point of integration with its weight.
pub type Point = ([f64; 3], f64);

/// 2 × 2 × 2 Gauss points.
pub fn gauss_8() -> Vec<Point> {
    let gauss = 1.0 / 3.0_f64.sqrt();
    let at = |q: usize| [0, 1, 2].map(|i| if q >> i & 1 == 0 { -gauss } else { gauss });
    (0..8).map(|q| (at(q), 1.0)).collect()
}

/// K of one cell with its nodes at `x` in m, Young's modulus `e` in Pa: in operators, K += Bᵀ (D w det J) B.
pub fn stiffness<const NODES: usize, const ROWS: usize>(
    element: &Element,
    points: &[Point],
    x: &[f64],
    (e, nu): (f64, f64),
) -> Stiffness<ROWS> {
    sum::<false, NODES, ROWS>(element, points, x, (e, nu))
}

/// The same where the last product is added to K as it is made, which nalgebra does fastest.
pub fn accumulated_stiffness<const NODES: usize, const ROWS: usize>(
    element: &Element,
    points: &[Point],
    x: &[f64],
    (e, nu): (f64, f64),
) -> Stiffness<ROWS> {
    sum::<true, NODES, ROWS>(element, points, x, (e, nu))
}

fn elasticity(e: f64, nu: f64) -> Elasticity {
    let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
    let mut d = Elasticity::zeros();
    d.fixed_view_mut::<3, 3>(0, 0).fill(lambda);
    d + SMatrix::from_diagonal(&SVector::from([2.0 * mu, 2.0 * mu, 2.0 * mu, mu, mu, mu]))
}

fn sum<const ACCUMULATED: bool, const NODES: usize, const ROWS: usize>(
    element: &Element,
    points: &[Point],
    x: &[f64],
    (e, nu): (f64, f64),
) -> Stiffness<ROWS> {
    let d = elasticity(e, nu);
    let mut k = Stiffness::<ROWS>::zeros();
    let nodes = Nodal::<NODES>::from_column_slice(x);
    let (mut values, mut slopes) = ([0.0; NODES], [[0.0; 3]; NODES]);
    for (point, weight) in points {
        (element.shape)(*point, &mut values, &mut slopes);
        let slopes = Nodal::<NODES>::from_column_slice(slopes.as_flattened());
        let jacobian: Matrix3<f64> = nodes * slopes.transpose();
        let Some(inverse) = jacobian.try_inverse() else { continue };
        let gradients = inverse.transpose() * slopes;
        let mut b = SMatrix::<f64, 6, ROWS>::zeros();
        for a in 0..NODES {
            let [x, y, z] = [0, 1, 2].map(|i| gradients[(i, a)]);
            let at = 3 * a;
            (b[(0, at)], b[(1, at + 1)], b[(2, at + 2)]) = (x, y, z);
            (b[(3, at)], b[(3, at + 1)]) = (y, x);
            (b[(4, at + 1)], b[(4, at + 2)]) = (z, y);
            (b[(5, at)], b[(5, at + 2)]) = (z, x);
        }
        let right = (d * (weight * jacobian.determinant())) * b;
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
    use crate::hand::elements::quadratic::{hex_27, tet_4, wedge_18};

    fn both_are_generated<const NODES: usize, const ROWS: usize>(name: &str, points: &[Point]) {
        let element = ELEMENTS.iter().find(|e| e.origin.name == name).expect("shipped");
        let nodes = element.reference_nodes.iter().flatten().enumerate();
        let x: Vec<f64> = nodes.map(|(i, x)| x + 0.02 * (1.3 * i as f64 + 0.7).sin()).collect();
        let kernel = element.form("stiffness").expect("shipped");
        let (packed, _) = kernel.of_cell(&x, &[200e9, 0.3]);
        let largest = packed.iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
        let plain = [stiffness::<NODES, ROWS>, accumulated_stiffness::<NODES, ROWS>];
        for k in plain.map(|k| k(element, points, &x, (200e9, 0.3))) {
            let entries = (0..ROWS).flat_map(|i| (i..ROWS).map(move |j| (i, j)));
            for ((i, j), packed) in entries.zip(&packed) {
                // A thousand roundings of terms that are no larger than the largest entry.
                let allowed = 1e3 * f64::EPSILON * largest;
                assert!((k[(i, j)] - packed).abs() < allowed, "{i} {j}: {} {packed}", k[(i, j)]);
                assert!((k[(j, i)] - packed).abs() < allowed);
            }
        }
    }

    #[test]
    fn both_are_the_generated_stiffness() {
        both_are_generated::<8, 24>("hex8", &gauss_8());
        both_are_generated::<10, 30>("tet10", &tet_4::points());
        both_are_generated::<15, 45>("wedge15", &wedge_18::points());
        both_are_generated::<20, 60>("hex20", &hex_27::points());
    }
}

//! Products with complex shapes.

use num_complex::Complex64;

use crate::linalg::Matrix;

/// A x.
pub(super) fn apply(matrix: &Matrix, x: &[Complex64]) -> Vec<Complex64> {
    let part = |of: fn(&Complex64) -> f64| matrix.apply(&x.iter().map(of).collect::<Vec<f64>>());
    let both = part(|own| own.re).into_iter().zip(part(|own| own.im));
    both.map(|(re, im)| Complex64::new(re, im)).collect()
}

/// xᴴy.
pub(super) fn inner(x: &[Complex64], y: &[Complex64]) -> Complex64 {
    x.iter().zip(y).map(|(x, y)| x.conj() * y).sum()
}

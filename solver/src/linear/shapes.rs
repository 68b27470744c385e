//! Products with complex shapes.

use num_complex::Complex64;

use crate::linalg::{Matrix, multiply};

/// A x.
pub(super) fn apply(matrix: &Matrix, x: &[Complex64]) -> Vec<Complex64> {
    let part = |of: fn(&Complex64) -> f64| matrix.apply(&x.iter().map(of).collect::<Vec<f64>>());
    let both = part(|own| own.re).into_iter().zip(part(|own| own.im));
    both.map(|(re, im)| Complex64::new(re, im)).collect()
}

/// A x of many shapes at once.
pub(super) fn apply_all<'s>(
    matrix: &Matrix,
    shapes: impl Iterator<Item = &'s [Complex64]>,
) -> Vec<Vec<Complex64>> {
    let parts = |shape: &'s [Complex64]| {
        shape.iter().map(|own| own.re).chain(shape.iter().map(|own| own.im))
    };
    let data: Vec<f64> = shapes.flat_map(parts).collect();
    let rows = matrix.cols;
    let both = Matrix { rows, cols: data.len() / rows.max(1), data };
    let moved = multiply(matrix.view(), both.view());
    let pairs = (0..moved.cols / 2).map(|k| (moved.col(2 * k), moved.col(2 * k + 1)));
    pairs
        .map(|(re, im)| re.iter().zip(im).map(|(re, im)| Complex64::new(*re, *im)).collect())
        .collect()
}

/// xᴴy.
pub(super) fn inner(x: &[Complex64], y: &[Complex64]) -> Complex64 {
    x.iter().zip(y).map(|(x, y)| x.conj() * y).sum()
}

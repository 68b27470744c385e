use faer::linalg::matmul::matmul;
use faer::prelude::ReborrowMut;
use faer::{Accum, Mat, MatMut, MatRef, Par};

use super::{Columns, Matrix, view, view_mut};
use crate::together::both;

/// Entries of a tall matrix beyond which its product with a block is worth a thread.
const WORTH: usize = 1 << 19;
/// Rows of it that are multiplied at a time in place.
const SOME: usize = 192;

/// C += α·A·B of a tall A, in two parts side by side where it is large.
pub(crate) fn multiply_add_beside(c: &mut [f64], alpha: f64, a: Columns, b: Columns) {
    if a.rows < 2 || a.data.len() < WORTH {
        return multiply_add(c, alpha, a, b);
    }
    let (above, below) = view(a.rows, a.cols, a.data).split_at_row(a.rows / 2);
    let (first, second) = view_mut(a.rows, b.cols, c).split_at_row_mut(a.rows / 2);
    let b = view(b.rows, b.cols, b.data);
    both(
        || matmul(first, Accum::Add, above, b, alpha, Par::Seq),
        || matmul(second, Accum::Add, below, b, alpha, Par::Seq),
    );
}

/// A ← A·B in its first columns, where B has no more columns than rows, by rows, in two parts side by side where A is large.
pub(crate) fn multiply_in_place_beside(a: &mut [f64], rows: usize, b: Columns) {
    let is_large = rows > 1 && a.len() >= WORTH;
    let whole = view_mut(rows, b.rows, a);
    let b = view(b.rows, b.cols, b.data);
    if !is_large {
        return multiply_in_place(whole, b);
    }
    let (above, below) = whole.split_at_row_mut(rows / 2);
    both(|| multiply_in_place(above, b), || multiply_in_place(below, b));
}

/// Some rows after the other, whose product stays near the processor.
fn multiply_in_place(mut a: MatMut<'_, f64>, b: MatRef<'_, f64>) {
    let mut product = Mat::zeros(SOME, b.ncols());
    for first in (0..a.nrows()).step_by(SOME) {
        let count = usize::min(SOME, a.nrows() - first);
        let mut rows = a.rb_mut().subrows_mut(first, count);
        let mut product = product.as_mut().subrows_mut(0, count);
        matmul(product.rb_mut(), Accum::Replace, rows.as_ref(), b, 1.0, Par::Seq);
        rows.rb_mut().subcols_mut(0, b.ncols()).copy_from(product);
    }
}

/// Aᵀ·B of a tall A, in two parts side by side where it is large.
pub(crate) fn transpose_multiply_beside(a: Columns, b: Columns) -> Matrix {
    let columns = a.cols / 2;
    if columns == 0 || a.data.len() < WORTH {
        return transpose_multiply(a, b);
    }
    let part = |from: usize, to: usize| Columns {
        rows: a.rows,
        cols: to - from,
        data: &a.data[from * a.rows..to * a.rows],
    };
    let [mut first, mut second] = [const { Matrix { rows: 0, cols: 0, data: Vec::new() } }; 2];
    both(
        || first = transpose_multiply(part(0, columns), b),
        || second = transpose_multiply(part(columns, a.cols), b),
    );
    Matrix::from_fn(a.cols, b.cols, |i, j| match i < columns {
        true => first[(i, j)],
        false => second[(i - columns, j)],
    })
}

/// A·B.
pub fn multiply(a: Columns, b: Columns) -> Matrix {
    let mut c = Matrix::zeros(a.rows, b.cols);
    multiply_add(&mut c.data, 1.0, a, b);
    c
}

/// C += α·A·B, with C (a.rows × b.cols) as a column-major slice.
pub fn multiply_add(c: &mut [f64], alpha: f64, a: Columns, b: Columns) {
    matmul(
        view_mut(a.rows, b.cols, c),
        Accum::Add,
        view(a.rows, a.cols, a.data),
        view(b.rows, b.cols, b.data),
        alpha,
        Par::Seq,
    );
}

/// C += α·A·Bᵀ, with C (a.rows × b.rows) as a column-major slice.
pub fn multiply_transpose_add(c: &mut [f64], alpha: f64, a: Columns, b: Columns) {
    matmul(
        view_mut(a.rows, b.rows, c),
        Accum::Add,
        view(a.rows, a.cols, a.data),
        view(b.rows, b.cols, b.data).transpose(),
        alpha,
        Par::Seq,
    );
}

/// Aᵀ·B.
pub fn transpose_multiply(a: Columns, b: Columns) -> Matrix {
    let mut c = Matrix::zeros(a.cols, b.cols);
    matmul(
        view_mut(a.cols, b.cols, &mut c.data),
        Accum::Replace,
        view(a.rows, a.cols, a.data).transpose(),
        view(b.rows, b.cols, b.data),
        1.0,
        Par::Seq,
    );
    c
}

/// TᵀAT.
pub fn congruence(a: &Matrix, t: &Matrix) -> Matrix {
    transpose_multiply(t.view(), multiply(a.view(), t.view()).view())
}

/// AᵀDA, where D is diagonal.
pub fn congruence_diagonal(a: Columns, diagonal: &[f64]) -> Matrix {
    let mut scaled = a.data.to_vec();
    for column in scaled.chunks_exact_mut(a.rows.max(1)) {
        for (value, d) in column.iter_mut().zip(diagonal) {
            *value *= d;
        }
    }
    let scaled = Columns { data: &scaled, ..a };
    transpose_multiply(a, scaled).symmetric_part()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_in_place_and_beside_are_those_of_the_whole() {
        // One row, rows that fill no block, and so many that two parts are made.
        for (rows, cols, keep) in [(1, 3, 2), (500, 7, 7), (200_003, 3, 2)] {
            let a = Matrix::from_fn(rows, cols, |i, j| (1.3 * (i + 5 * j) as f64).sin());
            let b = Matrix::from_fn(cols, keep, |i, j| (0.7 * (i + 3 * j) as f64).cos());
            let exact = multiply(a.view(), b.view());
            let mut own = a.clone();
            multiply_in_place_beside(&mut own.data, rows, b.view());
            let mut added = exact.data.clone();
            multiply_add_beside(&mut added, -1.0, a.view(), b.view());
            for (i, exact) in exact.data.iter().enumerate() {
                assert!((own.data[i] - exact).abs() < 1e-14, "{rows}: {i}");
                assert!(added[i].abs() < 1e-14, "{rows}: {i}");
            }
            // The other columns stay as they were.
            assert_eq!(own.data[keep * rows..], a.data[keep * rows..]);
        }
    }
}

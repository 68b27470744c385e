use faer::linalg::matmul::matmul;
use faer::{Accum, Par};

use super::{Columns, Matrix, view, view_mut};

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

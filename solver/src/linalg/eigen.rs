use faer::Par;
use faer::diag::DiagMut;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd;
use num_complex::Complex64;

use super::{Cholesky, LinearAlgebraError, Matrix, view, view_mut};

/// Eigenpairs of a symmetric matrix.
#[derive(Debug, Clone)]
pub struct SymmetricEigen {
    /// Eigenvalues, ascending.
    pub values: Vec<f64>,
    /// Eigenvectors as columns, orthonormal.
    pub vectors: Matrix,
}

/// Eigenpairs of A x = λ B x.
#[derive(Debug, Clone)]
pub struct GeneralisedEigen {
    /// Eigenvalues, ascending.
    pub values: Vec<f64>,
    /// Eigenvectors as columns, xᵀBx = 1.
    pub vectors: Matrix,
}

/// All eigenpairs of a symmetric matrix (only the lower triangle is read).
///
/// # Errors
/// [`LinearAlgebraError::NoConvergence`] if the matrix holds a value that is not finite.
pub fn symmetric_eigen(a: &Matrix) -> Result<SymmetricEigen, LinearAlgebraError> {
    let n = a.rows;
    if n == 0 {
        return Ok(SymmetricEigen { values: Vec::new(), vectors: Matrix::zeros(0, 0) });
    }
    let failure = LinearAlgebraError::NoConvergence { size: n };
    // faer loses digits for n ≥ 129 unless ‖A‖ ≈ 1. A power of two scales without rounding.
    let norm = a.norm_max();
    if a.data.iter().any(|value| !value.is_finite()) {
        return Err(failure);
    }
    let exponent = if norm > 0.0 { -norm.log2().round() as i32 } else { 0 };
    // Two factors, because a single power of two may overflow where the product does not.
    let (half, rest) = (2f64.powi(exponent / 2), 2f64.powi(exponent - exponent / 2));
    let scaled: Vec<f64> = a.data.iter().map(|value| value * half * rest).collect();
    let (mut values, mut vectors) = (vec![0.0; n], Matrix::zeros(n, n));
    let mut memory = MemBuffer::new(evd::self_adjoint_evd_scratch::<f64>(
        n,
        evd::ComputeEigenvectors::Yes,
        Par::Seq,
        Default::default(),
    ));
    evd::self_adjoint_evd(
        view(n, n, &scaled),
        DiagMut::from_slice_mut(&mut values),
        Some(view_mut(n, n, &mut vectors.data)),
        Par::Seq,
        MemStack::new(&mut memory),
        Default::default(),
    )
    .map_err(|_| failure)?;
    for value in &mut values {
        *value = *value / half / rest;
    }
    Ok(SymmetricEigen { values, vectors })
}

/// All eigenpairs of A x = λ B x, A symmetric, B symmetric positive definite (lower triangles are read).
///
/// # Errors
/// [`LinearAlgebraError::NotPositiveDefinite`] of B, or [`LinearAlgebraError::NoConvergence`].
pub fn generalised_symmetric_eigen(
    a: &Matrix,
    b: &Matrix,
) -> Result<GeneralisedEigen, LinearAlgebraError> {
    let n = a.rows;
    let mut cholesky = Cholesky::new(n);
    cholesky.factor(&b.data)?;
    // L⁻¹ A L⁻ᵀ, from the lower triangle of A.
    let mut c = Matrix::from_fn(n, n, |i, j| a[(i.max(j), i.min(j))]);
    cholesky.solve_lower_in_place(&mut c.data);
    c = c.transpose();
    cholesky.solve_lower_in_place(&mut c.data);
    let SymmetricEigen { values, mut vectors } = symmetric_eigen(&c.symmetric_part())?;
    cholesky.solve_upper_in_place(&mut vectors.data);
    Ok(GeneralisedEigen { values, vectors })
}

/// All eigenvalues of a square matrix, as real and imaginary parts.
///
/// # Errors
/// [`LinearAlgebraError::NoConvergence`], also for values that are not finite.
pub(crate) fn eigenvalues(a: &Matrix) -> Result<Vec<[f64; 2]>, LinearAlgebraError> {
    let failure = LinearAlgebraError::NoConvergence { size: a.rows };
    if a.data.iter().any(|value| !value.is_finite()) {
        return Err(failure);
    }
    let whole = faer::MatRef::from_column_major_slice(&a.data, a.rows, a.cols);
    let values = whole.eigenvalues().map_err(|_| failure)?;
    Ok(values.into_iter().map(|value| [value.re, value.im]).collect())
}

/// All eigenvalues of a square matrix, each with its vector of unit length: of the matrix of Arnoldi's process the last entry
/// tells what is left of a Ritz pair.
///
/// # Errors
/// As [`eigenvalues`].
pub(crate) fn ritz_pairs(
    a: &Matrix,
) -> Result<Vec<(Complex64, Vec<Complex64>)>, LinearAlgebraError> {
    let failure = LinearAlgebraError::NoConvergence { size: a.rows };
    if a.data.iter().any(|value| !value.is_finite()) {
        return Err(failure);
    }
    super::on_one_thread();
    let whole = faer::MatRef::from_column_major_slice(&a.data, a.rows, a.cols);
    let found = whole.eigen().map_err(|_| failure)?;
    let (values, vectors) = (found.S().column_vector(), found.U());
    let pairs = (0..a.rows).map(|k| {
        let size = (0..a.rows).map(|i| vectors[(i, k)].norm_sqr()).sum::<f64>().sqrt();
        let vector = (0..a.rows).map(|i| vectors[(i, k)] / size).collect();
        (Complex64::new(values[k].re, values[k].im), vector)
    });
    Ok(pairs.collect())
}

/// Eigenvalues, ascending, and orthonormal vectors of a Hermitian matrix, both column after column; its lower triangle is read.
///
/// # Errors
/// [`LinearAlgebraError::NoConvergence`], also for values that are not finite.
pub(crate) fn hermitian_eigen(
    size: usize,
    entries: &[Complex64],
) -> Result<(Vec<f64>, Vec<Complex64>), LinearAlgebraError> {
    let failure = LinearAlgebraError::NoConvergence { size };
    if entries.iter().any(|value| !value.is_finite()) {
        return Err(failure);
    }
    let whole = faer::MatRef::from_column_major_slice(entries, size, size);
    let found = whole.self_adjoint_eigen(faer::Side::Lower).map_err(|_| failure)?;
    let (values, vectors) = (found.S().column_vector(), found.U());
    let columns = (0..size).flat_map(|j| (0..size).map(move |i| vectors[(i, j)]));
    Ok(((0..size).map(|k| values[k].re).collect(), columns.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::{congruence, multiply};

    /// Tridiagonal second difference: eigenvalues 4 sin²(kπ/(2n+2)).
    fn string(n: usize, scale: f64) -> Matrix {
        Matrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => 2.0 * scale,
            1 => -scale,
            _ => 0.0,
        })
    }

    #[test]
    fn eigenvalues_keep_their_digits_at_every_scale() {
        let n = 200;
        for scale in [1e-300, 1e-12, 1.0, 1e12, 1e300] {
            let a = string(n, scale);
            let eigen = symmetric_eigen(&a).unwrap();
            let product = multiply(a.view(), eigen.vectors.view());
            for k in 0..n {
                let angle = (k + 1) as f64 * std::f64::consts::PI / (2 * n + 2) as f64;
                let exact = 4.0 * angle.sin().powi(2);
                assert!((eigen.values[k] / scale - exact).abs() < 1e-13, "{scale} {k}");
                for i in 0..n {
                    let residual = product[(i, k)] - eigen.values[k] * eigen.vectors[(i, k)];
                    assert!((residual / scale).abs() < 1e-13, "{scale} {k}");
                }
            }
        }
    }

    #[test]
    fn a_value_that_is_not_finite_is_an_error() {
        let mut a = string(5, 1.0);
        a[(3, 1)] = f64::NAN;
        assert_eq!(symmetric_eigen(&a).unwrap_err(), LinearAlgebraError::NoConvergence { size: 5 });
    }

    #[test]
    fn generalised_pairs_are_orthonormal_in_b_and_diagonalise_a() {
        let n = 30;
        let a = string(n, 1e8);
        let b = Matrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => 4e-3,
            1 => 1e-3,
            _ => 0.0,
        });
        let eigen = generalised_symmetric_eigen(&a, &b).unwrap();
        let (gram, rayleigh) = (congruence(&b, &eigen.vectors), congruence(&a, &eigen.vectors));
        for i in 0..n {
            for j in 0..n {
                let (one, value) = if i == j { (1.0, eigen.values[i]) } else { (0.0, 0.0) };
                assert!((gram[(i, j)] - one).abs() < 1e-13);
                assert!((rayleigh[(i, j)] - value).abs() < 1e-12 * eigen.values[n - 1]);
            }
        }
    }
}

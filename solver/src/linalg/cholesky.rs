use faer::Par;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::linalg::cholesky::llt::{factor, solve};
use faer::linalg::triangular_solve;

use super::{LinearAlgebraError, view, view_mut};

/// Cholesky factorisation A = LLᵀ of symmetric positive definite n × n matrices, one after the other
/// in the same memory: neither `Cholesky::factor` nor the solves allocate.
pub struct Cholesky {
    size: usize,
    values: Vec<f64>,
    memory: MemBuffer,
}

impl Cholesky {
    /// Memory for matrices of size n. The factor is that of the identity until [`Cholesky::factor`] is called.
    pub(crate) fn new(n: usize) -> Self {
        let scratch = StackReq::any_of(&[
            factor::cholesky_in_place_scratch::<f64>(n, Par::Seq, Default::default()),
            solve::solve_in_place_scratch::<f64>(n, n.max(1), Par::Seq),
        ]);
        Cholesky {
            size: n,
            values: super::Matrix::identity(n).data,
            memory: MemBuffer::new(scratch),
        }
    }

    /// Factors a symmetric matrix given column after column (n² values; only the lower triangle is read).
    ///
    /// # Errors
    /// [`LinearAlgebraError::NotPositiveDefinite`], also when the matrix holds a value that is not
    /// finite. The factor must then not be used.
    pub(crate) fn factor(&mut self, matrix: &[f64]) -> Result<(), LinearAlgebraError> {
        let n = self.size;
        self.values.copy_from_slice(matrix);
        let outcome = factor::cholesky_in_place(
            view_mut(n, n, &mut self.values),
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        if let Err(LltError::NonPositivePivot { index }) = outcome {
            return Err(LinearAlgebraError::NotPositiveDefinite { row: index, size: n });
        }
        match (0..n).find(|&j| !self.values[j * (n + 1)].is_finite()) {
            Some(row) => Err(LinearAlgebraError::NotPositiveDefinite { row, size: n }),
            None => Ok(()),
        }
    }

    /// Replaces each column b of `rhs` (columns of n values) by A⁻¹b.
    pub(crate) fn solve_in_place(&mut self, rhs: &mut [f64]) {
        let (n, cols) = self.shape(rhs);
        solve::solve_in_place(
            view(n, n, &self.values),
            view_mut(n, cols, rhs),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }

    /// Replaces each column b of `rhs` by L⁻¹b.
    pub(crate) fn solve_lower_in_place(&self, rhs: &mut [f64]) {
        let (n, cols) = self.shape(rhs);
        triangular_solve::solve_lower_triangular_in_place(
            view(n, n, &self.values),
            view_mut(n, cols, rhs),
            Par::Seq,
        );
    }

    /// Replaces each column b of `rhs` by L⁻ᵀb.
    pub(crate) fn solve_upper_in_place(&self, rhs: &mut [f64]) {
        let (n, cols) = self.shape(rhs);
        triangular_solve::solve_upper_triangular_in_place(
            view(n, n, &self.values).transpose(),
            view_mut(n, cols, rhs),
            Par::Seq,
        );
    }

    /// Replaces a matrix W of `rows` rows and n columns by W L⁻ᵀ, which makes the columns of W
    /// orthonormal in an inner product whose Gram matrix of W was factored.
    pub(crate) fn orthonormalise(&self, w: &mut [f64], rows: usize) {
        triangular_solve::solve_lower_triangular_in_place(
            view(self.size, self.size, &self.values),
            view_mut(rows, self.size, w).transpose_mut(),
            Par::Seq,
        );
    }

    /// Entry (i, j) of L, i ≥ j.
    pub(crate) fn lower(&self, i: usize, j: usize) -> f64 {
        self.values[i + j * self.size]
    }

    fn shape(&self, rhs: &[f64]) -> (usize, usize) {
        let cols = rhs.len().checked_div(self.size).unwrap_or(0);
        assert!(cols * self.size == rhs.len(), "rhs has whole columns");
        (self.size, cols)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Matrix;

    #[test]
    fn solves_and_orthonormalises() {
        let n = 40;
        let a = Matrix::from_fn(n, n, |i, j| 1.0 / (1.0 + i as f64 + j as f64).powi(2))
            .data
            .iter()
            .zip(&Matrix::identity(n).data)
            .map(|(a, e)| a + e)
            .collect::<Vec<_>>();
        let mut cholesky = Cholesky::new(n);
        cholesky.factor(&a).unwrap();
        let a = Matrix { rows: n, cols: n, data: a };
        let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let mut b = a.apply(&x);
        cholesky.solve_in_place(&mut b);
        assert!(b.iter().zip(&x).all(|(got, want)| (got - want).abs() < 1e-13));
        let mut w = Matrix::identity(n);
        cholesky.orthonormalise(&mut w.data, n);
        let gram = crate::linalg::congruence(&a, &w);
        for i in 0..n {
            for j in 0..n {
                let want = if i == j { 1.0 } else { 0.0 };
                assert!((gram[(i, j)] - want).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn an_indefinite_matrix_or_nan_is_an_error() {
        let mut cholesky = Cholesky::new(3);
        let mut a = Matrix::identity(3);
        a[(1, 1)] = -1.0;
        assert_eq!(
            cholesky.factor(&a.data),
            Err(LinearAlgebraError::NotPositiveDefinite { row: 1, size: 3 })
        );
        a[(1, 1)] = 1.0;
        a[(2, 0)] = f64::NAN;
        assert!(cholesky.factor(&a.data).is_err());
    }
}

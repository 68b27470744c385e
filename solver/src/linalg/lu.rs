use faer::Par;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;

use super::{LinearAlgebraError, view, view_mut};

/// LU factorisation with partial pivoting of n × n matrices, one after the other in the same memory:
/// neither [`Lu::factor`] nor [`Lu::solve_in_place`] allocates.
pub struct Lu {
    size: usize,
    values: Vec<f64>,
    forward: Vec<usize>,
    inverse: Vec<usize>,
    memory: MemBuffer,
}

impl Lu {
    /// Memory for matrices of size n. The factors are those of the identity until [`Lu::factor`] is called.
    pub fn new(n: usize) -> Self {
        let scratch = StackReq::any_of(&[
            factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Default::default()),
            solve::solve_in_place_scratch::<usize, f64>(n, n.max(1), Par::Seq),
        ]);
        Lu {
            size: n,
            values: super::Matrix::identity(n).data,
            forward: (0..n).collect(),
            inverse: (0..n).collect(),
            memory: MemBuffer::new(scratch),
        }
    }

    /// Number of rows, n.
    pub(crate) fn size(&self) -> usize {
        self.size
    }

    /// Factors a matrix given column after column (n² values).
    ///
    /// # Errors
    /// [`LinearAlgebraError::Singular`] if a pivot is zero or not finite; a value that is not finite
    /// anywhere in the matrix reaches a pivot. The factors must then not be used.
    pub fn factor(&mut self, matrix: &[f64]) -> Result<(), LinearAlgebraError> {
        self.values.copy_from_slice(matrix);
        self.factor_in_place()
    }

    /// Where the next matrix (column after column) may be written before [`Lu::factor_in_place`];
    /// it holds the last factors, so every entry must be set.
    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Factors the matrix written to [`Lu::values_mut`].
    ///
    /// # Errors
    /// As [`Lu::factor`].
    pub(crate) fn factor_in_place(&mut self) -> Result<(), LinearAlgebraError> {
        let n = self.size;
        factor::lu_in_place(
            view_mut(n, n, &mut self.values),
            &mut self.forward,
            &mut self.inverse,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        // A value that is not finite in L or U, above or below, takes part in every later pivot.
        for column in 0..n {
            let pivot = self.values[column * (n + 1)];
            if pivot == 0.0 || !pivot.is_finite() {
                return Err(LinearAlgebraError::Singular { column, pivot, size: n });
            }
        }
        Ok(())
    }

    /// Replaces each column b of `rhs` (one or more columns of n values, at most n) by A⁻¹b.
    pub fn solve_in_place(&mut self, rhs: &mut [f64]) {
        let n = self.size;
        if n == 0 {
            return;
        }
        let cols = rhs.len() / n;
        assert!(cols * n == rhs.len() && cols <= n, "rhs has whole columns, at most n");
        let factors = view(n, n, &self.values);
        solve::solve_in_place(
            factors,
            factors,
            PermRef::new_checked(&self.forward, &self.inverse, n),
            view_mut(n, cols, rhs),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Matrix;

    fn wild(n: usize, seed: u64) -> Matrix {
        let mut state = seed;
        Matrix::from_fn(n, n, |_, _| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        })
    }

    #[test]
    fn solves_what_it_factored() {
        let n = 226;
        let mut lu = Lu::new(n);
        for seed in 1..4 {
            let a = wild(n, seed);
            let x: Vec<f64> = (0..n).map(|i| 1.0 + i as f64).collect();
            let mut b = a.apply(&x);
            lu.factor(&a.data).unwrap();
            lu.solve_in_place(&mut b);
            for (got, want) in b.iter().zip(&x) {
                assert!((got - want).abs() < 1e-8 * want, "{got} {want}");
            }
        }
    }

    #[test]
    fn a_value_that_is_not_finite_is_found_wherever_it_stands() {
        let n = 150;
        let mut lu = Lu::new(n);
        for bad in [f64::NAN, f64::INFINITY] {
            for place in [(0, 0), (0, n - 1), (n - 1, 0), (n - 1, n - 1), (40, 90), (90, 40)] {
                let mut a = wild(n, 7);
                a[place] = bad;
                assert!(lu.factor(&a.data).is_err(), "{bad} at {place:?}");
            }
        }
    }

    #[test]
    fn a_singular_matrix_is_an_error() {
        let mut lu = Lu::new(2);
        let error = lu.factor(&[1.0, 2.0, 2.0, 4.0]).unwrap_err();
        assert_eq!(error, LinearAlgebraError::Singular { column: 1, pivot: 0.0, size: 2 });
    }
}

//! Systems of equations with complex coefficients.

use faer::linalg::solvers::{PartialPivLu, Solve};
use num_complex::Complex64;

use super::{LinearAlgebraError, on_one_thread};

/// The factors of a square matrix with complex entries, with partial pivoting.
pub(crate) struct ComplexLu {
    size: usize,
    factors: PartialPivLu<Complex64>,
}

impl ComplexLu {
    /// Of A, of `size` rows, column after column.
    ///
    /// # Errors
    /// [`LinearAlgebraError::Singular`] for a pivot that is zero, also for values that are not finite.
    pub(crate) fn new(size: usize, matrix: &[Complex64]) -> Result<Self, LinearAlgebraError> {
        let singular =
            |column: usize, pivot: f64| LinearAlgebraError::Singular { column, pivot, size };
        if matrix.iter().any(|value| !value.is_finite()) {
            return Err(singular(0, f64::NAN));
        }
        on_one_thread();
        let whole = faer::MatRef::from_column_major_slice(matrix, size, size);
        let factors = whole.partial_piv_lu();
        let pivot = |column: usize| factors.U()[(column, column)].norm();
        match (0..size).find(|column| !(pivot(*column) > 0.0)) {
            Some(column) => Err(singular(column, pivot(column))),
            None => Ok(ComplexLu { size, factors }),
        }
    }

    /// Replaces b by A⁻¹ b.
    pub(crate) fn solve_in_place(&self, right: &mut [Complex64]) {
        let column = faer::MatMut::from_column_major_slice_mut(right, self.size, 1);
        self.factors.solve_in_place(column);
    }
}

/// x of A x = b, A of `size` rows, column after column.
///
/// # Errors
/// [`LinearAlgebraError::Singular`], also for values that are not finite.
pub(crate) fn solve_complex(
    size: usize,
    matrix: &[Complex64],
    right: &[Complex64],
) -> Result<Vec<Complex64>, LinearAlgebraError> {
    let mut x = right.to_vec();
    ComplexLu::new(size, matrix)?.solve_in_place(&mut x);
    if x.iter().any(|value| !value.is_finite()) {
        return Err(LinearAlgebraError::Singular { column: 0, pivot: f64::NAN, size });
    }
    Ok(x)
}

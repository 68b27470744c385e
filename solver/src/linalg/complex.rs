//! Systems of equations with complex coefficients.

use faer::linalg::solvers::Solve;
use num_complex::Complex64;

use super::{LinearAlgebraError, on_one_thread};

/// x of A x = b, A of `size` rows, column after column.
///
/// # Errors
/// [`LinearAlgebraError::Singular`], also for values that are not finite.
pub(crate) fn solve_complex(
    size: usize,
    matrix: &[Complex64],
    right: &[Complex64],
) -> Result<Vec<Complex64>, LinearAlgebraError> {
    let failure = LinearAlgebraError::Singular { column: 0, pivot: f64::NAN, size };
    if matrix.iter().chain(right).any(|value| !value.is_finite()) {
        return Err(failure);
    }
    on_one_thread();
    let whole = faer::MatRef::from_column_major_slice(matrix, size, size);
    let mut x = right.to_vec();
    let column = faer::MatMut::from_column_major_slice_mut(&mut x, size, 1);
    whole.partial_piv_lu().solve_in_place(column);
    if x.iter().any(|value| !value.is_finite()) {
        return Err(failure);
    }
    Ok(x)
}

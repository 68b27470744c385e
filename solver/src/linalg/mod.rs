//! Linear algebra in concrete `f64`, column-major. The only module that names faer.
//!
//! A step runs on one thread: at its sizes (n ≈ 230) threads inside one solve cost more than they give, and independent
//! cases run side by side instead. What a reduction does with large matrices falls into two parts, wherever it runs.

mod block_solve;
mod cholesky;
mod combination;
mod complex;
mod eigen;
mod lower;
mod lu;
mod matrix;
mod memory;
mod packed;
mod periodic;
mod product;
mod quadratic;
mod rough_inverse;
mod sparse;
mod sums;
mod values;

pub use cholesky::Cholesky;
pub(crate) use combination::{add_columns, add_product, add_transposed, widely};
pub(crate) use complex::{ComplexLu, solve_complex};
pub use eigen::{GeneralisedEigen, SymmetricEigen, generalised_symmetric_eigen, symmetric_eigen};
pub(crate) use eigen::{eigenvalues, hermitian_eigen, ritz_pairs};
pub use lower::LowerTriangle;
pub(crate) use lower::add_scaled;
pub use lu::Lu;
pub use matrix::{Columns, Matrix};
pub(crate) use matrix::{copy_block_from, dot};
pub use memory::{MemoryLimit, Stage, readable_bytes, readable_estimate, readable_need};
pub(crate) use periodic::{Harmonic, Periodic, PeriodicPair};
pub use product::{
    congruence, congruence_diagonal, multiply, multiply_add, multiply_transpose_add,
    transpose_multiply,
};
pub(crate) use product::{
    multiply_add_beside, multiply_in_place_beside, transpose_multiply_beside,
};
pub(crate) use quadratic::{FirstOrder, QuadraticPair, quadratic_eigen, quadratic_eigen_with};
pub(crate) use rough_inverse::RoughInverse;
pub(crate) use sparse::Pattern;
pub use sparse::{Inertia, SparseCholesky, SparseLdlt};
pub(crate) use sums::{largest_and_sum, sum_of, sum_over};

use faer::{MatMut, MatRef};

/// Why a factorisation or a decomposition was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LinearAlgebraError {
    /// A pivot of an LU factorisation is zero or not finite.
    #[error(
        "the matrix is singular or holds a value that is not finite: pivot {pivot:e} in column {column} of {size}"
    )]
    Singular {
        /// Column (after elimination of those before it) whose pivot failed.
        column: usize,
        /// The pivot.
        pivot: f64,
        /// Rows of the matrix.
        size: usize,
    },
    /// A symmetric matrix has a pivot that is not positive.
    #[error(
        "the matrix is not positive definite: the pivot of row {row} of {size} is not positive"
    )]
    NotPositiveDefinite {
        /// Row, in the caller's numbering, at which the factorisation stopped.
        row: usize,
        /// Rows of the matrix.
        size: usize,
    },
    /// A factor, with what stands beside it, would need more memory than allowed.
    #[error(
        "{size} unknowns take {}, and the limit is {}: take fewer of them, or allow more",
        readable_need(*bytes), readable_bytes(*limit)
    )]
    TooLarge {
        /// Rows of the matrix.
        size: usize,
        /// Bytes by the estimate.
        bytes: usize,
        /// Bytes allowed.
        limit: usize,
    },
    /// An iteration for eigenvalues did not converge, which happens when the matrix is not finite.
    #[error(
        "the eigenvalues of a {size} × {size} matrix were not found; does it hold a value that is not finite?"
    )]
    NoConvergence {
        /// Rows of the matrix.
        size: usize,
    },
}

/// What faer does without being told how runs on the thread that asks for it: its own would wait for each other.
fn on_one_thread() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| faer::set_global_parallelism(faer::Par::Seq));
}

fn view(rows: usize, cols: usize, data: &[f64]) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(data, rows, cols)
}

fn view_mut(rows: usize, cols: usize, data: &mut [f64]) -> MatMut<'_, f64> {
    MatMut::from_column_major_slice_mut(data, rows, cols)
}

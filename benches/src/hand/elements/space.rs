//! Vectors in space, one a lane of cells.

use whirl_specs::{Batch, Lane, Matrix, Register};

/// A constant vector.
pub(super) type Vector = [f64; 3];

/// A vector in space, one a cell.
pub(super) type Space<L> = [L; 3];

#[inline(always)]
pub(super) fn plus<L: Lane>(a: Space<L>, b: Space<L>) -> Space<L> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(super) fn minus<L: Lane>(a: Space<L>, b: Space<L>) -> Space<L> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(super) fn times<L: Lane>(a: Space<L>, factor: f64) -> Space<L> {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

#[inline(always)]
pub(super) fn dot<L: Lane>(a: Space<L>, b: Space<L>) -> L {
    a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
}

#[inline(always)]
pub(super) fn cross<L: Lane>(a: Space<L>, b: Space<L>) -> Space<L> {
    [
        a[1].mul_add(b[2], -(a[2] * b[1])),
        a[2].mul_add(b[0], -(a[0] * b[2])),
        a[0].mul_add(b[1], -(a[1] * b[0])),
    ]
}

/// The trip count of a loop that must not be unrolled: with everything unrolled, sums leave the registers.
#[inline(always)]
pub(super) fn trips(count: usize) -> usize {
    std::hint::black_box(count).min(count)
}

/// A block of cells, as [`whirl_specs::CellKernel`] takes them.
pub(super) struct Cells<'a> {
    pub(super) coordinates: &'a [f64],
    pub(super) material: &'a [f64],
    pub(super) matrices: &'a mut [Batch],
    pub(super) jacobians: &'a mut [f64],
}

impl Cells<'_> {
    /// The matrices of `stored` values of the lane that begins with a cell.
    #[inline(always)]
    pub(super) fn matrix<L: Register>(&mut self, cell: usize, stored: usize) -> Matrix<'_, L> {
        let entries = &mut self.matrices[cell / Batch::CELLS * stored..][..stored];
        Matrix::new(entries, cell % Batch::CELLS)
    }
}

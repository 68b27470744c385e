//! How bores move at their springs.

use std::ops::Range;

use super::mirrors::{BlockMemory, Blocks};
use crate::linalg::{Matrix, add_product};

/// How the bores of a body move at all springs, and the sections of journals that turn in them.
pub(crate) struct Bores {
    /// Where the coordinates on which they depend stand in q.
    pub(crate) place: Range<usize>,
    /// T_b: motions of the bores from these coordinates (rows × coordinates), eqs. (20) to (23).
    pub(crate) rows: Matrix,
    /// T_bᵀ: one column a row of T_b.
    pub(crate) transposed: Matrix,
    /// Both in blocks, where mirrors map the bores onto themselves.
    pub(super) blocks: Option<Blocks>,
    /// b0 in the same rows, where any is not zero.
    pub(super) offset: Option<Vec<f64>>,
    /// What rotations that are given bring to rows: row, place in q, coefficient.
    pub(super) given: Vec<(usize, usize, f64)>,
}

impl Bores {
    pub(super) fn new(
        place: Range<usize>,
        mut rows: Matrix,
        offset: Option<Vec<f64>>,
        given: Vec<(usize, usize, f64)>,
    ) -> Self {
        let blocks = Blocks::of(&mut rows);
        Bores { place, transposed: rows.transpose(), rows, blocks, offset, given }
    }

    /// Adds to motions of the rows those by rotations that are given.
    pub(super) fn add_given(&self, x: &[f64], out: &mut [f64]) {
        self.given.iter().for_each(|&(row, place, own)| out[row] += own * x[place]);
    }

    /// Memory for products with T_b and its transpose.
    pub(crate) fn memory(&self) -> BlockMemory {
        self.blocks.as_ref().map(Blocks::memory).unwrap_or_default()
    }

    /// Adds T_b x.
    pub(crate) fn add_motion(&self, x: &[f64], out: &mut [f64], memory: &mut BlockMemory) {
        match &self.blocks {
            Some(blocks) => blocks.add_motion(x, out, memory),
            None => add_product(out, &self.rows, x),
        }
    }

    /// Adds T_bᵀ f.
    pub(crate) fn add_force(&self, f: &[f64], out: &mut [f64], memory: &mut BlockMemory) {
        match &self.blocks {
            Some(blocks) => blocks.add_force(f, out, memory),
            None => add_product(out, &self.transposed, f),
        }
    }
}

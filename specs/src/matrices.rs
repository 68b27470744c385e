//! Matrices of cells in memory: batches of eight cells side by side, entry after entry, as kernels write them.

use std::marker::PhantomData;

use crate::register::{Register, Zeros};

/// One value of each cell of a batch of eight, side by side: a cache line, which every register fills or divides.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C, align(64))]
pub struct Batch(pub [f64; Batch::CELLS]);

// SAFETY: numbers.
unsafe impl Zeros for Batch {}

impl Batch {
    /// Cells side by side.
    pub const CELLS: usize = 8;

    /// Memory for the matrices of `cells` cells, of `stored` values each.
    pub fn storage(cells: usize, stored: usize) -> Vec<Batch> {
        vec![Batch::default(); cells.div_ceil(Batch::CELLS) * stored]
    }
}

/// The matrix of one cell among those of many.
#[derive(Debug, Clone, Copy)]
pub struct CellMatrix<'a> {
    /// The cell and those beside it.
    entries: &'a [Batch],
    /// Which of them.
    place: usize,
}

impl<'a> CellMatrix<'a> {
    /// The matrix of a cell, of `stored` values.
    ///
    /// # Panics
    /// If there are fewer batches than it takes to hold the cell.
    pub fn new(matrices: &'a [Batch], stored: usize, cell: usize) -> Self {
        let entries = &matrices[cell / Batch::CELLS * stored..][..stored];
        CellMatrix { entries, place: cell % Batch::CELLS }
    }

    /// The stored value `entry`.
    ///
    /// # Panics
    /// If there are fewer.
    #[inline]
    pub fn get(self, entry: usize) -> f64 {
        self.entries[entry].0[self.place]
    }

    /// All stored values.
    pub fn values(self) -> impl Iterator<Item = f64> + 'a {
        self.entries.iter().map(move |entry| entry.0[self.place])
    }
}

/// The matrices of one lane of cells, in a part of a batch.
#[derive(Debug)]
pub struct Matrix<'a, L> {
    entries: &'a mut [Batch],
    /// Place of the first of the cells; with the others it ends within the batch.
    first: usize,
    lane: PhantomData<L>,
}

impl<'a, L: Register> Matrix<'a, L> {
    /// The cells `first`, `first + 1`, … of a batch.
    ///
    /// # Panics
    /// If a batch does not hold as many.
    #[inline(always)]
    pub fn new(entries: &'a mut [Batch], first: usize) -> Self {
        const {
            assert!(L::WIDTH <= Batch::CELLS);
            assert!(size_of::<L::Chunk>() == L::WIDTH * size_of::<f64>());
            assert!(align_of::<L::Chunk>() == align_of::<f64>());
        }
        assert!(first <= Batch::CELLS - L::WIDTH);
        Matrix { entries, first, lane: PhantomData }
    }

    /// The same cells of other entries.
    #[inline(always)]
    pub fn beside<'b>(&self, entries: &'b mut [Batch]) -> Matrix<'b, L> {
        Matrix { entries, first: self.first, lane: PhantomData }
    }

    /// The same, for a shorter time.
    #[inline(always)]
    pub fn again(&mut self) -> Matrix<'_, L> {
        Matrix { entries: self.entries, first: self.first, lane: PhantomData }
    }

    /// An entry.
    ///
    /// # Panics
    /// If there are fewer, as below.
    #[inline(always)]
    pub fn get(&self, entry: usize) -> L {
        let batch = &self.entries[entry];
        // SAFETY: a chunk is as large as WIDTH values and any bits are one; as many values begin at `first`.
        L::load(unsafe { &*batch.0.as_ptr().add(self.first).cast() })
    }

    /// Three entries from `start` on.
    #[inline(always)]
    pub fn three(&self, start: usize) -> [L; 3] {
        [self.get(start), self.get(start + 1), self.get(start + 2)]
    }

    /// Writes entries from `start` on.
    #[inline(always)]
    pub fn set(&mut self, start: usize, values: &[L]) {
        let entries = &mut self.entries[start..start + values.len()];
        for (batch, value) in entries.iter_mut().zip(values) {
            // SAFETY: as above.
            value.store(unsafe { &mut *batch.0.as_mut_ptr().add(self.first).cast() });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_found_among_many() {
        let mut matrices = Batch::storage(11, 3);
        assert_eq!(matrices.len(), 6);
        Matrix::<f64>::new(&mut matrices[3..], 2).set(1, &[7.0, 8.0]);
        let cell = CellMatrix::new(&matrices, 3, 10);
        assert_eq!((cell.get(0), cell.get(1)), (0.0, 7.0));
        assert_eq!(cell.values().collect::<Vec<_>>(), [0.0, 7.0, 8.0]);
        let others = (0..11).filter(|cell| *cell != 10);
        let mut others = others.flat_map(|cell| CellMatrix::new(&matrices, 3, cell).values());
        assert!(others.all(|value| value == 0.0));
    }

    #[test]
    fn entries_are_written_and_read() {
        let mut matrices = Batch::storage(1, 3);
        let mut matrix = Matrix::<f64>::new(&mut matrices, 7);
        matrix.set(0, &[1.0, 2.0, 3.0]);
        matrix.again().set(1, &[1.5]);
        assert_eq!(matrix.three(0), [1.0, 1.5, 3.0]);
    }

    #[test]
    #[should_panic(expected = "first <= Batch::CELLS")]
    fn a_ninth_cell_is_refused() {
        Matrix::<f64>::new(&mut [], 8);
    }
}

//! Storage of symmetric matrices: what kernels of forms call as [`crate::cells`].

use crate::matrices::Matrix;
use crate::register::Register;

/// The trip count of a loop that is to stay one: its code is smaller and, with as many values in registers
/// as there are, faster than what a compiler makes of it when it knows the count.
#[inline(always)]
pub fn looped(count: usize) -> usize {
    std::hint::black_box(count).min(count)
}

/// Place of entry (row, row) in the upper triangle by rows of a symmetric matrix with `size` rows.
#[inline(always)]
pub(crate) const fn diagonal(size: usize, row: usize) -> usize {
    row * (2 * size + 1 - row) / 2
}

/// Where the three rows of basis function a begin in the upper triangle by rows of a symmetric matrix with `size` rows,
/// so that column j is j places behind; those before the diagonal are not stored.
#[inline(always)]
pub fn upper_rows(size: usize, a: usize) -> [usize; 3] {
    let [i, j, k] = [3 * a, 3 * a + 1, 3 * a + 2];
    [diagonal(size, i) - i, diagonal(size, j) - j, diagonal(size, k) - k]
}

/// Where the three rows of basis function a begin in a matrix by rows with `size` columns.
#[inline(always)]
pub fn full_rows(size: usize, a: usize) -> [usize; 3] {
    [3 * a * size, (3 * a + 1) * size, (3 * a + 2) * size]
}

/// Stores the 3 × 3 block of basis function b in three rows.
#[inline(always)]
pub fn store_block<L: Register>(
    matrix: &mut Matrix<L>,
    rows: [usize; 3],
    b: usize,
    block: [[L; 3]; 3],
) {
    for (row, entries) in rows.iter().zip(&block) {
        matrix.set(row + 3 * b, entries);
    }
}

/// Stores the upper triangle of the 3 × 3 block of basis function a on the diagonal.
#[inline(always)]
pub fn store_diagonal<L: Register>(
    matrix: &mut Matrix<L>,
    rows: [usize; 3],
    a: usize,
    block: [[L; 3]; 3],
) {
    for (i, entries) in block.iter().enumerate() {
        matrix.set(rows[i] + 3 * a + i, &entries[i..]);
    }
}

/// Stores the entry of nodes a ≤ b in the upper triangle by rows of a symmetric matrix with `size` rows.
#[inline(always)]
pub fn store_entry<L: Register>(matrix: &mut Matrix<L>, size: usize, a: usize, b: usize, entry: L) {
    matrix.set(diagonal(size, a) + b - a, &[entry]);
}

#[cfg(test)]
mod tests {
    use std::array::from_fn;

    use super::*;
    use crate::matrices::Batch;

    #[test]
    fn blocks_land_in_the_upper_triangle() {
        let mut memory = Batch::storage(1, 21);
        let mut matrix = Matrix::<f64>::new(&mut memory, 0);
        let block = |start: f64| from_fn(|i| from_fn(|j| start + (3 * i + j) as f64));
        let rows = [upper_rows(6, 0), upper_rows(6, 1)];
        store_diagonal(&mut matrix, rows[0], 0, block(0.0));
        store_block(&mut matrix, rows[0], 1, block(10.0));
        store_diagonal(&mut matrix, rows[1], 1, block(20.0));
        let rows = [
            &[0.0, 1.0, 2.0, 10.0, 11.0, 12.0][..],
            &[4.0, 5.0, 13.0, 14.0, 15.0],
            &[8.0, 16.0, 17.0, 18.0],
            &[20.0, 21.0, 22.0],
            &[24.0, 25.0],
            &[28.0],
        ];
        let found: Vec<f64> = (0..21).map(|entry| matrix.get(entry)).collect();
        assert_eq!(found, rows.concat());
        let mut memory = Batch::storage(1, 36);
        let mut full = Matrix::<f64>::new(&mut memory, 0);
        store_block(&mut full, full_rows(6, 1), 0, block(1.0));
        assert_eq!([18, 19, 20].map(|entry| full.get(entry)), [1.0, 2.0, 3.0]);
        assert_eq!([30, 31, 32].map(|entry| full.get(entry)), [7.0, 8.0, 9.0]);
    }
}

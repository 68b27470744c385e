use std::ops::{Index, IndexMut, Range};

use serde::{Deserialize, Serialize};
use whirl_specs::columns;

/// A dense matrix, column after column.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Matrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub cols: usize,
    /// Entries: (i, j) at `i + j·rows`; `rows·cols` values.
    pub data: Vec<f64>,
}

/// Neighbouring columns of a dense matrix.
#[derive(Debug, Clone, Copy)]
pub struct Columns<'a> {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub cols: usize,
    /// Entries: (i, j) at `i + j·rows`.
    pub data: &'a [f64],
}

impl Matrix {
    /// All zeros.
    pub fn zeros(rows: usize, cols: usize) -> Self {
        Matrix { rows, cols, data: vec![0.0; rows * cols] }
    }

    /// The identity of size n.
    pub(crate) fn identity(n: usize) -> Self {
        Matrix::from_diagonal(&vec![1.0; n])
    }

    /// A square matrix with these values on its diagonal.
    pub fn from_diagonal(values: &[f64]) -> Self {
        Matrix::from_fn(values.len(), values.len(), |i, j| if i == j { values[i] } else { 0.0 })
    }

    /// Entry (i, j) from `entry(i, j)`.
    pub fn from_fn(rows: usize, cols: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Self {
        let mut data = Vec::with_capacity(rows * cols);
        for j in 0..cols {
            data.extend((0..rows).map(|i| entry(i, j)));
        }
        Matrix { rows, cols, data }
    }

    /// Column j.
    pub fn col(&self, j: usize) -> &[f64] {
        &self.data[j * self.rows..(j + 1) * self.rows]
    }

    /// Row `i`, column after column.
    pub(crate) fn row(&self, i: usize) -> Vec<f64> {
        (0..self.cols).map(|j| self[(i, j)]).collect()
    }

    /// Column j.
    pub(crate) fn col_mut(&mut self, j: usize) -> &mut [f64] {
        &mut self.data[j * self.rows..(j + 1) * self.rows]
    }

    /// Columns of `range`, without a copy.
    pub(crate) fn columns(&self, range: Range<usize>) -> Columns<'_> {
        Columns {
            rows: self.rows,
            cols: range.len(),
            data: &self.data[range.start * self.rows..range.end * self.rows],
        }
    }

    /// All columns, without a copy.
    pub(crate) fn view(&self) -> Columns<'_> {
        self.columns(0..self.cols)
    }

    /// The transpose.
    pub(crate) fn transpose(&self) -> Matrix {
        Matrix::from_fn(self.cols, self.rows, |i, j| self[(j, i)])
    }

    /// The rows and columns listed, in that order.
    pub(crate) fn select(&self, rows: &[usize], cols: &[usize]) -> Matrix {
        Matrix::from_fn(rows.len(), cols.len(), |i, j| self[(rows[i], cols[j])])
    }

    /// y = A x.
    pub fn apply(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.rows];
        columns::add_matrix(&mut y, &self.data, x);
        y
    }

    /// y = Aᵀ x.
    pub(crate) fn apply_transpose(&self, x: &[f64]) -> Vec<f64> {
        (0..self.cols).map(|j| dot(self.col(j), x)).collect()
    }

    /// Largest |entry|; 0 for an empty matrix.
    pub fn norm_max(&self) -> f64 {
        self.data.iter().fold(0.0, |norm, value| norm.max(value.abs()))
    }

    /// The mean of a square matrix and its transpose.
    pub(crate) fn symmetric_part(&self) -> Matrix {
        Matrix::from_fn(self.rows, self.cols, |i, j| 0.5 * (self[(i, j)] + self[(j, i)]))
    }

    /// Half the difference of a square matrix and its transpose.
    pub(crate) fn skew_part(&self) -> Matrix {
        Matrix::from_fn(self.rows, self.cols, |i, j| 0.5 * (self[(i, j)] - self[(j, i)]))
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;

    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        debug_assert!(i < self.rows && j < self.cols);
        &self.data[i + j * self.rows]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        debug_assert!(i < self.rows && j < self.cols);
        &mut self.data[i + j * self.rows]
    }
}

/// Copies the block of a square matrix of `size` rows from row and column `first` on, column after column.
pub(crate) fn copy_block_from(first: usize, whole: &[f64], size: usize, block: &mut [f64]) {
    let columns = whole.chunks_exact(size).skip(first);
    for (own, whole) in block.chunks_exact_mut(size - first).zip(columns) {
        own.copy_from_slice(&whole[first..]);
    }
}

/// a·b of vectors of one length, in partial sums.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    whirl_specs::vector::dot(a, b)
}

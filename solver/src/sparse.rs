//! Sparse matrices as assembly gives them, and their products with blocks of dense columns.

use std::borrow::Cow;

use whirl_specs::Registers;
use whirl_specs::registers::{Register, Task};

use crate::linalg::{LowerTriangle, add_scaled};
use crate::together::both;

/// Σ cᵢ uᵢ over dofs i, as (i, cᵢ).
pub type Row = Vec<(usize, f64)>;

/// A sparse matrix of any shape, column after column (compressed).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SparseColumns {
    /// Number of rows.
    pub height: usize,
    /// Where each column begins in `rows` and `values`; columns + 1 values.
    pub(crate) starts: Vec<usize>,
    /// Row of each value, ascending in a column.
    pub rows: Vec<usize>,
    /// The values.
    pub values: Vec<f64>,
}

impl SparseColumns {
    /// From (row, column, value) in any order; values at one place are summed, in the order given.
    pub(crate) fn from_triplets(
        height: usize,
        width: usize,
        mut triplets: Vec<(usize, usize, f64)>,
    ) -> SparseColumns {
        triplets.sort_by_key(|&(i, j, _)| (j, i));
        let mut matrix = SparseColumns {
            height,
            starts: vec![0; width + 1],
            rows: Vec::with_capacity(triplets.len()),
            values: Vec::with_capacity(triplets.len()),
        };
        let mut last = None;
        for (i, j, value) in triplets {
            if last == Some((i, j)) {
                *matrix.values.last_mut().expect("a value stands at the last place") += value;
                continue;
            }
            last = Some((i, j));
            matrix.rows.push(i);
            matrix.values.push(value);
            matrix.starts[j + 1] += 1;
        }
        for j in 0..width {
            matrix.starts[j + 1] += matrix.starts[j];
        }
        matrix
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The entries (row, value) of column j.
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[j]..self.starts[j + 1];
        self.rows[range.clone()].iter().copied().zip(self.values[range].iter().copied())
    }

    /// The transpose.
    pub fn transpose(&self) -> SparseColumns {
        let triplets = (0..self.width())
            .flat_map(|j| self.column(j).map(move |(i, value)| (j, i, value)))
            .collect();
        SparseColumns::from_triplets(self.width(), self.height, triplets)
    }

    /// The lower triangle of a symmetric matrix; entries above the diagonal are dropped.
    pub(crate) fn into_lower(self) -> LowerTriangle {
        LowerTriangle::from_columns(self.height, |j| self.column(j))
    }

    /// y = A x for each column of `x` (as long as the matrix is wide).
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        let (height, width) = (self.height, self.width());
        if width == 0 || height == 0 {
            y.fill(0.0);
            return;
        }
        for (x, y) in x.chunks_exact(width).zip(y.chunks_exact_mut(height)) {
            y.fill(0.0);
            for (j, &xj) in x.iter().enumerate() {
                for (i, value) in self.column(j) {
                    y[i] += value * xj;
                }
            }
        }
    }
}

/// A square matrix of a mesh; degree of freedom 3a + i is component i of node a.
#[derive(Debug, Clone, PartialEq)]
pub enum SparseMatrix {
    /// Symmetric.
    Symmetric(LowerTriangle),
    /// A symmetric scalar matrix s over the nodes times a 3 × 3 pattern:
    /// entry (3a+i, 3b+j) = `s[a,b] · pattern[i][j]`.
    Kronecker {
        /// s, nodes × nodes.
        scalar: LowerTriangle,
        /// Symmetric (M, Y) or skew (H).
        pattern: [[f64; 3]; 3],
    },
    /// Without a known structure.
    General(SparseColumns),
}

/// Columns that one pass over a matrix serves: wide enough for vector registers, narrow enough for the
/// rows that a pass touches to stay in cache.
const COLUMNS: usize = 8;
/// Numbers in a block of columns from which a product is worth a thread.
const WORTH: usize = 1 << 15;
/// Rows that are interleaved together, so few that they stay in the first cache.
const ROWS: usize = 64;

impl SparseMatrix {
    /// Number of rows and columns.
    pub fn size(&self) -> usize {
        match self {
            SparseMatrix::Symmetric(lower) => lower.size,
            SparseMatrix::Kronecker { scalar, .. } => 3 * scalar.size,
            SparseMatrix::General(columns) => columns.height,
        }
    }

    /// The lower triangle; `None` if the matrix is not symmetric by its structure.
    pub fn lower(&self) -> Option<Cow<'_, LowerTriangle>> {
        match self {
            SparseMatrix::Symmetric(lower) => Some(Cow::Borrowed(lower)),
            SparseMatrix::Kronecker { scalar, pattern } if is_symmetric(pattern) => {
                let expanded = LowerTriangle::from_columns(3 * scalar.size, |dof| {
                    let (b, j) = (dof / 3, dof % 3);
                    scalar.column(b).flat_map(move |(a, s)| {
                        (0..3)
                            .filter(move |&i| pattern[i][j] != 0.0)
                            .map(move |i| (3 * a + i, s * pattern[i][j]))
                    })
                });
                Some(Cow::Owned(expanded))
            }
            _ => None,
        }
    }

    /// All entries, both triangles.
    pub fn to_columns(&self) -> SparseColumns {
        let mut triplets = Vec::new();
        match self {
            SparseMatrix::Symmetric(lower) => both_triangles(lower, |i, j, value| {
                triplets.push((i, j, value));
            }),
            SparseMatrix::Kronecker { scalar, pattern } => both_triangles(scalar, |a, b, s| {
                for (i, row) in pattern.iter().enumerate() {
                    for (j, p) in row.iter().enumerate().filter(|&(_, &p)| p != 0.0) {
                        triplets.push((3 * a + i, 3 * b + j, s * p));
                    }
                }
            }),
            SparseMatrix::General(columns) => return columns.clone(),
        }
        SparseColumns::from_triplets(self.size(), self.size(), triplets)
    }

    /// A with these (dof, value) added to its diagonal.
    pub(crate) fn plus_diagonal(&self, diagonal: &[(usize, f64)]) -> SparseMatrix {
        let size = self.size();
        let triplets = diagonal.iter().map(|&(dof, value)| (dof, dof, value)).collect();
        let diagonal = SparseColumns::from_triplets(size, size, triplets);
        match self.lower() {
            Some(lower) => SparseMatrix::Symmetric(lower.plus(1.0, &diagonal.into_lower())),
            None => {
                let columns = self.to_columns();
                let entries = |a: &SparseColumns| -> Vec<(usize, usize, f64)> {
                    (0..size).flat_map(|j| a.column(j).map(move |(i, v)| (i, j, v))).collect()
                };
                let triplets = [entries(&columns), entries(&diagonal)].concat();
                SparseMatrix::General(SparseColumns::from_triplets(size, size, triplets))
            }
        }
    }

    /// y = A x for each column of `x`; both hold columns as long as the matrix.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        self.multiply_within(x, y, &mut BlockMemory::<COLUMNS>::default());
    }

    /// [`SparseMatrix::multiply`] of both halves of a few columns at the same time.
    pub(crate) fn multiply_beside(&self, x: &[f64], y: &mut [f64], memory: &mut HalfMemory) {
        if x.len() < WORTH {
            return self.multiply_within(x, y, &mut memory[0]);
        }
        let half = x.len() / self.size().max(1) / 2 * self.size();
        let ((x, other_x), (y, other_y)) = (x.split_at(half), y.split_at_mut(half));
        let [own, other] = memory;
        both(|| self.multiply_within(x, y, own), || self.multiply_within(other_x, other_y, other));
    }

    /// [`SparseMatrix::multiply`] in memory that is kept from one product to the next.
    fn multiply_within<const C: usize>(
        &self,
        x: &[f64],
        y: &mut [f64],
        memory: &mut BlockMemory<C>,
    ) {
        match self {
            SparseMatrix::General(columns) => columns.multiply(x, y),
            _ => memory.by_blocks(self, x, y),
        }
    }

    /// Adds A x, row by row of a few columns.
    #[inline(always)]
    fn add_rows<const C: usize>(&self, x: &[[f64; C]], y: &mut [[f64; C]]) {
        match self {
            SparseMatrix::Symmetric(lower) => lower.add_product(x, y),
            SparseMatrix::Kronecker { scalar, pattern } => {
                multiply_kronecker(scalar, pattern, x, y);
            }
            SparseMatrix::General(_) => unreachable!("its columns are multiplied one by one"),
        }
    }

    /// xᵀ A y.
    pub fn bilinear(&self, x: &[f64], y: &[f64]) -> f64 {
        let mut product = vec![0.0; y.len()];
        self.multiply(y, &mut product);
        x.iter().zip(&product).map(|(x, p)| x * p).sum()
    }
}

fn is_symmetric(pattern: &[[f64; 3]; 3]) -> bool {
    (0..3).all(|i| (0..i).all(|j| pattern[i][j] == pattern[j][i]))
}

fn both_triangles(lower: &LowerTriangle, mut entry: impl FnMut(usize, usize, f64)) {
    for j in 0..lower.size {
        for (i, value) in lower.column(j) {
            entry(i, j, value);
            if i != j {
                entry(j, i, value);
            }
        }
    }
}

/// A block of columns and its product, interleaved row by row.
#[derive(Debug)]
pub(crate) struct BlockMemory<const C: usize> {
    from: Vec<[f64; C]>,
    to: Vec<[f64; C]>,
}

/// Memory of the halves of a block.
pub(crate) type HalfMemory = [BlockMemory<{ COLUMNS / 2 }>; 2];

impl<const C: usize> Default for BlockMemory<C> {
    fn default() -> Self {
        BlockMemory { from: Vec::new(), to: Vec::new() }
    }
}

impl<const C: usize> BlockMemory<C> {
    /// y = A x by blocks of C columns, interleaved; a single remaining column on its own.
    fn by_blocks(&mut self, matrix: &SparseMatrix, x: &[f64], y: &mut [f64]) {
        let n = matrix.size();
        if n == 0 {
            return;
        }
        if x.len() > n {
            self.from.resize(n, [0.0; C]);
            self.to.resize(n, [0.0; C]);
        }
        let BlockMemory { from, to } = self;
        for (x, y) in x.chunks(C * n).zip(y.chunks_mut(C * n)) {
            // Unused lanes of a last block hold old values, which are not copied out.
            if x.len() > n {
                for (part, from) in from.chunks_mut(ROWS).enumerate() {
                    for (c, column) in x.chunks_exact(n).enumerate() {
                        let column = &column[part * ROWS..];
                        from.iter_mut().zip(column).for_each(|(row, &value)| row[c] = value);
                    }
                }
                to.fill([0.0; C]);
                Registers::current().run(AddRows { matrix, x: from, y: to });
                for (part, to) in to.chunks(ROWS).enumerate() {
                    for (c, column) in y.chunks_exact_mut(n).enumerate() {
                        let column = &mut column[part * ROWS..];
                        column.iter_mut().zip(to).for_each(|(value, row)| *value = row[c]);
                    }
                }
            } else {
                y.fill(0.0);
                matrix.add_rows::<1>(x.as_chunks().0, y.as_chunks_mut().0);
            }
        }
    }
}

/// [`SparseMatrix::add_rows`] on wide registers.
struct AddRows<'a, const C: usize> {
    matrix: &'a SparseMatrix,
    x: &'a [[f64; C]],
    y: &'a mut [[f64; C]],
}

impl<const C: usize> Task for AddRows<'_, C> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        self.matrix.add_rows(self.x, self.y);
    }
}

/// w = S x for the three components of every node, then y = pattern · w.
#[inline(always)]
fn multiply_kronecker<const C: usize>(
    scalar: &LowerTriangle,
    pattern: &[[f64; 3]; 3],
    x: &[[f64; C]],
    y: &mut [[f64; C]],
) {
    let x = x.as_chunks::<3>().0;
    let y = y.as_chunks_mut::<3>().0;
    for b in 0..scalar.size {
        let xb = x[b];
        let mut sum = [[0.0; C]; 3];
        for (a, s) in scalar.column(b) {
            for i in 0..3 {
                add_scaled(&mut sum[i], s, &x[a][i]);
                if a != b {
                    add_scaled(&mut y[a][i], s, &xb[i]);
                }
            }
        }
        for i in 0..3 {
            add_scaled(&mut y[b][i], 1.0, &sum[i]);
        }
    }
    for node in y {
        let w = *node;
        for (row, pattern) in node.iter_mut().zip(pattern) {
            *row = [0.0; C];
            for (&p, w) in pattern.iter().zip(&w) {
                if p != 0.0 {
                    add_scaled(row, p, w);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scalar() -> LowerTriangle {
        let columns = [vec![(0, 2.0), (2, 0.5)], vec![(1, 3.0), (2, -1.0)], vec![(2, 4.0)]];
        LowerTriangle::from_columns(3, |j| columns[j].clone().into_iter())
    }

    #[test]
    fn every_structure_gives_the_products_of_its_entries() {
        let skew = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
        let symmetric = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]];
        for pattern in [skew, symmetric] {
            let matrix = SparseMatrix::Kronecker { scalar: scalar(), pattern };
            let columns = matrix.to_columns();
            // Nineteen columns: two blocks and a rest.
            let x: Vec<f64> = (0..9 * 19).map(|k| ((k * k) % 17) as f64 - 8.0).collect();
            let (mut y, mut expected) = (vec![1.0; x.len()], vec![2.0; x.len()]);
            matrix.multiply(&x, &mut y);
            columns.multiply(&x, &mut expected);
            assert_eq!(y, expected);
            match matrix.lower() {
                Some(lower) => {
                    let lower = SparseMatrix::Symmetric(lower.into_owned());
                    assert_eq!(lower.to_columns(), columns);
                    lower.multiply(&x, &mut y);
                    assert_eq!(y, expected);
                }
                None => assert_eq!(pattern, skew),
            }
        }
    }

    #[test]
    fn triplets_at_one_place_are_summed() {
        let matrix =
            SparseColumns::from_triplets(2, 3, vec![(1, 2, 1.0), (0, 0, 5.0), (1, 2, 2.0)]);
        assert_eq!(matrix.starts, [0, 1, 1, 2]);
        assert_eq!(matrix.column(2).collect::<Vec<_>>(), [(1, 3.0)]);
    }
}

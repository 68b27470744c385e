//! Sparse symmetric matrices to which few rows add a part without zeros, as a retained mean does, and their factors.

use std::collections::BTreeMap;

use crate::error::ReductionError;
use crate::linalg::{
    LinearAlgebraError, LowerTriangle, Lu, Matrix, SparseCholesky, SparseLdlt, symmetric_eigen,
};
use crate::sparse::multiply_symmetric;

use super::rigid::Row;

/// A symmetric matrix A + Σ (t gᵀ + g tᵀ).
#[derive(Debug, Clone, PartialEq)]
pub struct UpdatedMatrix {
    /// A.
    pub sparse: LowerTriangle,
    /// The pairs (t, g) of rows.
    pub(super) pairs: Vec<(Row, Row)>,
}

impl From<LowerTriangle> for UpdatedMatrix {
    fn from(sparse: LowerTriangle) -> Self {
        UpdatedMatrix { sparse, pairs: Vec::new() }
    }
}

/// Σ row · x.
fn along(row: &Row, x: &[f64]) -> f64 {
    row.iter().map(|&(i, c)| c * x[i]).sum()
}

impl UpdatedMatrix {
    /// Number of rows and columns.
    pub fn size(&self) -> usize {
        self.sparse.size
    }

    /// The diagonal.
    pub(super) fn diagonal(&self) -> Vec<f64> {
        let mut diagonal = self.sparse.diagonal();
        for (t, g) in &self.pairs {
            let mut other = g.iter().peekable();
            for &(i, x) in t {
                while other.next_if(|(j, _)| *j < i).is_some() {}
                if let Some((_, y)) = other.next_if(|(j, _)| *j == i) {
                    diagonal[i] += 2.0 * x * y;
                }
            }
        }
        diagonal
    }

    /// This plus α times another one whose pairs have the same t.
    pub(super) fn plus(&self, alpha: f64, other: &UpdatedMatrix) -> UpdatedMatrix {
        assert_eq!(self.pairs.len(), other.pairs.len(), "matrices of one partition");
        let pairs = self.pairs.iter().zip(&other.pairs).map(|((t, own), (_, other))| {
            let mut sum = own.clone();
            sum.extend(other.iter().map(|&(i, value)| (i, alpha * value)));
            sum.sort_by_key(|(i, _)| *i);
            sum.dedup_by(|next, before| {
                let same = next.0 == before.0;
                before.1 += if same { next.1 } else { 0.0 };
                same
            });
            (t.clone(), sum)
        });
        UpdatedMatrix { sparse: self.sparse.plus(alpha, &other.sparse), pairs: pairs.collect() }
    }

    /// y = A x for each column of `x` (columns as long as the matrix).
    pub(super) fn multiply(&self, x: &[f64], y: &mut [f64]) {
        multiply_symmetric(&self.sparse, x, y);
        if self.pairs.is_empty() {
            return;
        }
        let n = self.size();
        for (x, y) in x.chunks_exact(n).zip(y.chunks_exact_mut(n)) {
            for (t, g) in &self.pairs {
                let (by_t, by_g) = (along(t, x), along(g, x));
                t.iter().for_each(|&(i, c)| y[i] += c * by_g);
                g.iter().for_each(|&(i, c)| y[i] += c * by_t);
            }
        }
    }

    /// With the pairs in the sparse matrix.
    pub(super) fn merged(&self) -> UpdatedMatrix {
        let n = self.size();
        let mut columns: Vec<BTreeMap<usize, f64>> =
            (0..n).map(|j| self.sparse.column(j).collect()).collect();
        for (t, g) in &self.pairs {
            for (left, right) in [(t, g), (g, t)] {
                for &(j, x) in left {
                    for &(i, y) in right.iter().filter(|(i, _)| *i >= j) {
                        *columns[j].entry(i).or_insert(0.0) += x * y;
                    }
                }
            }
        }
        LowerTriangle::from_columns(n, |j| columns[j].clone().into_iter()).into()
    }

    /// With all its zeros.
    pub(super) fn dense(&self) -> Matrix {
        let n = self.size();
        let mut full = Matrix::zeros(n, n);
        for j in 0..n {
            for (i, value) in self.sparse.column(j) {
                full[(i, j)] = value;
                full[(j, i)] = value;
            }
        }
        for (t, g) in &self.pairs {
            for &(i, x) in t {
                for &(j, y) in g {
                    full[(i, j)] += x * y;
                    full[(j, i)] += x * y;
                }
            }
        }
        full
    }

    /// U with A + U S Uᵀ, S = [0 1; 1 0] pair by pair, as rows: t and g of each pair, scaled to be alike in size.
    fn rows(&self) -> Vec<Row> {
        let size = |row: &Row| row.iter().map(|(_, c)| c * c).sum::<f64>().sqrt();
        let scaled = |row: &Row, by: f64| row.iter().map(|&(i, c)| (i, c * by)).collect::<Row>();
        let pairs = self.pairs.iter().flat_map(|(t, g)| {
            let ratio = (size(g) / size(t)).sqrt();
            let ratio = if ratio.is_finite() && ratio > 0.0 { ratio } else { 1.0 };
            [scaled(t, ratio), scaled(g, 1.0 / ratio)]
        });
        pairs.collect()
    }
}

/// U as columns, and A⁻¹U.
fn solved(rows: &[Row], n: usize, solve: impl Fn(&mut [f64])) -> Matrix {
    let mut columns = Matrix::zeros(n, rows.len());
    for (j, row) in rows.iter().enumerate() {
        row.iter().for_each(|&(i, c)| columns[(i, j)] = c);
    }
    solve(&mut columns.data);
    columns
}

/// S + UᵀA⁻¹U; S is its own inverse.
fn capacitance(rows: &[Row], inverse: &Matrix) -> Matrix {
    Matrix::from_fn(rows.len(), rows.len(), |i, j| {
        let pair = i / 2 == j / 2 && i != j;
        along(&rows[i], inverse.col(j)) + f64::from(u8::from(pair))
    })
}

/// The factor of A + Σ (t gᵀ + g tᵀ), positive definite both with the pairs and without.
///
/// (A + U S Uᵀ)⁻¹ = A⁻¹ − A⁻¹U (S⁻¹ + UᵀA⁻¹U)⁻¹ UᵀA⁻¹ (Sherman, Morrison, Woodbury).
pub struct UpdatedCholesky {
    sparse: SparseCholesky,
    /// A⁻¹U (S⁻¹ + UᵀA⁻¹U)⁻¹.
    inverse: Matrix,
    rows: Vec<Row>,
}

impl UpdatedCholesky {
    /// As [`SparseCholesky::new`].
    ///
    /// # Errors
    /// As there; a matrix that is singular with its pairs.
    pub(super) fn new(
        matrix: &UpdatedMatrix,
        order: &[usize],
        limit: usize,
    ) -> Result<Self, ReductionError> {
        let sparse = SparseCholesky::new(&matrix.sparse, order, limit)?;
        let rows = matrix.rows();
        let solve = |columns: &mut [f64]| sparse.solve_in_place(columns);
        let alone = solved(&rows, matrix.size(), solve);
        let mut inverse = alone.clone();
        if !rows.is_empty() {
            // X C = A⁻¹U, with C symmetric: C Xᵀ = (A⁻¹U)ᵀ, row by row of A⁻¹U.
            let mut factor = Lu::new(rows.len());
            factor.factor(&capacitance(&rows, &alone).symmetric_part().data)?;
            let mut row = vec![0.0; rows.len()];
            for i in 0..matrix.size() {
                (0..rows.len()).for_each(|j| row[j] = alone[(i, j)]);
                factor.solve_in_place(&mut row);
                (0..rows.len()).for_each(|j| inverse[(i, j)] = row[j]);
            }
        }
        Ok(UpdatedCholesky { sparse, inverse, rows })
    }

    /// Replaces each column b of `rhs` by the solution.
    pub(super) fn solve_in_place(&self, rhs: &mut [f64]) {
        self.sparse.solve_in_place(rhs);
        if self.rows.is_empty() {
            return;
        }
        for x in rhs.chunks_exact_mut(self.inverse.rows) {
            let parts: Vec<f64> = self.rows.iter().map(|row| along(row, x)).collect();
            for (column, part) in parts.iter().enumerate() {
                let column = self.inverse.col(column);
                x.iter_mut().zip(column).for_each(|(value, own)| *value -= part * own);
            }
        }
    }
}

/// Number of negative eigenvalues; none where the signs of pivots cannot be trusted.
///
/// Both Schur complements of [A U; Uᵀ −S⁻¹] have its inertia (Haynsworth): that of A with −S⁻¹ − UᵀA⁻¹U, and that of
/// −S⁻¹, with as many negative ones as there are pairs, with A + U S Uᵀ.
///
/// # Errors
/// As [`SparseLdlt::new`].
pub(super) fn negative(
    matrix: &UpdatedMatrix,
    order: &[usize],
    limit: usize,
) -> Result<Option<usize>, LinearAlgebraError> {
    /// An eigenvalue below this part of the largest has no sign that could be trusted.
    const ROUNDING: f64 = 1e-11;
    let Some(sparse) = SparseLdlt::new(&matrix.sparse, order, limit)? else { return Ok(None) };
    let rows = matrix.rows();
    if rows.is_empty() {
        return Ok(Some(sparse.inertia().negative));
    }
    let inverse = solved(&rows, matrix.size(), |columns| sparse.solve_in_place(columns));
    let complement = symmetric_eigen(&capacitance(&rows, &inverse).symmetric_part())?;
    let largest = complement.values.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    if complement.values.iter().any(|own| own.abs() <= ROUNDING * largest) {
        return Ok(None);
    }
    // Of −C the negative eigenvalues are the positive ones of C.
    let of_complement = complement.values.iter().filter(|own| **own > 0.0).count();
    let all = sparse.inertia().negative + of_complement;
    Ok(all.checked_sub(matrix.pairs.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::symmetric_eigen;

    /// A chain, and two pairs of rows that reach over all of it, with the sum positive definite.
    fn updated(n: usize) -> UpdatedMatrix {
        let sparse = LowerTriangle::from_columns(n, |j| {
            [(j, 2.5), (j + 1, -1.0)].into_iter().filter(move |&(i, _)| i < n)
        });
        let row = |seed: f64, scale: f64| -> Row {
            (0..n).map(|i| (i, scale * (seed * (i + 1) as f64).sin())).collect()
        };
        let near: Row = (3..9).map(|i| (i, 4.0 + i as f64)).collect();
        UpdatedMatrix {
            sparse,
            pairs: vec![(row(0.7, 1e-2), row(1.3, 2.0)), (near, row(2.1, 1e-3))],
        }
    }

    #[test]
    fn products_and_solutions_are_those_of_the_dense_matrix() {
        let n = 40;
        let matrix = updated(n);
        let dense = matrix.dense();
        let x: Vec<f64> = (0..2 * n).map(|i| (0.3 * i as f64).cos()).collect();
        let mut y = vec![0.0; 2 * n];
        matrix.multiply(&x, &mut y);
        for (x, y) in x.chunks_exact(n).zip(y.chunks_exact(n)) {
            let exact = dense.apply(x);
            assert!(exact.iter().zip(y).all(|(a, b)| (a - b).abs() < 1e-12), "{exact:?} {y:?}");
        }
        let merged = matrix.merged();
        assert!(merged.pairs.is_empty());
        for (a, b) in merged.dense().data.iter().zip(&dense.data) {
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
        let diagonal: Vec<f64> = (0..n).map(|i| dense[(i, i)]).collect();
        assert!(matrix.diagonal().iter().zip(&diagonal).all(|(a, b)| (a - b).abs() < 1e-14));
        let order: Vec<usize> = (0..n).map(|i| (7 * i) % n).collect();
        let factor = UpdatedCholesky::new(&matrix, &order, usize::MAX).expect("definite");
        factor.solve_in_place(&mut y);
        assert!(x.iter().zip(&y).all(|(a, b)| (a - b).abs() < 1e-10), "{x:?} {y:?}");
    }

    #[test]
    fn negative_eigenvalues_are_counted_with_the_pairs() {
        let n = 40;
        let (matrix, one) = (updated(n), |j| std::iter::once((j, 1.0)));
        let none = matrix.pairs.iter().map(|(t, _)| (t.clone(), Vec::new())).collect();
        let mass = UpdatedMatrix { sparse: LowerTriangle::from_columns(n, one), pairs: none };
        let exact = symmetric_eigen(&matrix.dense()).expect("eigenvalues").values;
        let order: Vec<usize> = (0..n).collect();
        let mut different = 0;
        for cut in [-1.0, 0.3, 1.0, 2.0, 3.3, 4.2, 9.0] {
            let counted = negative(&matrix.plus(-cut, &mass), &order, usize::MAX).expect("factors");
            let below = exact.iter().filter(|value| **value < cut).count();
            assert_eq!(counted, Some(below), "{cut}");
            let alone = matrix.sparse.plus(-cut, &mass.sparse);
            let alone =
                SparseLdlt::new(&alone, &order, usize::MAX).expect("factors").expect("pivots");
            different += usize::from(alone.inertia().negative != below);
        }
        assert!(different > 0, "the pairs matter at some cut");
    }
}

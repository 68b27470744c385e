//! Factors of a symmetric matrix A on the motions that constraints C u = 0 allow: with Lagrange multipliers λ,
//! A u + Cᵀ(−λ) = b and C u = d.
//!
//! The multipliers come last, and with them a few unknowns, the pins, without which A is regular: with E the columns of A and
//! of Cᵀ that couple both with the rest, the rest is solved by its own sparse factor, and what is left by the Schur
//! complement D − EᵀA⁻¹E, as small as there are constraints and pins.

use std::borrow::Cow;

use crate::error::ReductionError;
use crate::linalg::{
    LinearAlgebraError, LowerTriangle, Lu, Matrix, MemoryLimit, Pattern, SparseCholesky,
    SparseLdlt, add_columns, symmetric_eigen, transpose_multiply,
};

use crate::sparse::Row;

/// Constraints on the unknowns of a matrix, and the order in which these are eliminated.
#[derive(Debug, Clone, Copy)]
pub struct Constraints<'a> {
    /// Rows of C: Σ cᵢ uᵢ over unknowns i; linearly independent.
    pub rows: &'a [Row],
    /// Unknowns without which A is regular, ascending.
    pub pins: &'a [usize],
}

impl Constraints<'_> {
    /// None.
    pub const NONE: Constraints<'static> = Constraints { rows: &[], pins: &[] };
}

/// A matrix without its pins, and what couples both.
struct Split<'a> {
    /// Places of the unknowns that are left, ascending.
    free: Vec<usize>,
    /// Their matrix.
    sparse: Cow<'a, LowerTriangle>,
    /// Order of their elimination.
    order: Cow<'a, [usize]>,
    /// E: one column a pin, then one a constraint.
    coupling: Vec<Row>,
    /// D.
    corner: Matrix,
}

impl<'a> Split<'a> {
    fn new(matrix: &'a LowerTriangle, order: &'a [usize], constraints: Constraints) -> Split<'a> {
        let Constraints { rows, pins } = constraints;
        let (n, k) = (matrix.size, pins.len());
        let mut corner = Matrix::zeros(k + rows.len(), k + rows.len());
        let mut coupling = vec![Row::new(); k + rows.len()];
        let mut pin = vec![None; n];
        pins.iter().enumerate().for_each(|(place, &unknown)| pin[unknown] = Some(place));
        let free: Vec<usize> = (0..n).filter(|&unknown| pin[unknown].is_none()).collect();
        let mut place = vec![usize::MAX; n];
        free.iter().enumerate().for_each(|(index, &unknown)| place[unknown] = index);
        for (c, row) in rows.iter().enumerate() {
            for &(unknown, value) in row {
                match pin[unknown] {
                    Some(p) => {
                        corner[(p, k + c)] = value;
                        corner[(k + c, p)] = value;
                    }
                    None => coupling[k + c].push((place[unknown], value)),
                }
            }
        }
        if pins.is_empty() {
            let (sparse, order) = (Cow::Borrowed(matrix), Cow::Borrowed(order));
            return Split { free, sparse, order, coupling, corner };
        }
        for j in 0..n {
            for (i, value) in matrix.column(j) {
                match (pin[i], pin[j]) {
                    (Some(p), Some(q)) => {
                        corner[(p, q)] = value;
                        corner[(q, p)] = value;
                    }
                    (Some(p), None) => coupling[p].push((place[j], value)),
                    (None, Some(q)) => coupling[q].push((place[i], value)),
                    (None, None) => {}
                }
            }
        }
        let sparse = matrix.block(&free, |i| pin[i].is_none().then_some(place[i]));
        let sparse = Cow::Owned(sparse);
        let order = order.iter().filter(|unknown| pin[**unknown].is_none());
        let order = order.map(|&unknown| place[unknown]).collect();
        Split { sparse, order, coupling, corner, free }
    }

    /// A⁻¹E.
    fn solved(&self, solve: impl Fn(&mut [f64])) -> Matrix {
        let mut columns = Matrix::zeros(self.free.len(), self.coupling.len());
        for (j, row) in self.coupling.iter().enumerate() {
            row.iter().for_each(|&(i, value)| columns[(i, j)] += value);
        }
        if !self.coupling.is_empty() {
            solve(&mut columns.data);
        }
        columns
    }

    /// D − EᵀA⁻¹E, with the multipliers divided by a stiffness so that its entries are alike in size; and this.
    fn complement(&self, pins: usize, solved: &Matrix) -> (Matrix, f64) {
        let size = self.coupling.len();
        let mut small = Matrix::from_fn(size, size, |i, j| {
            let product: f64 = self.coupling[i].iter().map(|&(k, e)| e * solved[(k, j)]).sum();
            self.corner[(i, j)] - product
        });
        let compliance = (pins..size).map(|i| small[(i, i)].abs()).fold(0.0, f64::max);
        let scale = if compliance > 0.0 { compliance.sqrt().recip() } else { 1.0 };
        for i in 0..size {
            for j in 0..size {
                let of = |place: usize| if place < pins { 1.0 / scale } else { scale };
                small[(i, j)] *= of(i) * of(j);
            }
        }
        (small.symmetric_part(), scale)
    }
}

/// The factor of what is left without the pins.
enum Sparse {
    Definite(Box<SparseCholesky>),
    Indefinite(SparseLdlt),
}

impl Sparse {
    fn solve_in_place(&self, rhs: &mut [f64]) {
        match self {
            Sparse::Definite(factor) => factor.solve_in_place(rhs),
            Sparse::Indefinite(factor) => factor.solve_in_place(rhs),
        }
    }
}

/// The factor of A on the motions that constraints allow.
pub struct ConstrainedCholesky {
    sparse: Sparse,
    free: Vec<usize>,
    pins: Vec<usize>,
    /// A⁻¹E.
    solved: Matrix,
    /// Inverse of the Schur complement, its scaling taken back.
    small: Matrix,
    size: usize,
}

impl ConstrainedCholesky {
    /// Factors a matrix that is positive definite without its pins, eliminating the unknowns in the order given.
    ///
    /// # Errors
    /// As [`SparseCholesky::new`]; constraints that follow from each other, or leave a motion that costs nothing.
    pub fn new(
        matrix: &LowerTriangle,
        order: &[usize],
        constraints: Constraints,
        limit: impl Into<MemoryLimit>,
    ) -> Result<Self, ReductionError> {
        let split = Split::new(matrix, order, constraints);
        let sparse = SparseCholesky::new(&split.sparse, &split.order, limit);
        let sparse = sparse.map_err(|error| match error {
            LinearAlgebraError::NotPositiveDefinite { row, .. } => {
                LinearAlgebraError::NotPositiveDefinite { row: split.free[row], size: matrix.size }
            }
            other => other,
        })?;
        let solved = split.solved(|columns| sparse.solve_in_place(columns));
        let factors = (Sparse::Definite(Box::new(sparse)), solved);
        ConstrainedCholesky::of(split, factors, constraints.pins, matrix.size)
    }

    /// The same of a matrix that may have negative eigenvalues, with the number of these on the motions that constraints
    /// allow; none where the signs of pivots cannot be trusted.
    ///
    /// # Errors
    /// As [`SparseLdlt::new`].
    pub(super) fn indefinite(
        matrix: &LowerTriangle,
        order: &[usize],
        constraints: Constraints,
        limit: impl Into<MemoryLimit>,
    ) -> Result<Option<(Self, usize)>, ReductionError> {
        let split = Split::new(matrix, order, constraints);
        let Some(sparse) = SparseLdlt::new(&split.sparse, &split.order, limit)? else {
            return Ok(None);
        };
        let solved = split.solved(|columns| sparse.solve_in_place(columns));
        let Some(negative) = split.negative(&sparse, &solved, constraints)? else {
            return Ok(None);
        };
        let factors = (Sparse::Indefinite(sparse), solved);
        let factor = ConstrainedCholesky::of(split, factors, constraints.pins, matrix.size)?;
        Ok(Some((factor, negative)))
    }

    fn of(
        split: Split,
        (sparse, solved): (Sparse, Matrix),
        pins: &[usize],
        size: usize,
    ) -> Result<Self, ReductionError> {
        let (complement, scale) = split.complement(pins.len(), &solved);
        let mut small = Matrix::identity(complement.rows);
        if small.rows > 0 {
            let mut factor = Lu::new(small.rows);
            factor.factor(&complement.data)?;
            factor.solve_in_place(&mut small.data);
            let of = |place: usize| if place < pins.len() { 1.0 / scale } else { scale };
            for i in 0..small.rows {
                for j in 0..small.rows {
                    small[(i, j)] *= of(i) * of(j);
                }
            }
        }
        let (free, pins) = (split.free, pins.to_vec());
        Ok(ConstrainedCholesky { sparse, free, pins, solved, small, size })
    }

    fn pattern(&self) -> Option<&Pattern> {
        match &self.sparse {
            Sparse::Definite(factor) => factor.pattern(),
            Sparse::Indefinite(_) => None,
        }
    }

    /// Forgets what only a factor of another matrix with the same entries would need.
    pub(super) fn settle(&mut self) {
        if let Sparse::Definite(factor) = &mut self.sparse {
            factor.settle();
        }
    }

    /// Replaces each column b of `rhs` by u with A u − Cᵀλ = b and C u = 0.
    pub fn solve_in_place(&self, rhs: &mut [f64]) {
        if self.small.rows == 0 {
            return self.sparse.solve_in_place(rhs);
        }
        let columns = rhs.len().checked_div(self.size).unwrap_or(0);
        self.solve_with(rhs, &Matrix::zeros(self.small.rows - self.pins.len(), columns));
    }

    /// Replaces each column b of `rhs` by u with A u − Cᵀλ = b and C u = d, for the columns d of `given`; the columns λ.
    pub fn solve_with(&self, rhs: &mut [f64], given: &Matrix) -> Matrix {
        let (n, k) = (self.free.len(), self.pins.len());
        if self.size == 0 {
            // Every dof is retained or held.
            return Matrix::zeros(self.small.rows - k, given.cols);
        }
        let columns = rhs.len().checked_div(self.size).unwrap_or(0);
        let mut inner = Matrix::zeros(n, columns);
        let mut last = Matrix::zeros(self.small.rows, columns);
        for (c, rhs) in rhs.chunks_exact(self.size).enumerate() {
            let own = inner.col_mut(c).iter_mut().zip(&self.free);
            own.for_each(|(value, &place)| *value = rhs[place]);
            self.pins.iter().enumerate().for_each(|(p, &place)| last[(p, c)] = rhs[place]);
            (k..last.rows).for_each(|i| last[(i, c)] = given[(i - k, c)]);
        }
        // EᵀA⁻¹b.
        let taken = transpose_multiply(self.solved.view(), inner.view());
        last.data.iter_mut().zip(&taken.data).for_each(|(value, taken)| *value -= taken);
        self.sparse.solve_in_place(&mut inner.data);
        let mut multipliers = Matrix::zeros(last.rows - k, columns);
        let all: Vec<Vec<f64>> = (0..columns).map(|c| self.small.apply(last.col(c))).collect();
        self.subtract_solved(&mut inner, &all);
        for ((c, rhs), y) in rhs.chunks_exact_mut(self.size).enumerate().zip(&all) {
            self.free.iter().zip(inner.col(c)).for_each(|(&place, value)| rhs[place] = *value);
            self.pins.iter().zip(y).for_each(|(&place, value)| rhs[place] = *value);
            (k..y.len()).for_each(|i| multipliers[(i - k, c)] = -y[i]);
        }
        multipliers
    }

    /// Subtracts A⁻¹E y from every column, by blocks of rows that a cache holds for all of them.
    fn subtract_solved(&self, inner: &mut Matrix, all: &[Vec<f64>]) {
        /// Numbers of a block.
        const BLOCK: usize = 1 << 15;
        let (n, k) = (self.solved.rows, self.solved.cols);
        let step = (BLOCK / k.max(1)).max(64);
        for first in (0..n).step_by(step) {
            let rows = first..n.min(first + step);
            for (c, y) in all.iter().enumerate() {
                let columns = y.iter().enumerate();
                let columns = columns.map(|(j, own)| (&self.solved.col(j)[rows.clone()], -own));
                add_columns(&mut inner.col_mut(c)[rows.clone()], columns);
            }
        }
    }
}

impl Split<'_> {
    /// Number of negative eigenvalues on the motions that constraints allow, by the factor of what is left without the pins;
    /// none where a sign cannot be trusted.
    ///
    /// With the multipliers a matrix has as many negative ones more as there are constraints; and it has those of A without
    /// pins and those of the Schur complement (Haynsworth).
    fn negative(
        &self,
        sparse: &SparseLdlt,
        solved: &Matrix,
        constraints: Constraints,
    ) -> Result<Option<usize>, LinearAlgebraError> {
        /// An eigenvalue below this part of the largest has no sign that could be trusted.
        const ROUNDING: f64 = 1e-11;
        if self.coupling.is_empty() {
            return Ok(Some(sparse.inertia().negative));
        }
        let (complement, _) = self.complement(constraints.pins.len(), solved);
        let eigen = symmetric_eigen(&complement)?;
        let largest = eigen.values.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        if eigen.values.iter().any(|own| own.abs() <= ROUNDING * largest) {
            return Ok(None);
        }
        let all = sparse.inertia().negative + eigen.values.iter().filter(|own| **own < 0.0).count();
        Ok(all.checked_sub(constraints.rows.len()))
    }
}

/// Number of negative eigenvalues of a matrix on the motions that constraints allow; none where the signs of pivots cannot
/// be trusted. `alike`: the factor of a matrix with the same entries, order and constraints, if there is one.
///
/// # Errors
/// As [`SparseLdlt::new`].
pub(super) fn negative(
    matrix: &LowerTriangle,
    order: &[usize],
    constraints: Constraints,
    limit: usize,
    alike: Option<&ConstrainedCholesky>,
) -> Result<Option<usize>, LinearAlgebraError> {
    let split = Split::new(matrix, order, constraints);
    let factored = match alike.and_then(ConstrainedCholesky::pattern) {
        Some(pattern) => SparseLdlt::by_pattern(pattern, &split.sparse, limit)?,
        None => SparseLdlt::new(&split.sparse, &split.order, limit)?,
    };
    match factored {
        Some(sparse) => {
            let solved = split.solved(|columns| sparse.solve_in_place(columns));
            split.negative(&sparse, &solved, constraints)
        }
        None => Ok(None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::multiply;

    const N: usize = 40;

    /// A chain without ends, which its pin and its constraints hold.
    fn chain() -> LowerTriangle {
        LowerTriangle::from_columns(N, |j| {
            let end = f64::from(u8::from(j == 0 || j == N - 1));
            [(j, 2.0 - end), (j + 1, -1.0)].into_iter().filter(|&(i, _)| i < N)
        })
    }

    fn constraints() -> Vec<Row> {
        let row = |seed: f64| (0..N).map(|i| (i, 1.5 + (seed * (i + 1) as f64).sin())).collect();
        vec![row(0.7), vec![(3, 1.0), (20, -0.4)]]
    }

    /// An orthonormal basis of the motions that the constraints allow.
    fn allowed(rows: &[Row]) -> Matrix {
        let full = Matrix::from_fn(rows.len(), N, |i, j| {
            rows[i].iter().filter(|(k, _)| *k == j).map(|(_, c)| c).sum()
        });
        let gram = transpose_multiply(full.view(), full.view()).symmetric_part();
        let eigen = symmetric_eigen(&gram).expect("eigenvalues");
        let all: Vec<usize> = (0..N).collect();
        eigen.vectors.select(&all, &(0..N - rows.len()).collect::<Vec<_>>())
    }

    fn projected(basis: &Matrix, matrix: &LowerTriangle) -> Matrix {
        let mut product = Matrix::zeros(N, basis.cols);
        matrix.multiply(&basis.data, &mut product.data);
        transpose_multiply(basis.view(), product.view()).symmetric_part()
    }

    #[test]
    fn solutions_are_those_in_the_allowed_motions() {
        let (matrix, rows) = (chain(), constraints());
        let order: Vec<usize> = (0..N).map(|i| (7 * i) % N).collect();
        let own = Constraints { rows: &rows, pins: &[17] };
        let factor = ConstrainedCholesky::new(&matrix, &order, own, usize::MAX).expect("regular");
        let load: Vec<f64> = (0..2 * N).map(|i| (0.3 * i as f64).cos()).collect();
        let mut found = load.clone();
        factor.solve_in_place(&mut found);
        let basis = allowed(&rows);
        let mut small = Lu::new(basis.cols);
        small.factor(&projected(&basis, &matrix).data).expect("regular");
        for (load, found) in load.chunks_exact(N).zip(found.chunks_exact(N)) {
            let mut inner = basis.apply_transpose(load);
            small.solve_in_place(&mut inner);
            let exact = basis.apply(&inner);
            assert!(exact.iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-9), "{exact:?}");
        }
        // Given values, and the multipliers that bring them: A u − Cᵀλ = b.
        let given = Matrix { rows: 2, cols: 1, data: vec![2.0, -0.5] };
        let mut u = load[..N].to_vec();
        let lambda = factor.solve_with(&mut u, &given);
        let mut left = vec![0.0; N];
        matrix.multiply(&u, &mut left);
        for (row, value) in rows.iter().zip(&lambda.data) {
            row.iter().for_each(|&(i, c)| left[i] -= c * value);
        }
        assert!(left.iter().zip(&load).all(|(a, b)| (a - b).abs() < 1e-10), "{left:?}");
        for (row, want) in rows.iter().zip(&given.data) {
            let found: f64 = row.iter().map(|&(i, c)| c * u[i]).sum();
            assert!((found - want).abs() < 1e-12, "{found} for {want}");
        }
    }

    #[test]
    fn negative_eigenvalues_are_those_in_the_allowed_motions() {
        let (matrix, rows) = (chain(), constraints());
        let basis = allowed(&rows);
        let square = multiply(basis.view(), projected(&basis, &matrix).view());
        assert_eq!(square.rows, N);
        let exact = symmetric_eigen(&projected(&basis, &matrix)).expect("eigenvalues").values;
        let all: Vec<usize> = (0..N).collect();
        let one = LowerTriangle::from_columns(N, |j| std::iter::once((j, 1.0)));
        let mut different = 0;
        for cut in [-0.5, 0.004, 0.1, 0.5, 1.3, 2.2, 3.7] {
            let shifted = matrix.plus(-cut, &one);
            let below = exact.iter().filter(|value| **value < cut).count();
            for pins in [&[][..], &[17], &[2, 31]] {
                let own = Constraints { rows: &rows, pins };
                let counted = negative(&shifted, &all, own, usize::MAX, None).expect("factors");
                assert_eq!(counted, Some(below), "{cut}, {pins:?}");
            }
            let alone =
                negative(&shifted, &all, Constraints::NONE, usize::MAX, None).expect("factors");
            different += usize::from(alone != Some(below));
        }
        assert!(different > 0, "the constraints matter at some cut");
    }
}

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::{SupernodalLdltRef, SymbolicSupernodalCholesky};
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, Par, Side};

use super::block_solve::BlockSolve;
use super::values::Values;
use super::{LinearAlgebraError, LowerTriangle, MemoryLimit, view_mut};
use crate::together::{each_part, with_workers};

/// Where a factor has values, and in which order they are found.
#[derive(Debug)]
pub(crate) struct Pattern(Arc<SymbolicCholesky<usize>>);

/// Sparse Cholesky factorisation PAPᵀ = LLᵀ of a symmetric positive definite matrix.
#[derive(Debug)]
pub struct SparseCholesky {
    /// Until it is settled.
    pattern: Option<Pattern>,
    /// The row of each unknown of the factor, in the order in which they are eliminated.
    order: Vec<usize>,
    /// `None` of a matrix without rows.
    factor: Option<BlockSolve>,
}

/// How many eigenvalues of a symmetric matrix are negative and positive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inertia {
    /// Number of negative eigenvalues.
    pub(crate) negative: usize,
    /// Number of positive eigenvalues.
    pub(crate) positive: usize,
}

impl SparseCholesky {
    /// Factors `a`, eliminating the unknowns in the order given (`order[0]` first).
    ///
    /// # Errors
    /// [`LinearAlgebraError::TooLarge`] before anything large is allocated, if the factor with what stands
    /// beside it would need more than `limit`; [`LinearAlgebraError::NotPositiveDefinite`], also for a value that
    /// is not finite.
    pub fn new(
        a: &LowerTriangle,
        order: &[usize],
        limit: impl Into<MemoryLimit>,
    ) -> Result<Self, LinearAlgebraError> {
        let symbolic = symbolic(a, order, limit.into())?;
        let mut values = zeros(symbolic.len_val());
        let par = parallelism(&symbolic);
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(par, Default::default());
        let factorise = || {
            let made = symbolic.factorize_numeric_llt(
                &mut values,
                matrix(a),
                Side::Lower,
                Default::default(),
                par,
                MemStack::new(&mut MemBuffer::new(scratch)),
                Default::default(),
            );
            made.map(|_| ())
        };
        let outcome = with_workers(factorise);
        let row = |index: usize| match symbolic.perm() {
            Some(permutation) => permutation.arrays().0[index],
            None => index,
        };
        match outcome {
            Err(LltError::NonPositivePivot { index }) => {
                Err(LinearAlgebraError::NotPositiveDefinite { row: row(index), size: a.size })
            }
            Ok(()) => {
                let order = (0..a.size).map(row).collect();
                let not_finite =
                    || LinearAlgebraError::NotPositiveDefinite { row: row(0), size: a.size };
                let factor = supernodes(&symbolic)
                    .map(|own| BlockSolve::new(own, values).ok_or_else(not_finite))
                    .transpose()?;
                Ok(SparseCholesky { pattern: Some(Pattern(Arc::new(symbolic))), order, factor })
            }
        }
    }

    /// Its pattern, for factors of other matrices with the same entries; none once it is settled.
    pub(crate) fn pattern(&self) -> Option<&Pattern> {
        self.pattern.as_ref()
    }

    /// Forgets the pattern.
    pub(crate) fn settle(&mut self) {
        self.pattern = None;
    }

    /// Replaces each column b of `rhs` (columns as long as the matrix) by A⁻¹b, in two parts side by side where that pays.
    ///
    /// # Panics
    /// If they are not whole columns.
    pub fn solve_in_place(&self, rhs: &mut [f64]) {
        match &self.factor {
            Some(factor) => factor.solve(&self.order, rhs),
            None => assert!(rhs.is_empty(), "right sides of no rows"),
        }
    }
}

#[cfg(test)]
impl SparseCholesky {
    /// What solves by the factor.
    pub(super) fn blocks(&self) -> Option<&BlockSolve> {
        self.factor.as_ref()
    }
}

/// Sparse factorisation PAPᵀ = LDLᵀ of a symmetric matrix, without pivoting.
#[derive(Debug)]
pub struct SparseLdlt {
    symbolic: Arc<SymbolicCholesky<usize>>,
    values: Values,
    inertia: Inertia,
}

impl SparseLdlt {
    /// Factors `a` in the order given; `None` if a leading minor is singular to rounding, so that the signs of the pivots
    /// cannot be trusted.
    ///
    /// # Errors
    /// As [`SparseCholesky::new`], but for definiteness.
    pub fn new(
        a: &LowerTriangle,
        order: &[usize],
        limit: impl Into<MemoryLimit>,
    ) -> Result<Option<Self>, LinearAlgebraError> {
        SparseLdlt::by(Arc::new(symbolic(a, order, limit.into())?), a)
    }

    /// The same by the pattern of a factor of a matrix with the same entries, in the same order.
    ///
    /// # Errors
    /// As [`SparseLdlt::new`].
    pub(crate) fn by_pattern(
        pattern: &Pattern,
        a: &LowerTriangle,
        limit: impl Into<MemoryLimit>,
    ) -> Result<Option<Self>, LinearAlgebraError> {
        fits(&pattern.0, a, limit.into())?;
        SparseLdlt::by(pattern.0.clone(), a)
    }

    fn by(
        symbolic: Arc<SymbolicCholesky<usize>>,
        a: &LowerTriangle,
    ) -> Result<Option<Self>, LinearAlgebraError> {
        let mut values = zeros(symbolic.len_val());
        let par = parallelism(&symbolic);
        let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(par, Default::default());
        let factorise = || {
            let made = symbolic.factorize_numeric_ldlt(
                &mut values,
                matrix(a),
                Side::Lower,
                Default::default(),
                par,
                MemStack::new(&mut MemBuffer::new(scratch)),
                Default::default(),
            );
            made.map(|_| ())
        };
        if with_workers(factorise).is_err() {
            return Ok(None);
        }
        let inertia = inertia(&symbolic, &values);
        Ok(inertia.map(|inertia| SparseLdlt { symbolic, values, inertia }))
    }

    /// That of the matrix, by Sylvester's law.
    pub fn inertia(&self) -> Inertia {
        self.inertia
    }

    /// Replaces each column b of `rhs` (columns as long as the matrix) by A⁻¹b.
    pub fn solve_in_place(&self, rhs: &mut [f64]) {
        let n = self.symbolic.nrows();
        let cols = rhs.len().checked_div(n).unwrap_or(0);
        let scratch = self.symbolic.solve_in_place_scratch::<f64>(cols, Par::Seq);
        LdltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            view_mut(n, cols, rhs),
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
        );
    }
}

/// The signs of the pivots; `None` where one has none.
fn inertia(symbolic: &SymbolicCholesky<usize>, values: &[f64]) -> Option<Inertia> {
    let mut count = Inertia { negative: 0, positive: 0 };
    let Some(supernodes) = supernodes(symbolic) else { return Some(count) };
    let factor: SupernodalLdltRef<usize, f64> = SupernodalLdltRef::new(supernodes, values);
    for s in 0..supernodes.n_supernodes() {
        let block = factor.supernode(s).val();
        for j in 0..block.ncols() {
            let pivot: f64 = block[(j, j)];
            if !pivot.is_finite() || pivot == 0.0 {
                return None;
            }
            if pivot < 0.0 {
                count.negative += 1;
            } else {
                count.positive += 1;
            }
        }
    }
    Some(count)
}

/// `None` of a matrix without rows.
fn supernodes(symbolic: &SymbolicCholesky<usize>) -> Option<&SymbolicSupernodalCholesky<usize>> {
    match symbolic.raw() {
        SymbolicCholeskyRaw::Supernodal(supernodes) => Some(supernodes),
        SymbolicCholeskyRaw::Simplicial(_) if symbolic.nrows() == 0 => None,
        SymbolicCholeskyRaw::Simplicial(_) => {
            unreachable!("the symbolic factorisation is forced to be supernodal")
        }
    }
}

/// Values of a factor beyond which its dense blocks are large enough for threads to pay.
const MANY: usize = 1 << 23;
/// Parts that their dense blocks are then cut into.
const PARTS: usize = 2;

/// Values whose pages of memory are taken into use at a time.
const PAGES: usize = 1 << 18;

/// How dense blocks of a factor are shared out. Into how many parts is of the matrix, not of the processors that there are,
/// so that all machines compute the same.
fn parallelism(symbolic: &SymbolicCholesky<usize>) -> Par {
    if symbolic.len_val() < MANY { Par::Seq } else { Par::rayon(PARTS) }
}

/// Zeros for the values of a factor: of many, pages of memory are taken into use by all threads that have nothing else to do.
fn zeros(count: usize) -> Values {
    let mut values = Values::zeros(count);
    if count >= MANY {
        each_part(&mut values, PAGES, |part| part.fill(0.0));
    }
    values
}

fn symbolic(
    a: &LowerTriangle,
    order: &[usize],
    limit: MemoryLimit,
) -> Result<SymbolicCholesky<usize>, LinearAlgebraError> {
    let mut inverse = vec![0; a.size];
    for (place, &row) in order.iter().enumerate() {
        inverse[row] = place;
    }
    let parameters = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    let symbolic = factorize_symbolic_cholesky(
        matrix(a).symbolic(),
        Side::Lower,
        SymmetricOrdering::Custom(PermRef::new_checked(order, &inverse, a.size)),
        parameters,
    )
    .map_err(|_| too_large(a, usize::MAX, limit))?;
    fits(&symbolic, a, limit)?;
    Ok(symbolic)
}

/// Whether there is room for a factor.
fn fits(
    symbolic: &SymbolicCholesky<usize>,
    a: &LowerTriangle,
    limit: MemoryLimit,
) -> Result<(), LinearAlgebraError> {
    let values = symbolic.len_val().saturating_mul(size_of::<f64>());
    let par = parallelism(symbolic);
    let scratch = symbolic.factorize_numeric_ldlt_scratch::<f64>(par, Default::default());
    // The last factor is made beside all else.
    let bytes = limit.estimate(values).saturating_add(scratch.unaligned_bytes_required());
    if bytes > limit.most {
        return Err(too_large(a, bytes, limit));
    }
    Ok(())
}

fn too_large(a: &LowerTriangle, bytes: usize, limit: MemoryLimit) -> LinearAlgebraError {
    LinearAlgebraError::TooLarge { size: a.size, bytes, limit: limit.most }
}

fn matrix(a: &LowerTriangle) -> SparseColMatRef<'_, usize, f64> {
    let pattern = SymbolicSparseColMatRef::new_checked(a.size, a.size, &a.starts, None, &a.rows);
    SparseColMatRef::new(pattern, &a.values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn string(n: usize, diagonal: f64) -> LowerTriangle {
        LowerTriangle::from_columns(n, |j| {
            [(j, diagonal), (j + 1, -1.0)].into_iter().filter(move |&(i, _)| i < n)
        })
    }

    #[test]
    fn solves_in_any_order() {
        let n = 500;
        let a = string(n, 2.0);
        let x: Vec<f64> = (0..2 * n).map(|i| (i as f64).cos()).collect();
        let mut b = vec![0.0; 2 * n];
        a.multiply(&x, &mut b);
        let order: Vec<usize> = (0..n).map(|i| (i * 7) % n).collect();
        let factor = SparseCholesky::new(&a, &order, usize::MAX).unwrap();
        factor.solve_in_place(&mut b);
        // Condition 4n²/π² ≈ 1e5.
        assert!(b.iter().zip(&x).all(|(got, want)| (got - want).abs() < 1e-10));
    }

    #[test]
    fn inertia_counts_the_eigenvalues_on_either_side() {
        let n = 300;
        let order: Vec<usize> = (0..n).map(|i| (i * 11) % n).collect();
        for shift in [0.01, 0.5, 1.7, 3.9] {
            let angle = |k: usize| k as f64 * std::f64::consts::PI / (2 * n + 2) as f64;
            let below = (1..=n).filter(|&k| 4.0 * angle(k).sin().powi(2) < shift).count();
            let a = string(n, 2.0 - shift);
            let factor = SparseLdlt::new(&a, &order, usize::MAX).unwrap().unwrap();
            let x: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
            let mut b = vec![0.0; n];
            a.multiply(&x, &mut b);
            factor.solve_in_place(&mut b);
            assert!(b.iter().zip(&x).all(|(got, want)| (got - want).abs() < 1e-8));
            assert_eq!(factor.inertia(), Inertia { negative: below, positive: n - below });
        }
    }

    #[test]
    fn diagonals_and_nothing_at_all_are_factored() {
        for n in [0, 1, 5] {
            let a = LowerTriangle::from_columns(n, |j| std::iter::once((j, 2.0 + j as f64)));
            let order: Vec<usize> = (0..n).rev().collect();
            let factor = SparseCholesky::new(&a, &order, usize::MAX).unwrap();
            let mut x: Vec<f64> = (0..n).map(|j| 6.0 + 3.0 * j as f64).collect();
            factor.solve_in_place(&mut x);
            // Two roots, two reciprocals and two products.
            assert!(x.iter().all(|x| (x - 3.0).abs() < 8.0 * f64::EPSILON * 3.0), "{x:?}");
            let count = SparseLdlt::new(&a, &order, usize::MAX).unwrap().unwrap().inertia();
            assert_eq!(count, Inertia { negative: 0, positive: n });
        }
    }

    #[test]
    fn what_cannot_be_factored_is_an_error() {
        let order: Vec<usize> = (0..4).rev().collect();
        let mut a = string(4, 2.0);
        assert!(matches!(
            SparseCholesky::new(&a, &order, 8),
            Err(LinearAlgebraError::TooLarge { size: 4, limit: 8, .. })
        ));
        a.values[a.starts[1]] = -1.0;
        assert_eq!(
            SparseCholesky::new(&a, &order, usize::MAX).err(),
            Some(LinearAlgebraError::NotPositiveDefinite { row: 1, size: 4 })
        );
        a.values[a.starts[1]] = f64::NAN;
        assert!(SparseCholesky::new(&a, &order, usize::MAX).is_err());
    }
}

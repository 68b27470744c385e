//! The lowest modes of a body: all at once, by iteration, or slice after slice, and none of them missing.

use std::borrow::Cow;

use crate::linalg::{
    Cholesky, LinearAlgebraError, LowerTriangle, Matrix, MemoryLimit, Stage,
    generalised_symmetric_eigen, multiply, symmetric_eigen, transpose_multiply,
};

use crate::sparse::SparseMatrix;

use super::constrained::ConstrainedCholesky;
use super::lanczos::{Lanczos, dense_limit};
use super::pencil::{GUARD, Modes, Pencil, hertz};
use super::slices::Slices;
use super::{convention, lanczos, sturm};
use crate::error::ReductionError;

/// A multiple eigenvalue that reaches beyond the guard is searched for among this many times the modes.
const WIDEST: usize = 8;
/// Two ω² that differ by no more than this part are those of a pair.
const PAIR: f64 = 1e-3;
/// Dofs up to which all modes are found at once where the iteration finds no gap to count in.
const DENSE: usize = 2_000;
/// Dofs from which on modes are counted before anything is made of them.
const BESIDE: usize = 200_000;
/// Searches for modes that the Sturm count says are missing, before giving up.
const SEARCHES: usize = 4;

/// Whether the first `count` of ascending ω² end between the two of a pair: the next one is as large, and the one before is not.
fn ends_within_pair(eigenvalues: &[f64], count: usize) -> bool {
    let equal = |a: usize| match eigenvalues.get(a..a + 2) {
        Some(&[low, high]) => high - low <= PAIR * high,
        _ => false,
    };
    let Some(last) = count.checked_sub(1) else { return false };
    let before = (0..last).rev().take_while(|&place| equal(place)).count();
    equal(last) && before.is_multiple_of(2)
}

/// When the modes that were found are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Count {
    Now,
    /// Where there is a place to count at, by [`Pencil::agrees`].
    Later,
}

/// The ω² of modes that were found but not counted, ascending, those of the guard among them.
pub(super) type Uncounted = Vec<f64>;

impl Pencil<'_> {
    /// The `count` lowest modes of K x = ω² M x for a positive definite K, with K's factor.
    ///
    /// # Errors
    /// See [`ReductionError`]; none of the modes asked for is ever missing.
    pub fn lowest_modes(
        &self,
        count: usize,
    ) -> Result<(Modes, ConstrainedCholesky), ReductionError> {
        let (modes, factor, _) = self.shifted_modes(count, 0.0, (false, Count::Now))?;
        Ok((modes, factor))
    }

    /// As [`Pencil::lowest_modes`], and one more where the last of them would lose the partner with which it is a pair, as the
    /// bending of a round body about two axes is. If it is `later` that they are counted, some may be missing until they agree.
    ///
    /// # Errors
    /// As [`Pencil::lowest_modes`].
    pub(super) fn lowest_pairs(
        &self,
        count: usize,
        later: bool,
    ) -> Result<(Modes, ConstrainedCholesky, Option<Uncounted>), ReductionError> {
        self.shifted_modes(count, 0.0, (true, if later { Count::Later } else { Count::Now }))
    }

    /// The same, counted, by a factor of K that is there.
    ///
    /// # Errors
    /// As [`Pencil::lowest_modes`].
    pub(super) fn lowest_pairs_by(
        &self,
        factor: ConstrainedCholesky,
        count: usize,
    ) -> Result<(Modes, ConstrainedCholesky), ReductionError> {
        let known = (self.stiffness, factor);
        let (modes, factor, _) = self.modes_by(known, count, 0.0, (true, Count::Now))?;
        Ok((modes, factor))
    }

    /// Whether as many of the lowest modes were found as there are, by the factor of K.
    ///
    /// # Errors
    /// Of the linear algebra.
    pub(super) fn agrees(
        &self,
        found: &Uncounted,
        count: usize,
        factor: &ConstrainedCholesky,
    ) -> Result<bool, ReductionError> {
        let counted = self.count(found, count, Some((self.stiffness, factor)))?;
        Ok(counted.is_some_and(|(below, _, counted)| below == counted))
    }

    /// The `count` lowest modes of a body that may move freely (K positive semidefinite), rigid motions
    /// first.
    ///
    /// # Errors
    /// As [`Pencil::lowest_modes`].
    pub(crate) fn free_modes(&self, count: usize) -> Result<Modes, ReductionError> {
        // K is singular to ε·λ_max; the shift stands well clear of that, and as far below the first
        // elastic modes of any mesh that resolves them.
        Ok(self.shifted_modes(count, 1e-10 * self.highest(), (false, Count::Now))?.0)
    }

    /// Modes by the factor of K + shift·M, and the partner of the last where it is asked for.
    fn shifted_modes(
        &self,
        count: usize,
        shift: f64,
        (in_pairs, counting): (bool, Count),
    ) -> Result<(Modes, ConstrainedCholesky, Option<Uncounted>), ReductionError> {
        let n = self.mass.size;
        let available = n - self.constraints.rows.len();
        if count > available {
            return Err(ReductionError::TooManyModes { asked: count, available });
        }
        let definite = if shift == 0.0 {
            Cow::Borrowed(self.stiffness)
        } else {
            Cow::Owned(self.stiffness.plus(shift, self.mass))
        };
        let limit = self.limit(count, counting);
        let factor = ConstrainedCholesky::new(&definite, self.order, self.constraints, limit)?;
        self.modes_by((&definite, factor), count, shift, (in_pairs, counting))
    }

    /// Modes by the factor of a matrix, which is K + shift·M.
    fn modes_by(
        &self,
        (definite, mut factor): (&LowerTriangle, ConstrainedCholesky),
        count: usize,
        shift: f64,
        (in_pairs, counting): (bool, Count),
    ) -> Result<(Modes, ConstrainedCholesky, Option<Uncounted>), ReductionError> {
        let n = self.mass.size;
        let (mut modes, counted) = if n <= dense_limit(count + GUARD) {
            (self.all_dense((definite, &factor), shift, count)?, true)
        } else {
            self.by_iteration((&factor, definite), shift, count, counting)?
        };
        let uncounted = (!counted).then(|| modes.eigenvalues.clone());
        if counted {
            factor.settle();
        }
        // With the guard modes: a multiple eigenvalue at the end has all its vectors when it is settled.
        convention::settle(&modes.eigenvalues, self.blur(), &mut modes.vectors, self.components)?;
        let kept =
            if in_pairs && ends_within_pair(&modes.eigenvalues, count) { count + 1 } else { count };
        modes.eigenvalues.truncate(kept);
        modes.vectors.cols = kept;
        modes.vectors.data.truncate(n * kept);
        Ok((modes, factor, uncounted))
    }

    /// What is in use while `count` modes are found and counted, and while the columns are solved for.
    fn limit(&self, count: usize, counting: Count) -> MemoryLimit {
        let n = self.mass.size;
        let entries = |a: &LowerTriangle| a.rows.len() * (size_of::<f64>() + size_of::<usize>());
        let (k, m) = (entries(self.stiffness), entries(self.mass));
        let column = n * size_of::<f64>();
        let wanted = count + GUARD;
        let iteration = if n <= dense_limit(wanted) {
            // Both matrices, the eigenvectors and what the decomposition keeps beside them.
            Stage { factors: 1, besides: 6 * n * column + 2 * k + 2 * m }
        } else {
            // K assembled, of the inner dofs, as it is factored and less a cut, and as much again for what is left
            // of the assembly and for the patterns; M of the inner dofs and in products.
            Stage { factors: 2, besides: lanczos::memory(n, wanted) + 6 * k + 2 * m }
        };
        // Right sides, answers and the solve's own, then the modes with the answers twice: as shapes, and as products; where
        // the count runs beside them its factor, K less a cut as a whole and as it is factored, and the matrices of rotation.
        let columns = 3 * self.columns + count + 2 * (count + self.columns);
        let answers = match counting {
            Count::Later => Stage { factors: 2, besides: columns * column + 6 * k + m },
            Count::Now => Stage { factors: 1, besides: columns * column + 2 * k + m },
        };
        MemoryLimit { most: self.memory, stages: [iteration, answers] }
    }

    /// Whether modes are counted beside what is made of them: of a small matrix, whose second factor is no matter.
    pub(super) fn counts_beside(&self) -> bool {
        self.mass.size < BESIDE
    }

    /// By decomposition of M x = θ (K + shift·M) x, which gives the lowest ω² with the most digits.
    fn all_dense(
        &self,
        (definite, factor): (&LowerTriangle, &ConstrainedCholesky),
        shift: f64,
        count: usize,
    ) -> Result<Modes, ReductionError> {
        let n = self.mass.size;
        if !self.constraints.rows.is_empty() {
            return self.all_constrained(factor, shift, count);
        }
        let wanted = (count + GUARD).min(n);
        let eigen = generalised_symmetric_eigen(&dense(self.mass), &dense(definite))?;
        let mut modes =
            Modes { eigenvalues: Vec::with_capacity(wanted), vectors: Matrix::zeros(n, wanted) };
        for i in 0..wanted {
            let theta = eigen.values[n - 1 - i];
            if theta <= noise(&eigen.values) {
                if i < count {
                    return Err(ReductionError::TooManyModes { asked: count, available: i });
                }
                modes.vectors.cols = i;
                modes.vectors.data.truncate(n * i);
                break;
            }
            modes.eigenvalues.push(1.0 / theta - shift);
            let column = eigen.vectors.col(n - 1 - i);
            for (value, x) in modes.vectors.col_mut(i).iter_mut().zip(column) {
                *value = x / theta.sqrt();
            }
        }
        Ok(modes)
    }

    /// By decomposition of LᵀGL with M = LLᵀ, L not always triangular, and G the inverse of K + shift·M on the allowed motions.
    fn all_constrained(
        &self,
        factor: &ConstrainedCholesky,
        shift: f64,
        count: usize,
    ) -> Result<Modes, ReductionError> {
        let n = self.mass.size;
        let mut wanted = (count + GUARD).min(n - self.constraints.rows.len());
        let mass = dense(self.mass);
        let lower = root(&mass)?;
        let mut moved = lower.clone();
        factor.solve_in_place(&mut moved.data);
        let eigen =
            symmetric_eigen(&transpose_multiply(lower.view(), moved.view()).symmetric_part())?;
        let all: Vec<usize> = (0..n).collect();
        let highest: Vec<usize> = (n - wanted..n).rev().collect();
        let noise = noise(&eigen.values);
        // x = G L y / θ, which is allowed, and xᵀMx = 1.
        let mut vectors = multiply(moved.view(), eigen.vectors.select(&all, &highest).view());
        let mut eigenvalues = Vec::with_capacity(wanted);
        for (i, &place) in highest.iter().enumerate() {
            let theta = eigen.values[place];
            if theta <= noise {
                if i < count {
                    return Err(ReductionError::TooManyModes { asked: count, available: i });
                }
                wanted = i;
                break;
            }
            eigenvalues.push(1.0 / theta - shift);
            vectors.col_mut(i).iter_mut().for_each(|value| *value /= theta);
        }
        vectors.cols = wanted;
        vectors.data.truncate(n * wanted);
        Ok(Modes { eigenvalues, vectors })
    }

    /// By block Lanczos, until the Sturm count agrees or is left for later; whether it was made.
    fn by_iteration(
        &self,
        (factor, definite): (&ConstrainedCholesky, &LowerTriangle),
        shift: f64,
        count: usize,
        counting: Count,
    ) -> Result<(Modes, bool), ReductionError> {
        let mut wanted = count + GUARD;
        let mass = SparseMatrix::Symmetric(self.mass.clone());
        let mut lanczos = Lanczos::new(factor, &mass, wanted)?;
        let mut searches = 0;
        loop {
            let found = lanczos.run()?;
            let eigenvalues: Vec<f64> =
                found.theta.iter().map(|theta| 1.0 / theta - shift).collect();
            if !found.is_whole() {
                // They lie closer together than the iteration can tell from here.
                drop(lanczos);
                let slices = Slices::new(self, count, eigenvalues, found.vectors).modes()?;
                let modes =
                    slices.map_or_else(|| self.all_dense((definite, factor), shift, count), Ok);
                return Ok((modes?, true));
            }
            let modes = Modes { eigenvalues, vectors: found.vectors };
            if counting == Count::Later
                && sturm::cuts(&modes.eigenvalues, self.blur(), count).next().is_some()
            {
                return Ok((modes, false));
            }
            let known = Some((definite, factor));
            let Some((below, cut, counted)) = self.count(&modes.eigenvalues, count, known)? else {
                // A multiple eigenvalue reaches beyond the guard: search further up.
                wanted *= 2;
                let widest = wanted > WIDEST * (count + GUARD);
                let hopeless = widest || self.hides(&modes.eigenvalues);
                if self.mass.size <= dense_limit(wanted) || hopeless && self.mass.size <= DENSE {
                    return Ok((self.all_dense((definite, factor), shift, count)?, true));
                }
                if self.hides(&modes.eigenvalues) {
                    return Err(self.hidden(&modes.eigenvalues));
                }
                if widest {
                    drop(lanczos);
                    let slices =
                        Slices::new(self, count, modes.eigenvalues, modes.vectors).modes()?;
                    let modes =
                        slices.map_or_else(|| self.all_dense((definite, factor), shift, count), Ok);
                    return Ok((modes?, true));
                }
                lanczos = Lanczos::new(factor, &mass, wanted)?;
                continue;
            };
            if counted == below {
                return Ok((modes, true));
            }
            if counted < below || searches == SEARCHES {
                return Err(ReductionError::Miscounted {
                    found: below,
                    counted,
                    hertz: hertz(cut),
                });
            }
            searches += 1;
            lanczos.search_again()?;
        }
    }

    /// Whether rounding leaves no gap to count in among these eigenvalues, nor among eight times as many: by
    /// Weyl's law these reach 8^⅔ times as far.
    fn hides(&self, eigenvalues: &[f64]) -> bool {
        let span =
            eigenvalues.last().zip(eigenvalues.first()).map_or(0.0, |(last, first)| last - first);
        sturm::least_gap(0.0, self.blur()) > 4.0 * span
    }
}

/// The θ = 1/ω² up to which ascending ones are rounding: those of motions without mass are none.
fn noise(theta: &[f64]) -> f64 {
    f64::EPSILON * theta.last().copied().unwrap_or(0.0)
}

/// L with M = LLᵀ, lower triangular where every motion has mass.
fn root(mass: &Matrix) -> Result<Matrix, LinearAlgebraError> {
    let n = mass.rows;
    let mut lower = Cholesky::new(n);
    if lower.factor(&mass.data).is_ok() {
        return Ok(Matrix::from_fn(n, n, |i, j| if i >= j { lower.lower(i, j) } else { 0.0 }));
    }
    let mut eigen = symmetric_eigen(mass)?;
    for (j, value) in eigen.values.iter().enumerate() {
        let length = value.max(0.0).sqrt();
        eigen.vectors.col_mut(j).iter_mut().for_each(|x| *x *= length);
    }
    Ok(eigen.vectors)
}

fn dense(a: &LowerTriangle) -> Matrix {
    let mut full = Matrix::zeros(a.size, a.size);
    for j in 0..a.size {
        for (i, value) in a.column(j) {
            full[(i, j)] = value;
            full[(j, i)] = value;
        }
    }
    full
}

#[cfg(test)]
mod tests {
    use super::super::constrained::Constraints;
    use super::*;

    #[test]
    fn a_pair_is_not_left_by_half() {
        // A single one, a pair, one that is nearly as large as the next, and four alike.
        let all = [1.0, 2.0, 2.0001, 3.0, 3.01, 5.0, 5.0, 5.0, 5.0, 6.0];
        let found: Vec<usize> = (0..=all.len()).filter(|&n| ends_within_pair(&all, n)).collect();
        assert_eq!(found, [2, 6, 8]);
    }

    #[test]
    fn a_missing_mode_is_counted() {
        // Second differences over unit masses: ω² = 4 sin²(kπ/(2n+2)).
        let n = 400;
        let stiffness = LowerTriangle::from_columns(n, |j| {
            [(j, 2.0), (j + 1, -1.0)].into_iter().filter(move |&(i, _)| i < n)
        });
        let mass = LowerTriangle::from_columns(n, |j| std::iter::once((j, 1.0)));
        let order: Vec<usize> = (0..n).collect();
        let pencil = Pencil {
            stiffness: &stiffness,
            mass: &mass,
            order: &order,
            constraints: Constraints::NONE,
            components: &order.iter().map(|dof| dof % 3).collect::<Vec<_>>(),
            memory: usize::MAX,
            columns: 0,
        };
        let exact = |k: usize| {
            let angle = k as f64 * std::f64::consts::PI / (2 * n + 2) as f64;
            4.0 * angle.sin().powi(2)
        };
        let mut eigenvalues: Vec<f64> = (1..=30).map(exact).collect();
        let (below, _, counted) = pencil.count(&eigenvalues, 20, None).unwrap().unwrap();
        assert_eq!((below, counted), (20, 20));
        eigenvalues.remove(7);
        let (below, _, counted) = pencil.count(&eigenvalues, 20, None).unwrap().unwrap();
        assert_eq!((below, counted), (20, 21));

        let (modes, _) = pencil.lowest_modes(20).unwrap();
        for (k, value) in modes.eigenvalues.iter().enumerate() {
            assert!((value / exact(k + 1) - 1.0).abs() < 1e-10);
        }
    }

    /// A chain one mass of which is tied to the ground by a spring that swamps all digits of the others.
    #[test]
    fn modes_hidden_by_rounding_are_reported_at_once() {
        let n = 2 * DENSE;
        let own = |j: usize| if j == 1234 { 1e18 } else { 2.0 };
        let stiffness = LowerTriangle::from_columns(n, |j| {
            [(j, own(j)), (j + 1, -1.0)].into_iter().filter(move |&(i, _)| i < n)
        });
        let mass = LowerTriangle::from_columns(n, |j| std::iter::once((j, 1.0)));
        let order: Vec<usize> = (0..n).collect();
        let pencil = Pencil {
            stiffness: &stiffness,
            mass: &mass,
            order: &order,
            constraints: Constraints::NONE,
            components: &order.iter().map(|dof| dof % 3).collect::<Vec<_>>(),
            memory: usize::MAX,
            columns: 0,
        };
        match pencil.lowest_modes(20) {
            Err(ReductionError::Hidden { node: 1234, component: 1, stiffest, modes }) => {
                assert!((stiffest / hertz(1e18) - 1.0).abs() < 1e-12);
                // The 24 lowest of 4000: ω = 2 sin(kπ/2(n+1)) of the longer side of the chain.
                assert!(modes > 0.0 && modes < hertz(4.0) / 50.0, "{modes}");
            }
            other => panic!("{:?}", other.map(|(modes, _)| modes.eigenvalues)),
        }
    }
}

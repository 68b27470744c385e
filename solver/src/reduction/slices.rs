//! Modes that lie too close together for one iteration: slice after slice, each by the factor of K − σM with σ just below the
//! modes that are looked for, seen from where they stand apart. The inertia of that factor counts all that lie below.
//!
//! Source: Grimes, Lewis, Simon, SIAM J. Matrix Anal. Appl. 15 (1994) 228–272, section 4.

use crate::error::ReductionError;
use crate::linalg::{
    LowerTriangle, Matrix, generalised_symmetric_eigen, multiply, transpose_multiply,
};
use crate::sparse::SparseMatrix;

use super::constrained::ConstrainedCholesky;
use super::lanczos::{Lanczos, dense_limit};
use super::pencil::{GUARD, Modes, Pencil, hertz};
use super::sturm;

/// Slices at most.
const SLICES: usize = 40;
/// Shifts at most that are tried for one.
const SHIFTS: usize = 40;
/// Modes at most for which a multiple eigenvalue is found whole.
const MOST: usize = 4_000;

/// What is known of the modes while slices are added.
pub(super) struct Slices<'p> {
    pencil: &'p Pencil<'p>,
    count: usize,
    /// ω² of the modes found, ascending, with their vectors.
    found: Modes,
    /// Estimates from above of those that follow, ascending.
    ahead: Vec<f64>,
}

impl<'p> Slices<'p> {
    /// From what an iteration found: the eigenvalues that it approached, and the vectors of the first of them.
    pub(super) fn new(
        pencil: &'p Pencil<'p>,
        count: usize,
        mut eigenvalues: Vec<f64>,
        vectors: Matrix,
    ) -> Self {
        let ahead = eigenvalues.split_off(vectors.cols);
        Slices { pencil, count, found: Modes { eigenvalues, vectors }, ahead }
    }

    /// The lowest modes with a few beyond those asked for, counted; none where a decomposition of the whole is as quick.
    ///
    /// # Errors
    /// Modes that rounding hides, or that are not found.
    pub(super) fn modes(mut self) -> Result<Option<Modes>, ReductionError> {
        let pencil = self.pencil;
        let mut wanted = self.count + GUARD;
        for _ in 0..SLICES {
            if pencil.mass.size <= dense_limit(wanted) {
                return Ok(None);
            }
            if self.found.eigenvalues.len() < wanted {
                self.slice(wanted)?;
                continue;
            }
            let modes = self.together()?;
            let counted = match pencil.count(&modes.eigenvalues, self.count, None)? {
                Some((below, _, counted)) if counted == below => return Ok(Some(modes)),
                Some((found, cut, counted)) if counted < found => {
                    return Err(ReductionError::Miscounted { found, counted, hertz: hertz(cut) });
                }
                Some((.., counted)) => Some(counted),
                // No gap to count in: all that cannot be told from the last one is wanted.
                None => {
                    let last = modes.eigenvalues.last().copied().unwrap_or(0.0);
                    let cut = last + 2.0 * sturm::least_gap(last, pencil.blur());
                    sturm::count_below(pencil, cut, None)?
                }
            };
            wanted = match counted {
                Some(counted) if counted <= MOST => usize::max(counted + GUARD, 3 * wanted / 2),
                _ => return Err(pencil.hidden(&modes.eigenvalues)),
            };
        }
        Err(ReductionError::NotConverged {
            converged: self.found.eigenvalues.len(),
            asked: wanted,
            slices: SLICES,
        })
    }

    /// Adds those of the next modes that converge.
    fn slice(&mut self, wanted: usize) -> Result<(), ReductionError> {
        let (shift, factor) = self.shift(wanted)?;
        let missing = wanted - self.found.eigenvalues.len();
        let mass = SparseMatrix::Symmetric(self.pencil.mass.clone());
        let found = Lanczos::new(&factor, &mass, missing)?.run()?;
        // Of the modes below σ, θ is negative.
        let above = found.theta.iter().take_while(|theta| **theta > 0.0);
        let eigenvalues: Vec<f64> = above.map(|theta| shift + 1.0 / theta).collect();
        let converged = found.vectors.cols.min(eigenvalues.len());
        let rows = found.vectors.rows;
        self.found.eigenvalues.extend(&eigenvalues[..converged]);
        self.found.vectors.rows = rows;
        self.found.vectors.cols += converged;
        self.found.vectors.data.extend(&found.vectors.data[..rows * converged]);
        self.ahead = eigenvalues[converged..].to_vec();
        Ok(())
    }

    /// A shift below which all modes are found, as near to the next ones as these lie apart, with its factor.
    fn shift(&mut self, wanted: usize) -> Result<(f64, ConstrainedCholesky), ReductionError> {
        let pencil = self.pencil;
        let gap = |at: f64| sturm::least_gap(at, pencil.blur());
        let reach = self.reach(wanted);
        // How far below the next modes it stands.
        let mut distance = reach;
        for _ in 0..SHIFTS {
            // Where there is no cut in between, the last one is looked for again.
            let (next, room) = loop {
                let low = self.found.eigenvalues.last().copied();
                let next = self.ahead.first().copied().or(low).unwrap_or(0.0);
                let room = low.map_or(f64::INFINITY, |low| next - low);
                if room > 2.0 * gap(next) {
                    break (next, room);
                }
                self.forget(1);
            };
            let shift = next - distance.min(0.5 * room);
            let shifted = pencil.stiffness.plus(-shift, pencil.mass);
            let (order, limit) = (pencil.order, pencil.memory);
            let factor =
                ConstrainedCholesky::indefinite(&shifted, order, pencil.constraints, limit)?;
            let Some((factor, below)) = factor else {
                distance *= 1.1;
                continue;
            };
            let known = self.found.eigenvalues.len();
            if below == known {
                return Ok((shift, factor));
            }
            // Estimates lie above what they estimate, and an iteration may pass over a mode.
            if below < known || distance >= 0.5 * room {
                self.forget(usize::max(known.saturating_sub(below), 1));
            }
            distance *= 2.0;
        }
        let converged = self.found.eigenvalues.len();
        Err(ReductionError::NotConverged { converged, asked: wanted, slices: SHIFTS })
    }

    /// How far the modes that are looked for lie apart.
    fn reach(&self, wanted: usize) -> f64 {
        let missing = wanted.saturating_sub(self.found.eigenvalues.len());
        let known = &self.found.eigenvalues;
        let first = self.ahead.first().or(known.last()).copied().unwrap_or(0.0);
        let last = self.ahead.iter().take(missing.max(1)).next_back().copied().unwrap_or(first);
        (last - first).max(8.0 * sturm::least_gap(last, self.pencil.blur()))
    }

    /// Looks for the last modes found again.
    fn forget(&mut self, count: usize) {
        let keep = self.found.eigenvalues.len().saturating_sub(count);
        let mut ahead = self.found.eigenvalues.split_off(keep);
        ahead.append(&mut self.ahead);
        self.ahead = ahead;
        self.found.vectors.cols = keep;
        self.found.vectors.data.truncate(keep * self.found.vectors.rows);
    }

    /// All that were found as the modes of the motions that their vectors span, orthonormal across slices.
    fn together(&self) -> Result<Modes, ReductionError> {
        let Modes { vectors, .. } = &self.found;
        let product = |a: &LowerTriangle| {
            let mut out = Matrix::zeros(vectors.rows, vectors.cols);
            a.multiply(&vectors.data, &mut out.data);
            transpose_multiply(vectors.view(), out.view()).symmetric_part()
        };
        let (stiffness, mass) = (product(self.pencil.stiffness), product(self.pencil.mass));
        let eigen = generalised_symmetric_eigen(&stiffness, &mass)?;
        let vectors = multiply(vectors.view(), eigen.vectors.view());
        Ok(Modes { eigenvalues: eigen.values, vectors })
    }
}

#[cfg(test)]
mod tests {
    use super::super::constrained::Constraints;
    use super::*;

    /// A symmetric tridiagonal matrix of unknowns `first..first + n` with the eigenvalues low + step·i: that of the
    /// Krawtchouk polynomials (Kac), whose off-diagonal entries are ½√(k(n − k)).
    fn evenly_spaced(
        first: usize,
        n: usize,
        low: f64,
        step: f64,
    ) -> Vec<(usize, Vec<(usize, f64)>)> {
        (0..n)
            .map(|j| {
                let mut column = vec![(first + j, low + step * 0.5 * (n - 1) as f64)];
                if j + 1 < n {
                    let beside = 0.5 * (((j + 1) * (n - j - 1)) as f64).sqrt();
                    column.push((first + j + 1, step * beside));
                }
                (first + j, column)
            })
            .collect()
    }

    /// Checks the lowest modes against eigenvalues that are known.
    fn check(blocks: &[(usize, f64, f64)], count: usize) {
        let mut columns = Vec::new();
        let mut exact = Vec::new();
        for &(n, low, step) in blocks {
            columns.extend(evenly_spaced(columns.len(), n, low, step));
            exact.extend((0..n).map(|i| low + step * i as f64));
        }
        exact.sort_by(f64::total_cmp);
        let n = columns.len();
        // Masses of 2 on the whole.
        let scaled = |j: usize| columns[j].1.iter().map(|&(i, value)| (i, 2.0 * value));
        let stiffness =
            LowerTriangle::from_columns(n, |j| scaled(j).collect::<Vec<_>>().into_iter());
        let mass = LowerTriangle::from_columns(n, |j| std::iter::once((j, 2.0)));
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
        let (modes, _) = pencil.lowest_modes(count).expect("modes");
        assert_eq!(modes.eigenvalues.len(), count);
        for (found, exact) in modes.eigenvalues.iter().zip(&exact) {
            assert!((found / exact - 1.0).abs() < 1e-10, "{found} for {exact}");
        }
        // K x = ω² M x to the residual of converged pairs, seen from the nearest shift, and xᵀMx = 1.
        let mut force = vec![0.0; n * count];
        stiffness.multiply(&modes.vectors.data, &mut force);
        let mut momentum = vec![0.0; n * count];
        mass.multiply(&modes.vectors.data, &mut momentum);
        for (j, value) in modes.eigenvalues.iter().enumerate() {
            let range = j * n..(j + 1) * n;
            let left = force[range.clone()].iter().zip(&momentum[range]);
            let left: f64 = left.map(|(f, m)| (f - value * m).powi(2)).sum::<f64>().sqrt();
            assert!(left < 1e-8 * value, "{j}: {left}");
        }
        let gram = transpose_multiply(
            modes.vectors.view(),
            Matrix { rows: n, cols: count, data: momentum }.view(),
        );
        for i in 0..count {
            for j in 0..count {
                let one = f64::from(u8::from(i == j));
                assert!((gram[(i, j)] - one).abs() < 1e-10, "{i} {j}: {}", gram[(i, j)]);
            }
        }
    }

    /// 600 modes within 0.1 %, with others far above.
    const CLUSTER: (usize, f64, f64) = (600, 1e6, 1e3 / 600.0);
    const ABOVE: (usize, f64, f64) = (2400, 2e6, 1e4);

    #[test]
    fn hundreds_of_modes_within_a_thousandth_are_told_apart() {
        for count in [0, 1, 10, 40] {
            check(&[CLUSTER, ABOVE], count);
        }
    }

    #[test]
    fn a_cluster_above_other_modes_is_reached() {
        check(&[(12, 1e5, 5e4), CLUSTER, ABOVE], 30);
    }
}

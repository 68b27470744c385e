//! All motions at once.

use faer::linalg::solvers::Solve;
use faer::{Mat, MatRef};
use num_complex::Complex64;

use super::equations::{Periodic, PeriodicPair};
use crate::linalg::{LinearAlgebraError, Matrix, generalised_symmetric_eigen, on_one_thread};

/// ω below this share of the largest one stand for it where speeds are scaled by it.
const SLOWEST: f64 = 1e-4;
/// Shift of the bounds of centres, so that rounding decides about none that is on one.
const ASIDE: f64 = 1e-3;

impl Periodic {
    /// X_k of one of the three matrices, at (i, j).
    fn entry(&self, matrix: usize, k: i32, i: usize, j: usize) -> Complex64 {
        if k == 0 {
            return self.means[matrix][(i, j)].into();
        }
        let own = self.harmonics.iter().find(|own| own.order == k.abs());
        own.map_or(Complex64::ZERO, |own| {
            let [re, im] = &own.parts[matrix];
            Complex64::new(re[(i, j)], f64::from(k.signum()) * im[(i, j)])
        })
    }

    /// A matrix of blocks over k = −hs, …, hs: the sum of `weight(matrix, k of the column)` times X_{row − column}.
    fn blocks(&self, count: i32, weight: &dyn Fn(usize, i32) -> Complex64) -> Mat<Complex64> {
        let (n, step) = (self.means[0].rows, self.step());
        let k = |block: usize| (block as i32 - count) * step;
        let blocks = 2 * count as usize + 1;
        Mat::from_fn(n * blocks, n * blocks, |row, column| {
            let (to, from) = (k(row / n), k(column / n));
            let terms = (0..3).map(|matrix| {
                let weight = weight(matrix, from);
                if weight == Complex64::ZERO {
                    return Complex64::ZERO;
                }
                weight * self.entry(matrix, to - from, row % n, column % n)
            });
            terms.sum()
        })
    }

    /// All motions with harmonics up to ±hs, each once, and its conjugate as one of its own.
    ///
    /// # Errors
    /// M that is not positive definite, or values that are not finite.
    pub(crate) fn eigen(&self, count: i32) -> Result<Vec<PeriodicPair>, LinearAlgebraError> {
        let n = self.means[0].rows;
        if n == 0 {
            return Ok(Vec::new());
        }
        let failure = LinearAlgebraError::NoConvergence { size: n };
        let eigen = generalised_symmetric_eigen(&self.means[2].symmetric_part(), &self.means[0])?;
        let largest = eigen.values.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        let scale = largest.sqrt().max(self.speed.abs()).max(f64::MIN_POSITIVE);
        let omegas: Vec<f64> =
            eigen.values.iter().map(|own| own.abs().sqrt().max(SLOWEST * scale)).collect();
        let own = self.in_basis(&eigen.vectors);
        let shift = |k: i32| Complex64::new(0.0, f64::from(k) * self.speed);
        let zero = Complex64::ZERO;
        let mass = own.blocks(count, &|matrix, _| if matrix == 0 { 1.0.into() } else { zero });
        let damping = own.blocks(count, &|matrix, k| match matrix {
            0 => 2.0 * shift(k),
            1 => 1.0.into(),
            _ => zero,
        });
        let stiffness = own.blocks(count, &|matrix, k| match matrix {
            0 => shift(k) * shift(k),
            1 => shift(k),
            _ => 1.0.into(),
        });
        on_one_thread();
        let factors = mass.partial_piv_lu();
        let [damping, stiffness] = [damping, stiffness].map(|own| factors.solve(own));
        let all = n * (2 * count as usize + 1);
        let rates = Mat::from_fn(2 * all, 2 * all, |i, j| {
            let entry = match (i.checked_sub(all), j.checked_sub(all)) {
                (None, None) => -damping[(i, j)],
                (None, Some(k)) => -stiffness[(i, k)] / omegas[k % n],
                (Some(k), None) if k == j => omegas[k % n].into(),
                _ => zero,
            };
            entry / scale
        });
        let values = |own: MatRef<'_, Complex64>| {
            (0..own.ncols()).all(|j| (0..own.nrows()).all(|i| own[(i, j)].is_finite()))
        };
        if !values(rates.as_ref()) {
            return Err(failure);
        }
        let found = rates.eigen().map_err(|_| failure)?;
        let (lambdas, vectors) = (found.S().column_vector(), found.U());
        let step = self.step();
        let half = 0.5 * f64::from(step);
        let pair = |place: usize| -> Option<PeriodicPair> {
            let of = |block: usize| -> Vec<Complex64> {
                (0..n).map(|i| vectors[(all + block * n + i, place)] / omegas[i]).collect()
            };
            let parts: Vec<Vec<Complex64>> = (0..all / n).map(of).collect();
            let order = |block: usize| (block as i32 - count) * step;
            let sizes = parts.iter().enumerate().map(|(block, own)| {
                (f64::from(order(block)), own.iter().map(|own| own.norm_sqr()).sum::<f64>())
            });
            let (sum, whole) =
                sizes.fold((0.0, 0.0), |sums, (k, size)| (sums.0 + k * size, sums.1 + size));
            let centre = sum / whole;
            let is_kept = centre > -half + ASIDE && centre <= half + ASIDE;
            is_kept.then(|| PeriodicPair {
                value: lambdas[place] * scale,
                parts: parts
                    .into_iter()
                    .enumerate()
                    .map(|(block, own)| (order(block), of_modes(&eigen.vectors, &own)))
                    .collect(),
            })
        };
        Ok((0..2 * all).filter_map(pair).collect())
    }
}

/// V u.
fn of_modes(vectors: &Matrix, own: &[Complex64]) -> Vec<Complex64> {
    let part = |of: fn(&Complex64) -> f64| vectors.apply(&own.iter().map(of).collect::<Vec<f64>>());
    let both = part(|own| own.re).into_iter().zip(part(|own| own.im));
    both.map(|(re, im)| Complex64::new(re, im)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::periodic::equations::Harmonic;

    /// Mathieu's equation at δ = 1, ε small: growth is that of the known tongue, ε/2 within second order.
    #[test]
    fn growth_in_the_first_tongue_of_mathieu() {
        // z̈ + (1 + 2 q cos 2t) z = 0: growth q/2 in first order.
        let q = 1e-3;
        let one = |own: f64| Matrix::from_diagonal(&[own]);
        let own = Periodic {
            means: [one(1.0), one(0.0), one(1.0)],
            harmonics: vec![Harmonic {
                order: 2,
                parts: [[one(0.0), one(0.0)], [one(0.0), one(0.0)], [one(q), one(0.0)]],
            }],
            speed: 1.0,
        };
        for count in [2, 4] {
            let pairs = own.eigen(count).unwrap();
            assert_eq!(pairs.len(), 2, "{pairs:?}");
            let growth = pairs.iter().map(|own| own.value.re).fold(0.0, f64::max);
            assert!((growth / (0.5 * q) - 1.0).abs() < 1e-5, "{growth}");
        }
    }
}

//! T(λ) of Hill's equations: Σ_k [(λ + ikΩ)² M_{j−k} + (λ + ikΩ) C_{j−k} + K_{j−k}] z_k for j = −hs, …, hs, whole, with one block
//! for each harmonic and as wide a band of blocks as the matrices have harmonics.

use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};
use num_complex::Complex64;

use super::equations::Periodic;
use crate::linalg::{LinearAlgebraError, Matrix, on_one_thread};

/// T at a λ, and its band of blocks.
pub(super) struct Blocks<'p> {
    periodic: &'p Periodic,
    /// h: harmonics on both sides, in steps.
    count: i32,
    step: i32,
    /// How many steps the harmonics of the matrices reach.
    reach: usize,
}

/// z_k for k = −hs, …, hs.
pub(super) type Parts = Vec<Vec<Complex64>>;

/// T(σ) in factors: superblocks of as many harmonics as the band is wide are a chain.
pub(super) struct Factors {
    /// Of each superblock what is left of it after the one before, and the one before's share in it.
    chain: Vec<(PartialPivLu<Complex64>, Mat<Complex64>)>,
    /// What the next superblock has in the rows of each.
    above: Vec<Mat<Complex64>>,
    /// Rows of a harmonic.
    rows: usize,
}

impl<'p> Blocks<'p> {
    pub(super) fn new(periodic: &'p Periodic, count: i32) -> Self {
        let step = periodic.step();
        let last = periodic.harmonics.last().map_or(0, |own| own.order);
        Blocks { periodic, count, step, reach: (last / step).max(1) as usize }
    }

    fn len(&self) -> usize {
        2 * self.count as usize + 1
    }

    fn order(&self, block: usize) -> i32 {
        (block as i32 - self.count) * self.step
    }

    fn rate(&self, lambda: Complex64, block: usize) -> Complex64 {
        lambda + Complex64::new(0.0, f64::from(self.order(block)) * self.periodic.speed)
    }

    /// Real matrices of the block between harmonics: of which of M, C and K each is, and its factor; none beyond the band.
    fn terms(&self, to: usize, from: usize) -> Vec<(usize, Complex64, &'p Matrix)> {
        let apart = self.order(to) - self.order(from);
        if apart == 0 {
            let means = self.periodic.means.iter().enumerate();
            return means.map(|(place, own)| (place, Complex64::ONE, own)).collect();
        }
        let own = self.periodic.harmonics.iter().find(|own| own.order == apart.abs());
        let sign = Complex64::new(0.0, f64::from(apart.signum()));
        let parts = own.iter().flat_map(|own| own.parts.iter().enumerate());
        let both =
            parts.flat_map(|(place, [re, im])| [(place, Complex64::ONE, re), (place, sign, im)]);
        // Most of M and C does not vary.
        both.filter(|own| own.2.data.iter().any(|cell| *cell != 0.0)).collect()
    }

    /// T(λ) z, and T′(λ) z.
    pub(super) fn apply(&self, lambda: Complex64, z: &Parts) -> [Parts; 2] {
        let empty = || z.iter().map(|own| vec![Complex64::ZERO; own.len()]).collect();
        let [mut values, mut slopes]: [Parts; 2] = [empty(), empty()];
        for to in 0..self.len() {
            let band = to.saturating_sub(self.reach)..(to + self.reach + 1).min(self.len());
            for from in band {
                let rate = self.rate(lambda, from);
                let weights = [rate * rate, rate, Complex64::ONE];
                let steps = [2.0 * rate, Complex64::ONE, Complex64::ZERO];
                for (place, factor, matrix) in self.terms(to, from) {
                    let moved = times(matrix, &z[from]);
                    let [weight, step] = [weights, steps].map(|own| factor * own[place]);
                    let rows = values[to].iter_mut().zip(&mut slopes[to]).zip(moved);
                    rows.for_each(|((value, slope), moved)| {
                        *value += weight * moved;
                        *slope += step * moved;
                    });
                }
            }
        }
        [values, slopes]
    }

    /// T between superblocks.
    fn dense(&self, lambda: Complex64, to: &[usize], from: &[usize]) -> Mat<Complex64> {
        let rows = self.periodic.means[0].rows;
        let mut own = Mat::zeros(rows * to.len(), rows * from.len());
        for (i, &to) in to.iter().enumerate() {
            for (j, &from) in from.iter().enumerate() {
                let rate = self.rate(lambda, from);
                for (place, factor, matrix) in self.terms(to, from) {
                    let weight = factor * rate.powi(2 - place as i32);
                    for column in 0..rows {
                        for (row, cell) in matrix.col(column).iter().enumerate() {
                            own[(i * rows + row, j * rows + column)] += weight * *cell;
                        }
                    }
                }
            }
        }
        own
    }

    /// T(σ) in factors.
    ///
    /// # Errors
    /// Values that are not finite.
    pub(super) fn factors(&self, sigma: Complex64) -> Result<Factors, LinearAlgebraError> {
        on_one_thread();
        let rows = self.periodic.means[0].rows;
        let all: Vec<usize> = (0..self.len()).collect();
        let groups: Vec<&[usize]> = all.chunks(self.reach).collect();
        let mut factors = Factors { chain: Vec::new(), above: Vec::new(), rows };
        for (place, &group) in groups.iter().enumerate() {
            let mut own = self.dense(sigma, group, group);
            let mut below = Mat::zeros(0, 0);
            if place > 0 {
                below = self.dense(sigma, group, groups[place - 1]);
                let (before, _) = &factors.chain[place - 1];
                own -= &below * before.solve(&factors.above[place - 1]);
            }
            if !own.norm_l1().is_finite() {
                let size = rows * self.len();
                return Err(LinearAlgebraError::Singular { column: 0, pivot: f64::NAN, size });
            }
            factors.chain.push((own.partial_piv_lu(), below));
            if let Some(next) = groups.get(place + 1) {
                factors.above.push(self.dense(sigma, group, next));
            }
        }
        Ok(factors)
    }
}

impl Factors {
    /// T(σ)⁻¹ of a right side.
    pub(super) fn solve(&self, right: &Parts) -> Parts {
        let mut rest = right.iter();
        let mut sides: Vec<Mat<Complex64>> = Vec::with_capacity(self.chain.len());
        for (place, (own, below)) in self.chain.iter().enumerate() {
            let size = own.L().nrows();
            let values: Vec<Complex64> =
                rest.by_ref().take(size / self.rows).flatten().copied().collect();
            let mut side = Mat::from_fn(size, 1, |i, _| values[i]);
            if place > 0 {
                side -= below * self.chain[place - 1].0.solve(&sides[place - 1]);
            }
            sides.push(side);
        }
        let mut after: Option<Mat<Complex64>> = None;
        let mut solved: Vec<Mat<Complex64>> = Vec::with_capacity(sides.len());
        for (place, mut side) in sides.into_iter().enumerate().rev() {
            if let Some(after) = &after {
                side -= &self.above[place] * after;
            }
            let own = self.chain[place].0.solve(&side);
            solved.push(own.clone());
            after = Some(own);
        }
        let all = solved.iter().rev().flat_map(|own| (0..own.nrows()).map(move |i| own[(i, 0)]));
        let all: Vec<Complex64> = all.collect();
        all.chunks(self.rows).map(<[Complex64]>::to_vec).collect()
    }
}

/// A z.
fn times(matrix: &Matrix, z: &[Complex64]) -> Vec<Complex64> {
    let mut sum = vec![Complex64::ZERO; matrix.rows];
    for (column, own) in z.iter().enumerate() {
        sum.iter_mut().zip(matrix.col(column)).for_each(|(sum, cell)| *sum += own * *cell);
    }
    sum
}

//! A motion of all coordinates from one that is near it: residual inverse iteration with T(λ) as it is (Neumaier, SIAM J. Numer.
//! Anal. 22, 1985).

use num_complex::Complex64;

use super::blocks::{Blocks, Parts};
use super::equations::{Periodic, PeriodicPair};
use crate::linalg::LinearAlgebraError;

/// Share of |λ| by which it may still change.
const STANDS: f64 = 1e-10;
/// Size of the outermost harmonics beside all: λ changes by its square.
const TAIL: f64 = 1e-5;
/// Harmonics on both sides with which it begins beside those that it has, in steps.
const MORE: i32 = 3;
/// Inverse iterations that come first: the motion whose λ is nearest comes out, whichever was meant.
const TO_THE_NEAREST: usize = 3;
/// Most harmonics on both sides, in steps.
const HARMONICS: i32 = 48;
/// Iterations by the same factors, and how often these are made.
const ITERATIONS: usize = 8;
const FACTORS: usize = 12;
/// Share by which λ may move by iterations with the same factors.
const NEAR: f64 = 0.05;

impl Periodic {
    /// The motion to which the iteration settles from another one, with as many harmonics as it takes; none where it settles
    /// to none, or `goes_on`, which is asked before factors are made, says no.
    ///
    /// # Errors
    /// Values that are not finite.
    pub(crate) fn refined(
        &self,
        from: &PeriodicPair,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Option<PeriodicPair>, LinearAlgebraError> {
        let step = self.step();
        let mut count = (from.parts.len() / 2) as i32;
        let z: Parts = from.parts.iter().map(|own| own.1.clone()).collect();
        let mut z = self.beyond(z, MORE);
        count += MORE;
        let mut lambda = from.value;
        for turn in 0..FACTORS {
            if !goes_on() {
                return Ok(None);
            }
            let blocks = Blocks::new(self, count);
            let factors = blocks.factors(lambda)?;
            let sigma = lambda;
            for _ in 0..if turn == 0 { TO_THE_NEAREST } else { 0 } {
                z = factors.solve(&blocks.apply(sigma, &z)[1]);
            }
            let length = product(&self.weighed(&z), &z).re.sqrt();
            z.iter_mut().flatten().for_each(|own| *own /= length);
            let weights = self.weighed(&z);
            let mut stands = false;
            for _ in 0..ITERATIONS {
                let [residual, slope] = blocks.apply(lambda, &z);
                let [residual, slope] = [residual, slope].map(|own| factors.solve(&own));
                let by = product(&weights, &residual) / product(&weights, &slope);
                if !by.is_finite() {
                    return Ok(None);
                }
                lambda -= by;
                // T(λ) z with the new λ, to first order.
                let moved = residual.iter().zip(&slope);
                for (own, (residual, slope)) in z.iter_mut().zip(moved) {
                    let both = residual.iter().zip(slope);
                    own.iter_mut().zip(both).for_each(|(z, (r, s))| *z -= r - by * s);
                }
                stands = by.norm() <= STANDS * lambda.norm();
                if stands || (lambda - sigma).norm() > NEAR * sigma.norm() {
                    break;
                }
            }
            if !stands {
                continue;
            }
            if tail(&z) <= TAIL || count >= HARMONICS {
                let orders = (-count..=count).map(|k| k * step);
                return Ok(Some(PeriodicPair { value: lambda, parts: orders.zip(z).collect() }));
            }
            let more = (count / 2).clamp(1, HARMONICS - count);
            z = self.beyond(z, more);
            count += more;
        }
        Ok(None)
    }

    /// With room for more harmonics on both sides.
    fn beyond(&self, z: Parts, more: i32) -> Parts {
        let row = vec![Complex64::ZERO; self.means[0].rows];
        let empty = vec![row; usize::try_from(more).unwrap_or(0)];
        [empty.clone(), z, empty].concat()
    }

    /// (M_0 z_k)ᴴ of all k.
    fn weighed(&self, z: &Parts) -> Parts {
        let mass = &self.means[0];
        let moved = z.iter().map(|own| {
            let mut sum = vec![Complex64::ZERO; own.len()];
            for (column, value) in own.iter().enumerate() {
                let cells = sum.iter_mut().zip(mass.col(column));
                cells.for_each(|(sum, cell)| *sum += value.conj() * *cell);
            }
            sum
        });
        moved.collect()
    }
}

/// Σ a_k z_k.
fn product(a: &Parts, z: &Parts) -> Complex64 {
    a.iter().flatten().zip(z.iter().flatten()).map(|(a, z)| a * z).sum()
}

/// Size of the outermost parts beside that of all.
fn tail(z: &Parts) -> f64 {
    let size = |own: &Vec<Complex64>| own.iter().map(Complex64::norm_sqr).sum::<f64>();
    let all: f64 = z.iter().map(size).sum();
    let ends = z.first().map_or(0.0, size).max(z.last().map_or(0.0, size));
    (ends / all).sqrt()
}

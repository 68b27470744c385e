//! What directions of kept factors lack, learnt from those before: a quasi-Newton method with several secants, as those of Broyden
//! and Anderson.
//!
//! A step d that changed r by −y says that [AK]⁻¹y is d, where the kept factors make a of y. What they make of r is the nearest sum
//! Σ γ a and a rest, and Σ γ (d − a) is what it lacks as far as is known.

use serde::{Deserialize, Serialize};

use super::kept_columns::{KeptColumns, square};

/// Secants at most.
const SECANTS: usize = 4;
/// Share of their squares by which their sum is held: that of the rounding of an inverse in single precision, and more.
const HELD: f64 = 1e-10;

/// Share of the square of the first direction of a step below which one may be rounding, which is no secant.
const ROUNDING: f64 = 1e-10;

/// The last secants of some factors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Secants {
    /// a and d − a, in the same columns.
    given: KeptColumns,
    lacked: KeptColumns,
    /// The last direction of a step, as the factors gave it and as it was taken, how many there were, and the weighed square of
    /// the first one, once another followed.
    by_factors: Vec<f64>,
    taken: Vec<f64>,
    directions: usize,
    first: f64,
}

impl Secants {
    /// None, of so many unknowns.
    pub(super) fn new(unknowns: usize) -> Self {
        let columns = || KeptColumns::new(unknowns, [1, SECANTS], HELD);
        Secants {
            given: columns(),
            lacked: columns(),
            by_factors: vec![0.0; unknowns],
            taken: vec![0.0; unknowns],
            directions: 0,
            first: 0.0,
        }
    }

    /// Forgets all, as other factors make other directions.
    pub(super) fn clear(&mut self) {
        self.given.clear();
        self.lacked.clear();
        self.directions = 0;
    }

    /// Begins a step: its first residual has no direction before it.
    pub(super) fn begin(&mut self) {
        self.directions = 0;
    }

    /// Adds what `direction`, as the factors make it of r, lacks. It is expected to be taken whole: what is left of r then makes a
    /// secant. `weights`: 1/s of the unknowns; `memory`: one value an unknown.
    pub(super) fn correct(&mut self, direction: &mut [f64], weights: &[f64], memory: &mut [f64]) {
        let Secants { given, lacked, by_factors, taken, directions, first } = self;
        if *directions > 0 {
            if *directions == 1 {
                *first = square(by_factors, weights, memory);
            }
            by_factors.iter_mut().zip(&*direction).for_each(|(a, left)| *a -= left);
            taken.iter_mut().zip(&*by_factors).for_each(|(d, a)| *d -= a);
            let products = given.products_with(by_factors, weights, memory);
            if products.0 > ROUNDING * *first {
                given.push(by_factors, products);
                lacked.push(taken, Default::default());
            }
        }
        by_factors.copy_from_slice(direction);
        if !given.is_empty() {
            let (_, with) = given.products_with(direction, weights, memory);
            if let Some(shares) = given.nearest(&with) {
                lacked.add(&shares, direction);
            }
        }
        taken.copy_from_slice(direction);
        *directions += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear system whose factors are off by a matrix of rank 2 is solved as soon as both directions were taken.
    #[test]
    fn what_factors_lack_in_a_few_directions_is_learnt() {
        const N: usize = 32;
        let [u, v] = [0.3, 0.7].map(|seed: f64| (0..N).map(move |i| (seed * (i + 1) as f64).sin()));
        let (u, v): (Vec<f64>, Vec<f64>) = (u.collect(), v.collect());
        // A = 1 + 0.02 (u uᵀ + v vᵀ), factors of 1.
        let product = |x: &[f64]| -> Vec<f64> {
            let along = |w: &[f64]| 0.02 * w.iter().zip(x).map(|(w, x)| w * x).sum::<f64>();
            let (a, b) = (along(&u), along(&v));
            (0..N).map(|i| x[i] + a * u[i] + b * v[i]).collect()
        };
        let weights: Vec<f64> = (0..N).map(|i| 1.0 + 0.01 * i as f64).collect();
        let mut own = Secants::new(N);
        let size = |r: &[f64]| r.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
        let mut solve = |seed: f64, iterations: usize| {
            let mut r: Vec<f64> = (0..N).map(|i| (seed * (i + 3) as f64).cos()).collect();
            own.begin();
            for _ in 0..iterations {
                let mut d = r.clone();
                own.correct(&mut d, &weights, &mut [0.0; N]);
                let y = product(&d);
                r.iter_mut().zip(&y).for_each(|(r, y)| *r -= y);
            }
            size(&r)
        };
        let plain = solve(0.9, 1);
        assert!(plain > 1e-3, "{plain}");
        solve(1.3, 4);
        solve(1.9, 4);
        // Other residuals are solved at once as far as their parts along u and v are known; factors alone leave as much as at first.
        let learnt = solve(2.3, 2);
        assert!(learnt < 1e-9, "{learnt}");
        own.clear();
        let mut d = vec![1.0; N];
        own.correct(&mut d, &weights, &mut [0.0; N]);
        assert_eq!(d, vec![1.0; N]);
    }
}

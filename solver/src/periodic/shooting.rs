//! Newton's method on the cycle map: with its whole derivative where states are few, by products with it (GMRES) where they are
//! many.
//!
//! A correction is taken if the next one by the same derivative is smaller (the natural test); it is halved otherwise, and so
//! it is where the march does not get through the cycle.

use super::krylov::Krylov;
use super::metric::norm;
use super::weighed::{LinearCycle, Weighed};
use crate::error::Error;
use crate::linalg::{Lu, Matrix};

/// Products for a correction at most, and what may be left of the equations that they solve.
const PRODUCTS: usize = 120;
const LEFT: f64 = 1e-3;

/// What solves (Φ − 1) δ = f.
enum Derivative {
    Whole(Lu),
    Steps(LinearCycle),
}

/// A state with what the map made of it.
pub(super) struct Shot {
    pub(super) y: Vec<f64>,
    pub(super) image: Vec<f64>,
    derivative: Derivative,
}

impl Shot {
    /// From a state; none where Φ − 1 is singular.
    ///
    /// # Errors
    /// A step that does not converge.
    pub(super) fn new(map: &mut Weighed, y: Vec<f64>) -> Result<Option<Shot>, Error> {
        if !map.map.is_small() {
            let (image, steps) = map.linearised(&y)?;
            return Ok(Some(Shot { y, image, derivative: Derivative::Steps(steps) }));
        }
        let (image, monodromy) = map.monodromy(&y)?;
        let less = Matrix::from_fn(y.len(), y.len(), |i, j| {
            monodromy[(i, j)] - f64::from(u8::from(i == j))
        });
        let mut lu = Lu::new(y.len());
        let done = lu.factor(&less.data).is_ok();
        Ok(done.then_some(Shot { y, image, derivative: Derivative::Whole(lu) }))
    }

    fn residual(&self) -> Vec<f64> {
        self.image.iter().zip(&self.y).map(|(a, b)| a - b).collect()
    }

    /// δ of (Φ − 1) δ = f.
    ///
    /// # Errors
    /// A step that does not converge.
    fn solve(&mut self, map: &mut Weighed, f: &[f64]) -> Result<Vec<f64>, Error> {
        match &mut self.derivative {
            Derivative::Whole(lu) => {
                let mut solved = f.to_vec();
                lu.solve_in_place(&mut solved);
                Ok(solved)
            }
            Derivative::Steps(steps) => {
                let size = norm(f);
                if size == 0.0 {
                    return Ok(f.to_vec());
                }
                let mut krylov = Krylov::new(f);
                while let Some(next) = krylov.next() {
                    let image = map.change(steps, next)?;
                    krylov.take(image);
                    if krylov.size() == PRODUCTS || krylov.least(size).1 <= LEFT * size {
                        break;
                    }
                }
                Ok(krylov.least(size).0)
            }
        }
    }

    /// The state after a correction, or after a part of it that brings it nearer; none where there is none.
    pub(super) fn next(&mut self, map: &mut Weighed) -> Option<Shot> {
        let residual = self.residual();
        let correction = self.solve(map, &residual).ok()?;
        let size = norm(&correction);
        let mut length = 1.0;
        while length >= 1.0 / 64.0 {
            let moved = self.y.iter().zip(&correction).map(|(y, own)| y - length * own);
            if let Ok(Some(tried)) = Shot::new(map, moved.collect())
                && let Ok(next) = self.solve(map, &tried.residual())
            {
                let after = norm(&next);
                // At rounding it falls no more.
                if after <= (1.0 - 0.25 * length) * size || size <= 1e-10 * norm(&self.y) {
                    return Some(tried);
                }
            }
            length *= 0.5;
        }
        None
    }
}

//! Newton's method on the harmonics of the residual.
//!
//! Corrections are exact where unknowns are few. Else they come from products with the derivative alone (GMRES), the machine with its mean
//! tangents in front. A correction is taken if the motion that the mean machine has by the residual gets smaller, and halved otherwise.

use std::ops::ControlFlow;

use super::balance::{Balance, Derivative};
use super::mean::Mean;
use super::series::Series;
use crate::error::{Error, PeriodicError};
use crate::linalg::{Lu, Matrix};
use crate::periodic::krylov::Krylov;
use crate::periodic::metric::{Metric, norm};
use crate::periodic::options::CycleProgress;
use crate::periodic::solve::Observe;

/// Unknowns of which the whole derivative is found.
const WHOLE: usize = 500;
/// Products for a correction at most, and what may be left of the equations that they solve.
const PRODUCTS: usize = 200;
const LEFT: f64 = 1e-5;
/// Corrections, and how often one is halved.
const CORRECTIONS: usize = 60;
const SHORTEST: f64 = 1.0 / 256.0;
/// Part of the motion by which a correction is rounding.
const ROUNDING: f64 = 1e-14;

/// Harmonics whose residual is zero.
pub(super) struct Solved {
    pub(super) coefficients: Matrix,
    /// The last correction as a part of the motion, in the energy norm of positions.
    pub(super) left: f64,
    pub(super) corrections: usize,
}

/// What is solved, and in which norm.
pub(super) struct Equilibrating<'a, 'm> {
    pub(super) balance: &'a mut Balance<'m>,
    pub(super) series: &'a Series,
    pub(super) metric: &'a Metric,
}

impl Equilibrating<'_, '_> {
    /// The harmonics from others nearby; none where corrections do not lead to any.
    ///
    /// # Errors
    /// An interruption.
    pub(super) fn solve(
        &mut self,
        mut coefficients: Matrix,
        (tolerance, cycles): (f64, usize),
        observe: Observe,
    ) -> Result<Option<Solved>, Error> {
        let mut before = f64::INFINITY;
        for corrections in 1..=CORRECTIONS {
            let (residual, derivative) = self.balance.linearised(self.series, &coefficients);
            let Ok(mean) = Mean::new(self.series, &derivative.means) else { return Ok(None) };
            let Some(change) = self.correction(&derivative, &mean, &residual) else {
                return Ok(None);
            };
            let size = self.size(&coefficients);
            let share = |own: f64| if own == 0.0 { 0.0 } else { own / size };
            let whole = share(self.size(&change));
            let taken = self.taken(&coefficients, (&change, &residual), &mean, whole <= tolerance);
            let Some((next, length)) = taken else { return Ok(None) };
            coefficients = next;
            let left = length * whole;
            if observe(&CycleProgress { cycles, miss: left }) == ControlFlow::Break(()) {
                return Err(PeriodicError::Interrupted { cycles }.into());
            }
            if left <= ROUNDING || left <= tolerance && left > 0.5 * before {
                return Ok(Some(Solved { coefficients, left, corrections }));
            }
            before = left;
        }
        Ok(None)
    }

    /// The coefficients after a correction, or after a part of it, and which.
    fn taken(
        &mut self,
        coefficients: &Matrix,
        (change, residual): (&Matrix, &Matrix),
        mean: &Mean,
        is_small: bool,
    ) -> Option<(Matrix, f64)> {
        let before = self.size(&mean.moved_by(residual));
        let mut length = 1.0;
        while length >= SHORTEST {
            let mut trial = coefficients.clone();
            trial.data.iter_mut().zip(&change.data).for_each(|(own, more)| *own += length * more);
            let residual = self.balance.residual(self.series, &trial);
            let after = self.size(&mean.moved_by(&residual));
            // What is no number is never smaller; at rounding nothing is.
            if after <= (1.0 - 0.1 * length) * before || is_small && after.is_finite() {
                return Some((trial, length));
            }
            length *= 0.5;
        }
        None
    }

    /// δ of −∂r δ = r.
    fn correction(
        &self,
        derivative: &Derivative,
        mean: &Mean,
        residual: &Matrix,
    ) -> Option<Matrix> {
        let (n, columns) = (residual.rows, residual.cols);
        let of = |data: Vec<f64>| Matrix { rows: n, cols: columns, data };
        if n * columns <= WHOLE {
            let size = n * columns;
            let mut all = Vec::with_capacity(size * size);
            let mut unit = Matrix::zeros(n, columns);
            for place in 0..size {
                unit.data[place] = 1.0;
                all.extend(derivative.apply(self.series, &unit).data);
                unit.data[place] = 0.0;
            }
            let mut lu = Lu::new(size);
            lu.factor(&all).ok()?;
            let mut change = residual.data.clone();
            lu.solve_in_place(&mut change);
            return Some(of(change));
        }
        let moved = self.weighed(&mean.moved_by(residual));
        let size = norm(&moved);
        if size == 0.0 || !size.is_finite() {
            return (size == 0.0).then(|| Matrix::zeros(n, columns));
        }
        let mut krylov = Krylov::new(&moved);
        while let Some(next) = krylov.next() {
            let change = self.back(of(next.to_vec()));
            let image = mean.moved_by(&derivative.apply(self.series, &change));
            // What is solved there is (map − 1) z = f.
            let mut image = self.weighed(&image);
            image.iter_mut().zip(next).for_each(|(image, own)| *image += own);
            krylov.take(image);
            if krylov.size() == PRODUCTS || krylov.least(size).1 <= LEFT * size {
                break;
            }
        }
        Some(self.back(of(krylov.least(size).0)))
    }

    /// The energy norm of coefficients, as of positions.
    fn size(&self, coefficients: &Matrix) -> f64 {
        norm(&self.weighed(coefficients))
    }

    fn weighed(&self, coefficients: &Matrix) -> Vec<f64> {
        (0..coefficients.cols)
            .flat_map(|column| self.metric.weighed_positions(coefficients.col(column)))
            .collect()
    }

    fn back(&self, mut weighed: Matrix) -> Matrix {
        for column in 0..weighed.cols {
            self.metric.positions(weighed.col_mut(column));
        }
        weighed
    }
}

//! Newton's method on the harmonics of the residual, and on the frequency where nothing tells it.
//!
//! Corrections are exact where unknowns are few. Else they come from products with the derivative alone (GMRES), the machine with its
//! mean tangents in front. A correction is taken if the motion that the mean machine has by the residual gets smaller, and halved
//! otherwise. Of a motion with a period of its own one more equation fixes where the cycle begins: the first cosine of one coordinate
//! is zero.

use std::ops::ControlFlow;

use super::balance::{Balance, Derivative};
use super::mean::Mean;
use super::series::{INSTANTS, Series};
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
/// Part of the first harmonic that must be left of it for a motion of its own to be one.
const THERE: f64 = 1e-3;

/// Harmonics of a motion over a cycle.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    pub(super) coefficients: Matrix,
    /// s.
    pub(super) period: f64,
}

impl Motion {
    /// How many harmonics there are beside the mean.
    pub(super) fn count(&self) -> usize {
        self.coefficients.cols / 2
    }

    /// At the instants at which its forces are sampled.
    pub(super) fn series(&self, series: &mut impl FnMut(f64, usize, usize) -> Series) -> Series {
        series(self.period, self.count(), INSTANTS * self.count().max(1))
    }

    /// After a change, or a part of it.
    fn changed(&self, change: &Change, length: f64) -> Motion {
        let mut own = self.clone();
        let more = &change.coefficients.data;
        own.coefficients.data.iter_mut().zip(more).for_each(|(own, more)| *own += length * more);
        if change.frequency != 0.0 {
            own.period *= (-length * change.frequency).exp();
        }
        own
    }

    /// The size of its first harmonic.
    fn first(&self) -> f64 {
        norm(&[self.coefficients.col(1), self.coefficients.col(2)].concat())
    }
}

/// A motion whose residual is zero.
pub(super) struct Solved {
    pub(super) motion: Motion,
    /// The last correction as a part of the motion, in the energy norm of positions.
    pub(super) left: f64,
    pub(super) corrections: usize,
}

/// A change of the harmonics, and of the logarithm of the frequency.
struct Change {
    coefficients: Matrix,
    frequency: f64,
}

/// The equations at a motion.
struct Step<'a> {
    series: &'a Series,
    derivative: &'a Derivative,
    mean: &'a Mean,
    /// −∂r/∂ ln ω, and the place of the coefficient that stays zero, of a motion with a period of its own.
    border: Option<(Matrix, usize)>,
}

/// What is solved, and in which norm.
pub(super) struct Equilibrating<'a, 'm> {
    pub(super) balance: &'a mut Balance<'m>,
    pub(super) metric: &'a Metric,
    /// What makes a series of a period, harmonics and instants.
    pub(super) series: fn(f64, usize, usize) -> Series,
    /// The coordinate whose first cosine stays zero, where nothing tells the period.
    pub(super) reference: Option<usize>,
}

impl Equilibrating<'_, '_> {
    /// The motion from another one nearby; none where corrections do not lead to any, or where one that should move by itself comes to
    /// rest.
    ///
    /// # Errors
    /// An interruption.
    pub(super) fn solve(
        &mut self,
        mut motion: Motion,
        (tolerance, cycles): (f64, usize),
        observe: Observe,
    ) -> Result<Option<Solved>, Error> {
        let least = self.reference.map_or(0.0, |_| THERE * motion.first());
        let mut before = f64::INFINITY;
        for corrections in 1..=CORRECTIONS {
            let series = motion.series(&mut self.series);
            self.balance.set_period(motion.period);
            let (residual, derivative) = self.balance.linearised(&series, &motion.coefficients);
            let Ok(mean) = Mean::new(&series, &derivative.means) else { return Ok(None) };
            let border = self.reference.map(|reference| {
                let place = motion.coefficients.rows + reference;
                (derivative.by_frequency(&series, &motion.coefficients), place)
            });
            let step = Step { series: &series, derivative: &derivative, mean: &mean, border };
            let miss = step.border.as_ref().map_or(0.0, |own| motion.coefficients.data[own.1]);
            let so_far = CycleProgress { cycles, miss: before };
            let mut goes_on = || observe(&so_far) == ControlFlow::Continue(());
            let Some(change) = self.correction(&step, (&residual, miss), &mut goes_on) else {
                return match goes_on() {
                    true => Ok(None),
                    false => Err(PeriodicError::Interrupted { cycles }.into()),
                };
            };
            let share = |own: f64, size: f64| if own == 0.0 { 0.0 } else { own / size };
            let moved = share(self.size(&change.coefficients), self.size(&motion.coefficients));
            let whole = moved.max(change.frequency.abs());
            let taken = self.taken(&motion, &change, (&mean, &residual), whole <= tolerance);
            let Some((next, length)) = taken else { return Ok(None) };
            motion = next;
            let left = length * whole;
            if observe(&CycleProgress { cycles, miss: left }) == ControlFlow::Break(()) {
                return Err(PeriodicError::Interrupted { cycles }.into());
            }
            if motion.first() < least {
                return Ok(None);
            }
            if left <= ROUNDING || left <= tolerance && left > 0.5 * before {
                return Ok(Some(Solved { motion, left, corrections }));
            }
            before = left;
        }
        Ok(None)
    }

    /// The motion after a correction, or after a part of it, and which.
    fn taken(
        &mut self,
        motion: &Motion,
        change: &Change,
        (mean, residual): (&Mean, &Matrix),
        is_small: bool,
    ) -> Option<(Motion, f64)> {
        let before = self.size(&mean.moved_by(residual));
        let mut length = 1.0;
        while length >= SHORTEST {
            let trial = motion.changed(change, length);
            self.balance.set_period(trial.period);
            let series = trial.series(&mut self.series);
            let residual = self.balance.residual(&series, &trial.coefficients);
            let after = self.size(&mean.moved_by(&residual));
            // What is no number is never smaller; at rounding nothing is.
            if after <= (1.0 - 0.1 * length) * before || is_small && after.is_finite() {
                return Some((trial, length));
            }
            length *= 0.5;
        }
        None
    }

    /// δ and σ of −∂r δ − (∂r/∂ ln ω) σ = r; none where the equations have no solution, or it is not to go on.
    fn correction(
        &self,
        step: &Step,
        (residual, miss): (&Matrix, f64),
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Option<Change> {
        match residual.data.len() <= WHOLE {
            true => step.exactly(residual, miss),
            false => self.by_products(step, (residual, miss), goes_on),
        }
    }

    fn by_products(
        &self,
        step: &Step,
        (residual, miss): (&Matrix, f64),
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Option<Change> {
        let (n, columns) = (residual.rows, residual.cols);
        // The mean machine by itself, and what it does as the frequency changes.
        let by = step.border.as_ref().map(|(by, place)| (step.mean.moved_by(by), *place));
        let scale = by.as_ref().map_or(1.0, |(by, _)| self.size(by));
        let in_front = |force: &Matrix, miss: f64| -> Vec<f64> {
            let mut own = step.mean.moved_by(force);
            let mut frequency = 0.0;
            if let Some((by, place)) = &by {
                frequency = (own.data[*place] - miss) / by.data[*place];
                own.data.iter_mut().zip(&by.data).for_each(|(own, by)| *own -= frequency * by);
            }
            let mut all = self.metric.weighed_columns(&own);
            all.push(scale * frequency);
            all
        };
        let back = |own: &[f64]| -> Change {
            let (frequency, own) = own.split_last().expect("it has one");
            let weighed = Matrix { rows: n, cols: columns, data: own.to_vec() };
            Change { coefficients: self.metric.columns(weighed), frequency: frequency / scale }
        };
        let first = in_front(residual, -miss);
        let size = norm(&first);
        if !(size > 0.0 && size.is_finite()) {
            let still = Change { coefficients: Matrix::zeros(n, columns), frequency: 0.0 };
            return (size == 0.0).then_some(still);
        }
        let mut krylov = Krylov::new(&first);
        while let Some(next) = krylov.next() {
            if !goes_on() {
                return None;
            }
            let own = back(next);
            let mut force = step.derivative.apply(step.series, &own.coefficients);
            let mut miss = 0.0;
            if let Some((by, place)) = &step.border {
                let by = by.data.iter().map(|by| own.frequency * by);
                force.data.iter_mut().zip(by).for_each(|(force, by)| *force += by);
                miss = own.coefficients.data[*place];
            }
            // What is solved there is (map − 1) z = f.
            let mut image = in_front(&force, miss);
            image.iter_mut().zip(next).for_each(|(image, own)| *image += own);
            krylov.take(image);
            if krylov.size() == PRODUCTS || krylov.least(size).1 <= LEFT * size {
                break;
            }
        }
        Some(back(&krylov.least(size).0))
    }

    /// The energy norm of coefficients, as of positions.
    fn size(&self, coefficients: &Matrix) -> f64 {
        norm(&self.metric.weighed_columns(coefficients))
    }
}

impl Step<'_> {
    /// The change by the whole derivative.
    fn exactly(&self, residual: &Matrix, miss: f64) -> Option<Change> {
        let (n, columns, size) = (residual.rows, residual.cols, residual.data.len());
        let mut all = Vec::with_capacity((size + 1) * (size + 1));
        let mut unit = Matrix::zeros(n, columns);
        for k in 0..size {
            unit.data[k] = 1.0;
            all.extend(self.derivative.apply(self.series, &unit).data);
            unit.data[k] = 0.0;
            if let Some((_, place)) = &self.border {
                all.push(f64::from(u8::from(k == *place)));
            }
        }
        let mut change = residual.data.clone();
        if let Some((by, _)) = &self.border {
            all.extend(&by.data);
            all.push(0.0);
            change.push(-miss);
        }
        let mut lu = Lu::new(change.len());
        lu.factor(&all).ok()?;
        lu.solve_in_place(&mut change);
        let frequency = if self.border.is_some() { change.pop()? } else { 0.0 };
        let coefficients = Matrix { rows: n, cols: columns, data: change };
        Some(Change { coefficients, frequency })
    }
}

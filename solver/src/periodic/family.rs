//! A machine over a parameter: the residual of its cycle, and derivatives.

use std::sync::Arc;

use super::cycle::Cycle;
use super::map::CycleMap;
use super::metric::Metric;
use super::weighed::Weighed;
use crate::dynamics::NewtonOptions;
use crate::error::Error;
use crate::linalg::Matrix;
use crate::machine::Machine;

/// The machine at a value of the parameter, with its cycle.
pub type At<'f> = &'f mut dyn FnMut(f64) -> Result<(Machine, Cycle), Error>;

/// Change of the parameter for a derivative, of its range: it is right to about as much, which a correction need not notice.
const CHANGE: f64 = 1e-6;

/// Machines over a parameter, seen in the metric of one of them.
pub(super) struct Family<'f> {
    at: At<'f>,
    newton: NewtonOptions,
    metric: Arc<Metric>,
    /// Change of the parameter for a derivative, and the value beyond which there may be no machine.
    change: f64,
    most: f64,
    /// Cycles that were marched.
    pub(super) cycles: usize,
}

/// The residual G(y) − y of a cycle, with its derivatives.
pub(super) struct Evaluated {
    pub(super) residual: Vec<f64>,
    /// Φ.
    pub(super) monodromy: Matrix,
    /// By the parameter.
    pub(super) slope: Vec<f64>,
}

impl<'f> Family<'f> {
    /// Of machines over a range of the parameter, in the metric of the one at its start and x.
    ///
    /// # Errors
    /// As of the machine and its cycle.
    pub(super) fn new(
        at: At<'f>,
        newton: NewtonOptions,
        [from, to]: [f64; 2],
        x: &[f64],
    ) -> Result<Self, Error> {
        let (machine, cycle) = at(from)?;
        let mut map = CycleMap::new(&machine, cycle, newton)?;
        map.suits_branches()?;
        let metric = Arc::new(Metric::new(&mut map, x)?);
        Ok(Family::of(at, newton, [from, to], metric))
    }

    /// In a metric that others have, too.
    pub(super) fn of(
        at: At<'f>,
        newton: NewtonOptions,
        [from, to]: [f64; 2],
        metric: Arc<Metric>,
    ) -> Self {
        let change = CHANGE * (to - from).abs();
        Family { at, newton, metric, change, most: from.max(to), cycles: 0 }
    }

    /// The metric.
    pub(super) fn metric(&self) -> Arc<Metric> {
        self.metric.clone()
    }

    pub(super) fn weighed(&self, x: &[f64]) -> Vec<f64> {
        self.metric.weighed(x)
    }

    pub(super) fn state(&self, y: &[f64]) -> Vec<f64> {
        self.metric.state(y)
    }

    /// Does something with the map at a value.
    ///
    /// # Errors
    /// As of the machine, its cycle, and what is done.
    pub(super) fn with<T>(
        &mut self,
        value: f64,
        work: impl FnOnce(&mut Weighed) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let (machine, cycle) = (self.at)(value)?;
        let mut map = CycleMap::new(&machine, cycle, self.newton)?;
        let made = work(&mut Weighed::with(&mut map, self.metric.clone()));
        self.cycles += map.cycles();
        made
    }

    /// The residual and its derivatives.
    ///
    /// # Errors
    /// As [`Family::with`].
    pub(super) fn evaluate(&mut self, value: f64, y: &[f64]) -> Result<Evaluated, Error> {
        let (image, monodromy) = self.with(value, |map| map.monodromy(y))?;
        // Not beyond the range.
        let change = if value + self.change > self.most { -self.change } else { self.change };
        let beyond = self.with(value + change, |map| map.apply(y))?;
        let slope = beyond.iter().zip(&image).map(|(a, b)| (a - b) / change).collect();
        let residual = image.iter().zip(y).map(|(a, b)| a - b).collect();
        Ok(Evaluated { residual, monodromy, slope })
    }
}

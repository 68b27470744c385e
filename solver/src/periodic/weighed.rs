//! The cycle map in coordinates whose plain norm is that of energy: what all methods work in.

use std::sync::Arc;

use num_complex::Complex64;

use super::map::CycleMap;
use super::metric::{Metric, norm};
use crate::dynamics::{Changes, LinearStep};
use crate::error::Error;
use crate::linalg::{Matrix, dot};

/// A cycle map in weighed coordinates.
pub(super) struct Weighed<'a, 'm> {
    pub(super) map: &'a mut CycleMap<'m>,
    metric: Arc<Metric>,
}

/// The derivative of the map about a cycle.
pub(super) enum LinearCycle {
    /// Step by step, as it was kept.
    Steps { steps: Vec<LinearStep>, memory: Vec<f64> },
    /// By differences about y, where laws remember.
    Differences { y: Vec<f64> },
}

/// Change of a state for a difference, of its size; and of one of nothing. Central differences are right to the square of it.
const CHANGE: f64 = 1e-6;
const FROM_NOTHING: f64 = 1e-9;

impl<'a, 'm> Weighed<'a, 'm> {
    /// With the metric at a state.
    ///
    /// # Errors
    /// As [`Metric::new`].
    pub(super) fn new(map: &'a mut CycleMap<'m>, x: &[f64]) -> Result<Self, Error> {
        let metric = Arc::new(Metric::new(map, x)?);
        Ok(Weighed { map, metric })
    }

    /// With a metric that others have, too.
    pub(super) fn with(map: &'a mut CycleMap<'m>, metric: Arc<Metric>) -> Self {
        Weighed { map, metric }
    }

    /// Its metric, for the same map later.
    pub(super) fn metric(&self) -> Arc<Metric> {
        self.metric.clone()
    }

    pub(super) fn weighed(&self, x: &[f64]) -> Vec<f64> {
        self.metric.weighed(x)
    }

    pub(super) fn state(&self, y: &[f64]) -> Vec<f64> {
        self.metric.state(y)
    }

    /// What the map makes of y.
    ///
    /// # Errors
    /// A step that does not converge.
    pub(super) fn apply(&mut self, y: &[f64]) -> Result<Vec<f64>, Error> {
        let mut x = self.state(y);
        self.map.apply(&mut x)?;
        Ok(self.weighed(&x))
    }

    /// What half of a cycle makes of y.
    ///
    /// # Errors
    /// A step that does not converge.
    pub(super) fn half(&mut self, y: &[f64]) -> Result<Vec<f64>, Error> {
        let mut x = self.state(y);
        self.map.half(&mut x)?;
        Ok(self.weighed(&x))
    }

    /// The same with its derivative.
    ///
    /// # Errors
    /// A step that does not converge.
    pub(super) fn monodromy(&mut self, y: &[f64]) -> Result<(Vec<f64>, Matrix), Error> {
        let size = y.len();
        let mut columns = Vec::with_capacity(size * size);
        let mut unit = vec![0.0; size];
        if self.map.memory() > 0 {
            let image = self.apply(y)?;
            for j in 0..size {
                unit[j] = 1.0;
                columns.extend(self.difference(y, &unit)?);
                unit[j] = 0.0;
            }
            return Ok((image, Matrix { rows: size, cols: size, data: columns }));
        }
        let mut x = self.state(y);
        let of_states = self.map.monodromy(&mut x)?;
        for j in 0..size {
            unit[j] = 1.0;
            let change = of_states.apply(&self.state(&unit));
            unit[j] = 0.0;
            columns.extend(self.weighed(&change));
        }
        Ok((self.weighed(&x), Matrix { rows: size, cols: size, data: columns }))
    }

    /// The same with its derivative as steps.
    ///
    /// # Errors
    /// A step that does not converge.
    pub(super) fn linearised(&mut self, y: &[f64]) -> Result<(Vec<f64>, LinearCycle), Error> {
        if self.map.memory() > 0 {
            return Ok((self.apply(y)?, LinearCycle::Differences { y: y.to_vec() }));
        }
        let mut x = self.state(y);
        let steps = self.map.steps(&mut x)?;
        Ok((self.weighed(&x), LinearCycle::Steps { steps, memory: Vec::new() }))
    }

    /// What the derivative makes of a change.
    ///
    /// # Errors
    /// A step that does not converge.
    pub(super) fn change(
        &mut self,
        cycle: &mut LinearCycle,
        change: &[f64],
    ) -> Result<Vec<f64>, Error> {
        match cycle {
            LinearCycle::Steps { steps, memory } => {
                let x = self.state(change);
                let mut changes = Changes::new(x.len() / 2, 1, |i, _| x[i]);
                steps.iter_mut().for_each(|own| own.apply(&mut changes, memory));
                let mut changed: Vec<f64> = (0..x.len()).map(|i| changes.value(i, 0)).collect();
                self.map.turn_back(&mut changed);
                Ok(self.weighed(&changed))
            }
            LinearCycle::Differences { y } => self.difference(y, change),
        }
    }

    /// The mean cosine, in the energy of positions, between a change and the same a step later, over the steps of a cycle.
    ///
    /// # Errors
    /// A step that does not converge.
    pub(super) fn step_to_step(
        &mut self,
        cycle: &mut LinearCycle,
        change: &[Complex64],
    ) -> Result<f64, Error> {
        let parts = [0, 1].map(|part| -> Vec<f64> {
            change.iter().map(|own| if part == 0 { own.re } else { own.im }).collect()
        });
        let mut turns = Turns::default();
        match cycle {
            LinearCycle::Steps { steps, memory } => {
                let both = parts.map(|own| self.state(&own));
                let n = self.map.unknowns();
                let mut changes = Changes::new(n, 2, |i, j| both[j][i]);
                for step in steps {
                    step.apply(&mut changes, memory);
                    turns.take([0, 1].map(|j| self.metric.weighed_positions(changes.q.col(j))));
                }
            }
            LinearCycle::Differences { y } => {
                let [re, im] = parts.map(|own| self.positions_beside(y, &own));
                let both = [re?, im?];
                let n = self.map.unknowns();
                let steps = both[0].len() / n.max(1);
                for step in (1..steps).chain([0]) {
                    let at = |own: &Vec<f64>| self.metric.weighed_positions(&own[step * n..][..n]);
                    turns.take(both.each_ref().map(at));
                }
            }
        }
        Ok(turns.mean())
    }

    /// What a change at y does to the positions over the cycle, a column a step.
    fn positions_beside(&mut self, y: &[f64], change: &[f64]) -> Result<Vec<f64>, Error> {
        if norm(change) == 0.0 {
            return Ok(vec![0.0; self.map.unknowns() * self.map.cycle().steps]);
        }
        self.beside(y, change, |own, moved| {
            let mut x = own.state(moved);
            Ok(own.map.positions(&mut x)?.data)
        })
    }

    /// What the derivative at y makes of a change.
    fn difference(&mut self, y: &[f64], change: &[f64]) -> Result<Vec<f64>, Error> {
        self.beside(y, change, Self::apply)
    }

    /// The derivative of a function at y along a change, by a central difference.
    fn beside(
        &mut self,
        y: &[f64],
        change: &[f64],
        of: impl Fn(&mut Self, &[f64]) -> Result<Vec<f64>, Error>,
    ) -> Result<Vec<f64>, Error> {
        let own = norm(y);
        let step = if own > 0.0 { CHANGE * own } else { FROM_NOTHING } / norm(change);
        let mut at = |step: f64| {
            let moved: Vec<f64> = y.iter().zip(change).map(|(y, own)| y + step * own).collect();
            of(self, &moved)
        };
        let (after, before) = (at(step)?, at(-step)?);
        Ok(after.iter().zip(&before).map(|(a, b)| (a - b) / (2.0 * step)).collect())
    }
}

/// How far a change turns from step to step.
#[derive(Default)]
struct Turns {
    last: Option<[Vec<f64>; 2]>,
    sum: f64,
    steps: usize,
}

impl Turns {
    /// Takes the real and the imaginary part after a step.
    fn take(&mut self, own: [Vec<f64>; 2]) {
        if let Some(last) = &self.last {
            let product = |a: &[Vec<f64>; 2], b: &[Vec<f64>; 2]| {
                a.iter().zip(b).map(|(a, b)| dot(a, b)).sum::<f64>()
            };
            let size = (product(last, last) * product(&own, &own)).sqrt();
            if size > 0.0 {
                self.sum += product(last, &own) / size;
                self.steps += 1;
            }
        }
        self.last = Some(own);
    }

    /// 1 of what does not move.
    fn mean(&self) -> f64 {
        if self.steps == 0 { 1.0 } else { self.sum / self.steps as f64 }
    }
}

/// ‖image − y‖/‖image‖; 0 where nothing moves.
pub(super) fn miss(y: &[f64], image: &[f64]) -> f64 {
    let apart = norm(&image.iter().zip(y).map(|(a, b)| a - b).collect::<Vec<f64>>());
    if apart == 0.0 { 0.0 } else { apart / norm(image) }
}

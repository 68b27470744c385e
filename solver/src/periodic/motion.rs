//! A periodic motion, and what is known of it.

use super::cycle::Cycle;
use super::doubled::StepError;
use super::multipliers::{Multiplier, Stability, doubtful};
use super::options::Method;
use crate::dynamics::Outcome;
use crate::history::History;

/// A periodic motion.
#[derive(Debug, Clone)]
pub struct Periodic {
    /// Its cycle.
    pub cycle: Cycle,
    /// x at the start: positions of the unknowns, then their rates.
    pub state: Vec<f64>,
    /// The method that found it.
    pub method: Method,
    /// Cycles that were marched for it.
    pub cycles: usize,
    /// ‖x(T) − x(0)‖/‖x‖ in the energy norm.
    pub miss: f64,
    /// The rows of its cycle, one a step, the end of the cycle the last.
    pub history: History,
    /// What the steps of the cycle were worth.
    pub outcome: Outcome,
    /// The largest multipliers first; all of them where states are few.
    pub multipliers: Vec<Multiplier>,
    /// What they say.
    pub stability: Stability,
    /// What steps half as long change, where that was found; nothing of harmonics, which have no steps.
    pub step_error: Option<StepError>,
    /// Of what it is the sum, where harmonics were balanced.
    pub harmonics: Option<Harmonics>,
    /// Steps of the shortest contact of a spring that is free at other times; none where there is none.
    pub contact_steps: Option<usize>,
}

/// Harmonics of which a motion was made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonics {
    /// How many beside the mean.
    pub count: usize,
    /// Instants of the cycle at which forces were sampled.
    pub instants: usize,
    /// Corrections of Newton's method.
    pub corrections: usize,
    /// What twice as many change, where that was found.
    pub change: Option<StepError>,
    /// What a march over the cycle, from the same start, has otherwise.
    pub steps: StepError,
}

impl Periodic {
    /// The largest multiplier that is no verdict, if there is one.
    pub fn doubtful(&self) -> Option<&Multiplier> {
        doubtful(&self.multipliers)
    }
}

//! The steady state: every spring force and every displacement of a journal repeats from cycle to cycle.
//!
//! That a cycle is like the one before does not say that it is like those to come: a resonance with a damping ratio ζ grows by
//! 2πζ of what is left a period. So what is left is estimated (`remaining`). The paper asks for the repetition alone (section 5.1),
//! which `one_cycle` does.
//!
//! ```text
//! reached    when it was: what `remaining` and `one_cycle` find, from the signals of a cycle in samples
//! settled    from when on it may be told
//! ```

mod one_cycle;
mod reached;
mod remaining;
mod samples;
mod settled;

use serde::{Deserialize, Serialize};

use self::one_cycle::OneCycle;
use self::remaining::Remaining;
use self::samples::Samples;

pub use self::reached::SteadyState;
pub(crate) use self::settled::settled_from;

/// How a steady state is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SteadyRule {
    /// What is left to change is estimated as less than 1 % of what varies in a cycle.
    #[default]
    Remaining,
    /// A cycle repeats the one before to 1 %, and those that follow are no larger or smaller (paper, section 5.1).
    OneCycle,
}

impl SteadyRule {
    /// Cycles before which no steady state can be told.
    pub const fn cycles(self) -> usize {
        match self {
            SteadyRule::Remaining => remaining::LEAST_CYCLES,
            SteadyRule::OneCycle => 2,
        }
    }
}

/// Tells a steady state from spring forces and displacements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SteadyTest {
    samples: Samples,
    by: By,
    pub(crate) reached: Option<SteadyState>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum By {
    Remaining(Remaining),
    OneCycle(OneCycle),
}

impl SteadyTest {
    /// A test of so many forces and displacements for a cycle of `cycle` s in steps of `dt` s.
    pub(crate) fn new(rule: SteadyRule, signals: [usize; 2], cycle: f64, dt: f64) -> Self {
        let all = signals[0] + signals[1];
        let by = match rule {
            SteadyRule::Remaining => By::Remaining(Remaining::new(all)),
            SteadyRule::OneCycle => By::OneCycle(OneCycle::new(all)),
        };
        SteadyTest { samples: Samples::new(signals, cycle, dt), by, reached: None }
    }

    /// Adds forces and displacements at the end of a step, at time `t`.
    // A phase of its own in tables of where the time goes.
    #[inline(never)]
    pub(crate) fn add<'a>(&mut self, t: f64, signals: impl Iterator<Item = &'a f64> + Clone) {
        let is_sample = self.samples.add(signals.clone());
        match &mut self.by {
            By::Remaining(own) => own.add(t, &self.samples, is_sample, signals, &mut self.reached),
            By::OneCycle(own) => own.add(t, &self.samples, is_sample, signals, &mut self.reached),
        }
    }

    /// What is estimated to be left to change, as a fraction of what varies in a cycle, infinite where nothing settles; none
    /// before it can be estimated, and where it is not.
    pub(crate) fn left(&self) -> Option<f64> {
        match &self.by {
            By::Remaining(own) => own.left,
            By::OneCycle(_) => None,
        }
    }
}

#[cfg(test)]
mod tests;

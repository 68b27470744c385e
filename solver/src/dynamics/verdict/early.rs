//! The first steps of a march, which are kept until the machine is linearised behind them, and judged in its modes then. Most
//! machines are others at their start than a few steps later: springs touch, films begin to carry. One linearisation for both
//! costs half of what two do.

use super::quality_meter::{EarlyStep, QualityMeter};
use crate::equations::{Equations, State};

/// So many steps.
const EARLY: usize = 8;

impl QualityMeter {
    /// Judges a sampled step of a length, which has just ended at time `t` (s), or keeps it until it can be judged.
    pub(super) fn judge(
        &mut self,
        equations: &mut Equations,
        (time, dt): (f64, f64),
        [start, end]: [&State; 2],
    ) {
        if self.linearised.is_some() {
            return self.sample(equations, dt, start, end);
        }
        let (start, end, change) = (start.clone(), end.clone(), self.change.clone());
        self.sums.early.push(EarlyStep { time, dt, start, end, change });
        if self.sums.early.len() >= EARLY {
            self.judge_early(equations);
        }
    }

    /// Judges the steps that were kept, in the modes of the machine at the end of the last of them, where the system is evaluated.
    /// Where a mass matrix is not positive definite nothing is judged.
    pub(super) fn judge_early(&mut self, equations: &mut Equations) {
        let early = std::mem::take(&mut self.sums.early);
        let Some(last) = early.last() else { return };
        let Some(linearised) = self.linearise(equations, &last.end) else { return };
        self.add_displacement(&linearised, &early[0].start);
        self.linearised = Some(linearised);
        for step in &early {
            self.change.copy_from_slice(&step.change);
            self.sample(equations, step.dt, &step.start, &step.end);
        }
    }

    /// Judges what is left of a march that has ended.
    pub(super) fn judge_rest(&mut self, equations: &mut Equations) {
        if let Some(last) = self.sums.early.last() {
            equations.evaluate(last.time, &last.end);
            self.judge_early(equations);
        }
    }
}

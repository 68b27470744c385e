//! Where couples end that act until a speed is reached.
//!
//! A couple that ends within a step without its step being split acts for a part of the step too long or too short, which
//! makes θ wrong by O(Δt). So the step is split where the speed is reached: the time is found by a secant that keeps its
//! bracket, on speeds that are solved. The accelerations jump there, and start anew from the forces that are left.

use super::SHORTEST;
use crate::dynamics::iteration::{Ending, StepReport};
use crate::dynamics::marching::{March, accelerate};
use crate::equations::State;
use crate::error::Error;
use crate::loads::{Load, Release};

/// Speeds are the target's to this part of what a step changes them by; far below the error of the step.
const AT_TARGET: f64 = 1e-9;
/// Trials of a split; the secant takes three or four.
const TRIALS: usize = 40;

impl March<'_> {
    /// Ends the loads for which a step starts at their target or beyond it.
    pub(in crate::dynamics::marching) fn release_at_step(&mut self) {
        for (load, released) in self.machine.loads.iter().zip(&mut self.equations.released) {
            if load.target().is_some_and(|target| target.release == Release::AtStep) {
                *released |= self.machine.ends(load, &self.state.v);
            }
        }
    }

    /// How far the speeds in a state are beyond the targets of the loads that end there, as the largest of them, less
    /// rounding (rad/s); none without such loads.
    fn beyond(&self, state: &State) -> Option<f64> {
        let loads = self.machine.loads.iter().zip(&self.equations.released);
        let driving = loads.filter(|(_, released)| !**released);
        driving.filter_map(|(load, _)| self.beyond_target(load, state)).reduce(f64::max)
    }

    fn beyond_target(&self, load: &Load, state: &State) -> Option<f64> {
        let target = load.target().filter(|target| target.release == Release::Located)?;
        let theta = self.machine.places()[load.body].rotation?;
        let rounding = 4.0 * f64::EPSILON * target.speed.abs();
        Some(match target.from_above {
            true => target.speed + rounding - state.v[theta],
            false => state.v[theta] - (target.speed - rounding),
        })
    }

    /// Whether the state is at the target of a load that is to end there, or beyond it.
    pub(in crate::dynamics::marching) fn overshoots(&self) -> bool {
        self.beyond(&self.state).is_some_and(|beyond| beyond >= 0.0)
    }

    /// Solves the part of a step of `dt` from `start` at time `t` at whose end the first speed is reached that is reached
    /// within it; the whole step has been solved, with `whole`. What was solved, and its length (s).
    pub(super) fn locate(
        &mut self,
        t: f64,
        dt: f64,
        start: &State,
        whole: StepReport,
    ) -> (StepReport, f64) {
        let (Some(first), Some(last)) = (self.beyond(start), self.beyond(&self.state)) else {
            return (whole, dt);
        };
        let allowed = AT_TARGET * (last - first);
        let (mut low, mut high) = ((0.0, first), (dt, last));
        let (mut report, mut taken) = (whole, dt);
        // Of which side the last trial was, so that neither end stays (the Illinois rule).
        let mut side = 0;
        for _ in 0..TRIALS {
            if taken == high.0 && self.beyond(&self.state).is_some_and(|beyond| beyond <= allowed) {
                break;
            }
            let guess = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            // Just beyond the target, so that the speed is reached.
            let at = (guess + 0.25 * AT_TARGET * dt).max(SHORTEST * dt);
            let within = at > low.0 && at < high.0 && dt - at > SHORTEST * dt;
            if !within {
                break;
            }
            (report, taken) = (self.attempt(t, at, start), at);
            let Some(beyond) = self.beyond(&self.state) else { break };
            if report.ending != Ending::Converged {
                return (report, taken);
            }
            if beyond >= 0.0 {
                high = (at, beyond);
                low.1 *= if side == 1 { 0.5 } else { 1.0 };
                side = 1;
            } else {
                low = (at, beyond);
                high.1 *= if side == -1 { 0.5 } else { 1.0 };
                side = -1;
            }
        }
        if taken != high.0 {
            (report, taken) = (self.attempt(t, high.0, start), high.0);
        }
        (report, taken)
    }

    /// Ends the loads whose speeds are reached at time `t` (s), where a part of a step has just ended, and starts the
    /// accelerations anew.
    pub(in crate::dynamics::marching) fn release(&mut self, t: f64) -> Result<(), Error> {
        for place in 0..self.machine.loads.len() {
            let beyond = self.beyond_target(&self.machine.loads[place], &self.state);
            self.equations.released[place] |= beyond.is_some_and(|beyond| beyond >= 0.0);
        }
        accelerate(&mut self.equations, t, &mut self.state)?;
        self.meters.jump(&self.equations);
        Ok(())
    }
}

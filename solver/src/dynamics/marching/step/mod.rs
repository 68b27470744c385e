//! A step (`attempt`). It is split where something jumps within it (`jumps`), where it would miss rows of tables (`cuts`), and where
//! couples end that act until a speed is reached (`release`).
//!
//! The parts in which a step is taken: one where steps are fixed and nothing happens within them; those that the control of
//! the step chooses; halves of what is not solved, or is beyond the tolerance.

mod attempt;
mod cuts;
mod jumps;
mod release;

use super::march::March;
use crate::dynamics::iteration::{Coefficients, Ending};
use crate::dynamics::lengths::{FORESEEN, MOST_HALVINGS, MOST_SPLITS, most_halvings};
use crate::equations::State;
use crate::error::Error;

/// Parts of a step shorter than this part of it are none.
const SHORTEST: f64 = 1e-6;

impl March<'_> {
    /// Takes a step of `dt` from time `t` in parts of lengths that are chosen on the way.
    pub(super) fn step_in_parts(&mut self, t: f64, dt: f64) -> Result<(), Error> {
        if self.meters.begins() {
            self.foresee(t, dt);
        }
        let shortest = dt / f64::from(1_u32 << MOST_HALVINGS);
        let mut at = 0;
        while at < 1 << MOST_HALVINGS {
            let halvings = self.meters.halvings();
            let length = 1_u32 << (MOST_HALVINGS - halvings);
            let span = (t + f64::from(at) * shortest, f64::from(length) * shortest);
            self.step(span.0, span.1, halvings)?;
            at += length;
            self.meters.lengthen(at);
        }
        Ok(())
    }

    /// Foresees the first rows from time `t` on, each in one step, for how far the machine moves in them; as far as they are solved
    /// and make little energy; how far says a rough solution. Then the march begins where it stood.
    fn foresee(&mut self, t: f64, dt: f64) {
        let (begun, most_force) = (self.state.clone(), self.newton.largest_force());
        let mut start = begun.clone();
        self.newton.roughly();
        for row in 0..FORESEEN {
            let report = self.attempt(t + f64::from(row) * dt, dt, &start);
            let solved = report.ending == Ending::Converged;
            if !solved || !self.meters.foresee(&self.equations, [&start, &self.state]) {
                break;
            }
            start.copy_from(&self.state);
        }
        self.newton.thoroughly(self.options.newton);
        self.newton.forget(most_force);
        self.state.copy_from(&begun);
        self.equations.evaluate(t, &self.state);
        self.meters.turn_back(&self.equations);
    }

    /// Takes a step of `dt` from time `t`: in two parts if a load ends within it, in halves if it does not converge, is beyond the
    /// tolerance, or passes rows of a table over an angle or a speed unseen. `depth`: of such parts in parts; `halvings`: of a
    /// step, which led to `dt`.
    fn part(&mut self, (t, dt): (f64, f64), depth: usize, halvings: u32) -> Result<(), Error> {
        let mut start = std::mem::replace(&mut self.starts[depth], State::new(0));
        start.copy_from(&self.state);
        let most_force = self.newton.largest_force();
        let (mut report, mut taken) = (self.attempt(t, dt, &start), dt);
        if report.ending == Ending::Converged && self.overshoots() {
            (report, taken) = self.locate(t, dt, &start, report);
        }
        let hides = report.ending == Ending::Converged
            && depth < MOST_SPLITS
            && self.hides_rows(taken, &start);
        let may_halve = hides
            || halvings < most_halvings(self.options.automatic.is_some(), &self.options.newton);
        let ending = match report.ending {
            Ending::Converged if hides => None,
            Ending::Converged => {
                let judged = self.meters.judge(&self.equations, (t, taken), [&start, &self.state]);
                // What is no number is beyond every tolerance.
                if judged <= 1.0 || !may_halve { Some(judged) } else { None }
            }
            Ending::Failed => None,
        };
        let solved = match ending {
            Some(judged) => {
                let row_error = report.row_error;
                let step = Coefficients::new(self.integrator, taken);
                let linearised = match &mut self.linear {
                    Some(linear) => linear.add(&mut self.equations, step, &self.state),
                    None => Ok(()),
                };
                self.meters.add(&mut self.equations, (t, taken), &start, &self.state, row_error);
                self.meters.accept(judged, halvings);
                self.equations.springs.observe(&self.machine.springs, t + taken);
                linearised.and_then(|()| match self.overshoots() {
                    true => self.release(t + taken).and_then(|()| match taken < dt {
                        true => self.part((t + taken, dt - taken), depth + 1, halvings),
                        false => Ok(()),
                    }),
                    false => Ok(()),
                })
            }
            None if may_halve => {
                let failed = report.ending == Ending::Failed;
                if failed {
                    let at = self.newton.failed_at(&self.equations, &report);
                    self.tally.halvings.count(depth == 0, at);
                }
                self.meters.reject();
                self.newton.forget(most_force);
                self.state.copy_from(&start);
                let (half, halvings) = (0.5 * dt, halvings + u32::from(!hides));
                let first = self.part((t, half), depth + 1, halvings);
                first.and_then(|()| self.part((t + half, half), depth + 1, halvings))
            }
            None => {
                // What is kept, energies included, ends at the last state that solves its equations.
                self.state.copy_from(&start);
                Err(self.diverged(t + dt, dt, &report))
            }
        };
        self.starts[depth] = start;
        solved
    }
}

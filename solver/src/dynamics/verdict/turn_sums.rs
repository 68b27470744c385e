//! What is measured of turns for the verdict.
//!
//! In θ̈ = −λθ̇ the acceleration changes by −λ times what the speed does, and from λΔt = 2 on both change their signs in each
//! step of the trapezoidal rule, while the turn hardly moves: the change of the acceleration says nothing of its error there, and
//! what rings is measured by itself. In θ̈ = −ω²θ acceleration and speed change against each other in half of the time only, so that
//! steps which are far too long for it still count.

use serde::{Deserialize, Serialize};

use super::histogram::Histogram;
use super::rings::LASTS;
use crate::dynamics::motion::{FreeTurn, larger, reach, widen};
use crate::equations::State;

/// What is carried of a turn for the verdict.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct TurnSums {
    /// Least and largest speed (rad/s).
    speeds: [f64; 2],
    /// Of the rows that were sampled: errors of the steps that resolve it (rad), by what it changed its speed in each row, to and
    /// fro (rad/s), and the largest of both.
    pub(super) errors: Histogram,
    changes: Histogram,
    pub(super) largest_error: f64,
    largest_change: f64,
    /// The largest error of a step by which it is not resolved (rad).
    unresolved: f64,
    step: StepSums,
}

/// What was measured of a step so far, of which there may be parts.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct StepSums {
    /// Of the parts that resolve it, if there are any (rad).
    error: Option<f64>,
    /// How much it changed its speed in the row (rad/s).
    change: f64,
}

impl TurnSums {
    /// From a state on.
    pub(super) fn new(turn: &FreeTurn, start: &State) -> Self {
        TurnSums {
            speeds: [turn.of(|place| start.v[place]); 2],
            errors: Histogram::new(),
            changes: Histogram::new(),
            largest_error: 0.0,
            largest_change: 0.0,
            unresolved: 0.0,
            step: StepSums::default(),
        }
    }

    /// Takes the end of a step, or of a part of one.
    pub(super) fn take(&mut self, turn: &FreeTurn, end: &State) {
        widen(&mut self.speeds, turn.of(|place| end.v[place]));
    }

    /// Measures a step of `dt` s, or a part of one, of which errors are `factor` times the change of accelerations. Those of parts
    /// that follow each other add up.
    pub(super) fn measure(
        &mut self,
        turn: &FreeTurn,
        (factor, dt): (f64, f64),
        [start, end]: [&State; 2],
    ) {
        let speed = turn.of(|place| end.v[place] - start.v[place]);
        let acceleration = turn.of(|place| end.a[place] - start.a[place]);
        let lag = turn.of(|place| end.lag[place] - start.lag[place]);
        let error = factor * (acceleration + dt * lag).abs();
        self.step.change += speed.abs();
        // λΔt > 2.
        if -acceleration * dt * speed > 2.0 * speed * speed {
            self.unresolved = larger(self.unresolved, error);
        } else {
            self.step.error = Some(self.step.error.unwrap_or(0.0) + error);
        }
    }

    /// Ends a step that was measured, and stands for so many.
    pub(super) fn end_step(&mut self, stands_for: u64) {
        if let Some(error) = self.step.error.take() {
            self.errors.add_times(error, stands_for);
            self.largest_error = larger(self.largest_error, error);
        }
    }

    /// Ends a row that was measured, and its step.
    pub(super) fn end_row(&mut self, stands_for: u64) {
        self.end_step(stands_for);
        let change = std::mem::take(&mut self.step.change);
        self.changes.add_times(change, stands_for);
        self.largest_change = larger(self.largest_change, change);
    }

    /// Whether a step resolved it.
    pub(super) fn is_judged(&self) -> bool {
        self.errors.count() > 0
    }

    /// The error that 95 % of the steps stay below; classes round up (rad). Where none resolves it, and there are too few for
    /// ringing to be told, that of the others.
    pub(super) fn error(&self) -> f64 {
        if self.errors.count() == 0 && (self.changes.count() as f64) < LASTS + 3.0 {
            return self.unresolved;
        }
        self.errors.below(0.95).min(self.largest_error)
    }

    /// How far it departs from a uniform turn in rows of `dt` s (rad), by the acceleration that 95 % of them stay below, as for
    /// errors: a short pulse says nothing of the swing beside it.
    pub(super) fn reach(&self, dt: f64) -> f64 {
        let change = self.changes.below(0.95).min(self.largest_change);
        reach(self.speeds, change / dt, dt)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn turn() -> FreeTurn {
        FreeTurn { body: 0, row: vec![(0, 1.0)], radius: 1.0 }
    }

    fn state(speed: f64, acceleration: f64) -> State {
        State { v: vec![speed], a: vec![acceleration], ..State::new(1) }
    }

    /// Of θ̈ = t the trapezoidal rule misses h³/12 in a part of h s.
    #[test]
    fn parts_of_a_step_count_by_their_own_lengths_as_one() {
        for parts in [vec![1.0], vec![0.5, 0.5], vec![0.25, 0.75], vec![0.1; 10]] {
            let (turn, mut sums) = (turn(), TurnSums::new(&turn(), &state(0.0, 0.0)));
            let at = |t: f64| state(0.5 * t * t, t);
            let mut t = 1.0;
            for dt in &parts {
                sums.measure(&turn, (dt * dt / 12.0, *dt), [&at(t), &at(t + dt)]);
                t += dt;
            }
            sums.end_row(1);
            let exact = parts.iter().map(|dt| dt.powi(3) / 12.0).sum::<f64>();
            assert!((sums.largest_error / exact - 1.0).abs() < 1e-12, "{parts:?}");
            assert_eq!((sums.errors.count(), sums.changes.count()), (1, 1));
            assert!((sums.largest_change - 1.5).abs() < 1e-12, "{sums:?}");
        }
    }

    /// In steps of 1 s from a state, each by the trapezoidal rule: the share of them that resolve the turn, and the error.
    fn resolved(
        steps: usize,
        start: [f64; 2],
        step: impl Fn([f64; 2]) -> [f64; 2],
        a: impl Fn([f64; 2]) -> f64,
    ) -> (f64, f64) {
        let (turn, mut x) = (turn(), start);
        let mut sums = TurnSums::new(&turn, &state(x[1], a(x)));
        for _ in 0..steps {
            let next = step(x);
            sums.measure(&turn, (1.0 / 12.0, 1.0), [&state(x[1], a(x)), &state(next[1], a(next))]);
            sums.end_row(1);
            x = next;
        }
        (sums.errors.count() as f64 / steps as f64, sums.error())
    }

    #[test]
    fn a_fall_of_the_speed_is_resolved_until_it_alternates() {
        for (lambda, share) in [(0.5, 1.0), (1.99, 1.0), (2.01, 0.0), (100.0, 0.0)] {
            let factor = (1.0 - 0.5 * lambda) / (1.0 + 0.5 * lambda);
            let step = |[x, v]: [f64; 2]| [x + 0.5 * (1.0 + factor) * v, factor * v];
            let start = [0.0, 1.0];
            let found = [42, 43].map(|steps| resolved(steps, start, step, |[_, v]| -lambda * v));
            assert_eq!(found.map(|own| own.0), [share; 2], "{lambda}");
            // That of the first step, which changes most, until there is ringing to be told.
            let first = lambda * (1.0 - factor) / 12.0;
            let errors = found.map(|own| own.1);
            match share > 0.0 {
                true => assert!(errors.iter().all(|own| *own > 0.0 && *own <= first), "{errors:?}"),
                false => assert!(
                    (errors[0] / first - 1.0).abs() < 1e-12 && errors[1] == 0.0,
                    "{errors:?}"
                ),
            }
        }
    }

    /// Of a cos φ a step is left out where φ in its middle is within the last atan(½ωΔt) of the first or the third quarter.
    #[test]
    fn an_oscillation_counts_however_long_steps_are() {
        for omega in [0.1, 0.3, 1.0, 3.0, 30.0, 1e3_f64] {
            let turn = 2.0 * (0.5 * omega).atan();
            let step = |[x, v]: [f64; 2]| {
                let (x, v) = (x, v / omega);
                [x * turn.cos() + v * turn.sin(), omega * (v * turn.cos() - x * turn.sin())]
            };
            let (share, _) = resolved(20_000, [1.0, 0.0], step, |[x, _]| -omega * omega * x);
            let exact = 1.0 - (0.5 * omega).atan() / PI;
            // Half of the last sweep through all phases, of which there are 25 in the longest steps.
            assert!((share - exact).abs() < 0.02, "{omega}: {share} for {exact}");
        }
    }
}

//! What steps make of the inertia of bodies that turn.
//!
//! Equations stand in a frame that turns, so what stands in space, or moves there slowly, goes round in it once a revolution.
//! The trapezoidal rule gives its rates as if it went round faster, by (ΩΔt)²/12: inertia, Coriolis and centrifugal forces, which
//! cancel but for what little the motion accelerates in space, no longer do. Beside a soft support what is left may be larger
//! than the forces that hold the body, though each step has a small local error. So it is computed: rates without the error of the
//! rule, from five accelerations that follow each other, and the inertia forces with these and with those of the steps.

use serde::{Deserialize, Serialize};

use super::histogram::Histogram;
use super::sampling::{is_sampled, stands_for};
use crate::dynamics::motion::{larger, ratio};
use crate::equations::State;

/// States that are looked at together.
const TOGETHER: usize = 5;

/// Of the steps that are sampled one after the other it is measured in one of so many.
const EVERY: u64 = 4;
/// Fourth differences of accelerations over second ones of smooth motion.
const SMOOTH: f64 = 0.5;

/// What is carried of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct InSpace {
    /// The states that followed each other last, so many of them, in steps of a length (s).
    states: Vec<State>,
    filled: usize,
    dt: f64,
    /// By parts of the machine what was false, and the largest force of those that hold it, or of those that its bores take, both
    /// as accelerations (m/s²).
    errors: Vec<Histogram>,
    forces: Vec<f64>,
}

impl InSpace {
    /// Of so many coordinates and parts.
    pub(super) fn new(coordinates: usize, parts: usize) -> Self {
        InSpace {
            states: vec![State::new(coordinates); TOGETHER],
            filled: 0,
            dt: 0.0,
            errors: vec![Histogram::new(); parts],
            forces: vec![0.0; parts],
        }
    }

    /// What 95 % of the steps stay below of a part, as a fraction of its largest force.
    pub(super) fn error(&self, part: usize) -> f64 {
        ratio(self.errors[part].below(0.95), self.forces[part])
    }

    /// Whether a step is one of those by which it is measured, at their last.
    pub(super) fn needs(step: u64) -> bool {
        (step..step + TOGETHER as u64 - 1).any(|step| weight(step).is_some())
    }

    /// Has the next states follow none.
    pub(super) fn forget(&mut self) {
        self.filled = 0;
    }

    /// Adds what was false of a part, and what holds it, as accelerations (m/s²), for so many steps.
    pub(super) fn add(&mut self, part: usize, [error, force]: [f64; 2], stands_for: u64) {
        self.errors[part].add_times(error, stands_for);
        self.add_force(part, force);
    }

    /// Adds a force of a part, as an acceleration (m/s²).
    pub(super) fn add_force(&mut self, part: usize, force: f64) {
        self.forces[part] = larger(self.forces[part], force);
    }

    /// The state in the middle of those that follow each other.
    pub(super) fn middle(&self) -> &State {
        &self.states[TOGETHER / 2]
    }

    /// Keeps the ends of a step of `dt` s; whether five states follow each other.
    pub(super) fn keep(&mut self, dt: f64, [start, end]: [&State; 2]) -> bool {
        if self.filled == 0 || dt != self.dt {
            self.states[0].copy_from(start);
            (self.filled, self.dt) = (1, dt);
        }
        if self.filled == TOGETHER {
            self.states.rotate_left(1);
            self.filled -= 1;
        }
        self.states[self.filled].copy_from(end);
        self.filled += 1;
        self.filled == TOGETHER
    }

    /// Gives a state like that in the middle the rates that the motion has: less what the trapezoidal rule adds to them. Whether
    /// it is as smooth as that takes: of e^{iωt} fourth differences are (ωΔt)² of second ones, where forces have kinks they are more.
    pub(super) fn correct(&self, out: &mut State) -> bool {
        let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|place| &self.states[place]);
        out.copy_from(c);
        let [mut seconds, mut fourths] = [0.0, 0.0];
        for i in 0..out.a.len() {
            let [a, b, c, d, e] = [a.a[i], b.a[i], c.a[i], d.a[i], e.a[i]];
            let (second, fourth) = (d - 2.0 * c + b, e - 4.0 * (d + b) + 6.0 * c + a);
            seconds += second * second;
            fourths += fourth * fourth;
            let (first, third) = (0.5 * (d - b), 0.5 * (e - 2.0 * (d - b) - a));
            // Of e^{iωt} with s = sin ωΔt/2: 2s²/3 + 7s⁴/45 of the acceleration, Δt (1/12 + s²/30) of its central difference.
            out.a[i] -= -second / 6.0 + 7.0 / 720.0 * fourth;
            out.v[i] -= -self.dt * (first / 12.0 - third / 120.0);
        }
        fourths <= SMOOTH * SMOOTH * seconds
    }
}

/// For how many steps one stands at which it is measured; none where it is not.
pub(super) fn weight(step: u64) -> Option<u64> {
    match stands_for(step) {
        1 => step.is_multiple_of(EVERY).then_some(EVERY),
        more => is_sampled(step).then_some(more),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rates of cos ωt and sin ωt by the trapezoidal rule become those that they have.
    #[test]
    fn rates_lose_what_the_rule_adds_to_them() {
        for angle in [0.05_f64, 0.26] {
            let (dt, omega) = (0.01, angle / 0.01);
            let false_omega = 2.0 / dt * (0.5 * angle).tan();
            let state = |step: f64| {
                let (sin, cos) = (step * angle).sin_cos();
                let v = vec![-false_omega * sin, false_omega * cos];
                let a = vec![-false_omega.powi(2) * cos, -false_omega.powi(2) * sin];
                State { q: vec![cos, sin], v, a, ..State::new(2) }
            };
            let mut own = InSpace::new(2, 0);
            let kept: Vec<bool> = (0..4)
                .map(|k| own.keep(dt, [&state(f64::from(k)), &state(f64::from(k + 1))]))
                .collect();
            assert_eq!(kept, [false, false, false, true]);
            let mut found = State::new(2);
            assert!(own.correct(&mut found));
            let (sin, cos) = (2.0 * angle).sin_cos();
            // Of the error of the rule, 1/12, what is left falls with its fourth power.
            let left = 0.02 * angle.powi(6) * omega;
            assert!((found.v[0] + omega * sin).abs() < left, "{}", found.v[0]);
            assert!((found.v[1] - omega * cos).abs() < left, "{}", found.v[1]);
            assert!((found.a[0] + omega.powi(2) * cos).abs() < left * omega, "{}", found.a[0]);
            assert!((found.a[1] + omega.powi(2) * sin).abs() < left * omega, "{}", found.a[1]);
        }
    }
}

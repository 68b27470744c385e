//! How a machine is marched, and how its bodies begin.

use crate::dynamics::iteration::{Integrator, NewtonOptions};
use crate::dynamics::lengths::AutomaticStep;
use crate::dynamics::steady::SteadyRule;
use crate::equations::State;
use crate::machine::BodyPlace;

/// How far and how a machine is marched.
#[derive(Debug, Clone, PartialEq)]
pub struct MarchOptions {
    /// Δt (s): from one row to the next, of the steady-state test and of what is summed up over cycles, too.
    pub time_step: f64,
    /// Whether every step is integrated in parts, which the march chooses; in one otherwise.
    pub automatic: Option<AutomaticStep>,
    /// Number of steps.
    pub steps: usize,
    /// How steps are integrated.
    pub integrator: Integrator,
    /// How each step is solved.
    pub newton: NewtonOptions,
    /// Cycle of the steady-state test (s), if it is to be made.
    pub cycle: Option<f64>,
    /// How the steady state is told.
    pub steady_rule: SteadyRule,
    /// Whether to stop at the steady state.
    pub stop_when_steady: bool,
    /// How the bodies begin, in their order; those that are missing begin at rest.
    pub initial: Vec<BodyStart>,
    /// Whether all states of laws begin where their rates are zero, whatever the laws say.
    pub laws_at_rest: bool,
}

impl MarchOptions {
    /// Δt (s), if the march takes equal steps by the trapezoidal rule.
    pub fn equal_step(&self) -> Option<f64> {
        let equal = self.automatic.is_none() && self.integrator == Integrator::default();
        equal.then_some(self.time_step)
    }
}

/// A body at t = 0.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyStart {
    /// θ (rad), where it is an unknown.
    pub angle: f64,
    /// θ̇ (rad/s), where it is an unknown.
    pub speed: f64,
    /// η, or x_b; empty for zero.
    pub position: Vec<f64>,
    /// Their rates; empty for zero.
    pub velocity: Vec<f64>,
}

impl BodyStart {
    /// Writes it into a state of the machine, where the coordinates of the body stand.
    pub(crate) fn write(&self, place: &BodyPlace, state: &mut State) {
        let first = place.flexible.start;
        state.q[first..first + self.position.len()].copy_from_slice(&self.position);
        state.v[first..first + self.velocity.len()].copy_from_slice(&self.velocity);
        if let Some(theta) = place.rotation {
            (state.q[theta], state.v[theta]) = (self.angle, self.speed);
        }
    }
}

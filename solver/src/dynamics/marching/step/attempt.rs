//! One step of Newmark's method: the state is predicted, solved at its end, and corrected.

use crate::dynamics::iteration::{Coefficients, StepReport};
use crate::dynamics::marching::March;
use crate::equations::State;

impl March<'_> {
    /// Solves a step of `dt` from `start` at time `t`.
    pub(in crate::dynamics::marching) fn attempt(
        &mut self,
        t: f64,
        dt: f64,
        start: &State,
    ) -> StepReport {
        let step = Coefficients::new(self.integrator, dt);
        step.predict(start, &mut self.state);
        self.set_given(t + dt, self.equations.before);
        let report = self.newton.solve(&mut self.equations, t + dt, &step, &mut self.state);
        self.equations.springs.keep_states(&mut self.state.laws);
        step.end(start, self.machine.first_unknown(), &mut self.state);
        self.last_iterations += report.iterations;
        report
    }
}

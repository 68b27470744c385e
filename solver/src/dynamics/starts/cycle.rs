//! A march over one stretch of time again and again, each time from another state: the cycle of periodic motions.

use crate::bearing::LawStates;
use crate::dynamics::marching::{Clock, LinearSteps, March, MarchOptions, accelerate};
use crate::equations::State;
use crate::error::Error;
use crate::machine::Machine;

impl<'m> March<'m> {
    /// A march that begins at time `t` (s), with the positions and rates of a state, what the machine is given apart; its
    /// accelerations follow from the forces there.
    ///
    /// # Errors
    /// A mass matrix that cannot be inverted.
    pub(crate) fn at(
        machine: &'m Machine,
        options: &MarchOptions,
        mut state: State,
        t: f64,
    ) -> Result<Self, Error> {
        machine.set_given(t, false, [&mut state.q, &mut state.v, &mut state.a]);
        let released = machine.loads.iter().map(|load| machine.ends(load, &state.v)).collect();
        let mut march = March::begin(machine, options, (state, released, t), true)?;
        march.go_on(Clock { time: t, step: 0 }, t, None);
        Ok(march)
    }

    /// Goes back to time `t` (s), to other positions and rates of the unknowns, and to what laws remember there. What was measured of
    /// steps and laws goes on.
    ///
    /// # Errors
    /// A mass matrix that cannot be inverted.
    pub(crate) fn go_back(
        &mut self,
        t: f64,
        [q, v]: [&[f64]; 2],
        laws: LawStates,
    ) -> Result<(), Error> {
        let first = self.machine.first_unknown();
        let state = &mut self.state;
        state.laws = laws;
        state.q[first..].copy_from_slice(q);
        state.v[first..].copy_from_slice(v);
        self.machine.set_given(t, false, [&mut state.q, &mut state.v, &mut state.a]);
        accelerate(&mut self.equations, t, &mut self.state)?;
        self.meters.turn_back(&self.equations);
        self.tally.step = 0;
        self.go_on(Clock { time: t, step: 0 }, t, None);
        match &mut self.linear {
            Some(own) => own.begin(&mut self.equations, &self.state),
            None => Ok(()),
        }
    }

    /// Has the next steps linearised, or no longer; gives what was found of those before.
    pub(crate) fn linearise(
        &mut self,
        steps: Option<Box<LinearSteps>>,
    ) -> Option<Box<LinearSteps>> {
        std::mem::replace(&mut self.linear, steps)
    }

    /// Forces of all springs at the end of the last step (N).
    pub(crate) fn forces(&self) -> &[f64] {
        &self.equations.springs.forces
    }
}

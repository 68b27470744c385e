//! The cycle map: what a march over a cycle makes of the state with which it begins.
//!
//! The state x has the positions and rates of all unknowns; accelerations follow from r = 0 at the start. What turns by whole
//! turns is turned back by them, so that a periodic motion is a fixed point.

use super::common::speeds;
use super::cycle::Cycle;
use super::in_space::InSpace;
use crate::dynamics::{
    BodyStart, Changes, Integrator, LinearStep, LinearSteps, March, MarchOptions, NewtonOptions,
    Outcome, SteadyRule,
};
use crate::equations::State;
use crate::error::{Error, PeriodicError};
use crate::history::History;
use crate::linalg::Matrix;
use crate::machine::Machine;

/// The cycle map of a machine.
pub struct CycleMap<'m> {
    machine: &'m Machine,
    cycle: Cycle,
    options: MarchOptions,
    march: March<'m>,
    /// By how much rotations that are unknown advance (rad), by their places among the unknowns.
    turns: Vec<f64>,
    /// How bodies are turned back whose rotation does not repeat with the cycle.
    back: Option<InSpace>,
    cycles: usize,
}

/// The cycle of a motion, step by step.
pub(super) struct Orbit {
    /// The rows of a history, those of the steps.
    pub(super) history: History,
    /// What the steps were worth.
    pub(super) outcome: Outcome,
    /// Forces of all springs, step by step (N).
    pub(super) forces: Matrix,
}

impl<'m> CycleMap<'m> {
    /// The map of a machine over a cycle, each step solved to rounding.
    ///
    /// # Errors
    /// What the machine is told does not repeat, or a rotation is not known; a mass matrix that cannot be inverted.
    pub fn new(machine: &'m Machine, cycle: Cycle, newton: NewtonOptions) -> Result<Self, Error> {
        let turns = cycle.turns(machine)?;
        let turns = turns[machine.first_unknown()..].to_vec();
        CycleMap::with(machine, cycle, newton, (turns, None))
    }

    /// The same over a stretch of time in which nothing that the machine is told changes, and all bodies that turn are round: they need
    /// not turn by whole turns.
    ///
    /// # Errors
    /// A speed that is not known; a mass matrix that cannot be inverted.
    pub(super) fn free(
        machine: &'m Machine,
        cycle: Cycle,
        newton: NewtonOptions,
    ) -> Result<Self, Error> {
        let speeds = speeds(machine)?;
        let unknown = machine.first_unknown()..machine.rotations();
        let turned = unknown.map(|place| speeds[machine.owner(place).body] * cycle.period);
        let back = InSpace::new(machine, &speeds)?;
        CycleMap::with(machine, cycle, newton, (turned.collect(), Some(back)))
    }

    fn with(
        machine: &'m Machine,
        cycle: Cycle,
        newton: NewtonOptions,
        (turns, back): (Vec<f64>, Option<InSpace>),
    ) -> Result<Self, Error> {
        let springs = &machine.springs;
        if let Some(plane) = springs.remembering(|_| true).or_else(|| springs.with_film(|_| true)) {
            let (joint, law) = machine.names_of(plane);
            return Err(PeriodicError::Remembers { joint, law }.into());
        }
        let options = MarchOptions {
            time_step: cycle.time_step(),
            automatic: None,
            steps: cycle.steps,
            integrator: Integrator::default(),
            newton: NewtonOptions {
                relative_force_tolerance: f64::EPSILON,
                to_rounding: true,
                ..newton
            },
            cycle: None,
            steady_rule: SteadyRule::default(),
            stop_when_steady: false,
            laws_at_rest: false,
            initial: Vec::new(),
        };
        let march = March::at(machine, &options, State::new(machine.size()), cycle.start)?;
        Ok(CycleMap { machine, cycle, options, march, turns, back, cycles: 0 })
    }

    /// The same in twice as many steps.
    ///
    /// # Errors
    /// A mass matrix that cannot be inverted.
    pub(super) fn doubled(&self) -> Result<Self, Error> {
        let told = (self.turns.clone(), self.back.clone());
        CycleMap::with(self.machine, self.cycle.doubled(), self.options.newton, told)
    }

    /// Whether its cycle is one of the motion alone, and not of what the machine is told.
    pub(super) fn is_free(&self) -> bool {
        self.back.is_some()
    }

    /// The machine.
    pub fn machine(&self) -> &'m Machine {
        self.machine
    }

    /// The cycle.
    pub fn cycle(&self) -> Cycle {
        self.cycle
    }

    /// Number of unknowns; a state has twice as many values.
    pub fn unknowns(&self) -> usize {
        self.machine.active()
    }

    /// Cycles marched so far.
    pub fn cycles(&self) -> usize {
        self.cycles
    }

    /// Mean speeds of rotations that are unknown (rad/s), by their places among the unknowns.
    pub(super) fn speeds(&self) -> Vec<f64> {
        self.turns.iter().map(|turn| turn / self.cycle.period).collect()
    }

    /// Turns changes of a state at the end of the cycle back, as the state is.
    pub(super) fn turn_back(&self, change: &mut [f64]) {
        if let Some(space) = &self.back {
            let (q, v) = change.split_at_mut(self.unknowns());
            space.positions(q, self.cycle.period);
            space.positions(v, self.cycle.period);
        }
    }

    /// As [`CycleMap::apply`], with the positions of the unknowns over the cycle, what they turn by taken off: a column a step, from the
    /// end of the cycle on, which is its start.
    ///
    /// # Errors
    /// As there.
    pub(super) fn positions(&mut self, x: &mut [f64]) -> Result<Matrix, Error> {
        self.begin(x)?;
        self.cycles += 1;
        let (first, rows, steps) =
            (self.machine.first_unknown(), self.unknowns(), self.cycle.steps);
        let mut all = Matrix::zeros(rows, steps);
        for step in 1..=steps {
            self.march.advance()?;
            let share = step as f64 / steps as f64;
            let column = all.col_mut(step % steps);
            column.copy_from_slice(&self.march.state().q[first..]);
            column.iter_mut().zip(&self.turns).for_each(|(q, turn)| *q -= share * turn);
        }
        self.end(x);
        Ok(all)
    }

    /// Marches a cycle from a state x, which is replaced by the one at its end, turned back.
    ///
    /// # Errors
    /// A step that does not converge, however short.
    pub fn apply(&mut self, x: &mut [f64]) -> Result<(), Error> {
        self.begin(x)?;
        self.cycles += 1;
        for _ in 0..self.cycle.steps {
            self.march.advance()?;
        }
        self.end(x);
        Ok(())
    }

    /// As [`CycleMap::apply`], with its derivative: 2n × 2n, by the state at the start.
    ///
    /// # Errors
    /// As there.
    pub fn monodromy(&mut self, x: &mut [f64]) -> Result<Matrix, Error> {
        let n = self.unknowns();
        let unit = Changes::new(n, 2 * n, |i, j| f64::from(u8::from(i == j)));
        let steps = self.linearised(x, LinearSteps::new(unit, false))?;
        let mut whole = Matrix::from_fn(2 * n, 2 * n, |i, j| steps.changes.value(i, j));
        (0..2 * n).for_each(|j| self.turn_back(whole.col_mut(j)));
        Ok(whole)
    }

    /// As [`CycleMap::apply`], with its steps linearised about it.
    ///
    /// # Errors
    /// As there.
    pub(super) fn steps(&mut self, x: &mut [f64]) -> Result<Vec<LinearStep>, Error> {
        let nothing = Changes::new(self.unknowns(), 0, |_, _| 0.0);
        Ok(self.linearised(x, LinearSteps::new(nothing, true))?.into_steps())
    }

    fn linearised(&mut self, x: &mut [f64], steps: LinearSteps) -> Result<LinearSteps, Error> {
        self.march.linearise(Some(Box::new(steps)));
        let done = self.apply(x);
        let steps = self.march.linearise(None).expect("it was put there");
        done?;
        Ok(*steps)
    }

    /// The motion from a state, measured by itself.
    ///
    /// # Errors
    /// As [`CycleMap::apply`].
    pub(super) fn orbit(&mut self, x: &[f64]) -> Result<Orbit, Error> {
        let state = self.state(x);
        self.march = March::at(self.machine, &self.options, state, self.cycle.start)?;
        self.cycles += 1;
        let mut history = History::for_machine(self.machine);
        let mut forces = Vec::with_capacity(self.march.forces().len() * self.cycle.steps);
        for _ in 0..self.cycle.steps {
            self.march.advance()?;
            history.push(self.march.row());
            forces.extend_from_slice(self.march.forces());
        }
        let rows = self.march.forces().len();
        let forces = Matrix { rows, cols: self.cycle.steps, data: forces };
        let state = State::new(self.machine.size());
        let next = March::at(self.machine, &self.options, state, self.cycle.start)?;
        let outcome = std::mem::replace(&mut self.march, next).outcome();
        Ok(Orbit { history, outcome, forces })
    }

    /// x of bodies that begin somewhere.
    pub fn beginning(&self, bodies: &[BodyStart]) -> Vec<f64> {
        let mut state = State::new(self.machine.size());
        for (own, place) in bodies.iter().zip(self.machine.places()) {
            own.write(place, &mut state);
        }
        let first = self.machine.first_unknown();
        [&state.q[first..], &state.v[first..]].concat()
    }

    /// The state of the machine with x.
    pub(super) fn state(&self, x: &[f64]) -> State {
        let first = self.machine.first_unknown();
        let (q, v) = x.split_at(self.unknowns());
        let mut state = State::new(self.machine.size());
        state.q[first..].copy_from_slice(q);
        state.v[first..].copy_from_slice(v);
        let start = self.cycle.start;
        self.machine.set_given(start, false, [&mut state.q, &mut state.v, &mut state.a]);
        state
    }

    fn begin(&mut self, x: &[f64]) -> Result<(), Error> {
        let (q, v) = x.split_at(self.unknowns());
        self.march.go_back(self.cycle.start, [q, v])
    }

    fn end(&self, x: &mut [f64]) {
        let first = self.machine.first_unknown();
        let (q, v) = x.split_at_mut(self.unknowns());
        let state = self.march.state();
        q.copy_from_slice(&state.q[first..]);
        v.copy_from_slice(&state.v[first..]);
        q.iter_mut().zip(&self.turns).for_each(|(q, turn)| *q -= turn);
        self.turn_back(x);
    }
}

//! The cycle map: what a march over a cycle makes of the state with which it begins.
//!
//! The state x has the positions and rates of all unknowns, and what laws and films remember; accelerations follow from r = 0 at the
//! start. What turns by whole turns is turned back by them, so that a periodic motion is a fixed point.

use super::common::speeds;
use super::cycle::Cycle;
use super::in_space::InSpace;
use crate::bearing::Alike;
use crate::dynamics::{
    BodyStart, Changes, Integrator, LinearStep, LinearSteps, March, MarchOptions, NewtonOptions,
    Outcome, SteadyRule,
};
use crate::equations::{Equations, State};
use crate::error::{Error, PeriodicError};
use crate::history::History;
use crate::linalg::Matrix;
use crate::machine::Machine;

/// Values of a state of which the whole derivative is found: by the steps' own tangents, and by differences, where laws remember.
const WHOLE: [usize; 2] = [120, 60];

/// Values that films may remember in a branch.
const BRANCHED: usize = 200;

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
    /// What laws and films remember: alike values side by side, behind positions and rates.
    remembered: Vec<Alike>,
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

/// A state in which nothing moves, with laws as they begin.
fn resting(machine: &Machine) -> State {
    State { laws: machine.springs.beginning(), ..State::new(machine.size()) }
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
        let remembered = machine.springs.remembered();
        let march = March::at(machine, &options, resting(machine), cycle.start)?;
        Ok(CycleMap { machine, cycle, options, march, turns, back, remembered, cycles: 0 })
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

    /// Number of unknowns; a state has twice as many values, and those that laws remember.
    pub fn unknowns(&self) -> usize {
        self.machine.active()
    }

    /// Number of values of a state.
    pub fn size(&self) -> usize {
        2 * self.unknowns() + self.memory()
    }

    /// That laws and films remember so few values that a branch may take a cycle for each of them at every point.
    ///
    /// # Errors
    /// A film has more.
    pub fn suits_branches(&self) -> Result<(), PeriodicError> {
        let most = self.machine.springs.with_film(|_| true).filter(|_| self.memory() > BRANCHED);
        match most {
            Some(plane) => {
                let (joint, law) = self.machine.names_of(plane);
                let (values, most) = (self.memory(), BRANCHED);
                Err(PeriodicError::ManyValues { joint, law, values, most })
            }
            None => Ok(()),
        }
    }

    /// Whether a state has so few values that the whole derivative is found.
    pub(super) fn is_small(&self) -> bool {
        self.size() <= WHOLE[usize::from(self.memory() > 0)]
    }

    /// Number of values that laws and films remember.
    pub(super) fn memory(&self) -> usize {
        self.remembered.last().map_or(0, |own| own.place.end)
    }

    /// Those of them that are alike.
    pub(super) fn remembered(&self) -> &[Alike] {
        &self.remembered
    }

    /// The largest values that laws and films remember on the way from a state x, which is replaced by the one at the end: of each the
    /// largest above zero, and the largest below. Steps that are not solved end the way.
    pub(super) fn reach(&mut self, x: &mut [f64]) -> Result<Vec<[f64; 2]>, Error> {
        self.begin(x)?;
        self.cycles += 1;
        let mut now = x[2 * self.unknowns()..].to_vec();
        let mut largest = vec![[0.0; 2]; now.len()];
        for step in 0..=self.cycle.steps {
            for ([above, below], value) in largest.iter_mut().zip(&now) {
                *above = f64::max(*above, *value);
                *below = f64::max(*below, -value);
            }
            if step == self.cycle.steps || self.march.advance().is_err() {
                break;
            }
            self.machine.springs.read_memory(&self.march.state().laws, &mut now);
        }
        self.end(x);
        Ok(largest)
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
            let n = self.unknowns();
            let (q, v) = change[..2 * n].split_at_mut(n);
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

    /// Marches half of the steps of a cycle, by which bodies turn half as far.
    ///
    /// # Errors
    /// As [`CycleMap::apply`].
    pub(super) fn half(&mut self, x: &mut [f64]) -> Result<(), Error> {
        self.begin(x)?;
        self.cycles += 1;
        for _ in 0..self.cycle.steps / 2 {
            self.march.advance()?;
        }
        self.end(x);
        // They were turned back by whole cycles.
        let turns = self.turns.iter();
        x.iter_mut().zip(turns).for_each(|(q, turn)| *q += 0.5 * turn);
        Ok(())
    }

    /// As [`CycleMap::apply`], with its derivative: 2n × 2n, by the state at the start, where no law remembers anything.
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
        let next = March::at(self.machine, &self.options, resting(self.machine), self.cycle.start)?;
        let outcome = std::mem::replace(&mut self.march, next).outcome();
        Ok(Orbit { history, outcome, forces })
    }

    /// x of bodies that begin somewhere, with laws as they begin, or as they are where they have been there for long.
    pub fn beginning(&self, bodies: &[BodyStart], laws_at_rest: bool) -> Vec<f64> {
        let mut state = State::new(self.machine.size());
        for (own, place) in bodies.iter().zip(self.machine.places()) {
            own.write(place, &mut state);
        }
        let first = self.machine.first_unknown();
        let mut x = [&state.q[first..], &state.v[first..]].concat();
        if self.memory() > 0 {
            let springs = &self.machine.springs;
            let start = self.cycle.start;
            self.machine.set_given(start, false, [&mut state.q, &mut state.v, &mut state.a]);
            state.laws = springs.beginning();
            if laws_at_rest {
                state.laws.settle();
            }
            let mut equations = Equations::new(self.machine);
            equations.evaluate(start, &state);
            equations.springs.keep_states(&mut state.laws);
            let mut memory = vec![0.0; self.memory()];
            springs.read_memory(&state.laws, &mut memory);
            // Where no state was found, the march finds one.
            x.extend(memory.iter().map(|own| if own.is_finite() { *own } else { 0.0 }));
        }
        x
    }

    /// The state of the machine with x.
    pub(super) fn state(&self, x: &[f64]) -> State {
        let first = self.machine.first_unknown();
        let ([q, v], memory) = self.parts(x);
        let mut state = State::new(self.machine.size());
        state.q[first..].copy_from_slice(q);
        state.v[first..].copy_from_slice(v);
        state.laws = self.machine.springs.with_memory(memory);
        let start = self.cycle.start;
        self.machine.set_given(start, false, [&mut state.q, &mut state.v, &mut state.a]);
        state
    }

    /// Positions and rates, and what laws and films remember.
    fn parts<'x>(&self, x: &'x [f64]) -> ([&'x [f64]; 2], &'x [f64]) {
        let n = self.unknowns();
        ([&x[..n], &x[n..2 * n]], &x[2 * n..])
    }

    fn begin(&mut self, x: &[f64]) -> Result<(), Error> {
        let (moved, memory) = self.parts(x);
        let laws = self.machine.springs.with_memory(memory);
        self.march.go_back(self.cycle.start, moved, laws)
    }

    fn end(&self, x: &mut [f64]) {
        let (first, n) = (self.machine.first_unknown(), self.unknowns());
        let state = self.march.state();
        let (moved, memory) = x.split_at_mut(2 * n);
        let (q, v) = moved.split_at_mut(n);
        q.copy_from_slice(&state.q[first..]);
        v.copy_from_slice(&state.v[first..]);
        q.iter_mut().zip(&self.turns).for_each(|(q, turn)| *q -= turn);
        if !memory.is_empty() {
            self.machine.springs.read_memory(&state.laws, memory);
        }
        self.turn_back(x);
    }
}

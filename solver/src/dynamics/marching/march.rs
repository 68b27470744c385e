//! Marching: predict, solve, record, step after step.

use std::ops::{ControlFlow, Range};

use super::accelerate::accelerate;
use super::checkpoint::{Checkpoint, Clock, Tally};
use super::linear_steps::LinearSteps;
use super::options::MarchOptions;
use super::outcome::{Failure, Outcome, Progress};
use super::row::{displacements, write_row};
use crate::bearing::Worst;
use crate::dynamics::iteration::{Halvings, Integrator, Newton, NewtonState, StepReport};
use crate::dynamics::lengths::{
    MOST_SPLITS, SPARE_FACTORS, Watched, jumps, most_halvings, watched,
};
use crate::dynamics::steady::{SteadyTest, settled_from};
use crate::dynamics::verdict::{EnergyBalance, Meters, Quality};
use crate::equations::{Equations, State};
use crate::error::Error;
use crate::history::History;
use crate::machine::Machine;
use crate::told::ToldTurn;

/// Marches a machine from rest (or the initial state of the options) at t = 0 and keeps the history in memory.
/// `observe` is called after every step and may stop the march.
///
/// # Errors
/// A step that does not converge, however short; the history up to there is kept.
pub fn march(
    machine: &Machine,
    options: &MarchOptions,
    observe: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Outcome, Box<Failure>> {
    let mut march = March::new(machine, options)?;
    let mut history = History::for_machine(machine);
    history.reserve(options.steps.min(1000));
    while !march.is_done() {
        if let Err(error) = march.advance() {
            let outcome = Outcome { history, ..march.outcome() };
            return Err(Box::new(Failure { error, outcome }));
        }
        history.push(march.row());
        if observe(&march.progress()).is_break() {
            break;
        }
    }
    Ok(Outcome { history, ..march.outcome() })
}

/// A march that can be advanced step by step; it keeps no rows.
pub struct March<'m> {
    pub(in crate::dynamics) machine: &'m Machine,
    pub(in crate::dynamics) options: MarchOptions,
    pub(in crate::dynamics) equations: Equations<'m>,
    pub(super) newton: Newton,
    pub(in crate::dynamics) state: State,
    clock: Clock,
    /// State at the start of the step, and memory for the ends of its parts, one a halving.
    pub(super) starts: Vec<State>,
    pub(super) last_iterations: usize,
    pub(in crate::dynamics) tally: Tally,
    pub(in crate::dynamics) meters: Meters,
    /// Rotations that were told, by their places in q.
    pub(super) turns: Vec<Option<ToldTurn>>,
    row: Vec<f64>,
    /// Values of the row before those of the outputs by request.
    usual: usize,
    /// From when on nothing changes that is told over time (s).
    settled: f64,
    /// Coordinates of bodies that no joint sees.
    alone: Vec<Range<usize>>,
    /// When loads begin and told accelerations jump (s), ascending.
    pub(super) jumps: Vec<f64>,
    /// Curves by which loads vary.
    pub(super) watched: Vec<Watched>,
    /// By which the part at work is integrated.
    pub(super) integrator: Integrator,
    /// What becomes of small changes, where that is wanted.
    pub(in crate::dynamics) linear: Option<Box<LinearSteps>>,
}

/// Of bodies on which no spring acts, by the places of their coordinates in q: their motion is told steady by these.
fn alone(machine: &Machine) -> Vec<Range<usize>> {
    let reach = &machine.springs.reach;
    let own = machine.places().iter().map(|place| place.flexible.clone());
    own.filter(|own| reach[own.clone()].iter().all(|reach| *reach == 0.0)).collect()
}

impl<'m> March<'m> {
    /// The machine at t = 0, with the accelerations that its forces give it there.
    ///
    /// # Errors
    /// A mass matrix that cannot be inverted.
    pub fn new(machine: &'m Machine, options: &MarchOptions) -> Result<Self, Box<Failure>> {
        let mut state = State::new(machine.size());
        for (start, place) in options.initial.iter().zip(machine.places()) {
            start.write(place, &mut state);
        }
        machine.set_given(0.0, false, [&mut state.q, &mut state.v, &mut state.a]);
        state.laws = machine.springs.beginning();
        if options.laws_at_rest {
            state.laws.settle();
        }
        let released = machine.loads.iter().map(|load| machine.ends(load, &state.v)).collect();
        let begun = March::begin(machine, options, (state, released, 0.0), true);
        begun.map_err(|error| {
            let outcome = Outcome {
                history: History::for_machine(machine),
                worst: vec![None; machine.springs.measures().len()],
                ..Outcome::default()
            };
            Box::new(Failure { error, outcome })
        })
    }

    /// A march from a state at `time` (s), of which accelerations are those that it has or those that forces give it.
    ///
    /// # Errors
    /// A mass matrix that cannot be inverted.
    pub(in crate::dynamics) fn begin(
        machine: &'m Machine,
        options: &MarchOptions,
        (mut state, released, time): (State, Vec<bool>, f64),
        accelerated: bool,
    ) -> Result<Self, Error> {
        let size = machine.size();
        let mut equations = Equations::new(machine);
        equations.released = released;
        match accelerated {
            true => accelerate(&mut equations, time, &mut state)?,
            false => {
                equations.evaluate(time, &state);
                equations.springs.keep_states(&mut state.laws);
            }
        }
        if options.integrator.is_direct() {
            state.lag.fill(0.0);
            state.laws.lag.fill(0.0);
        }
        let length = (options.time_step, options.automatic);
        let meters = Meters::new(&mut equations, options.integrator, length, &state)?;
        let alone = alone(machine);
        let moved = alone.iter().map(Range::len).sum::<usize>();
        let signals = [machine.springs.forces(), 2 * machine.monitors.len() + moved];
        let rule = options.steady_rule;
        let test = |cycle| SteadyTest::new(rule, signals, cycle, options.time_step);
        // Where nothing is seen, nothing is known.
        let steady = options.cycle.filter(|_| signals != [0, 0]).map(test);
        let halvings = Halvings::new(size, machine.springs.bearings);
        let tally = Tally { step: 0, iterations: 0, halvings, steady };
        // Of parts that may be long or short, or end at rows of tables, factors are kept for the lengths of which there are most.
        let watched = watched(machine);
        let cut = options.automatic.is_some() || !watched.is_empty();
        let spare = if cut { SPARE_FACTORS } else { 0 };
        let halvings = most_halvings(options.automatic.is_some(), &options.newton);
        let columns = History::for_machine(machine).names().len();
        let asked: usize = machine.outputs.iter().map(|own| own.columns().len()).sum();
        Ok(March {
            alone,
            machine,
            newton: Newton::new(options.newton, &equations, (spare, options.automatic.is_some())),
            meters,
            equations,
            // Steps are halved, and split where loads end or rows are hidden.
            starts: vec![
                State { laws: state.laws.clone(), ..State::new(size) };
                MOST_SPLITS + halvings as usize + 2 + machine.loads.len()
            ],
            state,
            clock: Clock::default(),
            last_iterations: 0,
            tally,
            turns: vec![None; machine.first_unknown()],
            row: vec![0.0; columns],
            usual: columns - asked,
            settled: settled_from(machine),
            jumps: jumps(machine),
            watched,
            integrator: options.integrator,
            linear: None,
            options: options.clone(),
        })
    }

    /// Goes on with what the iteration kept, and counts time from `clock` on; the state is that of the march.
    pub(in crate::dynamics) fn go_on(
        &mut self,
        clock: Clock,
        time: f64,
        newton: Option<NewtonState>,
    ) {
        self.clock = clock;
        if let Some(newton) = newton {
            let (released, told) = (self.equations.released.clone(), self.equations.told.clone());
            self.newton.resume_from(&mut self.equations, self.options.integrator, newton);
            (self.equations.released, self.equations.told) = (released, told);
            self.equations.evaluate(time, &self.state);
        }
    }

    /// The machine as it was at a checkpoint of a march with the same machine and options. The rows of the
    /// steps that follow, and the outcome, have the same bits as those of a march that was never interrupted.
    ///
    /// # Errors
    /// A mass matrix that cannot be inverted.
    pub fn resume(
        machine: &'m Machine,
        options: &MarchOptions,
        from: Checkpoint,
    ) -> Result<Self, Error> {
        let Checkpoint { state, time, clock, newton, meters, worst, tally, .. } = from;
        let mut march = March::new(machine, options).map_err(|failure| failure.error)?;
        let equations = &mut march.equations;
        march.newton.resume_from(equations, options.integrator, newton);
        (equations.released, equations.told) = (from.released, from.told);
        equations.evaluate(time, &state);
        equations.springs.resume(&worst);
        march.meters.resume_from(equations, meters)?;
        equations.evaluate(time, &state);
        (march.state, march.clock, march.tally) = (state, clock, tally);
        march.turns = from.turns;
        Ok(march)
    }

    /// What a march needs to go on after the last step.
    pub fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            state: self.state.clone(),
            time: self.equations.time,
            clock: self.clock,
            released: self.equations.released.clone(),
            told: self.equations.told.clone(),
            turns: self.turns.clone(),
            newton: self.newton.kept(),
            meters: self.meters.sums(),
            worst: self.worst().to_vec(),
            tally: self.tally.clone(),
        }
    }

    /// Takes one step; its row is in [`March::row`].
    ///
    /// # Errors
    /// The step does not converge.
    pub fn advance(&mut self) -> Result<(), Error> {
        let dt = self.options.time_step;
        let start = self.time();
        self.release_at_step();
        if self.overshoots() {
            self.release(start)?;
        }
        self.last_iterations = 0;
        match self.options.automatic {
            Some(_) => self.step_in_parts(start, dt)?,
            None => self.step(start, dt, 0)?,
        }
        self.meters.end_row();
        self.tally.step += 1;
        self.tally.iterations += self.last_iterations;
        self.observe();
        let time = self.time();
        let settled = time >= self.settled && self.is_released();
        if let Some(test) = self.tally.steady.as_mut().filter(|_| settled) {
            let displacements = &self.row[displacements(self.machine.monitors.len())];
            let alone = self.alone.iter().flat_map(|own| &self.state.q[own.clone()]);
            let signals = self.equations.springs.forces.iter().chain(displacements).chain(alone);
            test.add(time, signals);
        }
        Ok(())
    }

    /// Writes the row of the state as it is: before the first step, that of the start.
    pub fn observe(&mut self) {
        let time = self.time();
        let (usual, asked) = self.row.split_at_mut(self.usual);
        write_row(&self.equations, &self.state, time, self.last_iterations, usual);
        self.equations.write_outputs(&self.state, time, asked);
    }

    /// Whether no drive is on its way to its target speed.
    fn is_released(&self) -> bool {
        let mut loads = self.machine.loads.iter().zip(&self.equations.released);
        loads.all(|(load, released)| *released || load.target().is_none())
    }

    pub(super) fn diverged(&self, time: f64, dt: f64, report: &StepReport) -> Error {
        if let Some((law, bearing)) = self.equations.springs.without_value(&self.machine.springs) {
            let step = self.tally.step + 1;
            return Error::NoForce { step, time, law, bearing: bearing + 1 };
        }
        if let Some(plane) = self.equations.springs.without_slope(&self.machine.springs) {
            let (joint, law) = self.machine.names_of(plane);
            let place = format!("in step {} (t = {time:.6e} s)", self.tally.step + 1);
            return Error::NoSlope { joint, law, place };
        }
        let worst = self.newton.worst(&self.equations.residual);
        Error::NewtonDiverged {
            step: self.tally.step + 1,
            time,
            time_step: dt,
            iterations: report.iterations,
            residual: report.residual,
            force_change: report.force_change,
            worst_dof: self.machine.coordinate(worst),
        }
    }

    /// The row of the last step, one value a column of [`History::for_machine`].
    pub fn row(&self) -> &[f64] {
        &self.row
    }

    /// Time at the end of the last step (s).
    pub fn time(&self) -> f64 {
        self.clock.time + (self.clock.step + self.tally.step) as f64 * self.options.time_step
    }

    /// Time at the start (s): 0, or that of the state from which the march goes on.
    pub fn begun(&self) -> f64 {
        self.clock.time + self.clock.step as f64 * self.options.time_step
    }

    /// Whether all steps are done, or the steady state is reached where that is the end.
    pub fn is_done(&self) -> bool {
        let steady = self.tally.steady.as_ref().is_some_and(|test| test.reached.is_some());
        self.tally.step >= self.options.steps || self.options.stop_when_steady && steady
    }

    /// The state at the end of the last step, or of the last part of a step that converged.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Writes pressure (Pa), gap (m) and filled part of the gap at the nodes of all films, in the order of
    /// [`Springs::films`](crate::bearing::Springs::films).
    pub fn write_films(&self, out: &mut Vec<f64>) {
        self.equations.springs.write_maps(&self.machine.springs, out);
    }

    /// For every load of the machine whether it has stopped driving.
    pub fn released(&self) -> &[bool] {
        &self.equations.released
    }

    /// The energy balance from t = 0 to the end of the last step.
    pub fn energy(&mut self) -> EnergyBalance {
        self.meters.balance(&mut self.equations, &self.state)
    }

    /// The worst value so far of every measure by which the laws may be believed, in the order of
    /// [`Springs::measures`](crate::bearing::Springs::measures).
    pub fn worst(&self) -> &[Option<Worst>] {
        self.equations.springs.worst()
    }

    /// Where the march is.
    pub fn progress(&self) -> Progress {
        Progress {
            step: self.tally.step,
            steps: self.options.steps,
            time: self.time(),
            iterations: self.last_iterations,
        }
    }

    /// Ends the march.
    pub fn outcome(mut self) -> Outcome {
        let parts = self.meters.parts_taken();
        let halved = self.tally.halvings.of(parts.map_or(self.tally.step, |own| own.parts));
        let unknown = self.newton.unknown_force();
        Outcome {
            energy: self.energy(),
            quality: Quality { halved, ..self.meters.quality(&mut self.equations, unknown) },
            worst: self.worst().to_vec(),
            history: History::for_machine(self.machine),
            steady: self.tally.steady.as_ref().and_then(|test| test.reached),
            left: self.tally.steady.as_ref().and_then(SteadyTest::left),
            told_until: self.settled,
            iterations: self.tally.iterations,
            factorisations: self.newton.factorisations(),
            halved_steps: self.tally.halvings.steps,
            parts,
        }
    }

    /// √(2φ) after every iteration of the last step (the merit of the Newton iteration).
    pub fn residuals(&self) -> &[f64] {
        &self.newton.residuals
    }
}

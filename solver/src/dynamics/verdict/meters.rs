//! What is measured of every step that is accepted: where its energy goes, and how good it is.

use serde::{Deserialize, Serialize};

use super::energy::{EnergyBalance, EnergyMeter, EnergySums, rounding};
use super::film_meter::{FilmMeter, FilmSums};
use super::periods::{FewestSteps, PeriodMeter};
use super::quality::Quality;
use super::quality_meter::{QualityMeter, QualitySums};
use super::ringing::{RingingMeter, RingingSums};
use super::state_errors::{StateMeter, StateSums};
use crate::dynamics::iteration::Integrator;
use crate::dynamics::lengths::{
    AutomaticStep, Contacts, ControlMemory, Measured, PartsTaken, StepControl,
};
use crate::dynamics::motion::{StepLength, larger};
use crate::equations::{Equations, State};
use crate::error::Error;

/// All meters of a march.
pub(crate) struct Meters {
    energy: EnergyMeter,
    quality: QualityMeter,
    ringing: RingingMeter,
    states: StateMeter,
    films: FilmMeter,
    /// Chooses the parts of steps, where the march does.
    control: Option<StepControl>,
    contacts: Contacts,
    periods: PeriodMeter,
    /// By parts of the machine, turns behind them: local errors of a part of a step, and displacements at its end.
    errors: Vec<f64>,
    displacements: Vec<f64>,
    /// Kinetic energies by bearing.
    kinetic: Vec<f64>,
}

/// What the meters carry from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct MeterSums {
    energy: EnergySums,
    quality: QualitySums,
    ringing: RingingSums,
    states: StateSums,
    films: FilmSums,
    control: Option<ControlMemory>,
    fewest_steps: Option<FewestSteps>,
}

impl MeterSums {
    /// What was remembered of the parts of steps.
    pub(in crate::dynamics) fn control(&self) -> Option<&ControlMemory> {
        self.control.as_ref()
    }
}

impl Meters {
    /// Starts at a state that was just evaluated, for steps of `dt` s, or of parts of it where the march chooses them.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub(crate) fn new(
        equations: &mut Equations,
        method: Integrator,
        (dt, automatic): (f64, Option<AutomaticStep>),
        state: &State,
    ) -> Result<Self, Error> {
        let length = match automatic {
            Some(_) => StepLength::Most(dt),
            None => StepLength::Fixed(dt),
        };
        let mut quality = QualityMeter::new(equations, method, length, state)?;
        let bearings = equations.machine.springs.bearings;
        let (parts, turns) = quality.parts();
        let mut displacements = vec![0.0; parts.len() + turns];
        quality.displacements((equations.time, state), &mut displacements);
        Ok(Meters {
            energy: EnergyMeter::new(equations, state),
            ringing: RingingMeter::new(equations, &quality.parts, method.damps()),
            states: StateMeter::new(&equations.machine.springs, method, state),
            films: FilmMeter::new(&equations.machine.springs),
            errors: vec![0.0; displacements.len()],
            kinetic: vec![0.0; bearings],
            control: automatic
                .map(|own| StepControl::new(own, dt, (&displacements, parts), bearings)),
            contacts: Contacts::new(equations.machine),
            periods: PeriodMeter::new(equations.machine),
            quality,
            displacements,
        })
    }

    /// What a part of a step of `dt` s from time `t` on is worth that ends at a state just evaluated, over what it may be; 0 where
    /// steps are fixed, and no number where a contact begins and ends within it, or a
    /// load that follows an angle has too few steps in its period. It leaves no trace in what was measured so far.
    pub(crate) fn judge(
        &mut self,
        equations: &Equations,
        (t, dt): (f64, f64),
        [start, end]: [&State; 2],
    ) -> f64 {
        if self.control.is_none() {
            return 0.0;
        }
        self.quality.errors(dt, start, end, &mut self.errors);
        let judged = self.measured(equations, [start, end], StepControl::judge).unwrap_or(0.0);
        let tolerance = self.control.as_ref().map_or(1.0, StepControl::tolerance);
        let judged = larger(judged, self.states.judge(dt, [start, end]) / tolerance);
        let hides = judged <= 1.0
            && (self.periods.excess([start, end]) > 1.0
                || self.contacts.are_within(equations, (t, dt), [start, end]));
        if hides { f64::NAN } else { judged }
    }

    /// Has the control take what is measured between two states, of which the second was just evaluated, where there is one.
    fn measured<T>(
        &mut self,
        equations: &Equations,
        [start, end]: [&State; 2],
        take: impl FnOnce(&mut StepControl, &Measured) -> T,
    ) -> Option<T> {
        let control = self.control.as_mut()?;
        self.quality.displacements((equations.time, end), &mut self.displacements);
        self.kinetic.fill(0.0);
        for state in [start, end] {
            self.quality.raise_kinetic(equations.machine, state, &mut self.kinetic);
        }
        let measured = Measured {
            errors: &self.errors,
            displacements: &self.displacements,
            flows: self.energy.measure(equations),
            kinetic: &self.kinetic,
            rounding: rounding(equations, end),
        };
        Some(take(control, &measured))
    }

    /// Whether the first rows are to be foreseen.
    pub(crate) fn begins(&self) -> bool {
        self.control.as_ref().is_some_and(StepControl::is_new)
    }

    /// Takes a row that is foreseen, and ends in a state that was just evaluated; whether the next one may be, too.
    pub(crate) fn foresee(&mut self, equations: &Equations, ends: [&State; 2]) -> bool {
        let goes_on = self.measured(equations, ends, StepControl::foresee) == Some(true);
        self.energy.turn_to(equations);
        goes_on
    }

    /// Goes back to a state that was just evaluated, where nothing has been added yet.
    pub(crate) fn turn_back(&mut self, equations: &Equations) {
        self.energy.turn_to(equations);
    }

    /// Leaves out the part of a step that was judged last, or was not solved.
    pub(crate) fn reject(&mut self) {
        self.energy.reject();
        if let Some(control) = &mut self.control {
            control.reject();
        }
    }

    /// Takes the part of a step that was judged, with so many halvings.
    pub(crate) fn accept(&mut self, judged: f64, halvings: u32) {
        if let Some(control) = &mut self.control {
            control.accept(judged, halvings);
        }
    }

    /// Halvings of a step that lead to its next part.
    pub(crate) fn halvings(&self) -> u32 {
        self.control.as_ref().map_or(0, |own| own.memory.halvings)
    }

    /// Ends a row.
    pub(crate) fn end_row(&mut self) {
        self.quality.end_row();
        if let Some(control) = &mut self.control {
            control.end_row();
        }
    }

    /// Makes the next part longer where that is due; see [`StepControl::lengthen`].
    pub(crate) fn lengthen(&mut self, at: u32) {
        if let Some(control) = &mut self.control {
            control.lengthen(at);
        }
    }

    /// Adds a step of `dt` s from `start` at time `t` (s) to `end`, which was just evaluated.
    // A phase of its own in tables of where the time goes.
    #[inline(never)]
    pub(crate) fn add(
        &mut self,
        equations: &mut Equations,
        span: (f64, f64),
        start: &State,
        end: &State,
        row_error: f64,
    ) {
        self.energy.add(equations, start, end);
        self.quality.add(equations, span, [start, end], (self.energy.flows(), row_error));
        self.periods.add(span.1, [start, end]);
        self.ringing.add(equations, end, &self.quality.parts);
        self.states.add(span.1, [start, end], equations.springs.relaxing());
        self.films.add(equations.machine, &equations.springs, &end.q);
    }

    /// Goes on at the state of the step that was added last, just evaluated, after loads have changed at once.
    pub(crate) fn jump(&mut self, equations: &Equations) {
        self.energy.jump(equations);
        self.states.jump();
    }

    /// What was measured so far.
    pub(crate) fn sums(&self) -> MeterSums {
        MeterSums {
            energy: self.energy.sums.clone(),
            quality: self.quality.sums.clone(),
            ringing: self.ringing.sums.clone(),
            states: self.states.sums.clone(),
            films: self.films.sums.clone(),
            control: self.control.as_ref().map(|own| own.memory.with_turns(&self.quality.turned)),
            fewest_steps: self.periods.fewest,
        }
    }

    /// Goes on from what was measured before, at a state that was just evaluated. The system is evaluated elsewhere after it.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub(crate) fn resume_from(
        &mut self,
        equations: &mut Equations,
        sums: MeterSums,
    ) -> Result<(), Error> {
        self.energy.resume_from(equations, sums.energy);
        self.periods.fewest = sums.fewest_steps;
        self.ringing.sums = sums.ringing;
        self.states.sums = sums.states;
        self.films.sums = sums.films;
        self.resume_control(sums.control);
        self.quality.resume_from(equations, sums.quality)
    }

    /// Chooses parts of steps as an earlier march did.
    pub(crate) fn resume_control(&mut self, memory: Option<ControlMemory>) {
        if let (Some(control), Some(memory)) = (&mut self.control, memory) {
            let turned = memory.turned.clone();
            if control.resume_from(memory) {
                self.quality.turned = turned;
            }
        }
    }

    /// The parts that steps took; none where steps are fixed.
    pub(crate) fn parts_taken(&self) -> Option<PartsTaken> {
        self.control.as_ref().map(|own| own.memory.taken)
    }

    /// The energy balance at a state.
    pub(crate) fn balance(&self, equations: &mut Equations, state: &State) -> EnergyBalance {
        self.energy.balance(equations, state)
    }

    /// What the steps were worth, where forces of springs are known to `unknown` (N); the system is evaluated elsewhere for it.
    pub(crate) fn quality(&mut self, equations: &mut Equations, unknown: f64) -> Quality {
        let quality = self.quality.quality(equations, &self.energy.sums.flows, unknown);
        let ringing = self.ringing.ringing(&self.quality.parts);
        let (states, films) = (self.states.worst(), self.films.worst());
        Quality { fewest_steps: self.periods.fewest, ringing, states, films, ..quality }
    }
}

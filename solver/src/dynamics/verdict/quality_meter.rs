//! How the steps of a march are measured: what `quality` is found from.

use serde::{Deserialize, Serialize};

use super::in_space::InSpace;
use super::part_sums::PartSums;
use super::sampling::{is_sampled, stands_for};
use super::turn_sums::TurnSums;
use crate::bearing::work::{Flow, MOTIONS};
use crate::dynamics::iteration::Integrator;
use crate::dynamics::motion::{
    Linearised, MachineModes, PartMotion, Parts, Place, StepLength, TurnRange,
};
use crate::equations::{Equations, State, Weights};
use crate::error::Error;

/// What is carried from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct QualitySums {
    /// Steps, or parts of steps, and whole rows.
    pub(super) steps: u64,
    pub(super) rows: u64,
    pub(super) parts: Vec<PartSums>,
    /// By turns that nothing elastic holds.
    pub(super) turns: Vec<TurnSums>,
    pub(super) row_error: f64,
    /// By bearings.
    pub(super) worst: Vec<WorstStep>,
    /// Steps that wait for the first linearisation.
    pub(super) early: Vec<EarlyStep>,
    /// What steps make of inertia in frames that turn.
    pub(super) in_space: InSpace,
    /// Where the machine was linearised last, after how many steps, and ω of its fastest mode so far (rad/s).
    pub(super) linearised: Option<Place>,
    pub(super) linearised_at: u64,
    pub(super) fastest: f64,
}

/// The step that made most energy at a bearing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct WorstStep {
    pub(super) made: f64,
    /// Times (s) and states at its ends.
    pub(super) ends: [(f64, State); 2],
}

/// A step that is not judged yet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct EarlyStep {
    /// When it ended (s).
    pub(super) time: f64,
    /// By which length it is judged (s).
    pub(super) dt: f64,
    pub(super) start: State,
    pub(super) end: State,
    /// By how much it changed what deformations and springs hold against.
    pub(super) change: Vec<f64>,
}

/// Measures steps.
pub(crate) struct QualityMeter {
    pub(crate) sums: QualitySums,
    pub(super) method: Integrator,
    pub(super) steps: StepLength,
    /// The modes by which the march chooses its steps, where it does.
    pub(super) undeformed: Option<MachineModes>,
    /// Those by which steps are judged; none before the first were.
    pub(super) linearised: Option<Linearised>,
    pub(super) parts: Parts,
    /// What turns were, also in a march before this one, by which the control judges where there is one.
    pub(super) turned: Vec<TurnRange>,
    /// A motion of the unknowns, what was before it, and what of it is in some modes.
    pub(super) motion: Vec<f64>,
    pub(super) before: Vec<f64>,
    pub(super) within: Vec<f64>,
    /// What deformations and springs held against at the end of the last step, and by how much the step changed it.
    pub(super) held: Vec<f64>,
    pub(super) change: Vec<f64>,
    /// A state with other rates, and what it changes of inertia forces.
    pub(super) corrected: State,
    pub(super) inertia: Vec<f64>,
    /// Of the step that was sampled last its motion by kinds of modes, and what of it is that of the parts.
    pub(super) kinds: [Vec<f64>; 3],
    pub(super) moved: Vec<PartMotion>,
}

impl QualityMeter {
    /// For steps from `state`, which was just evaluated.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub(crate) fn new(
        equations: &mut Equations,
        method: Integrator,
        steps: StepLength,
        state: &State,
    ) -> Result<Self, Error> {
        let automatic = matches!(steps, StepLength::Most(_));
        let (undeformed, parts) = undeformed(equations, state, automatic)?;
        let sums = QualitySums {
            steps: 0,
            rows: 0,
            parts: parts.all.iter().map(|_| PartSums::new()).collect(),
            turns: parts.turns.iter().map(|own| TurnSums::new(own, state)).collect(),
            row_error: 0.0,
            worst: vec![
                WorstStep { made: 0.0, ends: [(0.0, state.clone()), (0.0, state.clone())] };
                equations.machine.springs.bearings
            ],
            early: Vec::new(),
            in_space: InSpace::new(state.q.len(), parts.all.len()),
            linearised: None,
            linearised_at: 0,
            fastest: 0.0,
        };
        let values = || vec![0.0; equations.machine.active()];
        let mut meter = QualityMeter {
            sums,
            method,
            steps,
            undeformed,
            linearised: None,
            moved: vec![PartMotion::default(); parts.all.len()],
            turned: parts
                .turns
                .iter()
                .filter(|_| automatic)
                .map(|own| TurnRange::new(own, (equations.time, state)))
                .collect(),
            parts,
            motion: values(),
            before: values(),
            within: values(),
            held: values(),
            kinds: std::array::from_fn(|_| values()),
            change: values(),
            corrected: State::new(state.q.len()),
            inertia: vec![0.0; state.q.len()],
        };
        meter.hold(equations);
        meter.add_whole_displacement(state);
        Ok(meter)
    }

    /// Goes on from what was measured before, at a state that was just evaluated. The system is evaluated elsewhere after it.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub(crate) fn resume_from(
        &mut self,
        equations: &mut Equations,
        sums: QualitySums,
    ) -> Result<(), Error> {
        self.hold(equations);
        self.linearised = match &sums.linearised {
            Some(place) => {
                Some(Linearised::again(equations, &self.parts.all, self.steps.most(), place)?)
            }
            None => None,
        };
        self.sums = sums;
        Ok(())
    }

    /// Takes what deformations and springs hold against at the state that was just evaluated.
    fn hold(&mut self, equations: &Equations) {
        let first = equations.machine.first_unknown();
        let forces = equations.elastic[first..].iter().zip(&equations.spring[first..]);
        self.held.iter_mut().zip(forces).for_each(|(held, (elastic, spring))| {
            *held = elastic - spring;
        });
    }

    /// Adds a step of `dt` s from `start` at time `t` (s) to `end`, which was just evaluated.
    pub(crate) fn add(
        &mut self,
        equations: &mut Equations,
        (t, dt): (f64, f64),
        [start, end]: [&State; 2],
        (flows, row_error): (&[Flow], f64),
    ) {
        let sampled = is_sampled(self.sums.steps);
        if sampled {
            self.change.copy_from_slice(&self.held);
        }
        self.hold(equations);
        if sampled {
            self.change.iter_mut().zip(&self.held).for_each(|(own, held)| *own = held - *own);
            self.judge(equations, (t + dt, self.steps.of(dt)), [start, end]);
        }
        self.add_in_space(equations, dt, [start, end]);
        self.add_to_turns((t, dt), [start, end]);
        let sums = &mut self.sums;
        sums.steps += 1;
        sums.row_error = sums.row_error.max(row_error);
        for (worst, flows) in sums.worst.iter_mut().zip(flows.chunks_exact(MOTIONS)) {
            let made = flows.iter().map(|flow| flow.made).fold(0.0, f64::max);
            if made > worst.made {
                worst.made = made;
                for (kept, (t, state)) in worst.ends.iter_mut().zip([(t, start), (t + dt, end)]) {
                    kept.0 = t;
                    kept.1.copy_from(state);
                }
            }
        }
    }

    /// Adds a step of `dt` s to what is measured of turns, of rows that are sampled. Parts that a march chose are steps of their
    /// own; those of a step that was cut are one, however many there are.
    pub(super) fn add_to_turns(&mut self, (t, dt): (f64, f64), ends: [&State; 2]) {
        let factor = self.method.error_factor(dt);
        let (sampled, stands_for) = (is_sampled(self.sums.rows), stands_for(self.sums.rows));
        for (own, turn) in self.sums.turns.iter_mut().zip(&self.parts.turns) {
            own.take(turn, ends[1]);
            if sampled {
                own.measure(turn, (factor, dt), ends);
                if matches!(self.steps, StepLength::Most(_)) {
                    own.end_step(stands_for);
                }
            }
        }
        for (own, turn) in self.turned.iter_mut().zip(&self.parts.turns) {
            own.take(turn, (t + dt, ends[1]));
        }
    }

    /// Ends a row.
    pub(crate) fn end_row(&mut self) {
        if is_sampled(self.sums.rows) {
            let stands_for = stands_for(self.sums.rows);
            self.sums.turns.iter_mut().for_each(|own| own.end_row(stands_for));
        }
        self.sums.rows += 1;
    }
}

/// What is found of a machine that was just evaluated at a state where nothing is deformed, so that it is the same wherever a
/// march goes on: its modes, where a march chooses its steps by them, and its parts.
fn undeformed(
    equations: &mut Equations,
    state: &State,
    automatic: bool,
) -> Result<(Option<MachineModes>, Parts), Error> {
    let (time, released) = (equations.time, equations.released.clone());
    let mut still = State::new(state.q.len());
    let State { q, v, a, .. } = &mut still;
    equations.machine.set_given(0.0, false, [q, v, a]);
    equations.released.fill(false);
    equations.evaluate(0.0, &still);
    let modes = match automatic {
        true => MachineModes::new(equations, &still).map(Some),
        false => {
            let mut tangent = vec![0.0; state.q.len().pow(2)];
            equations.tangent(0.0, &still, Weights::POSITION, &mut tangent);
            Ok(None)
        }
    };
    let parts = Parts::new(equations);
    equations.released = released;
    equations.evaluate(time, state);
    Ok((modes?, parts))
}

#[cfg(test)]
mod tests {
    use super::super::windows::Windows;
    use super::*;
    use crate::dynamics::small::machine;
    use crate::linalg::Matrix;
    use crate::machine::{Body, Rotation};

    #[test]
    fn the_step_that_makes_most_energy_is_kept_with_its_ends() {
        let mut machine = machine(Rotation::Held);
        let [Body::Turning { shaft, .. }, Body::Standing { support, .. }] =
            machine.bodies.as_mut_slice()
        else {
            panic!("a shaft on a support")
        };
        (shaft.stiffness, support.stiffness) = (Matrix::zeros(2, 2), vec![0.0; 2]);
        let mut equations = Equations::new(&machine);
        let states: Vec<State> =
            [1.0, 2.0, 4.0, 8.0].map(|q| State { q: vec![q; 5], ..State::new(5) }).into();
        let mut meter = QualityMeter::new(
            &mut equations,
            Integrator::default(),
            StepLength::Fixed(0.5),
            &states[0],
        )
        .unwrap();
        for (place, made) in [(0, 3.0), (1, 7.0), (2, 5.0)] {
            let t = 10.0 + place as f64;
            let ends = [&states[place], &states[place + 1]];
            equations.evaluate(t + 0.5, ends[1]);
            // At the second of three bearings; at the third always as much, at the first nothing.
            let flow = |made: f64| Flow { made, flowed: 1.0, moved: 0.0 };
            let flows = [0.0, made, 1.0].map(|made| [flow(0.25 * made), flow(made)]);
            meter.add(&mut equations, (t, 0.5), ends, (flows.as_flattened(), 0.0));
        }
        let ends = |bearing: usize| meter.sums.worst[bearing].ends.clone();
        assert_eq!(ends(1), [(11.0, states[1].clone()), (11.5, states[2].clone())]);
        assert_eq!(ends(2), [(10.0, states[0].clone()), (10.5, states[1].clone())]);
        assert_eq!(meter.sums.worst[0].made, 0.0);
        // Nothing holds the machine, so that no step resolves it.
        let flows = Windows::new(3 * MOTIONS);
        assert_eq!(meter.quality(&mut equations, &flows, 1.0).resolving_step, None);
    }

    /// Parts of a step that was cut are judged as what the whole one resolves, parts that a march chose by themselves.
    #[test]
    fn cut_parts_are_judged_by_the_whole_step() {
        let machine = machine(Rotation::Held);
        let mut equations = Equations::new(&machine);
        let state = |q: f64, a: f64| State { q: vec![q; 5], a: vec![a; 5], ..State::new(5) };
        let (start, end) = (state(1e-6, 1.0), state(2e-6, 1.5));
        let mut measured = |steps: StepLength, dt: f64| {
            let mut meter =
                QualityMeter::new(&mut equations, Integrator::default(), steps, &start).unwrap();
            equations.evaluate(dt, &end);
            let flows = [Flow { made: 0.0, flowed: 1.0, moved: 0.0 }; 3];
            meter.add(&mut equations, (0.0, dt), [&start, &end], (&flows, 0.0));
            meter.judge_rest(&mut equations);
            let errors: Vec<f64> = meter.sums.parts.iter().map(|own| own.largest_error).collect();
            assert!(errors.iter().any(|error| *error > 0.0), "{errors:?}");
            errors
        };
        let whole = measured(StepLength::Fixed(1e-4), 1e-4);
        assert_eq!(measured(StepLength::Fixed(1e-4), 3e-5), whole);
        assert_ne!(measured(StepLength::Most(1e-4), 3e-5), whole);
    }

    /// Parts of a step that was cut are one step of a turn; those that a march chose are steps of their own.
    #[test]
    fn cut_parts_are_one_step_and_chosen_ones_count_by_themselves() {
        let machine = machine(Rotation::Free);
        let mut equations = Equations::new(&machine);
        let state =
            |speed: f64, a: f64| State { v: vec![speed; 5], a: vec![a; 5], ..State::new(5) };
        let states = [state(10.0, 1.0), state(10.1, 1.5), state(10.3, 2.5)];
        let counted = [StepLength::Fixed(0.1), StepLength::Most(0.1)].map(|steps| {
            let mut meter =
                QualityMeter::new(&mut equations, Integrator::default(), steps, &states[0])
                    .expect("a machine with mass");
            for (t, ends) in [0.0, 0.03].into_iter().zip(states.windows(2)) {
                meter.add_to_turns((t, 0.05), [&ends[0], &ends[1]]);
            }
            meter.end_row();
            meter.sums.turns.iter().map(|own| own.errors.count()).collect::<Vec<_>>()
        });
        assert_eq!(counted, [vec![1], vec![2]]);
    }
}

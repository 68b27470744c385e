//! Newton's method inside a time step, made safe against springs that switch.
//!
//! A direction Δq solves [AK] Δq = r, eqs. (45) and (46), for the coordinates that are unknown. The factors of
//! [AK] are kept over iterations and steps while they contract, and then learn what they lack from directions before (`secants`),
//! or foresee by the laws what they do not know (`condensed`). A step is taken only if it lessens the merit φ of
//! `Merit`: along the direction of a fresh [AK] φ falls for a short enough step wherever r is differentiable, so that
//! the iteration cannot cycle.
//! φ only steers. A step counts as solved when every row of r is (`Equations::row_error`) and the forces of the
//! springs have come to rest.

use serde::{Deserialize, Serialize};

use super::extrapolation::Extrapolation;
use super::factors::{FactorsState, KeptFactors};
use super::halvings::HalvedAt;
use super::merit::Merit;
use super::newmark::{Coefficients, Integrator};
use crate::equations::{Equations, State};
use crate::linalg::{largest_and_sum, widely};

/// How the equations of a step are solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewtonOptions {
    /// Largest change of a spring force in the last iteration, from what it was or was foreseen to become, and largest force
    /// missing at a spring (N).
    pub force_tolerance: f64,
    /// The same as a fraction of the largest spring force so far; the smaller of the two holds, so that a machine
    /// of small forces is solved as well as a large one.
    pub relative_force_tolerance: f64,
    /// Largest residual left in a row of the equations, as a fraction of the largest term of that row; see
    /// `Equations::row_error`.
    pub residual_tolerance: f64,
    /// Iterations after which a step counts as failed.
    pub max_iterations: usize,
    /// Whether factors are kept while they contract, or recomputed in every iteration. Kept ones take more
    /// iterations (in oil films 9 a step where new ones take 3), each much cheaper than factoring.
    pub keep_factors: bool,
    /// Whether steps that do not lessen φ are shortened. Without it this is the plain method, which can
    /// cycle where springs switch.
    pub line_search: bool,
    /// How often a failing step may be halved, where the march does not choose its steps.
    pub max_halvings: usize,
    /// Whether iterations go on beyond that until another one does not help: what is left of a step is rounding.
    pub to_rounding: bool,
}

impl Default for NewtonOptions {
    fn default() -> Self {
        NewtonOptions {
            force_tolerance: 1e-3,
            relative_force_tolerance: 1e-5,
            residual_tolerance: SOLVED,
            max_iterations: 40,
            keep_factors: true,
            line_search: true,
            max_halvings: 10,
            to_rounding: false,
        }
    }
}

/// Residual of a row, as a fraction of its largest term, at which it counts as solved.
const SOLVED: f64 = 5e-7;
/// The same, and share of the largest spring force, where a machine is foreseen.
const ROUGH: f64 = 1e-2;
/// Worst contraction for which factors are kept.
pub(super) const CONTRACTION: f64 = 0.2;
/// What is smaller has squares without digits.
pub(super) const UNSQUARED: f64 = 1e-140;
/// φ of an iteration over that of the one before from which on it no longer falls: another one may not help.
const STALLED: f64 = 0.5;
/// Share of the decrease promised by the slope of φ that a step must bring.
const SUFFICIENT: f64 = 1e-4;
/// Shortest step tried.
const SHORTEST: f64 = 1.0 / 4096.0;

/// Share of the largest spring force below which rounding of the clearances may keep a force from rest.
const FORCE_ROUNDING: f64 = 1e-9;

/// Share of the tolerance of forces up to which they are foreseen.
const FORESEEN: f64 = 0.25;

/// How an iteration ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Ending {
    /// The step is solved.
    Converged,
    /// Iterations ran out, no step lessens φ, or the matrix is singular.
    Failed,
}

/// What happened in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepReport {
    pub(crate) ending: Ending,
    pub(crate) iterations: usize,
    /// √(2φ) at the end.
    pub(crate) residual: f64,
    /// Largest change of a spring force in the last iteration (N).
    pub(crate) force_change: f64,
    /// `Equations::row_error` of the state that was accepted.
    pub(crate) row_error: f64,
}

/// What the iteration keeps over steps; of its factors enough to compute them again with the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct NewtonState {
    factors: FactorsState,
    /// Where the next step begins.
    extrapolation: Extrapolation,
    /// Largest spring force of all steps (N).
    largest_force: f64,
}

impl NewtonState {
    /// As it is, with no matrix factored yet.
    pub(crate) fn counted_anew(&self) -> NewtonState {
        NewtonState { factors: self.factors.counted_anew(), ..self.clone() }
    }
}

/// Memory of the iteration. Its rows are those of the unknowns: all coordinates from `first` on.
pub(crate) struct Newton {
    options: NewtonOptions,
    first: usize,
    factors: KeptFactors,
    merit: Merit,
    extrapolation: Extrapolation,
    largest_force: f64,
    direction: Vec<f64>,
    /// The state predicted for the end of the step, and what is added to its positions.
    predicted: State,
    correction: Vec<f64>,
    trial: State,
    forces: Vec<f64>,
    /// √(2φ) after every iteration of the last step.
    pub(crate) residuals: Vec<f64>,
}

impl Newton {
    /// With factors kept for so many step lengths beside the one in use. `turns`: whether lengths are doubled and halved.
    pub(crate) fn new(
        options: NewtonOptions,
        equations: &Equations,
        (spare, turns): (usize, bool),
    ) -> Self {
        let machine = equations.machine;
        let (size, first) = (machine.size(), machine.first_unknown());
        let unknowns = size - first;
        Newton {
            options,
            first,
            factors: KeptFactors::new(equations, spare),
            merit: Merit::new(first, unknowns),
            extrapolation: Extrapolation::new(unknowns, turns),
            largest_force: 0.0,
            direction: vec![0.0; unknowns],
            predicted: State::new(size),
            correction: vec![0.0; unknowns],
            trial: State::new(size),
            forces: vec![0.0; machine.springs.forces()],
            residuals: Vec::with_capacity(options.max_iterations + 1),
        }
    }

    /// What is kept over steps.
    pub(crate) fn kept(&self) -> NewtonState {
        let (factors, extrapolation) = (self.factors.state().clone(), self.extrapolation.clone());
        NewtonState { factors, extrapolation, largest_force: self.largest_force }
    }

    /// Goes on with what was kept; the system is evaluated elsewhere for it, with loads released as they were.
    pub(crate) fn resume_from(
        &mut self,
        equations: &mut Equations,
        method: Integrator,
        kept: NewtonState,
    ) {
        self.factors.resume_from((equations, method), kept.factors, &mut self.merit);
        (self.extrapolation, self.largest_force) = (kept.extrapolation, kept.largest_force);
    }

    /// How often a matrix was factored.
    pub(crate) fn factorisations(&self) -> usize {
        self.factors.factorisations()
    }

    /// Solves steps with two or three digits until `thoroughly`: enough for where a machine goes.
    pub(in crate::dynamics) fn roughly(&mut self) {
        self.options.relative_force_tolerance = ROUGH;
        self.options.force_tolerance = f64::INFINITY;
        self.options.residual_tolerance = ROUGH;
    }

    /// Solves steps as `options` ask for.
    pub(in crate::dynamics) fn thoroughly(&mut self, options: NewtonOptions) {
        self.options = options;
    }

    /// Largest spring force of all steps (N).
    pub(crate) fn largest_force(&self) -> f64 {
        self.largest_force
    }

    /// What may be missing of a force of a step that counts as solved (N).
    pub(crate) fn unknown_force(&self) -> f64 {
        self.force_tolerance(self.largest_force) + FORCE_ROUNDING * self.largest_force
    }

    /// Forgets the forces of a step that is not accepted: the largest was so much before it (N).
    pub(crate) fn forget(&mut self, largest_force: f64) {
        self.largest_force = largest_force;
    }

    /// Has factors computed anew, as steps are no longer those that they are of.
    pub(in crate::dynamics) fn forget_factors(&mut self) {
        self.factors.drop_all();
    }

    /// Solves for the state at `t`, the end of `step`, from the prediction in `end`.
    pub(crate) fn solve(
        &mut self,
        equations: &mut Equations,
        t: f64,
        step: &Coefficients,
        end: &mut State,
    ) -> StepReport {
        self.factors.begin(step.dt);
        self.merit.weigh(equations, step);
        self.predicted.copy_from(end);
        let (weights, memory) = (self.merit.weights(), &mut self.direction);
        self.extrapolation.begin((t, step.dt), (weights, memory), &mut self.correction);
        step.correct(&self.predicted, self.correction.iter().copied(), self.first, end);
        self.trial.copy_first(self.first, end);
        equations.evaluate(t, end);
        let mut norm = self.merit.norm(equations);
        self.residuals.clear();
        self.residuals.push(norm);
        let mut last_length = f64::INFINITY;
        let mut force_change = f64::INFINITY;
        for iteration in 1..=self.options.max_iterations {
            if !norm.is_finite() {
                return self.failed(iteration, norm, force_change);
            }
            let mut fresh = !self.factors.are_of(step.dt) || !self.options.keep_factors;
            if fresh && !self.factors.factor(equations, t, end, step) {
                return self.failed(iteration, norm, force_change);
            }
            self.direct(equations, t, step, end);
            let (length, tried) = loop {
                match self.search(equations, t, step, norm, fresh) {
                    Some(found) => break found,
                    None if !fresh => {
                        // Kept factors promise nothing: compute them at this state and try again.
                        equations.evaluate(t, end);
                        if !self.factors.factor(equations, t, end, step) {
                            return self.failed(iteration, norm, force_change);
                        }
                        fresh = true;
                        self.direct(equations, t, step, end);
                    }
                    None => return self.failed(iteration, norm, force_change),
                }
            };
            std::mem::swap(end, &mut self.trial);
            let parts = self.correction.iter_mut().zip(&self.direction);
            parts.for_each(|(sum, part)| *sum += length * part);
            let last_norm = std::mem::replace(&mut norm, tried);
            self.residuals.push(norm);
            let (change, largest) = self.force_change(equations);
            force_change = change;
            let most = f64::max(self.largest_force, largest);
            let force_tolerance = self.force_tolerance(most);
            let at_rest = change <= force_tolerance + FORCE_ROUNDING * largest;
            let stalls = norm > STALLED * last_norm;
            let ends = !self.options.to_rounding
                || norm == 0.0
                || fresh && stalls
                || at_rest && self.is_exact(equations, end);
            if length == 1.0 && at_rest && ends {
                let options = NewtonOptions { force_tolerance, ..self.options };
                let row_error = equations.row_error([end, &self.predicted], &options, stalls);
                if row_error <= 1.0 {
                    self.largest_force = most;
                    let (weights, memory) = (self.merit.weights(), &mut self.direction);
                    self.extrapolation.learn(&self.correction, weights, memory);
                    self.factors.count(iteration);
                    let (ending, iterations, residual) = (Ending::Converged, iteration, norm);
                    return StepReport { ending, iterations, residual, force_change, row_error };
                }
            }
            let size = self.merit.length(&self.direction);
            let lags = self.options.to_rounding && stalls;
            if length < 1.0 || lags || size > CONTRACTION * last_length || !self.factors.contract()
            {
                self.factors.drop();
            }
            last_length = size;
        }
        self.failed(self.options.max_iterations, norm, force_change)
    }

    /// Tries steps along the direction, the whole one first; the length taken and the norm it leads to.
    fn search(
        &mut self,
        equations: &mut Equations,
        t: f64,
        step: &Coefficients,
        norm: f64,
        fresh: bool,
    ) -> Option<(f64, f64)> {
        let mut length = 1.0;
        while length >= SHORTEST {
            let parts = self.correction.iter().zip(&self.direction);
            let moved = parts.map(|(sum, part)| sum + length * part);
            step.correct(&self.predicted, moved, self.first, &mut self.trial);
            equations.evaluate(t, &self.trial);
            let tried = self.merit.norm(equations);
            let enough = tried <= f64::max(norm * (1.0 - SUFFICIENT * length), UNSQUARED);
            if enough || !self.options.line_search || self.rounding_is_left(equations) {
                return Some((length, tried));
            }
            if !fresh {
                return None;
            }
            length *= 0.5;
        }
        None
    }

    /// Whether the rows of the trial are solved, however wide the tolerances are: what is left of φ is rounding,
    /// and need not fall.
    fn rounding_is_left(&self, equations: &mut Equations) -> bool {
        let residual_tolerance = self.options.residual_tolerance.min(SOLVED);
        let narrow = NewtonOptions { force_tolerance: 0.0, residual_tolerance, ..self.options };
        equations.row_error([&self.trial, &self.predicted], &narrow, true) <= 1.0
    }

    /// Whether nothing but rounding is left in the rows of a state that was just evaluated.
    fn is_exact(&self, equations: &mut Equations, end: &State) -> bool {
        let exact = NewtonOptions { force_tolerance: 0.0, residual_tolerance: 0.0, ..self.options };
        equations.row_error([end, &self.predicted], &exact, false) <= 1.0
    }

    /// Largest change of a spring force since the start of the iteration, and the largest force (N).
    fn force_change(&self, equations: &Equations) -> (f64, f64) {
        let (before, after) = (&self.forces, &equations.springs.forces);
        let after = &after[..before.len()];
        let (mut change, mut sum, mut largest) = (0.0, 0.0, 0.0);
        widely(|| {
            (change, sum) = largest_and_sum(before.len(), |j| before[j] - after[j]);
            (largest, _) = largest_and_sum(after.len(), |j| after[j]);
        });
        // A difference that is no number is the largest.
        (if sum.is_nan() { sum } else { change }, largest)
    }

    /// Finds the direction at the state that was last evaluated, and the forces that are foreseen at its end: those of now, or
    /// what the laws give where the joints move.
    fn direct(&mut self, equations: &mut Equations, t: f64, step: &Coefficients, at: &State) {
        self.direction.copy_from_slice(&equations.residual[self.first..]);
        let rounding = FORCE_ROUNDING * self.largest_force;
        let missing = FORESEEN * self.force_tolerance(self.largest_force) + rounding;
        let judged = (&self.merit, missing);
        self.factors.solve(equations, (t, at, step), &mut self.direction, judged);
        self.forces.copy_from_slice(&equations.springs.forces);
    }

    /// How much a force may change (N) where the largest of all is `most`.
    fn force_tolerance(&self, most: f64) -> f64 {
        let relative = self.options.relative_force_tolerance * most;
        f64::min(self.options.force_tolerance, relative)
    }

    fn failed(&mut self, iterations: usize, residual: f64, force_change: f64) -> StepReport {
        self.factors.drop();
        let row_error = f64::INFINITY;
        StepReport { ending: Ending::Failed, iterations, residual, force_change, row_error }
    }

    /// Where an iteration failed that just did: at the bearing whose force changed most, if the forces did not come to rest.
    pub(crate) fn failed_at(&self, equations: &Equations, report: &StepReport) -> HalvedAt {
        let settled = self.unknown_force();
        let moving = report.force_change > settled && report.force_change.is_finite();
        let changes = self.forces.iter().zip(&equations.springs.forces).map(|(a, b)| (a - b).abs());
        let most = changes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).filter(|_| moving);
        let bearing = most.and_then(|(force, _)| equations.machine.springs.bearing_of(force));
        let row = || HalvedAt::Coordinate(self.worst(&equations.residual));
        bearing.map_or_else(row, HalvedAt::Bearing)
    }

    /// The coordinate that contributes most to φ.
    pub(crate) fn worst(&self, residual: &[f64]) -> usize {
        self.merit.worst(residual)
    }
}

#[cfg(test)]
mod tests {
    use super::super::newmark::Newmark;
    use super::*;
    use crate::dynamics::small::{machine, state};
    use crate::machine::Rotation;

    /// However much a row may have. The laws of the small machine hide their slopes: forces come to rest slowly.
    #[test]
    fn a_step_ends_when_its_forces_are_at_rest() {
        let machine = machine(Rotation::Held);
        let mut equations = Equations::new(&machine);
        let options = NewtonOptions {
            force_tolerance: 1e-6,
            residual_tolerance: 1e3,
            ..NewtonOptions::default()
        };
        let mut newton = Newton::new(options, &equations, (0, false));
        let step = Coefficients::new(Newmark::default(), 0.01);
        let report = newton.solve(&mut equations, 0.01, &step, &mut state(5));
        assert_eq!(report.ending, Ending::Converged);
        let largest = equations.springs.forces.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
        assert!(report.iterations > 2 && largest < 100.0, "{report:?}");
        assert!(report.force_change <= 1e-6 + 1e-9 * largest, "{report:?}");
    }
}

//! Newton's method inside a time step, made safe against springs that switch.
//!
//! A direction Δq solves [AK] Δq = r, eqs. (45) and (46), for the coordinates that are unknown. The factors of
//! [AK] are kept over iterations and steps while they contract. A step is taken only if it lessens the merit
//! φ = ½ Σ r_i²/s_i, where s is the diagonal of the constant part a2 M + a1 C + K: along the direction of a
//! fresh [AK] φ falls for a short enough step wherever r is differentiable, so that the iteration cannot cycle.
//! φ only steers. A step counts as solved when every row of r is (`System::row_error`) and the forces of the
//! springs have come to rest.

use serde::{Deserialize, Serialize};

use super::extrapolation::Extrapolation;
use super::newmark::{Coefficients, Newmark, State};
use super::system::System;
use crate::linalg::{Lu, RoughInverse, copy_block_from, largest_and_sum, sum_of};

/// How the equations of a step are solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewtonOptions {
    /// Largest change of a spring force in the last iteration, and largest force missing at a spring (N).
    pub force_tolerance: f64,
    /// The same as a fraction of the largest spring force so far; the smaller of the two holds, so that a machine
    /// of small forces is solved as well as a large one.
    pub relative_force_tolerance: f64,
    /// Largest residual left in a row of the equations, as a fraction of the largest term of that row; see
    /// `System::row_error`.
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
        }
    }
}

/// Residual of a row, as a fraction of its largest term, at which it counts as solved.
const SOLVED: f64 = 5e-7;
/// Worst contraction for which factors are kept.
pub(super) const CONTRACTION: f64 = 0.2;
/// Directions from factors before they are inverted, which takes as long as some hundred directions from the inverse save.
const FACTORED: usize = 64;
/// Share of the decrease promised by the slope of φ that a step must bring.
const SUFFICIENT: f64 = 1e-4;
/// Shortest step tried.
const SHORTEST: f64 = 1.0 / 4096.0;

/// Share of the largest spring force below which rounding of the clearances may keep a force from rest.
const FORCE_ROUNDING: f64 = 1e-9;

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
    /// `System::row_error` of the state that was accepted.
    pub(crate) row_error: f64,
}

/// What the iteration keeps over steps, but its factors: enough to compute them again with the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct NewtonState {
    /// Time (s), state and released loads at which [AK] was factored.
    time: f64,
    state: State,
    released: Vec<bool>,
    /// Step length (s) for which it was; 0 where there are no factors.
    dt: f64,
    /// How often a matrix was factored.
    pub(crate) factorisations: usize,
    /// Directions that the factors have given.
    directions: usize,
    /// The fewest iterations of a step since, and how many more others took, summed.
    fewest: usize,
    excess: usize,
    /// Largest spring force of all steps (N).
    largest_force: f64,
    /// Where the next step begins.
    extrapolation: Extrapolation,
    /// Where the factors on the shelves were computed, and the shelf that is emptied next.
    shelved: Vec<Factored>,
    next_shelf: usize,
}

/// Where factors were computed: time (s), state, released loads and step length (s), 0 where there are none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Factored {
    time: f64,
    state: State,
    released: Vec<bool>,
    dt: f64,
}

impl NewtonState {
    /// As it is, with no matrix factored yet.
    pub(crate) fn counted_anew(&self) -> NewtonState {
        NewtonState { factorisations: 0, ..self.clone() }
    }
}

/// Memory of the iteration, and the factors it keeps. Rows and columns are those of the unknowns: all
/// coordinates from `first` on.
pub(crate) struct Newton {
    options: NewtonOptions,
    first: usize,
    lu: Lu,
    /// Factors for other step lengths.
    shelves: Vec<Lu>,
    /// The inverse of factors that are kept for long, and whether it is of those.
    inverse: RoughInverse,
    is_inverse: bool,
    /// [AK] of all coordinates, where not all are unknown.
    whole: Vec<f64>,
    kept: NewtonState,
    /// 1/s.
    weights: Vec<f64>,
    weights_dt: f64,
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
    /// With factors kept for so many step lengths beside the one in use.
    pub(crate) fn new(options: NewtonOptions, system: &System, shelves: usize) -> Self {
        let machine = system.machine;
        let (size, first) = (machine.size(), machine.first_unknown());
        let unknowns = size - first;
        let released = vec![false; machine.loads.len()];
        let nothing =
            || Factored { time: 0.0, state: State::new(size), released: released.clone(), dt: 0.0 };
        Newton {
            options,
            first,
            lu: Lu::new(unknowns),
            shelves: (0..shelves).map(|_| Lu::new(unknowns)).collect(),
            inverse: RoughInverse::new(unknowns),
            is_inverse: false,
            whole: vec![0.0; if first > 0 { size * size } else { 0 }],
            kept: NewtonState {
                time: 0.0,
                state: State::new(size),
                shelved: (0..shelves).map(|_| nothing()).collect(),
                next_shelf: 0,
                released,
                dt: 0.0,
                factorisations: 0,
                directions: 0,
                fewest: usize::MAX,
                excess: 0,
                largest_force: 0.0,
                extrapolation: Extrapolation::new(unknowns),
            },
            weights: vec![1.0; unknowns],
            weights_dt: 0.0,
            direction: vec![0.0; unknowns],
            predicted: State::new(size),
            correction: vec![0.0; unknowns],
            trial: State::new(size),
            forces: vec![0.0; machine.springs.forces()],
            residuals: Vec::with_capacity(options.max_iterations + 1),
        }
    }

    /// What is kept over steps.
    pub(crate) fn kept(&self) -> &NewtonState {
        &self.kept
    }

    /// Goes on with what was kept; the system is evaluated elsewhere for it, with loads released as they were.
    pub(crate) fn resume_from(&mut self, system: &mut System, method: Newmark, kept: NewtonState) {
        for (shelf, own) in kept.shelved.iter().enumerate().filter(|(_, own)| own.dt > 0.0) {
            system.released.copy_from_slice(&own.released);
            system.evaluate(own.time, &own.state);
            self.factor(system, own.time, &own.state, &Coefficients::new(method, own.dt));
            std::mem::swap(&mut self.lu, &mut self.shelves[shelf]);
        }
        if kept.dt > 0.0 {
            system.released.copy_from_slice(&kept.released);
            system.evaluate(kept.time, &kept.state);
            let step = Coefficients::new(method, kept.dt);
            self.factor(system, kept.time, &kept.state, &step);
            if kept.directions >= FACTORED {
                self.weigh(system, &step);
                self.is_inverse = self.inverse.invert(&mut self.lu, &self.weights);
            }
        }
        self.kept = kept;
    }

    /// Puts the factors of another step length on a shelf, and takes those of `dt` s from theirs.
    fn exchange(&mut self, dt: f64) {
        let kept = &mut self.kept;
        if kept.dt == dt || kept.shelved.is_empty() {
            return;
        }
        let known = kept.shelved.iter().position(|own| own.dt == dt);
        let free = || kept.shelved.iter().position(|own| own.dt == 0.0);
        let Some(shelf) = known.or_else(|| (kept.dt > 0.0).then(free).flatten()).or_else(|| {
            let next = kept.next_shelf;
            (kept.dt > 0.0).then(|| {
                kept.next_shelf = (next + 1) % kept.shelved.len();
                next
            })
        }) else {
            return;
        };
        std::mem::swap(&mut self.lu, &mut self.shelves[shelf]);
        let own = &mut kept.shelved[shelf];
        std::mem::swap(&mut kept.time, &mut own.time);
        std::mem::swap(&mut kept.state, &mut own.state);
        std::mem::swap(&mut kept.released, &mut own.released);
        std::mem::swap(&mut kept.dt, &mut own.dt);
        if kept.dt != dt {
            kept.dt = 0.0;
        }
        // An inverse is not kept: it is made again where these factors give many directions again.
        (self.is_inverse, kept.directions) = (false, 0);
        (kept.fewest, kept.excess) = (usize::MAX, 0);
    }

    /// Largest spring force of all steps (N).
    pub(crate) fn largest_force(&self) -> f64 {
        self.kept.largest_force
    }

    /// Forgets the forces of a step that is not accepted: the largest was so much before it (N).
    pub(crate) fn forget(&mut self, largest_force: f64) {
        self.kept.largest_force = largest_force;
    }

    /// Solves for the state at `t`, the end of `step`, from the prediction in `end`.
    pub(crate) fn solve(
        &mut self,
        system: &mut System,
        t: f64,
        step: &Coefficients,
        end: &mut State,
    ) -> StepReport {
        self.exchange(step.dt);
        self.weigh(system, step);
        self.predicted.copy_from(end);
        self.kept.extrapolation.begin(step.dt, &mut self.correction);
        step.correct(&self.predicted, self.correction.iter().copied(), self.first, end);
        self.trial.copy_from(end);
        system.evaluate(t, end);
        let mut norm = self.norm(system);
        self.residuals.clear();
        self.residuals.push(norm);
        let mut last_length = f64::INFINITY;
        let mut force_change = f64::INFINITY;
        for iteration in 1..=self.options.max_iterations {
            if !norm.is_finite() {
                return self.failed(iteration, norm, force_change);
            }
            let mut fresh = self.kept.dt != step.dt || !self.options.keep_factors;
            if fresh && !self.factor(system, t, end, step) {
                return self.failed(iteration, norm, force_change);
            }
            self.direct(system);
            self.forces.copy_from_slice(&system.springs.forces);
            let (length, tried) = loop {
                match self.search(system, t, step, norm, fresh) {
                    Some(found) => break found,
                    None if !fresh => {
                        // Kept factors promise nothing: compute them at this state and try again.
                        system.evaluate(t, end);
                        if !self.factor(system, t, end, step) {
                            return self.failed(iteration, norm, force_change);
                        }
                        fresh = true;
                        self.direct(system);
                    }
                    None => return self.failed(iteration, norm, force_change),
                }
            };
            std::mem::swap(end, &mut self.trial);
            let parts = self.correction.iter_mut().zip(&self.direction);
            parts.for_each(|(sum, part)| *sum += length * part);
            norm = tried;
            self.residuals.push(norm);
            let (change, largest) = self.force_change(system);
            force_change = change;
            let most = f64::max(self.kept.largest_force, largest);
            let relative = self.options.relative_force_tolerance * most;
            let force_tolerance = f64::min(self.options.force_tolerance, relative);
            let at_rest = change <= force_tolerance + FORCE_ROUNDING * largest;
            if length == 1.0 && at_rest {
                let options = NewtonOptions { force_tolerance, ..self.options };
                let row_error = system.row_error(end, &self.predicted, &options);
                if row_error <= 1.0 {
                    self.kept.largest_force = most;
                    self.kept.extrapolation.learn(&self.correction, &self.weights);
                    self.count(iteration);
                    let ending = Ending::Converged;
                    let iterations = iteration;
                    return StepReport {
                        ending,
                        iterations,
                        residual: norm,
                        force_change,
                        row_error,
                    };
                }
            }
            let size = self.length();
            if length < 1.0 || size > CONTRACTION * last_length {
                self.kept.dt = 0.0;
            }
            last_length = size;
        }
        self.failed(self.options.max_iterations, norm, force_change)
    }

    /// Tries steps along the direction, the whole one first; the length taken and the norm it leads to.
    fn search(
        &mut self,
        system: &mut System,
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
            system.evaluate(t, &self.trial);
            let tried = self.norm(system);
            let enough = tried <= norm * (1.0 - SUFFICIENT * length);
            if enough || !self.options.line_search || self.rounding_is_left(system) {
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
    fn rounding_is_left(&self, system: &mut System) -> bool {
        let residual_tolerance = self.options.residual_tolerance.min(SOLVED);
        let narrow = NewtonOptions { force_tolerance: 0.0, residual_tolerance, ..self.options };
        system.row_error(&self.trial, &self.predicted, &narrow) <= 1.0
    }

    /// Largest change of a spring force since the start of the iteration, and the largest force (N).
    fn force_change(&self, system: &System) -> (f64, f64) {
        let (before, after) = (&self.forces, &system.springs.forces);
        let (change, sum) = largest_and_sum(before.len(), |j| before[j] - after[j]);
        let (largest, _) = largest_and_sum(after.len(), |j| after[j]);
        // A difference that is no number is the largest.
        (if sum.is_nan() { sum } else { change }, largest)
    }

    /// Solves for the direction at the state that was last evaluated.
    fn direct(&mut self, system: &System) {
        self.direction.copy_from_slice(&system.residual[self.first..]);
        if self.kept.directions == FACTORED {
            self.is_inverse = self.inverse.invert(&mut self.lu, &self.weights);
        }
        match self.is_inverse {
            true => self.inverse.apply(&mut self.direction),
            false => self.lu.solve_in_place(&mut self.direction),
        }
        self.kept.directions += 1;
    }

    fn factor(&mut self, system: &mut System, t: f64, at: &State, step: &Coefficients) -> bool {
        let (first, size) = (self.first, at.q.len());
        if first == 0 {
            system.tangent(t, at, step, self.lu.values_mut());
        } else {
            system.tangent(t, at, step, &mut self.whole);
            copy_block_from(first, &self.whole, size, self.lu.values_mut());
        }
        let done = self.lu.factor_in_place().is_ok();
        self.is_inverse = false;
        let kept = &mut self.kept;
        (kept.directions, kept.fewest, kept.excess) = (0, usize::MAX, 0);
        kept.factorisations += 1;
        (kept.time, kept.dt) = (t, if done { step.dt } else { 0.0 });
        kept.state.copy_from(at);
        kept.released.copy_from_slice(&system.released);
        done
    }

    /// Counts the iterations of a step that is solved. Factors end where steps have taken so many more than the best one as
    /// new factors cost, which is about one for each row.
    fn count(&mut self, iterations: usize) {
        let kept = &mut self.kept;
        kept.fewest = kept.fewest.min(iterations);
        kept.excess += iterations - kept.fewest;
        if kept.excess > self.correction.len() {
            kept.dt = 0.0;
        }
    }

    /// Makes the weights of φ for a step length.
    fn weigh(&mut self, system: &System, step: &Coefficients) {
        if self.weights_dt == step.dt {
            return;
        }
        let diagonal = system.diagonal(step);
        let own = self.weights.iter_mut().zip(&diagonal[self.first..]);
        own.for_each(|(weight, s)| *weight = 1.0 / s);
        self.weights_dt = step.dt;
    }

    /// √(2φ) = √(Σ r_i²/s_i) of the state that was last evaluated.
    fn norm(&self, system: &System) -> f64 {
        let residual = &system.residual[self.first..];
        sum_of(residual.len(), |i| residual[i] * residual[i] * self.weights[i]).sqrt()
    }

    /// √(Σ s_i Δq_i²).
    fn length(&self) -> f64 {
        let moved = &self.direction;
        sum_of(moved.len(), |i| moved[i] * moved[i] / self.weights[i]).sqrt()
    }

    fn failed(&mut self, iterations: usize, residual: f64, force_change: f64) -> StepReport {
        self.kept.dt = 0.0;
        let row_error = f64::INFINITY;
        StepReport { ending: Ending::Failed, iterations, residual, force_change, row_error }
    }

    /// The coordinate that contributes most to φ.
    pub(crate) fn worst(&self, residual: &[f64]) -> usize {
        let terms = residual[self.first..].iter().zip(&self.weights).map(|(x, w)| x * x * w);
        let worst = terms.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        self.first + worst.map_or(0, |(place, _)| place)
    }
}

#[cfg(test)]
mod tests {
    use super::super::newmark::Newmark;
    use super::super::small::{machine, state};
    use super::*;
    use crate::machine::Rotation;

    /// a2 M + a1 C + K on the diagonal of the small machine.
    fn diagonal(step: &Coefficients) -> [f64; 5] {
        let (a1, a2) = (step.a1, step.a2);
        [
            a2 * 7.0,
            a2 * 2.0 + a1 * 13.0 + 900.0,
            a2 * 3.0 + a1 * 17.0 + 1700.0,
            a2 + a1 * 5.0 + 125.0,
            a2 + a1 * 7.0 + 200.0,
        ]
    }

    #[test]
    fn norms_weigh_rows_by_the_diagonal() {
        for (rotation, first) in [(Rotation::Free, 0), (Rotation::Held, 1)] {
            let machine = machine(rotation.clone());
            let mut system = System::new(&machine);
            let mut newton = Newton::new(NewtonOptions::default(), &system, 0);
            let r = [3.0, -70.0, 20.0, 50.0, -11.0];
            system.residual.copy_from_slice(&r);
            // Anew for every step length.
            for dt in [0.3, 0.1] {
                let step = Coefficients::new(Newmark::default(), dt);
                newton.weigh(&system, &step);
                newton.direction.copy_from_slice(&r[first..]);
                let s = &diagonal(&step)[first..];
                let pairs = || r[first..].iter().zip(s);
                let norm = pairs().map(|(r, s)| r * r / s).sum::<f64>().sqrt();
                let length = pairs().map(|(x, s)| x * x * s).sum::<f64>().sqrt();
                assert!((newton.norm(&system) / norm - 1.0).abs() < 1e-14, "{rotation:?} {dt}");
                assert!((newton.length() / length - 1.0).abs() < 1e-14, "{rotation:?} {dt}");
            }
        }
    }

    /// However much a row may have. The laws of the small machine hide their slopes: forces come to rest slowly.
    #[test]
    fn a_step_ends_when_its_forces_are_at_rest() {
        let machine = machine(Rotation::Held);
        let mut system = System::new(&machine);
        let options = NewtonOptions {
            force_tolerance: 1e-6,
            residual_tolerance: 1e3,
            ..NewtonOptions::default()
        };
        let mut newton = Newton::new(options, &system, 0);
        let step = Coefficients::new(Newmark::default(), 0.01);
        let report = newton.solve(&mut system, 0.01, &step, &mut state(5));
        assert_eq!(report.ending, Ending::Converged);
        let largest = system.springs.forces.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
        assert!(report.iterations > 2 && largest < 100.0, "{report:?}");
        assert!(report.force_change <= 1e-6 + 1e-9 * largest, "{report:?}");
    }

    #[test]
    fn the_worst_coordinate_has_the_largest_part_of_the_merit() {
        let machine = machine(Rotation::Held);
        let system = System::new(&machine);
        let mut newton = Newton::new(NewtonOptions::default(), &system, 0);
        // Without inertia 1/s is 1/900, 1/1700, 1/125 and 1/200.
        newton.weigh(&system, &Coefficients { dt: 1.0, a1: 0.0, a2: 1e-9 });
        assert_eq!(newton.worst(&[1e9, 1.0, 1.0, 1.0, 1.0]), 3);
        // The largest row is not the worst, nor is that with the least s.
        assert_eq!(newton.worst(&[0.0, -30.0, 40.0, 3.0, 1.0]), 1);
        assert_eq!(newton.worst(&[0.0, -30.0, 40.0, 3.0, -20.0]), 4);
    }
}

//! Newton's method inside a time step, made safe against springs that switch.
//!
//! A direction Δq solves [AK] Δq = r, eqs. (45) and (46). The factors of [AK] are kept over iterations and
//! steps while they contract. A step is taken only if it lessens the merit φ = ½ Σ r_i²/s_i, where s is the
//! diagonal of the constant part a2 M + a1 C + K: along the direction of a fresh [AK] φ falls for a short
//! enough step wherever r is differentiable, so that the iteration cannot cycle.

use super::newmark::{Coefficients, State};
use super::system::System;
use crate::linalg::Lu;

/// How the equations of a step are solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewtonOptions {
    /// Largest change of a spring force in the last iteration (N).
    pub force_tolerance: f64,
    /// Largest residual left, as a share of the largest forces of the march, both in the norm of φ.
    pub residual_tolerance: f64,
    /// Iterations after which a step counts as failed.
    pub max_iterations: usize,
    /// Whether factors are kept while they contract, or made anew in every iteration. Kept ones take more
    /// iterations (in oil films 9 a step where new ones take 3), each much cheaper than factoring.
    pub keep_factors: bool,
    /// Whether steps that do not lessen φ are shortened. Without it this is the plain method, which can
    /// cycle where springs switch.
    pub line_search: bool,
    /// How often a failing step may be halved.
    pub max_halvings: usize,
}

impl Default for NewtonOptions {
    fn default() -> Self {
        NewtonOptions {
            force_tolerance: 1e-3,
            residual_tolerance: 1e-7,
            max_iterations: 40,
            keep_factors: true,
            line_search: true,
            max_halvings: 10,
        }
    }
}

/// Worst contraction for which factors are kept.
const CONTRACTION: f64 = 0.2;
/// Share of the decrease promised by the slope of φ that a step must bring.
const SUFFICIENT: f64 = 1e-4;
/// Shortest step tried.
const SHORTEST: f64 = 1.0 / 4096.0;

/// Multiples of eps · |s q| that rounding may leave in the residual: positions enter it three times, and
/// products over many coordinates add up.
const ROUNDING: f64 = 32.0;

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
pub(crate) struct Report {
    pub(crate) ending: Ending,
    pub(crate) iterations: usize,
    /// √(2φ) at the end.
    pub(crate) residual: f64,
    /// Largest change of a spring force in the last iteration (N).
    pub(crate) force_change: f64,
}

/// Memory of the iteration, and the factors it keeps.
pub(crate) struct Newton {
    options: NewtonOptions,
    lu: Lu,
    /// Step length for which the factors were made; none if 0.
    factored_dt: f64,
    /// 1/s.
    weights: Vec<f64>,
    weights_dt: f64,
    direction: Vec<f64>,
    trial: State,
    forces: Vec<f64>,
    /// Largest norm of forces at the end of a step so far.
    scale: f64,
    /// How often a matrix was factored.
    pub(crate) factorisations: usize,
    /// √(2φ) after every iteration of the last step.
    pub(crate) residuals: Vec<f64>,
}

impl Newton {
    pub(crate) fn new(options: NewtonOptions, size: usize, springs: usize) -> Self {
        Newton {
            options,
            lu: Lu::new(size),
            factored_dt: 0.0,
            weights: vec![1.0; size],
            weights_dt: 0.0,
            direction: vec![0.0; size],
            trial: State::new(size),
            forces: vec![0.0; springs],
            scale: 0.0,
            factorisations: 0,
            residuals: Vec::with_capacity(options.max_iterations + 1),
        }
    }

    /// Solves for the state at `t`, the end of `step`, from the prediction in `end`.
    pub(crate) fn solve(
        &mut self,
        system: &mut System,
        t: f64,
        step: &Coefficients,
        start: &State,
        end: &mut State,
    ) -> Report {
        self.weigh(system, step);
        system.evaluate(t, end);
        let mut norm = self.norm(&system.residual);
        self.residuals.clear();
        self.residuals.push(norm);
        let mut last_length = f64::INFINITY;
        let mut force_change = f64::INFINITY;
        for iteration in 1..=self.options.max_iterations {
            if !norm.is_finite() {
                return self.failed(iteration, norm, force_change);
            }
            let mut fresh = self.factored_dt != step.dt || !self.options.keep_factors;
            if fresh && !self.factor(system, t, end, step) {
                return self.failed(iteration, norm, force_change);
            }
            self.direct(system);
            self.forces.copy_from_slice(&system.springs.forces);
            let (share, tried) = loop {
                match self.search(system, t, step, start, end, norm, fresh) {
                    Some(found) => break found,
                    None if !fresh => {
                        // Kept factors promise nothing: make them at this state and try again.
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
            end.copy_from(&self.trial);
            norm = tried;
            self.residuals.push(norm);
            let changes =
                self.forces.iter().zip(&system.springs.forces).map(|(a, b)| (a - b).abs());
            force_change = changes.fold(0.0, f64::max);
            let scale = self.scale.max(self.size(system, end));
            let small = norm <= self.floor(scale, end);
            if share == 1.0 && force_change <= self.options.force_tolerance && small {
                // Only solved states count: forces of a prediction can be far too large.
                self.scale = scale;
                let ending = Ending::Converged;
                return Report { ending, iterations: iteration, residual: norm, force_change };
            }
            let length = self.length();
            if share < 1.0 || length > CONTRACTION * last_length {
                self.factored_dt = 0.0;
            }
            last_length = length;
        }
        self.failed(self.options.max_iterations, norm, force_change)
    }

    /// Tries steps along the direction, the whole one first; the share taken and the norm it leads to.
    #[expect(clippy::too_many_arguments, reason = "the state of one iteration, used in one place")]
    fn search(
        &mut self,
        system: &mut System,
        t: f64,
        step: &Coefficients,
        start: &State,
        end: &State,
        norm: f64,
        fresh: bool,
    ) -> Option<(f64, f64)> {
        // Below this φ says nothing of interest.
        let floor = self.floor(self.scale, end);
        let mut share = 1.0;
        while share >= SHORTEST {
            for i in 0..end.q.len() {
                self.trial.q[i] = end.q[i] + share * self.direction[i];
            }
            step.rates(start, &mut self.trial);
            system.evaluate(t, &self.trial);
            let tried = self.norm(&system.residual);
            let enough = tried <= norm * (1.0 - SUFFICIENT * share) || tried <= floor;
            if enough || !self.options.line_search {
                return Some((share, tried));
            }
            if !fresh {
                return None;
            }
            share *= 0.5;
        }
        None
    }

    /// Solves for the direction at the state that was last evaluated.
    fn direct(&mut self, system: &System) {
        self.direction.copy_from_slice(&system.residual);
        self.lu.solve_in_place(&mut self.direction);
    }

    fn factor(&mut self, system: &mut System, t: f64, at: &State, step: &Coefficients) -> bool {
        system.tangent(t, at, step, self.lu.values_mut());
        self.factorisations += 1;
        let done = self.lu.factor_in_place().is_ok();
        self.factored_dt = if done { step.dt } else { 0.0 };
        done
    }

    /// Makes the weights of φ for a step length.
    fn weigh(&mut self, system: &System, step: &Coefficients) {
        if self.weights_dt == step.dt {
            return;
        }
        let (shaft, support) = (&system.machine.shaft, &system.machine.support);
        let (first, weights) = (1 + shaft.size(), &mut self.weights);
        weights[0] = 1.0 / (step.a2 * shaft.j0.max(f64::MIN_POSITIVE.sqrt()));
        for j in 0..shaft.size() {
            let diagonal = step.a2 * shaft.mass[(j, j)]
                + step.a1 * shaft.damping[(j, j)]
                + shaft.stiffness[(j, j)];
            weights[1 + j] = 1.0 / diagonal;
        }
        for i in 0..support.size() {
            let diagonal = step.a2 + step.a1 * support.damping[i] + support.stiffness[i];
            weights[first + i] = 1.0 / diagonal;
        }
        self.weights_dt = step.dt;
    }

    /// √(Σ x_i²/s_i).
    fn norm(&self, x: &[f64]) -> f64 {
        x.iter().zip(&self.weights).map(|(x, w)| x * x * w).sum::<f64>().sqrt()
    }

    /// √(Σ s_i Δq_i²).
    fn length(&self) -> f64 {
        let parts = self.direction.iter().zip(&self.weights);
        parts.map(|(x, w)| x * x / w).sum::<f64>().sqrt()
    }

    /// The norm of the residual that counts as nothing beside forces of size `scale`, and what rounding of
    /// the state leaves.
    fn floor(&self, scale: f64, state: &State) -> f64 {
        let parts = state.q.iter().zip(&self.weights).map(|(q, weight)| q * q / weight);
        let rounding = parts.sum::<f64>().sqrt();
        self.options.residual_tolerance * scale + ROUNDING * f64::EPSILON * rounding
    }

    /// The largest forces at the state that was last evaluated: those applied, or where there are none,
    /// those of inertia by the diagonal of M. (Beside applied forces these would say too much: θ and the
    /// flexible shaft accelerate against each other.)
    fn size(&self, system: &System, state: &State) -> f64 {
        let parts = [&system.load, &system.spring, &system.damper].map(|part| self.norm(part));
        let applied = parts.into_iter().fold(0.0, f64::max);
        if applied > 0.0 {
            return applied;
        }
        let shaft = &system.machine.shaft;
        let mass = |i: usize| match i {
            0 => shaft.j0,
            _ if i <= shaft.size() => shaft.mass[(i - 1, i - 1)],
            _ => 1.0,
        };
        let parts = self.weights.iter().enumerate();
        parts.map(|(i, weight)| weight * (mass(i) * state.a[i]).powi(2)).sum::<f64>().sqrt()
    }

    fn failed(&mut self, iterations: usize, residual: f64, force_change: f64) -> Report {
        self.factored_dt = 0.0;
        Report { ending: Ending::Failed, iterations, residual, force_change }
    }

    /// The coordinate with the largest share in φ.
    pub(crate) fn worst(&self, residual: &[f64]) -> usize {
        let shares = residual.iter().zip(&self.weights).map(|(x, w)| x * x * w);
        let worst = shares.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        worst.map_or(0, |(place, _)| place)
    }
}

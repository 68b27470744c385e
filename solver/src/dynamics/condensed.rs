//! A step without what carries no joint: the iteration in the measures u of the joints.
//!
//! Between its joints a machine is all but linear in a step, body by body: of the residual r at a state the forces on the
//! measures become F = F(u₀ + N L⁻¹(r + Nᵀ(F − F₀))), where L = a2 M + a1 C + K + PF − a1 P − B without springs: diagonal for bodies
//! that do not turn, a small block for each of the others. With the kept tangent K₀ of the springs, forces ρ = ΔF − K₀Δu that it
//! did not foresee move the measures by Zρ, Z = N(L − NᵀK₀N)⁻¹Nᵀ. So u is iterated by the laws themselves until no force is missing,
//! and the coordinates follow at once: L⁻¹(r + NᵀΔF). What varies in L is left to the iteration of the step, which judges every
//! state by its own residual.

use std::ops::Range;

use whirl_specs::ContactTangent;

use super::newmark::{Coefficients, State};
use super::system::System;
use crate::bearing::Springs;
use crate::linalg::{Columns, Lu, Matrix, add_columns, add_product, largest_and_sum};
use crate::machine::Body;

/// Corrections at most.
const MOST: usize = 16;
/// Worst contraction with which the iteration goes on.
const CONTRACTION: f64 = 0.5;
/// Share of the first missing force below which an iteration has done its work, though rounding may hold it up.
const ENOUGH: f64 = 1e-2;

/// Share of the tolerance of forces below which one is not worth a column of Z.
const NOTHING: f64 = 0.03;

/// How an iteration in the measures ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Followed {
    /// Corrections of the measures.
    pub(super) corrections: usize,
    /// Whether they got smaller.
    pub(super) contracts: bool,
}

/// L⁻¹ and Z of kept factors, and memory for an iteration. Forces and motions are one value a measure.
pub(super) struct Condensed {
    first: usize,
    bodies: Vec<BodyInverse>,
    /// L, column after column over all coordinates.
    whole: Vec<f64>,
    /// T_b of the bores of every body.
    bores: Vec<Vec<f32>>,
    /// Z, column after column.
    compliance: Vec<f32>,
    /// What moments are multiplied by to compare them with forces (1/m); 1 for forces.
    weights: Vec<f64>,
    /// Motion since the iteration began, and that of a correction.
    moved: Vec<f64>,
    last: Vec<f64>,
    found: Vec<f32>,
    /// Forces at the start, before and after a correction, and those that are missing.
    start: Vec<f64>,
    before: Vec<f64>,
    after: Vec<f64>,
    missing: Vec<f64>,
    /// r + NᵀΔF.
    forces: Vec<f64>,
    /// The end of a correction, and what the own terms of bodies that turn change on the way.
    end: State,
    lack: Vec<f64>,
}

/// L⁻¹ of a body.
struct BodyInverse {
    /// Its rotation among the unknowns, if it is one, and its other coordinates.
    rotation: Option<usize>,
    flexible: Range<usize>,
    kind: Inverse,
}

enum Inverse {
    Diagonal(Vec<f64>),
    /// Rotation first; memory for it, and values of the body before and after.
    Block { lu: Lu, inverse: Matrix, given: Vec<f64>, solved: Vec<f64> },
}

impl Condensed {
    /// For a machine whose measures are constant and few enough that Z is less than what it spares, T_b and its transpose.
    pub(super) fn new(system: &System) -> Option<Self> {
        let (machine, springs) = (system.machine, &system.machine.springs);
        let (first, unknowns) = (machine.first_unknown(), machine.active());
        let measured = springs.measured();
        let spared = springs.bores.iter().map(|own| own.rows.data.len()).sum::<usize>();
        let is_less = measured * measured <= 4 * spared + unknowns * unknowns;
        if measured == 0 || !is_less || !springs.measures_are_constant() {
            return None;
        }
        let bodies = machine.bodies.iter().zip(machine.places()).map(|(body, place)| {
            let flexible = place.flexible.start - first..place.flexible.end - first;
            let rotation = place.rotation.filter(|&theta| theta >= first).map(|own| own - first);
            let size = flexible.len() + usize::from(rotation.is_some());
            let kind = match body {
                Body::Standing { .. } => Inverse::Diagonal(vec![0.0; size]),
                Body::Turning { .. } => Inverse::Block {
                    lu: Lu::new(size),
                    inverse: Matrix::identity(size),
                    given: vec![0.0; size],
                    solved: vec![0.0; size],
                },
            };
            BodyInverse { rotation, flexible, kind }
        });
        let values = || vec![0.0; measured];
        Some(Condensed {
            first,
            bodies: bodies.collect(),
            whole: vec![0.0; machine.size() * machine.size()],
            bores: springs.rough_bores(),
            compliance: vec![0.0; measured * measured],
            weights: springs.arms_of_measures().iter().map(|arm| 1.0 / arm).collect(),
            moved: values(),
            last: values(),
            found: vec![0.0; measured],
            start: values(),
            before: values(),
            after: values(),
            missing: values(),
            forces: vec![0.0; unknowns],
            end: State::new(machine.size()),
            lack: vec![0.0; machine.size()],
        })
    }

    /// Makes Z of (L − NᵀK₀N)⁻¹, column after column; whether single precision holds it.
    pub(super) fn take_compliance(&mut self, springs: &Springs, inverse: &[f64]) -> bool {
        let n = self.forces.len();
        let inverse = Columns { rows: n, cols: n, data: inverse };
        let compliance = springs.compliance(self.first, inverse).data;
        self.compliance.iter_mut().zip(&compliance).for_each(|(own, value)| *own = *value as f32);
        self.compliance.iter().all(|own| own.is_finite())
    }

    /// Makes L⁻¹ at a state just evaluated; whether there is one.
    pub(super) fn take_bodies(
        &mut self,
        system: &mut System,
        t: f64,
        state: &State,
        step: &Coefficients,
    ) -> bool {
        system.tangent_of_bodies(t, state, step, &mut self.whole);
        let (first, size) = (self.first, state.q.len());
        let (whole, bodies) = (&self.whole, &mut self.bodies);
        bodies.iter_mut().all(|body| {
            let places = body.places();
            match &mut body.kind {
                Inverse::Diagonal(inverse) => {
                    let diagonal = places.map(|place| whole[(first + place) * (size + 1)]);
                    inverse.iter_mut().zip(diagonal).for_each(|(own, l)| *own = 1.0 / l);
                    inverse.iter().all(|own| own.is_finite())
                }
                Inverse::Block { lu, inverse, .. } => {
                    let entries = lu.values_mut().chunks_exact_mut(inverse.rows.max(1));
                    for (column, values) in places.clone().zip(entries) {
                        let column = &whole[(first + column) * size..][..size];
                        let rows = places.clone().map(|row| column[first + row]);
                        values.iter_mut().zip(rows).for_each(|(own, value)| *own = value);
                    }
                    let done = lu.factor_in_place().is_ok();
                    inverse.data.fill(0.0);
                    let rows = inverse.rows;
                    inverse.data.iter_mut().step_by(rows + 1).for_each(|own| *own = 1.0);
                    lu.solve_in_place(&mut inverse.data);
                    done
                }
            }
        })
    }

    /// Replaces the residual of `state`, just evaluated, by the correction with which less than `tolerance` (N) is missing at
    /// every spring. The springs are left where they are foreseen. Where a law has no value there, nothing is replaced.
    pub(super) fn solve(
        &mut self,
        system: &mut System,
        tangents: &[ContactTangent],
        (state, step): (&State, &Coefficients),
        residual: &mut [f64],
        (tolerance, again): (f64, bool),
    ) -> Option<Followed> {
        let springs = &system.machine.springs;
        self.forces.copy_from_slice(residual);
        self.bodies.iter_mut().for_each(|body| body.solve(residual));
        let rough = (self.first, self.bores.as_slice());
        springs.measure(rough, residual, &mut self.found, &mut self.last);
        system.springs.mark();
        system.springs.measured_forces(&mut self.start);
        // What L⁻¹r moves springs by calls forces by itself.
        self.missing.fill(0.0);
        springs.add_linear(tangents, &self.last, 1.0, &mut self.missing);
        self.moved.copy_from_slice(&self.last);
        self.correct(tolerance);
        self.last.copy_from_slice(&self.moved);
        self.before.copy_from_slice(&self.start);
        let Some(followed) = self.follow(system, tangents, step.a1, tolerance) else {
            residual.copy_from_slice(&self.forces);
            return None;
        };
        let ends = self.after.iter().zip(&self.start);
        self.missing.iter_mut().zip(ends).for_each(|(out, (after, start))| *out = after - start);
        springs.add_measured(self.first, &self.missing, &mut self.forces);
        residual.copy_from_slice(&self.forces);
        self.bodies.iter_mut().for_each(|body| body.solve(residual));
        if again {
            self.solve_again(system, state, step, residual);
        }
        Some(followed)
    }

    /// Corrects what bodies that turn still lack where L varies: once more by L⁻¹, from their own equations at the end of
    /// `correction`, the forces there left as they are foreseen.
    fn solve_again(
        &mut self,
        system: &mut System,
        state: &State,
        step: &Coefficients,
        correction: &mut [f64],
    ) {
        let first = self.first;
        self.end.copy_from(state);
        step.correct(state, correction.iter().copied(), first, &mut self.end);
        system.change_of_turning(&self.end, &mut self.lack);
        let turning = self.bodies.iter_mut().filter(|body| body.turns());
        for body in turning {
            for place in body.places() {
                self.forces[place] += self.lack[first + place];
            }
            body.solve(&mut self.forces);
            for place in body.places() {
                correction[place] += self.forces[place];
            }
        }
    }

    /// Corrects the measures until no force is missing; leaves the forces that are foreseen in `after`.
    fn follow(
        &mut self,
        system: &mut System,
        tangents: &[ContactTangent],
        a1: f64,
        tolerance: f64,
    ) -> Option<Followed> {
        let springs: &Springs = &system.machine.springs;
        let (mut first, mut least) = (None, f64::INFINITY);
        for corrections in 1..=MOST {
            system.springs.displace(springs, &self.moved, a1);
            system.springs.measured_forces(&mut self.after);
            let forces = self.after.iter().zip(&self.before);
            self.missing.iter_mut().zip(forces).for_each(|(out, (after, before))| {
                *out = after - before;
            });
            springs.add_linear(tangents, &self.last, -1.0, &mut self.missing);
            let (missing, weights) = (&self.missing, &self.weights);
            let (size, sum) = largest_and_sum(missing.len(), |i| missing[i] * weights[i]);
            if !sum.is_finite() {
                return None;
            }
            if size <= tolerance {
                return Some(Followed { corrections, contracts: true });
            }
            if size > CONTRACTION * least {
                // What the tangent foresees is better.
                let forces = self.after.iter_mut().zip(&self.missing);
                forces.for_each(|(force, missing)| *force -= missing);
                let contracts = first.is_some_and(|first| size <= ENOUGH * first);
                return Some(Followed { corrections, contracts });
            }
            first.get_or_insert(size);
            least = size;
            self.correct(tolerance);
            std::mem::swap(&mut self.before, &mut self.after);
        }
        self.after.copy_from_slice(&self.before);
        Some(Followed { corrections: MOST, contracts: false })
    }

    /// Moves the measures by Zρ, forces left out that move nothing to speak of.
    fn correct(&mut self, tolerance: f64) {
        let (n, least) = (self.missing.len(), NOTHING * tolerance);
        self.found.fill(0.0);
        let forces = self.missing.iter().zip(&self.weights);
        let forces = forces.map(|(own, weight)| match (own * weight).abs() > least {
            true => *own as f32,
            false => 0.0,
        });
        add_columns(&mut self.found, self.compliance.chunks_exact(n).zip(forces));
        for ((last, moved), found) in self.last.iter_mut().zip(&mut self.moved).zip(&self.found) {
            *last = f64::from(*found);
            *moved += *last;
        }
    }
}

impl BodyInverse {
    fn turns(&self) -> bool {
        matches!(self.kind, Inverse::Block { .. })
    }

    /// Its coordinates among the unknowns.
    fn places(&self) -> impl Iterator<Item = usize> + Clone + use<> {
        self.rotation.into_iter().chain(self.flexible.clone())
    }

    /// Replaces the forces on its coordinates, among those on all unknowns, by L⁻¹ times them.
    fn solve(&mut self, x: &mut [f64]) {
        match &mut self.kind {
            Inverse::Diagonal(inverse) => {
                let own = x[self.flexible.clone()].iter_mut().zip(inverse.iter());
                own.for_each(|(x, inverse)| *x *= inverse);
            }
            Inverse::Block { inverse, given, solved, .. } => {
                let (theta, rest) = given.split_at_mut(usize::from(self.rotation.is_some()));
                theta.iter_mut().zip(self.rotation).for_each(|(own, place)| *own = x[place]);
                rest.copy_from_slice(&x[self.flexible.clone()]);
                solved.fill(0.0);
                add_product(solved, inverse, given);
                let (theta, rest) = solved.split_at(usize::from(self.rotation.is_some()));
                theta.iter().zip(self.rotation).for_each(|(own, place)| x[place] = *own);
                x[self.flexible.clone()].copy_from_slice(rest);
            }
        }
    }
}

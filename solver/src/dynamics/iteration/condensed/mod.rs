//! A step without what carries no joint: the iteration in the measures u of the joints.
//!
//! Between its joints a machine is all but linear in a step, body by body: of the residual r at a state the forces on the
//! measures become F = F(u₀ + N L⁻¹(r + Nᵀ(F − F₀))), where L = a2 M + a1 C + K + PF − a1 P − B without springs: diagonal for bodies
//! that do not turn, a small block for each of the others. With the kept tangent K₀ of the springs, forces ρ = ΔF − K₀Δu that it
//! did not foresee move the measures by Zρ, Z = N(L − NᵀK₀N)⁻¹Nᵀ. So u is iterated by the laws themselves until no force is missing,
//! and the coordinates follow at once: L⁻¹(r + NᵀΔF). What varies in L is left to the iteration of the step, which judges every
//! state by its own residual.

mod bodies;
mod compliance;
mod kept;

use whirl_specs::ContactTangent;

use self::bodies::BodyInverse;
use self::compliance::Compliance;
pub(super) use self::kept::KeptBodies;
use super::newmark::Coefficients;
use crate::bearing::Springs;
use crate::equations::{Equations, State};
use crate::linalg::largest_and_sum;

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
    compliance: Compliance,
    /// What moments are multiplied by to compare them with forces (1/m); 1 for forces.
    weights: Vec<f64>,
    /// Motion since the iteration began, and that of a correction.
    moved: Vec<f64>,
    last: Vec<f64>,
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

impl Condensed {
    /// For a machine whose measures are constant, where it saves time.
    pub(super) fn new(equations: &Equations) -> Option<Self> {
        let springs = &equations.machine.springs;
        let saves = Compliance::is_worth_it(springs, equations.machine.active());
        (saves && springs.measures_are_constant()).then(|| Condensed::of(equations))
    }

    fn of(equations: &Equations) -> Self {
        let (machine, springs) = (equations.machine, &equations.machine.springs);
        let (first, unknowns) = (machine.first_unknown(), machine.active());
        let measured = springs.measured();
        let values = || vec![0.0; measured];
        Condensed {
            first,
            bodies: BodyInverse::all(machine),
            whole: vec![0.0; machine.size() * machine.size()],
            compliance: Compliance::new(springs, first, unknowns),
            weights: springs.arms_of_measures().iter().map(|arm| 1.0 / arm).collect(),
            moved: values(),
            last: values(),
            start: values(),
            before: values(),
            after: values(),
            missing: values(),
            forces: vec![0.0; unknowns],
            end: State::new(machine.size()),
            lack: vec![0.0; machine.size()],
        }
    }

    /// Makes Z of (L − NᵀK₀N)⁻¹, column after column; whether single precision holds it.
    pub(super) fn take_compliance(&mut self, springs: &Springs, inverse: &[f64]) -> bool {
        self.compliance.take(springs, inverse)
    }

    /// Makes L⁻¹ at a state just evaluated; whether there is one.
    pub(super) fn take_bodies(
        &mut self,
        equations: &mut Equations,
        t: f64,
        state: &State,
        step: &Coefficients,
    ) -> bool {
        equations.tangent_of_bodies(t, state, step.weights(), &mut self.whole);
        let (whole, size, first) = (&self.whole, state.q.len(), self.first);
        self.bodies.iter_mut().all(|body| body.take(whole, size, first))
    }

    /// Replaces the residual of `state`, just evaluated, by the correction with which less than `tolerance` (N) is missing at
    /// every spring. The springs are left where they are foreseen. Where a law has no value there, nothing is replaced.
    pub(super) fn solve(
        &mut self,
        equations: &mut Equations,
        tangents: &[ContactTangent],
        (state, step): (&State, &Coefficients),
        residual: &mut [f64],
        (tolerance, again): (f64, bool),
    ) -> Option<Followed> {
        let springs = &equations.machine.springs;
        self.forces.copy_from_slice(residual);
        self.bodies.iter_mut().for_each(|body| body.solve(residual));
        self.compliance.measure(springs, residual, &mut self.last);
        equations.springs.mark();
        equations.springs.measured_forces(&mut self.start);
        // What L⁻¹r moves springs by calls forces by itself.
        self.missing.fill(0.0);
        springs.add_linear(tangents, &self.last, 1.0, &mut self.missing);
        self.moved.copy_from_slice(&self.last);
        self.correct(tolerance);
        self.last.copy_from_slice(&self.moved);
        self.before.copy_from_slice(&self.start);
        let Some(followed) = self.follow(equations, tangents, step.a1, tolerance) else {
            residual.copy_from_slice(&self.forces);
            return None;
        };
        let ends = self.after.iter().zip(&self.start);
        self.missing.iter_mut().zip(ends).for_each(|(out, (after, start))| *out = after - start);
        self.compliance.add_forces(springs, &self.missing, &mut self.forces);
        residual.copy_from_slice(&self.forces);
        self.bodies.iter_mut().for_each(|body| body.solve(residual));
        if again {
            self.solve_again(equations, state, step, residual);
        }
        Some(followed)
    }

    /// Corrects what bodies that turn still lack where L varies: once more by L⁻¹, from their own equations at the end of
    /// `correction`, the forces there left as they are foreseen.
    fn solve_again(
        &mut self,
        equations: &mut Equations,
        state: &State,
        step: &Coefficients,
        correction: &mut [f64],
    ) {
        let first = self.first;
        self.end.copy_first(first, state);
        step.correct(state, correction.iter().copied(), first, &mut self.end);
        equations.change_of_turning(&self.end, &mut self.lack);
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
        equations: &mut Equations,
        tangents: &[ContactTangent],
        a1: f64,
        tolerance: f64,
    ) -> Option<Followed> {
        let springs: &Springs = &equations.machine.springs;
        let (mut first, mut least) = (None, f64::INFINITY);
        for corrections in 1..=MOST {
            equations.springs.displace(springs, &self.moved, a1);
            equations.springs.measured_forces(&mut self.after);
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
        let least = NOTHING * tolerance;
        let forces = self.missing.iter().zip(&self.weights);
        let forces = forces.map(|(own, weight)| match (own * weight).abs() > least {
            true => *own as f32,
            false => 0.0,
        });
        self.compliance.apply(forces, &mut self.last);
        self.moved.iter_mut().zip(&self.last).for_each(|(moved, last)| *moved += last);
    }
}

#[cfg(test)]
mod tests {
    use super::super::newmark::Newmark;
    use super::*;
    use crate::dynamics::small::{machine, state};
    use crate::linalg::{Lu, Matrix};
    use crate::machine::Rotation;

    /// What single precision leaves of a number.
    const ROUGH: f64 = 1e-6;

    fn values(n: usize, first: f64) -> Vec<f64> {
        (0..n).map(|i| (first + 2.3 * i as f64).sin()).collect()
    }

    fn measure(own: &mut Condensed, equations: &Equations, d: &[f64]) -> Vec<f64> {
        let mut u = vec![0.0; own.last.len()];
        own.compliance.measure(&equations.machine.springs, d, &mut u);
        u
    }

    fn sum(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    /// Springs that are moved by their measures do what they do where the coordinates have moved.
    #[test]
    fn springs_move_with_their_measures() {
        for (rotation, first) in [(Rotation::Free, 0), (Rotation::Held, 1)] {
            let machine = machine(rotation);
            let (mut equations, step) =
                (Equations::new(&machine), Coefficients::new(Newmark::default(), 0.01));
            let mut own = Condensed::of(&equations);
            let (from, d) = (state(5), values(5 - first, 0.7));
            let d: Vec<f64> = d.iter().map(|own| 1e-3 * own).collect();
            let mut to = from.clone();
            step.correct(&from, d.iter().copied(), first, &mut to);
            let (mut moved, mut exact) = (vec![0.0; own.last.len()], vec![0.0; own.last.len()]);
            equations.evaluate(0.0, &to);
            equations.springs.measured_forces(&mut exact);
            equations.evaluate(0.0, &from);
            let u = measure(&mut own, &equations, &d);
            equations.springs.mark();
            equations.springs.displace(&machine.springs, &u, step.a1);
            equations.springs.measured_forces(&mut moved);
            let most = exact.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            for (moved, exact) in moved.iter().zip(&exact) {
                assert!((moved - exact).abs() < ROUGH * most, "{moved} for {exact}");
            }
        }
    }

    /// Forces on the measures do the same work as those on the coordinates that come from them.
    #[test]
    fn forces_on_measures_work_on_the_coordinates() {
        let machine = machine(Rotation::Free);
        let equations = Equations::new(&machine);
        let mut own = Condensed::of(&equations);
        let (d, forces) = (values(5, 0.7), values(own.last.len(), 1.9));
        let mut on_coordinates = vec![0.0; 5];
        own.compliance.add_forces(&machine.springs, &forces, &mut on_coordinates);
        let (there, here) =
            (sum(&forces, &measure(&mut own, &equations, &d)), sum(&on_coordinates, &d));
        assert!((there - here).abs() < ROUGH * here.abs(), "{there} for {here}");
    }

    #[test]
    fn the_compliance_moves_measures_by_forces_on_them() {
        let machine = machine(Rotation::Free);
        let equations = Equations::new(&machine);
        let mut own = Condensed::of(&equations);
        let inverse = values(25, 0.2);
        assert!(own.take_compliance(&machine.springs, &inverse));
        let n = own.last.len();
        let forces = values(n, 1.3);
        let mut on_coordinates = vec![0.0; 5];
        own.compliance.add_forces(&machine.springs, &forces, &mut on_coordinates);
        let moved: Vec<f64> =
            (0..5).map(|i| (0..5).map(|j| inverse[5 * j + i] * on_coordinates[j]).sum()).collect();
        let exact = measure(&mut own, &equations, &moved);
        let most = exact.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        let mut found = vec![0.0; n];
        let rough = forces.iter().map(|own| *own as f32);
        own.compliance.apply(rough, &mut found);
        for (i, exact) in exact.iter().enumerate() {
            let found = found[i];
            assert!((found - exact).abs() < 10.0 * ROUGH * most, "{i}: {found} for {exact}");
        }
    }

    /// Laws that hide their slopes, and matrices that vary with the motion: a few corrections solve the step.
    #[test]
    fn a_correction_leaves_nothing_that_a_linear_machine_lacks() {
        for rotation in [Rotation::Free, Rotation::Held] {
            let machine = machine(rotation);
            let first = machine.first_unknown();
            let (mut equations, step) =
                (Equations::new(&machine), Coefficients::new(Newmark::default(), 1e-3));
            let mut own = Condensed::of(&equations);
            let mut at = state(5);
            equations.evaluate(0.0, &at);
            let mut lu = Lu::new(5 - first);
            let mut whole = vec![0.0; 25];
            equations.tangent(0.0, &at, step.weights(), &mut whole);
            crate::linalg::copy_block_from(first, &whole, 5, lu.values_mut());
            lu.factor_in_place().unwrap();
            let mut inverse = Matrix::identity(5 - first).data;
            lu.solve_in_place(&mut inverse);
            assert!(own.take_compliance(&machine.springs, &inverse));
            assert!(own.take_bodies(&mut equations, 0.0, &at, &step));
            let tangents = equations.spring_tangents().to_vec();
            let size = |equations: &Equations| {
                equations.residual[first..].iter().map(|r| r.abs()).fold(0.0, f64::max)
            };
            let start = size(&equations);
            for again in [false, true] {
                let mut correction = equations.residual[first..].to_vec();
                let followed = own
                    .solve(&mut equations, &tangents, (&at, &step), &mut correction, (1e-9, again))
                    .expect("laws have values");
                assert!(followed.contracts, "{followed:?}");
                let foreseen = equations.springs.forces.clone();
                let from = at.clone();
                step.correct(&from, correction.into_iter(), first, &mut at);
                equations.evaluate(0.0, &at);
                let forces = equations.springs.forces.iter().zip(&foreseen);
                forces.for_each(|(own, foreseen)| assert!((own - foreseen).abs() < 1e-3));
            }
            let end = size(&equations);
            assert!(end < 1e-9 * start, "{end} of {start}");
        }
    }
}

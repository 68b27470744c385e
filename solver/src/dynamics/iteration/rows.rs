//! How far the rows of the equations are from solved, each compared with its own terms.

use whirl_specs::Registers;
use whirl_specs::registers::{Register, Task};

use super::newton::{CONTRACTION, NewtonOptions, UNSQUARED};
use crate::equations::{Equations, State, TurningBody, instant};
use crate::linalg::{largest_and_sum, sum_of, sum_over, widely};

/// Share of the largest force projected on a row that counts as nothing, beside that of the row's terms: where
/// forces cancel, what is left of them is rounding of the state.
pub(super) const PROJECTED: f64 = 1e-3;
/// Share of the tolerance of forces that may be missing at each spring: what is left of a change that was the last,
/// where kept factors contract as badly as they may.
const MISSING: f64 = CONTRACTION / (1.0 - CONTRACTION);
/// Multiples of eps · Σ |terms| that rounding may leave in a row.
const ROUNDING: f64 = 16.0;
/// What is smaller is none (N, N·m): what decays for ever ends where numbers have fewer and fewer digits.
const NOTHING: f64 = 1e-280;

/// Norms from which follows what forces and products can add to the bound of a row at most: a row beyond that is
/// not solved, and needs none of them.
#[derive(Clone, Copy)]
struct RowBounds {
    /// Largest force of a spring or ring (N).
    force: f64,
    /// ‖q̈‖ + ‖predicted q̈‖, ‖q̇‖ and ‖q‖.
    state: [f64; 3],
}

impl RowBounds {
    fn of(equations: &Equations, state: &State, predicted: &State) -> Self {
        let norm = |x: &[f64]| match sum_over([x], |[x]| x * x).sqrt() {
            tiny if tiny < UNSQUARED => largest_and_sum(x.len(), |i| x[i]).1,
            norm => norm,
        };
        let forces = &equations.springs.forces;
        let mut force = 0.0;
        widely(|| force = largest_and_sum(forces.len(), |j| forces[j]).0);
        let state = [norm(&state.a) + norm(&predicted.a), norm(&state.v), norm(&state.q)];
        RowBounds { force, state }
    }

    /// Twice what they can add to the bound of row `i`; of the row of θ nothing is known.
    fn allowed(&self, equations: &Equations, state: &State, tolerance: f64, i: usize) -> f64 {
        let products = match (equations.turning_at(i), equations.machine.owner(i).coordinate) {
            (_, None) => return f64::INFINITY,
            (Some(body), Some(row)) => {
                let norms = &equations.turning[body].row_norms[row];
                norms.iter().zip(&self.state).map(|(a, b)| a * b).sum()
            }
            (None, Some(_)) => self.state[0],
        };
        let reach = equations.machine.springs.reach[i];
        let load: f64 = equations.projected_loads(state, i).sum();
        let followed: f64 = equations.followed_loads(state, i).sum();
        // Σ |coefficient · force| of n springs is √n · reach · force at most.
        let springs = (equations.springs.forces.len() as f64).sqrt() * self.force * reach;
        2.0 * (tolerance * PROJECTED * (self.force * reach + load)
            + ROUNDING * f64::EPSILON * (products + springs + load + followed))
    }
}

impl Equations<'_> {
    /// The largest |r_i| of the unknowns' rows at the state that was last evaluated, over what a row may have:
    /// `residual_tolerance` · (largest term + 1e-3 · largest force projected on it) + a quarter of
    /// `force_tolerance` missing at each spring + 16 ε Σ |terms|. At most 1: solved; otherwise that of the first
    /// row that is not.
    ///
    /// Terms are Q_v − M q̈, C q̇, K q, loads and springs; where they cancel, their products are summed, with
    /// those of the accelerations in `predicted`, from which the state was corrected. What is left where iterations stall
    /// may come from springs that hold differences of large coordinates (`SpringRounding`, which costs two tangents of all).
    // A phase of its own in tables of where the time goes.
    #[inline(never)]
    pub(crate) fn row_error(
        &mut self,
        [state, predicted]: [&State; 2],
        options: &NewtonOptions,
        stalls: bool,
    ) -> f64 {
        let tolerance = options.residual_tolerance;
        let first = self.machine.first_unknown();
        self.bound_rows(options);
        let mut worst = 0.0;
        let mut mass_is_known = None;
        let mut most: Option<RowBounds> = None;
        let mut measures_are_sized = false;
        for i in first..self.residual.len() {
            let (r, bound) = (self.residual[i].abs(), self.row_bounds[i]);
            if r <= bound {
                if r > worst * bound {
                    worst = r / bound;
                }
                continue;
            }
            let most = match most {
                Some(most) => most,
                None => {
                    self.size_terms(state, predicted);
                    *most.insert(RowBounds::of(self, state, predicted))
                }
            };
            let above = bound + most.allowed(self, state, tolerance, i);
            let mut measured = 0.0;
            if r > above && !stalls {
                return r / above;
            }
            if r > above {
                measured = self.measured_rounding(state, &mut measures_are_sized, i);
                if r > above + measured {
                    return r / (above + measured);
                }
            }
            let body = self.turning_at(i);
            if let Some(own) = body.filter(|_| body != mass_is_known) {
                self.turning[own].evaluate_mass(state);
                mass_is_known = body;
            }
            let (projected, products) = self.projected(state, predicted, i);
            let mut bound = bound
                + tolerance * PROJECTED * projected
                + ROUNDING * f64::EPSILON * products
                + measured;
            if r > bound && measured == 0.0 && stalls {
                bound += self.measured_rounding(state, &mut measures_are_sized, i);
            }
            // A ratio that is no number is the worst.
            let error = if (r / bound).is_nan() { f64::INFINITY } else { r / bound };
            if error > 1.0 {
                return error;
            }
            worst = f64::max(worst, error);
        }
        worst
    }

    /// What every row may have by its own terms and the forces that may be missing, without what forces and
    /// products that cancel in it explain.
    fn bound_rows(&mut self, options: &NewtonOptions) {
        let n = self.residual.len();
        let terms = [&self.inertia, &self.damper, &self.elastic, &self.load, &self.spring];
        Registers::current().run(Bounds {
            terms: terms.map(|own| &own[..n]),
            reach: &self.machine.springs.reach[..n],
            tolerance: options.residual_tolerance,
            missing: MISSING * options.force_tolerance,
            bounds: &mut self.row_bounds[..n],
        });
    }

    /// What the rounding of the measures of springs may leave in row `i`, at the state that was last evaluated.
    fn measured_rounding(&mut self, state: &State, are_sized: &mut bool, i: usize) -> f64 {
        if !std::mem::replace(are_sized, true) {
            let springs = &self.machine.springs;
            self.spring_rounding.take(springs, &mut self.springs, [&state.q, &state.v]);
        }
        let rounding = ROUNDING * f64::EPSILON * self.spring_rounding.forces[i];
        // Of a law without slopes nothing is known.
        if rounding.is_finite() { rounding } else { 0.0 }
    }

    /// Takes what all rows have in common of their products.
    fn size_terms(&mut self, state: &State, predicted: &State) {
        let accelerations = state.a.iter().zip(&predicted.a).map(|(a, b)| a.abs() + b.abs());
        self.accelerations.iter_mut().zip(accelerations).for_each(|(own, size)| *own = size);
        self.springs.size_forces(&self.machine.springs);
    }

    /// The turning body whose coordinate stands at place `i` of q.
    fn turning_at(&self, i: usize) -> Option<usize> {
        let is_own = |own: &TurningBody| own.theta() == i || own.place.flexible.contains(&i);
        self.turning.iter().position(is_own)
    }

    /// The loads projected on row `i`.
    fn projected_loads<'s>(&'s self, state: &'s State, i: usize) -> impl Iterator<Item = f64> + 's {
        let (machine, owner) = (self.machine, self.machine.owner(i));
        let strengths = self.amplitudes.iter().zip(&self.load_factors);
        let loads = machine.loads.iter().zip(strengths);
        loads.filter(move |(load, _)| load.body == owner.body).map(move |(load, strength)| {
            let flexible = machine.places()[load.body].flexible.clone();
            let (amplitude, factor) = strength;
            load.projected((amplitude, *factor), &state.q[flexible], owner.coordinate)
        })
    }

    /// What loads would change by on row `i` if the angles or speeds that they follow were none: their rounding is one of these.
    fn followed_loads<'s>(&'s self, state: &'s State, i: usize) -> impl Iterator<Item = f64> + 's {
        let (machine, owner) = (self.machine, self.machine.owner(i));
        let now = instant(machine, self.time, state);
        let loads = machine.loads.iter().zip(&self.amplitudes);
        loads.filter(move |(load, _)| load.body == owner.body).map(move |(load, amplitude)| {
            let flexible = machine.places()[load.body].flexible.clone();
            let strength = (amplitude, load.followed(&now));
            load.projected(strength, &state.q[flexible], owner.coordinate)
        })
    }

    /// Of row `i` the largest single force projected on it, and the sum of all products that stand in it, of the terms that
    /// were sized. The mass matrix of its body, if that turns, must be in the body's block; it and K are symmetric.
    fn projected(&self, state: &State, predicted: &State, i: usize) -> (f64, f64) {
        let owner = self.machine.owner(i);
        let (mut largest, mut sum) = self.springs.projected(&self.machine.springs, i);
        for force in self.projected_loads(state, i) {
            largest = f64::max(largest, force);
            sum += force;
        }
        sum += self.followed_loads(state, i).sum::<f64>();
        let Some(body) = self.turning_at(i).map(|body| &self.turning[body]) else {
            return (largest, sum + predicted.a[i].abs());
        };
        let column = body.column(owner.coordinate.map_or(0, |row| 1 + row));
        let flexible = body.place.flexible.clone();
        let accelerations = &self.accelerations[flexible.clone()];
        let (q, v) = (&state.q[flexible.clone()], &state.v[flexible]);
        sum += column[0].abs() * self.accelerations[body.theta()];
        widely(|| {
            let n = accelerations.len();
            // Of one length, so that no bound is checked on the way.
            let (column, q, v) = (&column[1..][..n], &q[..n], &v[..n]);
            sum += sum_of(n, |j| column[j].abs() * accelerations[j]);
            let Some(row) = owner.coordinate else { return };
            let elastic = &body.shaft.stiffness.col(row)[..n];
            sum += sum_of(n, |j| (elastic[j] * q[j]).abs());
            sum += match body.proportional {
                Some(factor) => factor.abs() * sum_of(n, |j| (elastic[j] * v[j]).abs()),
                None => sum_of(n, |j| (body.shaft.damping[(row, j)] * v[j]).abs()),
            };
        });
        (largest, sum)
    }
}

/// See [`Equations::bound_rows`].
struct Bounds<'a> {
    terms: [&'a [f64]; 5],
    reach: &'a [f64],
    tolerance: f64,
    missing: f64,
    bounds: &'a mut [f64],
}

impl Task for Bounds<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        // Of one length, so that no bound is checked on the way.
        let n = self.bounds.len();
        let [inertia, damper, elastic, load, spring] = self.terms.map(|own| &own[..n]);
        let (reach, bounds) = (&self.reach[..n], &mut self.bounds[..n]);
        for i in 0..n {
            let terms = [inertia[i], damper[i], elastic[i], load[i], spring[i]].map(f64::abs);
            let larger = |a: f64, b: f64| if a > b { a } else { b };
            let largest = terms.into_iter().fold(0.0, larger);
            let sum: f64 = terms.into_iter().sum();
            bounds[i] = self.tolerance * largest
                + self.missing * reach[i]
                + ROUNDING * f64::EPSILON * sum
                + NOTHING;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::small::{ANGLES, FORCE, RADIUS, machine, state};
    use crate::machine::Rotation;

    /// |force| projected on every coordinate, force by force, from the geometry of the small machine. Its node
    /// moves by 5 and 13 for a unit of η, each in a direction of its own.
    fn projected(equations: &Equations, state: &State) -> [Vec<f64>; 5] {
        let (eta, arms) = (&state.q[1..3], [5.0, 13.0]);
        let moved = [3.0 * eta[0] + 5.0 * eta[1], 4.0 * eta[0] - 12.0 * eta[1]];
        let offset = moved[0].hypot(moved[1]);
        let forces = &equations.springs.forces;
        let (alone, normal) = (&forces[..3], &forces[3..6]);
        let (friction, ring) = (&forces[6..9], &forces[9..12]);
        let load = FORCE.iter().map(|f| f * f).sum::<f64>().sqrt();
        let off_centre = alone.iter().chain(normal).chain(&ring[..2]);
        let mut theta: Vec<f64> = off_centre.clone().map(|f| (f * offset).abs()).collect();
        theta.extend(friction.iter().map(|f| (f * (RADIUS + offset)).abs()));
        theta.push((ring[2] * RADIUS).abs());
        theta.push(load * (0.3 + moved[0]).hypot(0.4 + moved[1]));
        let on_shaft = arms.map(|arm| {
            let forces = off_centre.clone().chain(friction).map(|f| (arm * f).abs());
            forces.chain([arm * load]).collect()
        });
        // A unit of a coordinate of the support moves the bore by 1/√4.
        let on_support = [0, 1].map(|axis| {
            let along = |j: usize| [ANGLES[j].cos(), ANGLES[j].sin()][axis];
            let across = |j: usize| [-ANGLES[j].sin(), ANGLES[j].cos()][axis];
            let mut all: Vec<f64> = (0..3).map(|j| (0.5 * alone[j] * along(j)).abs()).collect();
            all.extend((0..3).map(|j| (0.5 * normal[j] * along(j)).abs()));
            all.extend((0..3).map(|j| (0.5 * friction[j] * across(j)).abs()));
            all.push((0.5 * ring[axis]).abs());
            all
        });
        let ([a, b], [c, d]) = (on_shaft, on_support);
        [theta, a, b, c, d]
    }

    /// √Σ of the squares of how far a unit of each coordinate moves the seven places where forces act.
    fn reach() -> [f64; 5] {
        let on_support = [0, 1].map(|axis| {
            let along = |psi: &f64| [psi.cos(), psi.sin()][axis].powi(2);
            // Springs along the normal; those with friction along both directions; the ring.
            (0.25 * (ANGLES.iter().map(along).sum::<f64>() + 3.0 + 1.0)).sqrt()
        });
        let all = 7.0_f64.sqrt();
        [0.5 * all, 5.0 * all, 13.0 * all, on_support[0], on_support[1]]
    }

    /// Every product that stands in a row but those of forces.
    fn products(equations: &mut Equations, state: &State, predicted: &State) -> [f64; 5] {
        let mass = equations.turning[0].unknown_mass(state, false).data;
        let shaft = equations.machine.bodies[0].shaft().expect("a shaft");
        let on_shaft = [0, 1, 2].map(|i| {
            let inertia =
                (0..3).map(|j| mass[3 * j + i].abs() * (state.a[j].abs() + predicted.a[j].abs()));
            let own = |j: usize| {
                let bent = shaft.stiffness[(i - 1, j)] * state.q[1 + j];
                bent.abs() + (shaft.damping[(i - 1, j)] * state.v[1 + j]).abs()
            };
            inertia.sum::<f64>() + if i > 0 { own(0) + own(1) } else { 0.0 }
        });
        let [theta, a, b] = on_shaft;
        [theta, a, b, predicted.a[3].abs(), predicted.a[4].abs()]
    }

    /// Row by row, by each part of what a row may have and by all of them.
    #[test]
    fn a_row_may_have_what_its_terms_its_forces_and_rounding_explain() {
        let machine = machine(Rotation::Free);
        let (state, mut predicted) = (state(5), state(5));
        predicted.a.iter_mut().for_each(|a| *a *= -1.3);
        let mut equations = Equations::new(&machine);
        equations.evaluate(0.0, &state);
        let (projected, reach) = (projected(&equations, &state), reach());
        let products = products(&mut equations, &state, &predicted);
        // What the measures of springs round to is a test of the command.
        equations.spring_rounding.take(
            &machine.springs,
            &mut equations.springs,
            [&state.q, &state.v],
        );
        let measured = equations.spring_rounding.forces.clone();
        for (residual_tolerance, force_tolerance) in
            [(1e-2, 0.0), (0.0, 3.0), (0.0, 0.0), (1e-2, 3.0)]
        {
            let options =
                NewtonOptions { residual_tolerance, force_tolerance, ..NewtonOptions::default() };
            for i in 0..5 {
                let terms = [
                    &equations.inertia,
                    &equations.damper,
                    &equations.elastic,
                    &equations.load,
                    &equations.spring,
                ];
                let terms = terms.map(|term| term[i].abs());
                let (largest, sum) =
                    (terms.into_iter().fold(0.0, f64::max), terms.iter().sum::<f64>());
                let missing = 0.25 * force_tolerance * reach[i];
                let seen = residual_tolerance * largest + missing + 16.0 * f64::EPSILON * sum;
                let forces = projected[i].iter().copied();
                let without = residual_tolerance
                    * (largest + 1e-3 * forces.clone().fold(0.0, f64::max))
                    + missing
                    + 16.0 * f64::EPSILON * (sum + forces.sum::<f64>() + products[i]);
                let own = without + 16.0 * f64::EPSILON * measured[i];
                // Within what the terms alone explain, within what all explains, and beyond it.
                for r in [0.75 * seen, 0.999 * own, 1.001 * own, 7.0 * own] {
                    equations.residual.fill(0.0);
                    equations.residual[i] = -r;
                    // Memory in which anything may stand.
                    equations.turning[0].spoil();
                    let found = equations.row_error([&state, &predicted], &options, true);
                    let name = (i, residual_tolerance, force_tolerance);
                    let limits = [seen, without, own];
                    let exact = r / limits.into_iter().find(|limit| r <= *limit).unwrap_or(own);
                    let least = if exact > 1.0 { 1.0 } else { exact * (1.0 - 1e-12) };
                    let most = exact * (1.0 + 1e-12);
                    assert!((least..=most).contains(&found), "{name:?}: {found} for {exact}");
                    // While the iteration goes on, the rounding of measures explains nothing.
                    let early = equations.row_error([&state, &predicted], &options, false);
                    assert_eq!(early <= 1.0, r <= without, "{name:?}: {early}");
                }
            }
        }
        equations.residual.fill(0.0);
        assert_eq!(equations.row_error([&state, &predicted], &NewtonOptions::default(), true), 0.0);
    }
}

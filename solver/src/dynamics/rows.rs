//! How far the rows of the equations are from solved, each judged by what stands in it.

use super::newmark::State;
use super::newton::NewtonOptions;
use super::system::System;

/// Share of the largest force projected on a row that counts as nothing, beside that of the row's terms: where
/// forces cancel, what is left of them is rounding of the state.
pub(super) const PROJECTED: f64 = 1e-3;
/// Share of the tolerance of forces that may be missing at each spring: forces at rest to it are nearer to their
/// limit, as far as the iteration contracts.
const MISSING: f64 = 0.1;
/// Multiples of eps · Σ |terms| that rounding may leave in a row.
const ROUNDING: f64 = 16.0;

impl System<'_> {
    /// The largest |r_i| of the unknowns' rows at the state that was last evaluated, over what a row may have:
    /// `residual_tolerance` · (largest term + 1e-3 · largest force projected on it) + a tenth of
    /// `force_tolerance` missing at each spring + 16 ε Σ |terms|. At most 1: solved; otherwise that of the first
    /// row that is not.
    ///
    /// Terms are Q_v − M q̈, C q̇, K q, loads and springs; where they cancel, their products are summed, with
    /// those of the accelerations in `predicted`, from which the state was corrected.
    pub(crate) fn row_error(
        &mut self,
        state: &State,
        predicted: &State,
        options: &NewtonOptions,
    ) -> f64 {
        let tolerance = options.residual_tolerance;
        let reach = &self.machine.springs.reach;
        let first = self.machine.first_unknown();
        let mut worst = 0.0;
        let mut mass_is_known = false;
        for i in first..self.residual.len() {
            let r = self.residual[i].abs();
            let terms = [&self.inertia, &self.damper, &self.elastic, &self.load, &self.spring];
            let terms = terms.map(|term| term[i].abs());
            let largest = terms.into_iter().fold(0.0, f64::max);
            let sum: f64 = terms.into_iter().sum();
            let missing = MISSING * options.force_tolerance * reach[i];
            let bound = tolerance * largest + missing + ROUNDING * f64::EPSILON * sum;
            if r <= bound {
                worst = f64::max(worst, if r > 0.0 { r / bound } else { 0.0 });
                continue;
            }
            if !mass_is_known && i <= self.machine.shaft.size() {
                let mut mass = std::mem::take(&mut self.shaft_block);
                self.shaft_mass(state, &mut mass);
                self.shaft_block = mass;
                mass_is_known = true;
            }
            let (projected, products) = self.projected(state, predicted, i);
            let bound = tolerance * (largest + PROJECTED * projected)
                + missing
                + ROUNDING * f64::EPSILON * (sum + products);
            // A ratio that is no number is the worst.
            let error = if (r / bound).is_nan() { f64::INFINITY } else { r / bound };
            if error > 1.0 {
                return error;
            }
            worst = f64::max(worst, error);
        }
        worst
    }

    /// Of row `i` the largest single force projected on it, and the sum of all products that stand in it.
    /// The shaft's mass matrix must be in `shaft_block`.
    fn projected(&self, state: &State, predicted: &State, i: usize) -> (f64, f64) {
        let machine = self.machine;
        let (shaft, first) = (&machine.shaft, 1 + machine.shaft.size());
        let (mut largest, mut sum) = self.springs.projected(&machine.springs, i);
        if i >= first {
            return (largest, sum + predicted.a[i].abs());
        }
        for (load, released) in machine.loads.iter().zip(&self.released) {
            let factor = load.factor(self.time, *released);
            let force = load.projected(factor, &state.q[1..first], i);
            largest = f64::max(largest, force);
            sum += force;
        }
        let mass = self.shaft_block.chunks_exact(first);
        let accelerations = state.a.iter().zip(&predicted.a).map(|(a, b)| a.abs() + b.abs());
        sum += mass.zip(accelerations).map(|(column, a)| column[i].abs() * a).sum::<f64>();
        if let Some(row) = i.checked_sub(1) {
            for j in 0..shaft.size() {
                sum += (shaft.stiffness[(row, j)] * state.q[1 + j]).abs()
                    + (shaft.damping[(row, j)] * state.v[1 + j]).abs();
            }
        }
        (largest, sum)
    }
}

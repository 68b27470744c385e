//! How far the rows of the equations are from solved, each judged by what stands in it.

use super::newmark::State;
use super::newton::NewtonOptions;
use super::system::System;

/// Share of the largest force projected on a row that counts as nothing, beside that of the row's terms: where
/// forces cancel, what is left of them is rounding of the state.
pub(super) const PROJECTED: f64 = 1e-3;
/// Multiples of eps · Σ |terms| that rounding may leave in a row.
const ROUNDING: f64 = 16.0;

impl System<'_> {
    /// The largest |r_i| of the unknowns' rows at the state that was last evaluated, over what a row may have:
    /// `residual_tolerance` · (largest term + 1e-3 · largest force projected on it) + `force_tolerance`
    /// missing at each spring + 16 ε Σ |terms|. At most 1: solved.
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
        for i in first..self.residual.len() {
            let r = self.residual[i].abs();
            let terms = [&self.inertia, &self.damper, &self.elastic, &self.load, &self.spring];
            let terms = terms.map(|term| term[i].abs());
            let largest = terms.into_iter().fold(0.0, f64::max);
            let sum: f64 = terms.into_iter().sum();
            let missing = options.force_tolerance * reach[i];
            let bound = tolerance * largest + missing + ROUNDING * f64::EPSILON * sum;
            if r <= bound {
                worst = f64::max(worst, if r > 0.0 { r / bound } else { 0.0 });
                continue;
            }
            let (projected, products) = self.projected(state, predicted, i);
            let bound = tolerance * (largest + PROJECTED * projected)
                + missing
                + ROUNDING * f64::EPSILON * (sum + products);
            // A ratio that is no number is the worst.
            let error = r / bound;
            worst = if error.is_nan() { f64::INFINITY } else { f64::max(worst, error) };
        }
        worst
    }

    /// Of row `i` the largest single force projected on it, and the sum of all products that stand in it.
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
        // Inertia as it is at η = 0.
        let accelerations = |i: usize| state.a[i].abs() + predicted.a[i].abs();
        let couplings = match i.checked_sub(1) {
            None => &shaft.g0[..],
            Some(row) => shaft.mass.col(row),
        };
        let own = i.checked_sub(1).map_or(shaft.j0, |row| shaft.g0[row]);
        sum += own.abs() * accelerations(0);
        let others = couplings.iter().enumerate();
        sum += others.map(|(j, share)| share.abs() * accelerations(1 + j)).sum::<f64>();
        if let Some(row) = i.checked_sub(1) {
            for j in 0..shaft.size() {
                sum += (shaft.stiffness[(row, j)] * state.q[1 + j]).abs()
                    + (shaft.damping[(row, j)] * state.v[1 + j]).abs();
            }
        }
        (largest, sum)
    }
}

//! Forces of a solved film on a rigid journal, and their slopes, by one solution with the transposed matrix for each: with
//! Jᵀ λ = ∂F/∂y, dF = (∂F/∂h − λᵀ ∂R/∂h) dh.

use super::balance::Balance;
use super::oil::Oil;
use super::openings::OilFilm;
use super::reaction::{Gradients, OUTPUTS, arms};

impl Balance {
    /// Forces and moments on the journal; the integrals of the outputs.
    pub(super) fn forces(
        &mut self,
        film: &OilFilm,
        gradients: &Gradients,
        outputs: &mut [f64],
    ) -> [f64; OUTPUTS] {
        self.cells(film, 1);
        let (kernel, grid) = (film.kernel, &film.grid);
        let [across, up] = grid.cells();
        let count = kernel.nodes[0] * kernel.nodes[1];
        let mut total = [0.0; OUTPUTS];
        outputs.fill(0.0);
        for k in 0..up {
            let out = &self.surface[k * kernel.surface.count * across..];
            for (value, row) in kernel.surface.rows.iter().enumerate() {
                let values = &out[row * across..][..across];
                let (force, a) = (value / count, value % count);
                let Some(gradients) = gradients.get(force) else {
                    let output = value - count * gradients.len();
                    outputs[output] += values.iter().sum::<f64>();
                    continue;
                };
                let places = &self.places[(k * count + a) * across..][..across];
                let z = grid.z(places[0] / grid.around);
                let mut sums = [0.0; 3];
                for (value, node) in values.iter().zip(places) {
                    let gradient = gradients[node % grid.around];
                    for (sum, gradient) in sums.iter_mut().zip(gradient) {
                        *sum += value * gradient;
                    }
                }
                for (total, arm) in total.iter_mut().zip(arms(sums, z)) {
                    *total += arm;
                }
            }
        }
        total
    }

    /// Slopes of forces and moments by the gap and by the gap that holds oil at every node, to `by_node`, and by the speed. The
    /// matrix must be that of the state.
    #[inline(never)]
    pub(super) fn slopes(
        &mut self,
        film: &OilFilm,
        oil: &Oil,
        gradients: &Gradients,
    ) -> [f64; OUTPUTS] {
        let (kernel, grid) = (film.kernel, &film.grid);
        let nodes = grid.nodes();
        let [across, up] = grid.cells();
        let count = kernel.nodes[0] * kernel.nodes[1];
        self.factors(film, oil, 1);
        self.adjoint.fill([0.0; OUTPUTS]);
        for rows in &mut self.by_node {
            rows.fill([0.0; OUTPUTS]);
        }
        let mut by_speed = [0.0; OUTPUTS];
        for k in 0..up {
            let out = &self.surface[k * kernel.surface.count * across..];
            let places = |a: usize| &self.places[(k * count + a) * across..][..across];
            for slope in kernel.surface.slopes {
                let Some(gradients) = gradients.get(slope.value / count) else { continue };
                let (own, by) = (places(slope.value % count), places(slope.node));
                let z = grid.z(own[0] / grid.around);
                let values = &out[slope.row * across..][..across];
                let active = &self.by_active[1][slope.field * nodes..][..nodes];
                let gap = &self.by_gap[1][slope.field * nodes..][..nodes];
                for ((value, node), by) in values.iter().zip(own).zip(by) {
                    let arms = arms(gradients[node % grid.around], z);
                    let (first, second) = (value * active[*by], value * gap[*by]);
                    for n in 0..OUTPUTS {
                        self.adjoint[self.order[*by]][n] += first * arms[n];
                        self.by_node[0][*by][n] += second * arms[n];
                    }
                }
            }
            for (row, value) in kernel.surface.by_speed {
                let Some(gradients) = gradients.get(value / count) else { continue };
                let own = places(value % count);
                let z = grid.z(own[0] / grid.around);
                for (value, node) in out[row * across..][..across].iter().zip(own) {
                    let arms = arms(gradients[node % grid.around], z);
                    for n in 0..OUTPUTS {
                        by_speed[n] += value * arms[n];
                    }
                }
            }
        }
        self.matrix.solve_transposed(&mut self.adjoint);
        for k in 0..up {
            let out = &self.flow[k * kernel.flow.count * across..];
            let places = |a: usize| &self.places[(k * count + a) * across..][..across];
            for slope in kernel.flow.slopes {
                let (rows, by) = (places(slope.value), places(slope.node));
                let gap = &self.by_gap[0][slope.field * nodes..][..nodes];
                let values = &out[slope.row * across..][..across];
                for ((value, row), by) in values.iter().zip(rows).zip(by) {
                    let factor = value * gap[*by];
                    let adjoint = &self.adjoint[self.order[*row]];
                    for n in 0..OUTPUTS {
                        self.by_node[0][*by][n] -= factor * adjoint[n];
                    }
                }
            }
            for (row, value) in kernel.flow.by_speed {
                for (value, node) in out[row * across..][..across].iter().zip(places(*value)) {
                    for n in 0..OUTPUTS {
                        by_speed[n] -= value * self.adjoint[self.order[*node]][n];
                    }
                }
            }
        }
        // Of a step by what nodes hold, of a steady film by the rate of that: the same slope of it by the gap.
        let rate = if self.motion.per_step > 0.0 { self.motion.per_step } else { 1.0 };
        for a in 0..nodes {
            let factor = self.stored[3 * nodes + a] * film.areas[a] * rate;
            for n in 0..OUTPUTS {
                self.by_node[1][a][n] = -factor * self.adjoint[self.order[a]][n];
            }
        }
        by_speed
    }
}

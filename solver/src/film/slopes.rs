//! Forces of a solved film on a rigid journal, and their slopes, by one solution with the transposed matrix for each: with
//! Jᵀ λ = ∂F/∂y, dF = (∂F/∂h − λᵀ ∂R/∂h) dh.

use whirl_specs::Registers;
use whirl_specs::registers::{Register, Task};

use super::balance::Balance;
use super::band::add;
use super::oil::Oil;
use super::openings::OilFilm;
use super::reaction::{Gradients, OUTPUTS, WIDE, arms};

/// What a force at a node does to as many outputs as fill a register.
pub(super) trait Weights {
    /// Whether one of the film's forces counts.
    fn of_force(&self, force: usize) -> bool;

    /// Outputs by a unit of a force at a node of a row at z (m).
    fn at(&self, force: usize, node: usize, z: f64) -> [f64; WIDE];
}

/// Forces and moments on the journal.
struct OnJournal<'a> {
    gradients: &'a Gradients,
    around: usize,
}

impl Weights for OnJournal<'_> {
    fn of_force(&self, force: usize) -> bool {
        force < self.gradients.len()
    }

    #[inline(always)]
    fn at(&self, force: usize, node: usize, z: f64) -> [f64; WIDE] {
        arms(self.gradients[force][node % self.around], z)
    }
}

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

    /// Slopes of forces and moments by the gap and by the gap that holds oil at every node, to `by_node`, and by the speed.
    #[inline(never)]
    pub(super) fn slopes(
        &mut self,
        film: &OilFilm,
        oil: &Oil,
        gradients: &Gradients,
    ) -> [f64; WIDE] {
        self.factor(film, oil);
        self.factors(film, oil, 1);
        let around = film.grid.around;
        self.slopes_by_nodes(film, oil, &OnJournal { gradients, around })
    }

    /// The same of other outputs, right after it.
    pub(super) fn slopes_by_nodes(
        &mut self,
        film: &OilFilm,
        oil: &Oil,
        weights: &impl Weights,
    ) -> [f64; WIDE] {
        let nodes = film.grid.nodes();
        let mut by_speed = [0.0; WIDE];
        let Balance { surface, flow, places, order, by_active, by_gap, adjoint, by_node, .. } =
            self;
        let [by_own, by_stored] = by_node;
        adjoint.fill([0.0; WIDE]);
        by_own.fill([0.0; WIDE]);
        let cells = Cells { film, places };
        Registers::current().run(OfForces {
            cells: &cells,
            values: surface,
            order,
            by_active: &by_active[1],
            by_gap: &by_gap[1],
            weights,
            adjoint,
            by_own,
            by_speed: &mut by_speed,
        });
        self.matrix.solve_transposed(adjoint);
        Registers::current().run(OfFlows {
            cells: &cells,
            values: flow,
            order,
            by_gap: &by_gap[0],
            adjoint,
            by_own,
            by_speed: &mut by_speed,
        });
        // Of a step by what nodes hold, of a steady film by the rate of that: the same slope of it by the gap. What a cavity of a
        // steady film holds stays, so that its fill follows the gap there and nothing else.
        let steady = self.motion.per_step == 0.0;
        for a in 0..nodes {
            let rate = match (steady, oil.second[a]) {
                (false, _) => self.motion.per_step,
                (true, held) => f64::from(u8::from(!held)),
            };
            let factor = self.stored[3 * nodes + a] * film.areas[a] * rate;
            by_stored[a] = adjoint[order[a]].map(|value| -factor * value);
        }
        by_speed
    }
}

/// Cells of a film, row after row of them.
struct Cells<'a> {
    film: &'a OilFilm,
    /// Of every row of cells, node of a cell and cell around: the node.
    places: &'a [usize],
}

impl Cells<'_> {
    /// Cells around and along, and nodes of one.
    #[inline(always)]
    fn sizes(&self) -> ([usize; 2], usize) {
        (self.film.grid.cells(), self.film.kernel.nodes[0] * self.film.kernel.nodes[1])
    }

    /// The nodes of all cells of a row that are the a-th of their cells.
    #[inline(always)]
    fn nodes(&self, k: usize, a: usize) -> &[usize] {
        let ([across, _], count) = self.sizes();
        &self.places[(k * count + a) * across..][..across]
    }
}

/// Slopes of outputs by the unknowns that are not zero, by the gap and by the speed, as forces at the nodes have them.
struct OfForces<'a, W> {
    cells: &'a Cells<'a>,
    values: &'a [f64],
    order: &'a [usize],
    by_active: &'a [f64],
    by_gap: &'a [f64],
    weights: &'a W,
    adjoint: &'a mut [[f64; WIDE]],
    by_own: &'a mut [[f64; WIDE]],
    by_speed: &'a mut [f64; WIDE],
}

impl<W: Weights> Task for OfForces<'_, W> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let OfForces { cells, values, order, by_active, by_gap, weights, .. } = self;
        let (kernel, grid) = (&cells.film.kernel.surface, &cells.film.grid);
        let (([across, up], count), nodes) = (cells.sizes(), grid.nodes());
        for k in 0..up {
            let out = &values[k * kernel.count * across..];
            for slope in kernel.slopes {
                let force = slope.value / count;
                if !weights.of_force(force) {
                    continue;
                }
                let (own, by) = (cells.nodes(k, slope.value % count), cells.nodes(k, slope.node));
                let z = grid.z(own[0] / grid.around);
                let values = &out[slope.row * across..][..across];
                let active = &by_active[slope.field * nodes..][..nodes];
                let gap = &by_gap[slope.field * nodes..][..nodes];
                for ((value, node), by) in values.iter().zip(own).zip(by) {
                    let own = weights.at(force, *node, z);
                    add::<L>(&mut self.adjoint[order[*by]], value * active[*by], &own);
                    add::<L>(&mut self.by_own[*by], value * gap[*by], &own);
                }
            }
            for (row, value) in kernel.by_speed {
                let force = value / count;
                if !weights.of_force(force) {
                    continue;
                }
                let own = cells.nodes(k, value % count);
                let z = grid.z(own[0] / grid.around);
                for (value, node) in out[row * across..][..across].iter().zip(own) {
                    add::<L>(self.by_speed, *value, &weights.at(force, *node, z));
                }
            }
        }
    }
}

/// What the balance of flows adds to slopes by the gap and by the speed.
struct OfFlows<'a> {
    cells: &'a Cells<'a>,
    values: &'a [f64],
    order: &'a [usize],
    by_gap: &'a [f64],
    adjoint: &'a [[f64; WIDE]],
    by_own: &'a mut [[f64; WIDE]],
    by_speed: &'a mut [f64; WIDE],
}

impl Task for OfFlows<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let OfFlows { cells, values, order, by_gap, adjoint, .. } = self;
        let (kernel, grid) = (&cells.film.kernel.flow, &cells.film.grid);
        let (([across, up], _), nodes) = (cells.sizes(), grid.nodes());
        for k in 0..up {
            let out = &values[k * kernel.count * across..];
            for slope in kernel.slopes {
                let (rows, by) = (cells.nodes(k, slope.value), cells.nodes(k, slope.node));
                let gap = &by_gap[slope.field * nodes..][..nodes];
                let values = &out[slope.row * across..][..across];
                for ((value, row), by) in values.iter().zip(rows).zip(by) {
                    add::<L>(&mut self.by_own[*by], -value * gap[*by], &adjoint[order[*row]]);
                }
            }
            for (row, value) in kernel.by_speed {
                let nodes = cells.nodes(k, *value);
                for (value, node) in out[row * across..][..across].iter().zip(nodes) {
                    add::<L>(self.by_speed, -value, &adjoint[order[*node]]);
                }
            }
        }
    }
}

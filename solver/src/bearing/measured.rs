//! The springs by what they see of the machine: the measures u of all planes and bores. A step that is solved in these needs
//! no coordinates between its first and its last state.

use whirl_specs::ContactTangent;

use super::state::SpringState;
use super::{Plane, Springs};
use crate::linalg::{Matrix, add_product, sum_of};

/// Measures that a plane has beside those of its bore: the angle and both displacements of its journal.
const RING: usize = 3;

impl Springs {
    /// Length of u: angle, ε_x and ε_y of every plane, then the motions of the bores of body after body.
    pub(crate) fn measured(&self) -> usize {
        RING * self.planes.len() + self.bores.iter().map(|own| own.rows.rows).sum::<usize>()
    }

    /// Whether u is a constant matrix N times the coordinates: axes that are apart make rows that change with an angle.
    pub(crate) fn measures_are_constant(&self) -> bool {
        let turns = |plane: &Plane| plane.apart.is_some_and(|own| own.theta.is_some());
        !self.planes.iter().any(turns)
    }

    /// What a force on every measure is divided by to be compared with the forces of springs (m): the arm of a moment, 1.
    pub(crate) fn arms_of_measures(&self) -> Vec<f64> {
        let rings = self.planes.iter().flat_map(|plane| [plane.arm, 1.0, 1.0]);
        let bores = self.bores.iter().map(|own| own.rows.rows).sum::<usize>();
        rings.chain(std::iter::repeat_n(1.0, bores)).collect()
    }

    /// N times a motion of the coordinates from `first` on; those before do not move.
    pub(crate) fn measure(&self, first: usize, motion: &[f64], u: &mut [f64]) {
        let (rings, mut bores) = u.split_at_mut(RING * self.planes.len());
        let rows = self.planes.iter().flat_map(|plane| &plane.rows);
        for (value, row) in rings.iter_mut().zip(rows) {
            let unknown = row.iter().filter(|(place, _)| *place >= first);
            *value = unknown.map(|&(place, own)| own * motion[place - first]).sum();
        }
        for own in &self.bores {
            let (values, rest) = bores.split_at_mut(own.rows.rows);
            values.fill(0.0);
            if !own.place.is_empty() {
                let place = own.place.start - first..own.place.end - first;
                add_product(values, &own.rows, &motion[place]);
            }
            bores = rest;
        }
    }

    /// Adds Nᵀ times forces on the measures to generalised forces on the coordinates from `first` on.
    pub(crate) fn add_measured(&self, first: usize, forces: &[f64], out: &mut [f64]) {
        let (rings, mut bores) = forces.split_at(RING * self.planes.len());
        let rows = self.planes.iter().flat_map(|plane| &plane.rows);
        for (force, row) in rings.iter().zip(rows) {
            let unknown = row.iter().filter(|(place, _)| *place >= first);
            unknown.for_each(|&(place, own)| out[place - first] += own * force);
        }
        for own in &self.bores {
            let (values, rest) = bores.split_at(own.rows.rows);
            if !own.place.is_empty() {
                let place = own.place.start - first..own.place.end - first;
                add_product(&mut out[place], &own.transposed, values);
            }
            bores = rest;
        }
    }

    /// N, over the coordinates from `first` on.
    pub(crate) fn measures_of(&self, first: usize, unknowns: usize) -> Matrix {
        let mut measures = Matrix::zeros(self.measured(), unknowns);
        let mut unit = vec![0.0; unknowns];
        for j in 0..unknowns {
            unit[j] = 1.0;
            let rows = measures.rows;
            self.measure(first, &unit, &mut measures.data[j * rows..][..rows]);
            unit[j] = 0.0;
        }
        measures
    }

    /// Adds a factor times K₀ times a motion of the measures to forces on them; K₀ by its planes, as [`SpringState::tangent`] gives
    /// them.
    pub(crate) fn add_linear(
        &self,
        tangents: &[ContactTangent],
        moved: &[f64],
        factor: f64,
        out: &mut [f64],
    ) {
        let bores_from = RING * self.planes.len();
        for (number, (plane, tangent)) in self.planes.iter().zip(tangents).enumerate() {
            let ring = RING * number;
            let own: [f64; RING] = [0, 1, 2].map(|i| factor * moved[ring + i]);
            for (i, row) in tangent.ring_ring.iter().enumerate() {
                out[ring + i] += row[0] * own[0] + row[1] * own[1] + row[2] * own[2];
            }
            let law = &self.laws[plane.law];
            let before: usize = self.bores[..law.bores].iter().map(|bores| bores.rows.rows).sum();
            let (motions, n) = (law.motions.len(), plane.springs.len());
            let place = |b: usize| {
                law.motions[b].map(|row| bores_from + before + row + plane.springs.start)
            };
            for b in 0..motions {
                let Some(at) = place(b) else { continue };
                let motion = &moved[at..at + n];
                for i in 0..RING {
                    let by_bore = &tangent.ring_bore[(i * motions + b) * n..][..n];
                    out[ring + i] += factor * sum_of(n, |j| by_bore[j] * motion[j]);
                }
                let [x, y, z] = [0, 1, 2].map(|i| &tangent.bore_ring[(3 * b + i) * n..][..n]);
                for (j, sum) in out[at..at + n].iter_mut().enumerate() {
                    *sum += x[j] * own[0] + y[j] * own[1] + z[j] * own[2];
                }
                for a in 0..motions {
                    let Some(to) = place(a) else { continue };
                    let slopes = &tangent.bore_bore[(a * motions + b) * n..][..n];
                    let sums = out[to..to + n].iter_mut();
                    sums.zip(slopes.iter().zip(motion))
                        .for_each(|(sum, (k, u))| *sum += factor * k * u);
                }
            }
        }
    }
}

/// Where the measures stand, and their rates, before they are moved.
pub(super) struct Mark {
    rings: Vec<[[f64; RING]; 2]>,
    bores: Vec<[Vec<f64>; 2]>,
}

impl Mark {
    pub(super) fn new(springs: &Springs) -> Self {
        let bore = |rows: usize| [vec![0.0; rows], vec![0.0; rows]];
        Mark {
            rings: vec![[[0.0; RING]; 2]; springs.planes.len()],
            bores: springs.bores.iter().map(|own| bore(own.rows.rows)).collect(),
        }
    }
}

impl SpringState {
    /// Has the measures move from where they stand now.
    pub(crate) fn mark(&mut self) {
        for (mark, plane) in self.mark.rings.iter_mut().zip(&self.planes) {
            *mark = [plane.position, plane.velocity];
        }
        for ([motion, rate], own) in self.mark.bores.iter_mut().zip(&self.bores) {
            motion.copy_from_slice(&own.motion);
            rate.copy_from_slice(&own.rate);
        }
    }

    /// Computes everything but the tangent as [`SpringState::update`] does, for measures that have moved by `u` since they
    /// were marked, and rates by a1 u.
    pub(crate) fn displace(&mut self, springs: &Springs, u: &[f64], a1: f64) {
        let (rings, mut bores) = u.split_at(RING * self.planes.len());
        let moved = rings.as_chunks::<RING>().0;
        for ((plane, mark), moved) in self.planes.iter_mut().zip(&self.mark.rings).zip(moved) {
            let [position, velocity] = mark;
            plane.position = [0, 1, 2].map(|i| position[i] + moved[i]);
            plane.velocity = [0, 1, 2].map(|i| velocity[i] + a1 * moved[i]);
        }
        for (own, [motion, rate]) in self.bores.iter_mut().zip(&self.mark.bores) {
            let (moved, rest) = bores.split_at(own.motion.len());
            let sums = own.motion.iter_mut().zip(motion).zip(moved);
            sums.for_each(|((sum, from), u)| *sum = from + u);
            if self.rates {
                let sums = own.rate.iter_mut().zip(rate).zip(moved);
                sums.for_each(|((sum, from), u)| *sum = from + a1 * u);
            }
            bores = rest;
        }
        self.respond(springs);
    }

    /// The forces on the measures: as [`SpringState::plane_force`] has them, then those on the bores.
    pub(crate) fn measured_forces(&self, out: &mut [f64]) {
        let (rings, mut bores) = out.split_at_mut(RING * self.planes.len());
        for (place, force) in rings.as_chunks_mut::<RING>().0.iter_mut().enumerate() {
            *force = self.plane_force(place);
        }
        for own in &self.bores {
            let (forces, rest) = bores.split_at_mut(own.force.len());
            forces.copy_from_slice(&own.force);
            bores = rest;
        }
    }
}

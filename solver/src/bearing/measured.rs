//! The springs by what they see of the machine: the measures u of all planes and bores. A step that is solved in these needs
//! no coordinates between its first and its last state.

use whirl_specs::registers::{Register, Task};
use whirl_specs::{ContactTangent, Registers};

use super::bores::Bores;
use super::mark::RING;
use super::mirrors::BlockMemory;
use super::plane::Plane;
use super::springs::Springs;
use super::state::SpringState;
use crate::linalg::{
    Columns, Matrix, add_columns, multiply, multiply_transpose_add, sum_of, widely,
};

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

    /// Memory for products with N and its transpose, one a body with bores.
    pub(crate) fn memory(&self) -> Vec<BlockMemory> {
        self.bores.iter().map(Bores::memory).collect()
    }

    /// u = N times a motion of the coordinates from `first` on; those before do not move.
    pub(crate) fn measure(
        &self,
        first: usize,
        motion: &[f64],
        u: &mut [f64],
        memory: &mut [BlockMemory],
    ) {
        let (rings, mut rest) = u.split_at_mut(RING * self.planes.len());
        let rows = self.planes.iter().flat_map(|plane| &plane.rows);
        for (value, row) in rings.iter_mut().zip(rows) {
            let unknown = row.iter().filter(|(place, _)| *place >= first);
            *value = unknown.map(|&(place, own)| own * motion[place - first]).sum();
        }
        for (own, memory) in self.bores.iter().zip(memory) {
            let values;
            (values, rest) = rest.split_at_mut(own.rows.rows);
            values.fill(0.0);
            if !own.place.is_empty() {
                let place = own.place.start - first..own.place.end - first;
                own.add_motion(&motion[place], values, memory);
            }
        }
    }

    /// Adds Nᵀ times forces on the measures to generalised forces on the coordinates from `first` on.
    pub(crate) fn add_measured(
        &self,
        first: usize,
        forces: &[f64],
        out: &mut [f64],
        memory: &mut [BlockMemory],
    ) {
        let (rings, mut rest) = forces.split_at(RING * self.planes.len());
        let rows = self.planes.iter().flat_map(|plane| &plane.rows);
        for (force, row) in rings.iter().zip(rows) {
            let unknown = row.iter().filter(|(place, _)| *place >= first);
            unknown.for_each(|&(place, own)| out[place - first] += own * force);
        }
        for (own, memory) in self.bores.iter().zip(memory) {
            let values;
            (values, rest) = rest.split_at(own.rows.rows);
            if !own.place.is_empty() {
                let place = own.place.start - first..own.place.end - first;
                own.add_force(values, &mut out[place], memory);
            }
        }
    }

    /// Z = N A⁻¹Nᵀ of an A⁻¹ over the coordinates from `first` on, column after column.
    pub(crate) fn compliance(&self, first: usize, inverse: Columns) -> Matrix {
        let (n, measured) = (inverse.cols, self.measured());
        let rings = RING * self.planes.len();
        let rows: Vec<&[(usize, f64)]> =
            self.planes.iter().flat_map(|plane| plane.rows.each_ref().map(Vec::as_slice)).collect();
        let terms = |row: usize| {
            let unknown = rows[row].iter().filter(move |(place, _)| *place >= first);
            unknown.map(move |&(place, own)| (place - first, own))
        };
        // N A⁻¹, of which the rows of bores come from rows of A⁻¹ that stand side by side.
        let mut moved = Matrix::zeros(measured, n);
        let (mut from, mut part) = (rings, Vec::new());
        for j in 0..n {
            let column = &inverse.data[j * n..][..n];
            for i in 0..rings {
                moved[(i, j)] = terms(i).map(|(place, own)| own * column[place]).sum();
            }
        }
        for own in &self.bores {
            let (start, end) = (from, from + own.rows.rows);
            from = end;
            if own.place.is_empty() || own.rows.rows == 0 {
                continue;
            }
            let place = own.place.start - first..own.place.end - first;
            part.clear();
            part.extend(inverse.data.chunks_exact(n).flat_map(|column| &column[place.clone()]));
            let product =
                multiply(own.rows.view(), Columns { rows: place.len(), cols: n, data: &part });
            for (j, column) in product.data.chunks_exact(own.rows.rows).enumerate() {
                moved.col_mut(j)[start..end].copy_from_slice(column);
            }
        }
        let mut compliance = Matrix::zeros(measured, measured);
        for i in 0..rings {
            let columns = terms(i).map(|(place, own)| (moved.col(place), own));
            add_columns(compliance.col_mut(i), columns);
        }
        from = rings;
        for own in &self.bores {
            let start = from;
            from += own.rows.rows;
            if own.place.is_empty() {
                continue;
            }
            let place = own.place.start - first..own.place.end - first;
            let of_body = &moved.data[place.start * measured..place.end * measured];
            let of_body = Columns { rows: measured, cols: place.len(), data: of_body };
            let out = &mut compliance.data[start * measured..from * measured];
            multiply_transpose_add(out, 1.0, of_body, own.rows.view());
        }
        compliance
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
        Registers::current().run(AddLinear { springs: self, tangents, moved, factor, out });
    }
}

struct AddLinear<'a> {
    springs: &'a Springs,
    tangents: &'a [ContactTangent],
    moved: &'a [f64],
    factor: f64,
    out: &'a mut [f64],
}

impl Task for AddLinear<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let AddLinear { springs, tangents, moved, factor, out } = self;
        let bores_from = RING * springs.planes.len();
        for (number, (plane, tangent)) in springs.planes.iter().zip(tangents).enumerate() {
            let ring = RING * number;
            let own: [f64; RING] = [0, 1, 2].map(|i| factor * moved[ring + i]);
            for (i, row) in tangent.ring_ring.iter().enumerate() {
                out[ring + i] += row[0] * own[0] + row[1] * own[1] + row[2] * own[2];
            }
            let law = &springs.laws[plane.law];
            let before: usize =
                springs.bores[..law.bores].iter().map(|bores| bores.rows.rows).sum();
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
                let sums = &mut out[at..at + n];
                for j in 0..n {
                    sums[j] += x[j] * own[0] + y[j] * own[1] + z[j] * own[2];
                }
                for a in 0..motions {
                    let Some(to) = place(a) else { continue };
                    let slopes = &tangent.bore_bore[(a * motions + b) * n..][..n];
                    let sums = &mut out[to..to + n];
                    for j in 0..n {
                        sums[j] += factor * slopes[j] * motion[j];
                    }
                }
            }
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
            widely(|| sums.for_each(|((sum, from), u)| *sum = from + u));
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

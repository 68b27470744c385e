//! The tangent of the springs, B + a1 P, on the machine's coordinates.

use whirl_specs::ContactTangent;

use crate::bearing::{Bores, Plane, SpringState, Springs, TurnedRows};
use crate::linalg::{Columns, add_columns, multiply_transpose_add};

/// Subtracts a block over ring coordinates from a matrix of `size` rows, column after column.
fn subtract_ring(
    block: &[[f64; 3]; 3],
    rows: &[Vec<(usize, f64)>; 3],
    size: usize,
    out: &mut [f64],
) {
    for i in 0..3 {
        for j in 0..3 {
            let value = block[i][j];
            for &(row, left) in &rows[i] {
                for &(column, right) in &rows[j] {
                    out[column * size + row] -= left * right * value;
                }
            }
        }
    }
}

/// Memory for the tangents of all planes.
pub(crate) struct SpringTangent {
    planes: Vec<ContactTangent>,
    turned: TurnedRows,
    /// Rows of the bores of a body that act, and what they act with: coordinates × rows.
    active: Vec<f64>,
    weighted: Vec<f64>,
    block: Vec<f64>,
    cross: Vec<f64>,
}

impl SpringTangent {
    /// Memory for springs.
    pub(crate) fn new(springs: &Springs) -> Self {
        let tangent = |plane: &Plane| {
            ContactTangent::new(plane.springs.len(), springs.laws[plane.law].motions.len())
        };
        let most = |of: fn(&Bores) -> usize| springs.bores.iter().map(of).max().unwrap_or(0);
        let rows = most(|own| own.rows.rows * own.place.len());
        let width = most(|own| own.place.len());
        SpringTangent {
            planes: springs.planes.iter().map(tangent).collect(),
            turned: TurnedRows::default(),
            active: vec![0.0; rows],
            weighted: vec![0.0; rows],
            block: vec![0.0; width * width],
            cross: vec![0.0; width],
        }
    }

    /// B + a1 P by planes, as they were subtracted last.
    pub(crate) fn planes(&self) -> &[ContactTangent] {
        &self.planes
    }

    /// ∂M/∂θ of a plane, of its moment and its angle, at the state of the tangent that was last evaluated.
    pub(crate) fn by_angle(&self, plane: usize) -> f64 {
        self.planes[plane].ring_ring[0][0]
    }

    /// Subtracts B + a1 P from a matrix of `size` rows, column after column.
    pub(crate) fn subtract(
        &mut self,
        springs: &Springs,
        state: &SpringState,
        a1: f64,
        size: usize,
        out: &mut [f64],
    ) {
        for (place, plane) in springs.planes.iter().enumerate() {
            state.tangent(springs, place, a1, &mut self.planes[place], &mut self.turned);
            subtract_ring(&self.planes[place].ring_ring, state.rows(place), size, out);
            let theta = plane.apart.and_then(|own| own.theta);
            if let Some(theta) = theta {
                self.subtract_turned(state.rows(place), theta, size, out);
            }
            let bores = &springs.bores[springs.laws[plane.law].bores];
            if !bores.place.is_empty() {
                self.subtract_cross(springs, place, state.rows(place), theta, size, out);
            }
        }
        for (number, bores) in springs.bores.iter().enumerate() {
            let mut count = 0;
            for (place, plane) in springs.planes.iter().enumerate() {
                if springs.laws[plane.law].bores == number && !bores.place.is_empty() {
                    count = self.collect(springs, place, count);
                }
            }
            if count > 0 {
                self.subtract_bores(bores, count, size, out);
            }
        }
    }

    /// What rows that change with θ of the journal, at `theta`, add by it to the forces on the ring.
    fn subtract_turned(
        &self,
        rows: &[Vec<(usize, f64)>; 3],
        theta: usize,
        size: usize,
        out: &mut [f64],
    ) {
        let column = &mut out[theta * size..(theta + 1) * size];
        for (row, value) in rows.iter().zip(self.turned.ring) {
            row.iter().for_each(|&(place, coefficient)| column[place] -= coefficient * value);
        }
        column[theta] -= self.turned.row;
    }

    /// Ring by bore and bore by ring of a plane.
    fn subtract_cross(
        &mut self,
        springs: &Springs,
        place: usize,
        rows: &[Vec<(usize, f64)>; 3],
        theta: Option<usize>,
        size: usize,
        out: &mut [f64],
    ) {
        let (plane, tangent) = (&springs.planes[place], &self.planes[place]);
        let law = &springs.laws[plane.law];
        let (motions, n) = (law.motions.len(), plane.springs.len());
        let bores = &springs.bores[law.bores];
        let own = bores.place.clone();
        let cross = &mut self.cross[..own.len()];
        for (i, ring) in rows.iter().enumerate() {
            let by_bore = |b: usize| &tangent.ring_bore[(i * motions + b) * n..][..n];
            combine(springs, plane, by_bore, cross);
            for &(row, coefficient) in ring {
                for (column, value) in own.clone().zip(cross.iter()) {
                    out[column * size + row] -= coefficient * value;
                }
            }
            let by_ring = |b: usize| &tangent.bore_ring[(3 * b + i) * n..][..n];
            combine(springs, plane, by_ring, cross);
            for &(column, coefficient) in ring {
                let column = &mut out[column * size..][own.clone()];
                column.iter_mut().zip(cross.iter()).for_each(|(sum, v)| *sum -= coefficient * v);
            }
        }
        if let Some(theta) = theta {
            combine(springs, plane, |b: usize| &self.turned.bore[b * n..][..n], cross);
            let column = &mut out[theta * size..][own];
            column.iter_mut().zip(cross.iter()).for_each(|(sum, value)| *sum -= value);
        }
    }

    /// Adds the rows t_a of a plane's springs that act, and Σ_b D_ab t_b, to those that are collected; how
    /// many there are then.
    fn collect(&mut self, springs: &Springs, place: usize, mut count: usize) -> usize {
        let (plane, tangent) = (&springs.planes[place], &self.planes[place]);
        let law = &springs.laws[plane.law];
        let (bores, rows) = (&springs.bores[law.bores], &law.motions);
        let width = bores.place.len();
        let (motions, n, first) = (rows.len(), plane.springs.len(), plane.springs.start);
        for (a, row) in rows.iter().enumerate() {
            let Some(row) = *row else { continue };
            for j in 0..n {
                let weights = (rows.iter().enumerate()).filter_map(|(b, other)| {
                    let weight = tangent.bore_bore[(a * motions + b) * n + j];
                    other.filter(|_| weight != 0.0).map(|other| (other + first + j, weight))
                });
                let weighted = &mut self.weighted[count * width..(count + 1) * width];
                let mut acts = false;
                for (other, weight) in weights {
                    let other = bores.transposed.col(other);
                    if !std::mem::replace(&mut acts, true) {
                        weighted.fill(0.0);
                    }
                    weighted
                        .iter_mut()
                        .zip(other)
                        .for_each(|(sum, coefficient)| *sum += weight * coefficient);
                }
                if acts {
                    let own = bores.transposed.col(row + first + j);
                    self.active[count * width..(count + 1) * width].copy_from_slice(own);
                    count += 1;
                }
            }
        }
        count
    }

    /// Subtracts Σ t_aᵀ (Σ_b D_ab t_b) over what was collected of the bores of a body.
    fn subtract_bores(&mut self, bores: &Bores, count: usize, size: usize, out: &mut [f64]) {
        let place = bores.place.clone();
        let width = place.len();
        let block = &mut self.block[..width * width];
        block.fill(0.0);
        let rows = |data| Columns { rows: width, cols: count, data };
        let (active, weighted) = (&self.active[..count * width], &self.weighted[..count * width]);
        multiply_transpose_add(block, 1.0, rows(active), rows(weighted));
        for (column, values) in place.clone().zip(block.chunks_exact(width)) {
            let column = &mut out[column * size..][place.clone()];
            column.iter_mut().zip(values).for_each(|(sum, value)| *sum -= value);
        }
    }
}

/// Σ weight · row over the rows of a plane; `weights` of a motion are one a spring.
fn combine<'w>(
    springs: &Springs,
    plane: &Plane,
    weights: impl Fn(usize) -> &'w [f64],
    out: &mut [f64],
) {
    out.fill(0.0);
    let law = &springs.laws[plane.law];
    let transposed = &springs.bores[law.bores].transposed;
    for (b, row) in law.motions.iter().enumerate() {
        let Some(row) = row.map(|row| row + plane.springs.start) else { continue };
        let rows = weights(b).iter().enumerate().filter(|(_, weight)| **weight != 0.0);
        add_columns(out, rows.map(|(j, weight)| (transposed.col(row + j), *weight)));
    }
}

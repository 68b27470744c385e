//! The tangent of the springs, B + a1 P, on the machine's coordinates.

use whirl_specs::ContactTangent;

use crate::bearing::{Plane, SpringState, Springs};
use crate::linalg::{Columns, add_columns, multiply_transpose_add};

/// Coefficients of θ, ε_x and ε_y over (θ, η): a place and a coefficient each.
type RingRows<'a> = [&'a [(usize, f64)]; 3];

/// Rows of the coordinates of a ring.
fn ring_rows(eccentricity: &[Vec<(usize, f64)>; 2]) -> RingRows<'_> {
    let [x, y] = eccentricity;
    [&[(0, 1.0)], x, y]
}

/// Place in q of part j of ring coordinate i: θ is 0, η_j is 1 + j.
fn place(i: usize, j: usize) -> usize {
    if i == 0 { 0 } else { 1 + j }
}

/// Subtracts a block over ring coordinates from a matrix of `size` rows, column after column.
fn subtract_ring(block: &[[f64; 3]; 3], rows: RingRows<'_>, size: usize, out: &mut [f64]) {
    for i in 0..3 {
        for j in 0..3 {
            let value = block[i][j];
            for &(row, left) in rows[i] {
                for &(column, right) in rows[j] {
                    out[place(j, column) * size + place(i, row)] -= left * right * value;
                }
            }
        }
    }
}

/// Memory for the tangents of all planes.
pub(super) struct SpringTangent {
    planes: Vec<ContactTangent>,
    /// Rows of the bores that act, and what they act with: coordinates × rows.
    active: Vec<f64>,
    weighted: Vec<f64>,
    block: Vec<f64>,
    cross: Vec<f64>,
}

impl SpringTangent {
    /// Memory for springs on a support of `coordinates` coordinates.
    pub(super) fn new(springs: &Springs, coordinates: usize) -> Self {
        let tangent = |plane: &Plane| {
            ContactTangent::new(plane.springs.len(), springs.laws[plane.law].motions.len())
        };
        let rows = springs.bore.rows;
        let any = usize::from(rows > 0);
        SpringTangent {
            planes: springs.planes.iter().map(tangent).collect(),
            active: vec![0.0; coordinates * rows],
            weighted: vec![0.0; coordinates * rows],
            block: vec![0.0; any * coordinates * coordinates],
            cross: vec![0.0; any * coordinates],
        }
    }

    /// Subtracts B + a1 P from a matrix of `size` rows, column after column, in which the support's
    /// coordinates begin at `first`.
    pub(super) fn subtract(
        &mut self,
        springs: &Springs,
        state: &SpringState,
        a1: f64,
        first: usize,
        size: usize,
        out: &mut [f64],
    ) {
        let mut count = 0;
        for place in 0..springs.planes.len() {
            state.tangent(springs, place, a1, &mut self.planes[place]);
            let rows = ring_rows(&springs.planes[place].eccentricity);
            subtract_ring(&self.planes[place].ring_ring, rows, size, out);
            if size > first {
                self.subtract_cross(springs, place, first, size, out);
                count = self.collect(springs, place, count, size - first);
            }
        }
        if count > 0 {
            self.subtract_bores(count, first, size, out);
        }
    }

    /// Ring by bore and bore by ring of a plane.
    fn subtract_cross(
        &mut self,
        springs: &Springs,
        place_of_plane: usize,
        first: usize,
        size: usize,
        out: &mut [f64],
    ) {
        let (plane, tangent) = (&springs.planes[place_of_plane], &self.planes[place_of_plane]);
        let (motions, n) = (springs.laws[plane.law].motions.len(), plane.springs.len());
        let rows = ring_rows(&plane.eccentricity);
        for (i, ring) in rows.into_iter().enumerate() {
            let by_bore = |b: usize| &tangent.ring_bore[(i * motions + b) * n..][..n];
            combine(springs, plane, by_bore, &mut self.cross);
            for &(row, coefficient) in ring {
                for (b, value) in self.cross.iter().enumerate() {
                    out[(first + b) * size + place(i, row)] -= coefficient * value;
                }
            }
            let by_ring = |b: usize| &tangent.bore_ring[(3 * b + i) * n..][..n];
            combine(springs, plane, by_ring, &mut self.cross);
            for &(column, coefficient) in ring {
                let start = place(i, column) * size + first;
                let column = &mut out[start..start + self.cross.len()];
                column.iter_mut().zip(&self.cross).for_each(|(sum, v)| *sum -= coefficient * v);
            }
        }
    }

    /// Adds the rows t_a of a plane's springs that act, and Σ_b D_ab t_b, to those that are collected; how
    /// many there are then.
    fn collect(
        &mut self,
        springs: &Springs,
        place: usize,
        mut count: usize,
        width: usize,
    ) -> usize {
        let (plane, tangent) = (&springs.planes[place], &self.planes[place]);
        let rows = &springs.laws[plane.law].motions;
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
                    let other = springs.bore_transposed.col(other);
                    if !std::mem::replace(&mut acts, true) {
                        weighted.fill(0.0);
                    }
                    weighted
                        .iter_mut()
                        .zip(other)
                        .for_each(|(sum, coefficient)| *sum += weight * coefficient);
                }
                if acts {
                    let own = springs.bore_transposed.col(row + first + j);
                    self.active[count * width..(count + 1) * width].copy_from_slice(own);
                    count += 1;
                }
            }
        }
        count
    }

    /// Subtracts Σ t_aᵀ (Σ_b D_ab t_b) over what was collected.
    fn subtract_bores(&mut self, count: usize, first: usize, size: usize, out: &mut [f64]) {
        let width = size - first;
        self.block.fill(0.0);
        let rows = |data| Columns { rows: width, cols: count, data };
        let (active, weighted) = (&self.active[..count * width], &self.weighted[..count * width]);
        multiply_transpose_add(&mut self.block, 1.0, rows(active), rows(weighted));
        for (b, values) in self.block.chunks_exact(width).enumerate() {
            let start = (first + b) * size + first;
            let column = &mut out[start..start + width];
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
    for (b, row) in springs.laws[plane.law].motions.iter().enumerate() {
        let Some(row) = row.map(|row| row + plane.springs.start) else { continue };
        let rows = weights(b).iter().enumerate().filter(|(_, weight)| **weight != 0.0);
        add_columns(out, rows.map(|(j, weight)| (springs.bore_transposed.col(row + j), *weight)));
    }
}

//! The tangent of laws that take or give more than Q(h, ḣ), on the machine's coordinates.

use whirl_specs::ContactTangent;

use crate::bearing::Contacts;
use crate::bearing::contact::{ContactPlane, ContactsState};
use crate::linalg::{Columns, multiply_transpose_add};

/// Coefficients of θ, ε_x and ε_y over (θ, η): a place and a coefficient each.
pub(super) type RingRows<'a> = [&'a [(usize, f64)]; 3];

/// Rows of the coordinates of a ring.
pub(super) fn ring_rows(eccentricity: &[Vec<(usize, f64)>; 2]) -> RingRows<'_> {
    let [x, y] = eccentricity;
    [&[(0, 1.0)], x, y]
}

/// Place in q of part j of ring coordinate i: θ is 0, η_j is 1 + j.
fn place(i: usize, j: usize) -> usize {
    if i == 0 { 0 } else { 1 + j }
}

/// Subtracts a block over ring coordinates from a matrix of `size` rows, column after column.
pub(super) fn subtract_ring(
    block: &[[f64; 3]; 3],
    rows: RingRows<'_>,
    size: usize,
    out: &mut [f64],
) {
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
pub(super) struct ContactTangents {
    planes: Vec<ContactTangent>,
    /// Rows of the bores that act, and what they act with: coordinates × rows.
    active: Vec<f64>,
    weighted: Vec<f64>,
    block: Vec<f64>,
    cross: Vec<f64>,
}

impl ContactTangents {
    /// Memory for a support of `coordinates` coordinates.
    pub(super) fn new(contacts: &Contacts, coordinates: usize) -> Self {
        let tangent = |plane: &ContactPlane| ContactTangent::new(plane.count, plane.motions.len());
        let rows = contacts.bore_transposed.cols;
        let any = usize::from(rows > 0);
        ContactTangents {
            planes: contacts.planes.iter().map(tangent).collect(),
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
        contacts: &Contacts,
        state: &ContactsState,
        a1: f64,
        first: usize,
        size: usize,
        out: &mut [f64],
    ) {
        for (law, planes) in &contacts.laws {
            for plane in planes.clone() {
                state.tangent(contacts, law, plane, a1, &mut self.planes[plane]);
            }
        }
        let mut count = 0;
        for plane in 0..contacts.planes.len() {
            let rows = ring_rows(&contacts.planes[plane].eccentricity);
            subtract_ring(&self.planes[plane].ring_ring, rows, size, out);
            if size > first {
                self.subtract_cross(contacts, plane, first, size, out);
                count = self.collect(contacts, plane, count, size - first);
            }
        }
        if count > 0 {
            self.subtract_bores(count, first, size, out);
        }
    }

    /// Ring by bore and bore by ring of a plane.
    fn subtract_cross(
        &mut self,
        contacts: &Contacts,
        place_of_plane: usize,
        first: usize,
        size: usize,
        out: &mut [f64],
    ) {
        let (plane, tangent) = (&contacts.planes[place_of_plane], &self.planes[place_of_plane]);
        let (motions, n) = (plane.motions.len(), plane.count);
        let rows = ring_rows(&plane.eccentricity);
        for (i, ring) in rows.into_iter().enumerate() {
            let by_bore = |b: usize| &tangent.ring_bore[(i * motions + b) * n..][..n];
            combine(contacts, plane, by_bore, &mut self.cross);
            for &(row, coefficient) in ring {
                for (b, value) in self.cross.iter().enumerate() {
                    out[(first + b) * size + place(i, row)] -= coefficient * value;
                }
            }
            let by_ring = |b: usize| &tangent.bore_ring[(3 * b + i) * n..][..n];
            combine(contacts, plane, by_ring, &mut self.cross);
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
        contacts: &Contacts,
        plane: usize,
        mut count: usize,
        width: usize,
    ) -> usize {
        let (plane, tangent) = (&contacts.planes[plane], &self.planes[plane]);
        let (motions, n) = (plane.motions.len(), plane.count);
        for (a, row) in plane.motions.iter().enumerate() {
            let Some(row) = *row else { continue };
            for j in 0..n {
                let weights = (plane.motions.iter().enumerate()).filter_map(|(b, other)| {
                    let weight = tangent.bore_bore[(a * motions + b) * n + j];
                    other.map(|other| (other + j, weight)).filter(|(_, weight)| *weight != 0.0)
                });
                let weighted = &mut self.weighted[count * width..(count + 1) * width];
                let mut acts = false;
                for (other, weight) in weights {
                    let other = contacts.bore_transposed.col(other);
                    if !std::mem::replace(&mut acts, true) {
                        weighted.fill(0.0);
                    }
                    weighted
                        .iter_mut()
                        .zip(other)
                        .for_each(|(sum, coefficient)| *sum += weight * coefficient);
                }
                if acts {
                    let own = contacts.bore_transposed.col(row + j);
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
    contacts: &Contacts,
    plane: &ContactPlane,
    weights: impl Fn(usize) -> &'w [f64],
    out: &mut [f64],
) {
    out.fill(0.0);
    for (b, row) in plane.motions.iter().enumerate() {
        let Some(row) = *row else { continue };
        for (j, &weight) in weights(b).iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
            let own = contacts.bore_transposed.col(row + j);
            out.iter_mut().zip(own).for_each(|(sum, coefficient)| *sum += weight * coefficient);
        }
    }
}

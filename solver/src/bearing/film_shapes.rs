//! How a bore gives way under its film: what the faces on which the nodes of the film stand do beyond the motions of a rigid bore.
//!
//! The coordinates q of the body of the bore open the gap at the nodes by D q, of which a rigid bore does a part by its measures.
//! Of the rest the directions count that a force finds: δ = S w, w = N q with the left and the right singular vectors of
//! D K^(−½). The film pushes on w, so that what opens the gap and what pushes on the body are one matrix and its transpose.

use whirl_specs::{BoreMotion, ContactState, Ring};

use super::Bearing;
use super::law::BoundLaw;
use super::section::SectionMotion;
use crate::bodies::Body;
use crate::film::{Journal, Shapes};
use crate::linalg::{Matrix, multiply, symmetric_eigen, transpose_multiply};

/// Stiffnesses of a body below this part of its largest are those of motions that nothing resists.
const FREE: f64 = 1e-13;
/// Directions count whose compliance is above this part of the largest.
const COUNTS: f64 = 1e-11;
/// What is left of a rigid motion by rounding, of the motion itself.
const RIGID: f64 = 1e-10;

/// What the kernels of a joint know where nothing has moved.
pub(super) struct AtRest<'a> {
    pub(super) table: &'a [f64],
    pub(super) radius: f64,
    pub(super) clearance: f64,
}

/// Whether a law is a film whose bore is to give way.
pub(super) fn gives_way(law: &BoundLaw, bearing: &Bearing) -> bool {
    let surface = bearing.sides.surface.as_ref();
    law.law.film().is_some() && surface.is_some_and(|own| !own.film.is_empty())
}

/// The shapes of a bore with a film, and the rows of w over the coordinates of its body. `rows`: for every motion of the bore that
/// the film takes its row there. None of a bore that does not deform, or whose faces are not known.
pub(super) fn shapes_of(
    law: &BoundLaw,
    bearing: &Bearing,
    body: &Body,
    rows: &[(usize, Vec<f64>)],
    at: &AtRest,
) -> Option<(Shapes, Vec<Vec<f64>>)> {
    let journal = law.law.film()?;
    let surface = bearing.sides.surface.as_ref().filter(|own| !own.film.is_empty())?;
    let grid = &journal.film.grid;
    let size = body.size();
    let nodes = body.nodes();
    let mut opened = Matrix::zeros(grid.nodes(), size);
    for (a, point) in surface.film.iter().enumerate() {
        let (sin, cos) = grid.angle(a % grid.around).sin_cos();
        for &(node, weight) in point {
            let shapes = &nodes[node].shapes;
            for j in 0..size {
                opened[(a, j)] += weight * (cos * shapes[(0, j)] + sin * shapes[(1, j)]);
            }
        }
    }
    let most = opened.norm_max();
    let rigid = rigid_part(law, journal, rows, at);
    for j in 0..size {
        for (value, rigid) in opened.col_mut(j).iter_mut().zip(rigid.iter().map(|own| own[j])) {
            *value -= rigid;
        }
    }
    if !(opened.norm_max() > RIGID * most) {
        return None;
    }
    let (shapes, rows) = directions(&opened, &stiffness(body))?;
    Some((Shapes::new(shapes), rows))
}

/// How much of the gap at every node a rigid bore opens by a unit of each coordinate of its body.
fn rigid_part(
    law: &BoundLaw,
    journal: &Journal,
    rows: &[(usize, Vec<f64>)],
    at: &AtRest,
) -> Vec<Vec<f64>> {
    let kind = law.kind;
    let mut inputs = vec![0.0; kind.rows];
    let (mut bore, still) = (vec![0.0; kind.bore.len()], vec![0.0; kind.bore.len()]);
    let ring = Ring { c: at.clearance, ..Ring::default() };
    // e_x, e_y and both tilts, which stand first among what a film takes.
    let mut seen = |bore: &[f64]| -> [f64; 4] {
        let (table, radius, bore_dot) = (at.table, at.radius, still.as_slice());
        let state = ContactState { stride: 1, table, ring: &ring, radius, bore, bore_dot };
        (kind.evaluate)(1, &state, &mut inputs);
        std::array::from_fn(|k| inputs[law.inputs[k]])
    };
    let before = seen(&bore);
    let size = rows.iter().map(|(_, row)| row.len()).max().unwrap_or(0);
    let grid = &journal.film.grid;
    let mut opened = vec![vec![0.0; size]; grid.nodes()];
    for (motion, row) in rows.iter().filter(|(motion, _)| is_of_bore(kind.bore[*motion])) {
        bore[*motion] = 1.0;
        let after = seen(&bore);
        bore[*motion] = 0.0;
        let moved: [f64; 4] = std::array::from_fn(|k| after[k] - before[k]);
        for (a, opened) in opened.iter_mut().enumerate() {
            let slopes = journal.opening(a % grid.around, a / grid.around);
            let by: f64 = slopes.iter().zip(&moved).map(|(slope, moved)| slope * moved).sum();
            opened.iter_mut().zip(row).for_each(|(sum, value)| *sum += by * value);
        }
    }
    opened
}

/// Whether the bore moves so, not the journal.
fn is_of_bore(motion: BoreMotion) -> bool {
    SectionMotion::of(motion).is_none_or(|own| own.side == 1)
}

fn stiffness(body: &Body) -> Matrix {
    match (body.shaft(), body.support()) {
        (Some(shaft), _) => shaft.stiffness.clone(),
        (None, Some(support)) => {
            let own = &support.stiffness;
            Matrix::from_fn(own.len(), own.len(), |i, j| if i == j { own[i] } else { 0.0 })
        }
        (None, None) => Matrix::zeros(body.size(), body.size()),
    }
}

/// S, whose columns are 1 at most, and the rows N of w = N q: of D = S N as much as a force finds.
fn directions(opened: &Matrix, stiffness: &Matrix) -> Option<(Matrix, Vec<Vec<f64>>)> {
    let own = symmetric_eigen(stiffness).ok()?;
    let most = own.values.iter().copied().fold(0.0, f64::max);
    let stiff: Vec<usize> =
        (0..own.values.len()).filter(|&k| own.values[k] > FREE * most).collect();
    let root = |k: usize| own.values[stiff[k]].sqrt();
    // K^(−½) and K^(½) in the directions of eigenvectors, of which only those count that resist.
    let vectors = Matrix::from_fn(opened.cols, stiff.len(), |i, k| own.vectors[(i, stiff[k])]);
    let mut soft = multiply(opened.view(), vectors.view());
    for k in 0..stiff.len() {
        let root = root(k);
        soft.col_mut(k).iter_mut().for_each(|value| *value /= root);
    }
    let found = symmetric_eigen(&transpose_multiply(soft.view(), soft.view())).ok()?;
    let largest = found.values.last().copied().filter(|own| *own > 0.0)?;
    // The softest first.
    let kept: Vec<usize> =
        (0..stiff.len()).rev().filter(|&k| found.values[k] > COUNTS * largest).collect();
    let right = Matrix::from_fn(stiff.len(), kept.len(), |i, k| found.vectors[(i, kept[k])]);
    let mut shapes = multiply(soft.view(), right.view());
    let mut rows = Vec::with_capacity(kept.len());
    for k in 0..kept.len() {
        let column = shapes.col_mut(k);
        let most = column.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        column.iter_mut().for_each(|own| *own /= most);
        let weights: Vec<f64> =
            right.col(k).iter().enumerate().map(|(i, own)| most * own * root(i)).collect();
        let row = (0..opened.cols)
            .map(|j| weights.iter().enumerate().map(|(i, own)| own * vectors[(j, i)]).sum());
        rows.push(row.collect());
    }
    Some((shapes, rows))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// δ = S N q for all q that a stiffness resists, and no more directions than D has.
    #[test]
    fn directions_are_those_of_the_matrix() {
        // Four coordinates, of which two open the gap alike and one not at all.
        let opened = Matrix::from_fn(7, 4, |a, j| match j {
            0 => (a as f64).sin(),
            1 => 1e3 * (a as f64).sin(),
            2 => 2.0 + a as f64,
            _ => 0.0,
        });
        let stiffness = Matrix::from_fn(4, 4, |i, j| match (i, j) {
            (0, 1) | (1, 0) => 3.0,
            _ if i == j => 10f64.powi(3 * i as i32 + 1),
            _ => 0.0,
        });
        let (shapes, rows) = directions(&opened, &stiffness).unwrap();
        assert_eq!(shapes.cols, 2);
        for k in 0..2 {
            let most = shapes.col(k).iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            assert!((most - 1.0).abs() < 1e-12);
        }
        for j in 0..4 {
            for a in 0..7 {
                let found: f64 = (0..2).map(|k| shapes[(a, k)] * rows[k][j]).sum();
                let exact = opened[(a, j)];
                assert!((found - exact).abs() < 1e-9 * 1e3, "{a} {j}: {found} for {exact}");
            }
        }
    }
}

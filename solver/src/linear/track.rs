//! Which modes at one speed are which at the next.

use num_complex::Complex64;
use pathfinding::kuhn_munkres::kuhn_munkres_min;
use pathfinding::matrix::Matrix as Costs;

use super::modes::Mode;
use super::shapes::{apply_all, inner};
use crate::linalg::Matrix;

/// MAC from which on two shapes are one mode.
const SURE: f64 = 0.8;
/// Two whose MAC is below the first of these and whose λ differ by more than the second share are not one: one leaves the list
/// as the other comes into it.
const UNLIKE: [f64; 2] = [0.05, 0.3];
/// Costs are compared as whole numbers of this size.
const UNIT: f64 = 1e9;
/// Cost of modes that have no other.
const APART: f64 = 4.0;

/// The modes of two speeds that are one, and how sure that is.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Matched {
    /// For every mode of the first speed that of the second.
    pub(super) to: Vec<Option<usize>>,
    /// Whether all shapes are alike, and all in the same order.
    pub(super) is_sure: bool,
}

/// MAC = |xᴴM y|² of shapes with xᴴM x = 1.
pub(super) fn mac(moved: &[Complex64], other: &[Complex64]) -> f64 {
    inner(moved, other).norm_sqr()
}

/// Assigns modes by (1 − MAC) + |Δλ|/|λ|, all together.
pub(super) fn matched(mass: &Matrix, from: &[Mode], to: &[Mode]) -> Matched {
    if from.is_empty() || to.is_empty() {
        return Matched { to: vec![None; from.len()], is_sure: true };
    }
    let moved = apply_all(mass, from.iter().map(|own| own.shape.as_slice()));
    let alike = |i: usize, j: usize| mac(&moved[i], &to[j].shape);
    let size = from.len().max(to.len());
    let mut macs = vec![vec![0.0; to.len()]; from.len()];
    let mut are_one = vec![vec![true; to.len()]; from.len()];
    let mut costs = Costs::new(size, size, (APART * UNIT) as i64);
    for (i, a) in from.iter().enumerate() {
        for (j, b) in to.iter().enumerate() {
            macs[i][j] = alike(i, j);
            let apart = (a.value - b.value).norm() / a.value.norm().max(b.value.norm());
            costs[(i, j)] = ((1.0 - macs[i][j] + apart) * UNIT) as i64;
            are_one[i][j] = macs[i][j] >= UNLIKE[0] || apart <= UNLIKE[1];
        }
    }
    let (_, assigned) = kuhn_munkres_min(&costs);
    let to_of = |i: usize| Some(assigned[i]).filter(|&j| j < to.len() && are_one[i][j]);
    let found: Vec<Option<usize>> = (0..from.len()).map(to_of).collect();
    // The last modes may have left the list, and others come into it.
    let inside = from.len().min(to.len()).saturating_sub(2);
    let sure = found.iter().enumerate().take(inside).all(|(i, j)| {
        j.is_some_and(|j| macs[i][j] >= SURE && (j == i || j >= inside && i >= inside))
    });
    Matched { to: found, is_sure: sure }
}

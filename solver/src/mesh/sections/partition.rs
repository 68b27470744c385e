//! Planes along z, and the radii of nodes in each of them.
//!
//! All pieces at a plane use all radii of the plane between theirs, so that cells fit together across steps. A radius is
//! carried over to the next plane where no radius is there within reach of the layer, so that cells are not much skewed;
//! longer layers need not carry it, and have triangles instead.

use super::intervals::{Interval, SAME_RADIUS, largest};
use super::row::{SAME, SectionRow};

/// Edges of cells along the axis lean by at most this ratio of radius to length, where they need not.
const SKEW: f64 = 0.6;
/// Rings are at most this part of the radius wide, divided by how fine the mesh is, times a slack.
const WIDEST: f64 = 0.5;
const SLACK: f64 = 1.4;

/// A row between two neighbouring planes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) row: usize,
    /// Indices of its inner and its outer radius, in the left and in the right plane.
    pub(super) left: [usize; 2],
    pub(super) right: [usize; 2],
    /// Whether its inside and its outside are free surfaces.
    pub(super) free: [bool; 2],
}

/// A step of at most this part of the radius is levelled: a ring as thin would take away the digits of a slender body.
const STEP: f64 = 1e-3;
/// Unless another radius, of a layer or a gap, is within so many times the step.
const CLEAR: f64 = 8.0;

/// Planes with radii, and what is between them.
pub(super) struct Partition {
    /// z, ascending, m.
    pub(super) planes: Vec<f64>,
    /// Of each plane, ascending, m.
    pub(super) radii: Vec<Vec<f64>>,
    /// Between each plane and the next one, from the axis outwards.
    pub(super) pieces: Vec<Vec<Piece>>,
}

/// A row between two planes by its radii: inner and outer one, on the left and on the right.
#[derive(Clone, Copy)]
struct Range {
    row: usize,
    left: [f64; 2],
    right: [f64; 2],
}

impl Partition {
    /// Radii at these planes.
    pub(super) fn new(
        rows: &[SectionRow],
        intervals: &[Interval],
        planes: Vec<f64>,
        refine: usize,
    ) -> Partition {
        let same = SAME_RADIUS * largest(rows);
        let near = SAME * (planes[planes.len() - 1] - planes[0]);
        let range = |row: usize, [from, to]: [f64; 2]| {
            // Ends of rows are planes to rounding: radii there are those that the row gives.
            let snapped =
                |z: f64| rows[row].z.into_iter().find(|end| (end - z).abs() <= near).unwrap_or(z);
            Range { row, left: rows[row].at(snapped(from)), right: rows[row].at(snapped(to)) }
        };
        let mut strips: Vec<Vec<Range>> = planes
            .windows(2)
            .map(|pair| {
                let middle = 0.5 * (pair[0] + pair[1]);
                let own = intervals.iter().find(|own| middle < own.z[1]);
                own.map_or_else(Vec::new, |own| {
                    own.rows.iter().map(|&row| range(row, [pair[0], pair[1]])).collect()
                })
            })
            .collect();
        (1..strips.len()).for_each(|plane| level(rows, &mut strips, plane, same));
        let mut radii = vec![Vec::new(); planes.len()];
        for (strip, own) in strips.iter().enumerate() {
            for range in own {
                range.left.into_iter().for_each(|r| insert(&mut radii[strip], r, same));
                range.right.into_iter().for_each(|r| insert(&mut radii[strip + 1], r, same));
            }
        }
        let widest = WIDEST / refine.max(1) as f64;
        for (strip, own) in strips.iter().enumerate() {
            for range in own {
                divide(&mut radii[strip], range.left, widest, same);
                divide(&mut radii[strip + 1], range.right, widest, same);
            }
        }
        carry(&mut radii, &strips, &planes, same);
        let pieces = strips.iter().enumerate().map(|(strip, own)| {
            let place = |plane: usize, r: f64| nearest(&radii[plane], r);
            let piece = |range: &Range| Piece {
                row: range.row,
                left: range.left.map(|r| place(strip, r)),
                right: range.right.map(|r| place(strip + 1, r)),
                free: [true; 2],
            };
            let mut own: Vec<Piece> = own.iter().map(piece).collect();
            for k in 1..own.len() {
                let touch =
                    own[k - 1].left[1] == own[k].left[0] && own[k - 1].right[1] == own[k].right[0];
                own[k - 1].free[1] &= !touch;
                own[k].free[0] &= !touch;
            }
            own
        });
        let pieces = pieces.collect();
        Partition { planes, radii, pieces }
    }

    /// Layers along z.
    pub(super) fn layers(&self) -> usize {
        self.pieces.len()
    }

    /// Cells of a sector, at most.
    pub(super) fn cells(&self) -> usize {
        let of = |piece: &Piece| piece.left[1] - piece.left[0] + piece.right[1] - piece.right[0];
        self.pieces.iter().flatten().map(of).sum()
    }
}

/// Levels small steps in the plane between two strips: both sides get the radius of the one that has a name, or the mean. A
/// step between two that have names stays.
fn level(rows: &[SectionRow], strips: &mut [Vec<Range>], plane: usize, same: f64) {
    let (left, right) = strips.split_at_mut(plane);
    let (left, right) = (&mut left[plane - 1], &mut right[0]);
    let ends = |strip: &[Range], side: fn(&Range) -> [f64; 2]| -> Vec<(f64, bool)> {
        let of = |own: &Range| side(own).map(|r| (r, rows[own.row].name.is_some()));
        strip.iter().flat_map(of).collect()
    };
    let (before, behind) = (ends(left, |own| own.right), ends(right, |own| own.left));
    let named = |all: &[(f64, bool)], r: f64| all.iter().any(|own| own.1 && own.0 == r);
    let mut levelled: Vec<([f64; 2], f64)> = Vec::new();
    for &(a, _) in &before {
        for &(b, _) in &behind {
            let step = (a - b).abs();
            let alone = |r: &f64| {
                let others = before.iter().filter(|own| (own.0 - a).abs() > same);
                let others = others.chain(behind.iter().filter(|own| (own.0 - b).abs() > same));
                others.clone().all(|own| (own.0 - r).abs() > CLEAR * step)
            };
            if step <= same || step > STEP * a.max(b) || ![a, b].iter().all(alone) {
                continue;
            }
            match [named(&before, a), named(&behind, b)] {
                [true, true] => {}
                [true, false] => levelled.push(([a, b], a)),
                [false, true] => levelled.push(([a, b], b)),
                [false, false] => levelled.push(([a, b], 0.5 * (a + b))),
            }
        }
    }
    let ends = left.iter_mut().map(|own| &mut own.right);
    for radius in ends.chain(right.iter_mut().map(|own| &mut own.left)).flatten() {
        let near = |own: &&([f64; 2], f64)| own.0.iter().any(|r| (r - *radius).abs() <= same);
        if let Some((_, r)) = levelled.iter().find(near) {
            *radius = *r;
        }
    }
}

/// Adds a radius unless it is there.
fn insert(radii: &mut Vec<f64>, r: f64, same: f64) {
    let place = radii.partition_point(|own| *own < r);
    let known = [place.checked_sub(1), Some(place)].into_iter().flatten();
    let mut known = known.filter_map(|place| radii.get(place));
    if known.all(|own| (own - r).abs() > same) {
        radii.insert(place, r);
    }
}

/// Adds radii where a piece has wide rings.
fn divide(radii: &mut Vec<f64>, [inner, outer]: [f64; 2], widest: f64, same: f64) {
    let within: Vec<f64> =
        radii.iter().copied().filter(|r| inner - same <= *r && *r <= outer + same).collect();
    for pair in within.windows(2) {
        let parts = (pair[1] - pair[0]) / (widest * outer);
        let count = (parts / SLACK).ceil().max(1.0) as usize;
        let step = (pair[1] - pair[0]) / count as f64;
        (1..count).for_each(|k| insert(radii, pair[0] + step * k as f64, same));
    }
}

/// Carries radii from plane to plane, to both sides, until each has one within reach or its own.
fn carry(radii: &mut [Vec<f64>], strips: &[Vec<Range>], planes: &[f64], same: f64) {
    loop {
        let mut added = false;
        for forth in [true, false] {
            for k in 0..strips.len() {
                let strip = if forth { k } else { strips.len() - 1 - k };
                let reach = SKEW * (planes[strip + 1] - planes[strip]);
                let [from, to] = if forth { [strip, strip + 1] } else { [strip + 1, strip] };
                for range in &strips[strip] {
                    let [own, other] =
                        if forth { [range.left, range.right] } else { [range.right, range.left] };
                    let inside = |r: f64, [a, b]: [f64; 2]| a + same < r && r < b - same;
                    let wanted: Vec<f64> =
                        radii[from].iter().copied().filter(|r| inside(*r, own)).collect();
                    for r in wanted {
                        let part = (r - own[0]) / (own[1] - own[0]);
                        // Straight on where the piece is there, else in proportion.
                        let target = match inside(r, other) {
                            true => r,
                            false => other[0] + part * (other[1] - other[0]),
                        };
                        let found = radii[to][nearest(&radii[to], target)];
                        let within = other[0] - same <= found && found <= other[1] + same;
                        if inside(target, other) && !(within && (found - target).abs() <= reach) {
                            insert(&mut radii[to], target, same);
                            added = true;
                        }
                    }
                }
            }
        }
        if !added {
            return;
        }
    }
}

/// The place of the radius that is nearest.
fn nearest(radii: &[f64], r: f64) -> usize {
    let away = |place: &usize| (radii[*place] - r).abs();
    (0..radii.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
}

//! Quadratic cells of generated meshes: linear ones with a node in the middle of each edge.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// Edges of a hexahedron by its corners, in the order in which Abaqus lists the nodes in their middles.
const HEXAHEDRON: [[usize; 2]; 12] = [
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 0],
    [4, 5],
    [5, 6],
    [6, 7],
    [7, 4],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];
/// Those of a wedge.
const WEDGE: [[usize; 2]; 9] =
    [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
/// Lengths nearer than this part of a radius are the same.
const SAME: f64 = 1e-9;

/// A round of a section: its centre, and the radius up to which edges around it are arcs (m).
pub(super) type Round = ([f64; 2], f64);

/// Nodes in the middles of edges, each once.
#[derive(Debug, Default)]
pub(super) struct Middles {
    known: BTreeMap<[usize; 2], usize>,
}

impl Middles {
    /// Cells of 8 or 6 corners with the nodes in the middles of their edges, all in the order of Abaqus; edges between nodes
    /// at one z and as far from the centre of a round become arcs.
    pub(super) fn raise(
        &mut self,
        nodes: &mut Vec<[f64; 3]>,
        cells: &[usize],
        corners: usize,
        rounds: &[Round],
    ) -> Vec<usize> {
        let edges: &[[usize; 2]] = if corners == 6 { &WEDGE } else { &HEXAHEDRON };
        let mut raised = Vec::with_capacity(cells.len() / corners * (corners + edges.len()));
        for cell in cells.chunks_exact(corners) {
            raised.extend_from_slice(cell);
            for [a, b] in edges {
                let (a, b) = (cell[*a], cell[*b]);
                let place = *self.known.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    nodes.push(middle(nodes[a], nodes[b], rounds));
                    nodes.len() - 1
                });
                raised.push(place);
            }
        }
        raised
    }

    /// Corners of a surface with the nodes in the middles of the edges between two of them, ascending.
    pub(super) fn with_middles(&self, corners: &BTreeSet<usize>) -> BTreeSet<usize> {
        let between =
            self.known.iter().filter(|(ends, _)| ends.iter().all(|a| corners.contains(a)));
        corners.iter().copied().chain(between.map(|(_, middle)| *middle)).collect()
    }

    /// Nodes around a closed ring with those between them.
    pub(super) fn around(&self, ring: &[usize]) -> Vec<usize> {
        let next = |place: usize| ring[(place + 1) % ring.len()];
        let pairs = ring.iter().enumerate().map(|(place, &node)| [node, next(place)]);
        let both = |[a, b]: [usize; 2]| {
            let between = self.known.get(&[a.min(b), a.max(b)]).copied();
            [Some(a), between].into_iter().flatten()
        };
        pairs.flat_map(both).collect()
    }
}

/// The middle between two nodes, on their arc where they are on one.
fn middle(a: [f64; 3], b: [f64; 3], rounds: &[Round]) -> [f64; 3] {
    let straight = [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]));
    for &(centre, most) in rounds {
        let from = |x: [f64; 3]| [x[0] - centre[0], x[1] - centre[1]];
        let far = |[x, y]: [f64; 2]| x.hypot(y);
        let (first, second, half) = (far(from(a)), far(from(b)), far(from(straight)));
        let same = |x: f64, y: f64| (x - y).abs() <= SAME * most;
        if same(a[2], b[2])
            && same(first, second)
            && half > SAME * most
            && first <= most * (1.0 + SAME)
        {
            let [x, y] = from(straight).map(|x| x * first / half);
            return [centre[0] + x, centre[1] + y, straight[2]];
        }
    }
    straight
}

/// Radius to the corners of a section whose edges are parabolas through points on a circle, such that it has the second
/// moment of area of a circle of radius r.
///
/// An edge over the angle 2α is x = 1 − c s², y = sin α s with c = 1 − cos α, s from −1 to 1; its part of the polar second
/// moment is ¼ ∫ (x² + y²)(x y' − y x') ds, that of the circle ½ α.
pub(super) fn corner_radius(r: f64, corners: usize) -> f64 {
    let half = PI / corners as f64;
    let (sin, c) = (half.sin(), 1.0 - half.cos());
    let square = sin * sin;
    let integral = 2.0 * (1.0 + (square - c) / 3.0 + c * (square - c) / 5.0 + c.powi(3) / 7.0);
    r * (2.0 * half / (sin * integral)).powf(0.25)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parabolas_have_the_second_moment_of_the_circle() {
        for corners in [4, 8, 24] {
            let half = PI / corners as f64;
            let radius = corner_radius(0.5, corners);
            // Simpson's rule over many parts, of polynomials of degree six.
            let parts = 2000;
            let term = |s: f64| {
                let c = 1.0 - half.cos();
                let (x, y) = (radius * (1.0 - c * s * s), radius * half.sin() * s);
                let (dx, dy) = (-2.0 * radius * c * s, radius * half.sin());
                0.25 * (x * x + y * y) * (x * dy - y * dx)
            };
            let h = 2.0 / f64::from(parts);
            let weight = |k: i32| match k {
                0 => 1.0,
                k if k == parts => 1.0,
                k => 2.0 + 2.0 * f64::from(k % 2),
            };
            let sum: f64 = (0..=parts).map(|k| weight(k) * term(-1.0 + h * f64::from(k))).sum();
            let whole = corners as f64 * sum * h / 3.0;
            assert!(
                (whole / (0.5 * PI * 0.5_f64.powi(4)) - 1.0).abs() < 1e-10,
                "{corners}: {whole}"
            );
        }
    }
}

//! Nodes of the developed bore, the cells between them, and the order in which they are eliminated.

use std::f64::consts::TAU;
use std::ops::Range;

/// Evenly spaced nodes around a bore, in rows along it: all around, or from one end of an arc to the other. Node (i, j), the
/// i-th around in the j-th row, has place j·around + i.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Nodes around.
    pub around: usize,
    /// Rows along.
    pub along: usize,
    /// Radius at which the bore is developed (m).
    pub radius: f64,
    /// Length of the film (m).
    pub length: f64,
    /// Angle of the first node of every row (rad).
    pub first: f64,
    /// Angle from the first node to the last one of every row (rad), of a film that does not close.
    pub arc: Option<f64>,
    /// Nodes of a cell around and along.
    pub(super) cell: [usize; 2],
}

/// A point at which what bounds a film is seen.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Around (rad).
    pub angle: f64,
    /// From the middle of the film (m).
    pub z: f64,
    /// What of each node it is.
    pub shares: Vec<(usize, f64)>,
}

/// Gauss's rule of three points: places from 0 to 1, and weights.
const GAUSS: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_31, 5.0 / 18.0],
    [0.5, 8.0 / 18.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

/// Functions of two or three nodes along a line at a place from 0 to 1.
fn functions(nodes: usize, s: f64) -> Vec<f64> {
    match nodes {
        2 => vec![1.0 - s, s],
        _ => vec![(1.0 - s) * (1.0 - 2.0 * s), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)],
    }
}

impl Grid {
    /// Angle of the i-th node around (rad).
    pub fn angle(&self, i: usize) -> f64 {
        self.first + self.span() * i as f64 / self.intervals() as f64
    }

    /// The angle that the film takes (rad).
    pub fn span(&self) -> f64 {
        self.arc.unwrap_or(TAU)
    }

    /// Distances between neighbours around.
    fn intervals(&self) -> usize {
        self.around - usize::from(self.arc.is_some())
    }

    /// Distance of a row from the middle of the film (m).
    pub fn z(&self, j: usize) -> f64 {
        self.length * (j as f64 / (self.along - 1) as f64 - 0.5)
    }

    /// Nodes of all rows.
    pub fn nodes(&self) -> usize {
        self.around * self.along
    }

    /// Angle (rad) and distance from the middle (m) of every node, row after row.
    pub fn places(&self) -> Vec<[f64; 2]> {
        (0..self.nodes()).map(|a| [self.angle(a % self.around), self.z(a / self.around)]).collect()
    }

    /// Distance between neighbours around and along (m).
    pub fn spacing(&self) -> [f64; 2] {
        let around = self.span() * self.radius / self.intervals() as f64;
        [around, self.length / (self.along - 1) as f64]
    }

    /// Lengths of a cell around and along (m).
    pub(super) fn cell_lengths(&self) -> [f64; 2] {
        let [x, z] = self.spacing();
        [x * (self.cell[0] - 1) as f64, z * (self.cell[1] - 1) as f64]
    }

    /// Cells around and along.
    pub(super) fn cells(&self) -> [usize; 2] {
        [self.intervals() / (self.cell[0] - 1), (self.along - 1) / (self.cell[1] - 1)]
    }

    /// Areas of the nodes of one row after the other (m²): shares of the cells as their functions have them at the nodes.
    pub fn areas(&self) -> Vec<f64> {
        let weights = |nodes: usize| match nodes {
            2 => vec![0.5, 0.5],
            _ => vec![1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0],
        };
        let (x, z) = (weights(self.cell[0]), weights(self.cell[1]));
        let [dx, dz] = self.cell_lengths();
        let mut areas = vec![0.0; self.nodes()];
        let [across, up] = self.cells();
        for k in 0..up {
            for c in 0..across {
                for (a, weight) in x.iter().enumerate() {
                    for (b, other) in z.iter().enumerate() {
                        areas[self.node(c, k, a + self.cell[0] * b)] += weight * other * dx * dz;
                    }
                }
            }
        }
        areas
    }

    /// Points at which what bounds a film is seen, with the shares of the nodes: of each node they add up to one, and are those of its
    /// function in the cells. What stands between nodes so counts as much as the film's pressure pushes on it.
    pub fn samples(&self) -> Vec<Sample> {
        let [across, up] = self.cells();
        let (areas, [dx, dz]) = (self.areas(), self.cell_lengths());
        let [wide, high] = self.cell;
        // In each half of a cell along, so that there are as many between all rows.
        let parts = high - 1;
        let mut samples = Vec::with_capacity(across * up * parts * GAUSS.len().pow(2));
        for (c, k) in (0..across).flat_map(|c| (0..up).map(move |k| (c, k))) {
            for part in 0..parts {
                for ([s, weight], [t, other]) in
                    GAUSS.iter().flat_map(|own| GAUSS.iter().map(move |other| (own, other)))
                {
                    let t = (part as f64 + t) / parts as f64;
                    let area = dx * dz * weight * other / parts as f64;
                    let (around, along) = (functions(wide, *s), functions(high, t));
                    let shares = (0..wide * high).map(|a| {
                        let node = self.node(c, k, a);
                        (node, area * around[a % wide] * along[a / wide] / areas[node])
                    });
                    samples.push(Sample {
                        angle: self.first + (c as f64 + s) * dx / self.radius,
                        z: (k as f64 + t) * dz - 0.5 * self.length,
                        shares: shares.collect(),
                    });
                }
            }
        }
        samples
    }

    /// Place of node a of the c-th cell around in the k-th row of cells.
    pub(super) fn node(&self, c: usize, k: usize, a: usize) -> usize {
        let i = (c * (self.cell[0] - 1) + a % self.cell[0]) % self.around;
        let j = k * (self.cell[1] - 1) + a / self.cell[0];
        j * self.around + i
    }

    /// Values of a row; of one that closes with those at its beginning repeated behind its end, so that cells find theirs side by
    /// side.
    pub(super) fn pitch(&self) -> usize {
        match self.arc {
            Some(_) => self.around,
            None => self.around + self.cell[0] - 1,
        }
    }

    /// Rows of the band matrix: those around in the order 0, n − 1, 1, n − 2 …, so that neighbours stay close where the ring
    /// closes; along an arc one after the other.
    pub(super) fn order(&self) -> Vec<usize> {
        let n = self.around;
        let folded = |i: usize| match self.arc {
            Some(_) => i,
            None if 2 * i < n => 2 * i,
            None => 2 * (n - i) - 1,
        };
        let mut order = Vec::with_capacity(self.nodes());
        for j in 0..self.along {
            order.extend((0..n).map(|i| folded(i) * self.along + j));
        }
        order
    }

    /// Entries of the band matrix beside its diagonal.
    pub(super) fn half_band(&self) -> usize {
        let folds = if self.arc.is_some() { 1 } else { 2 };
        folds * (self.cell[0] - 1) * self.along + self.cell[1] - 1
    }

    /// Whether a range of angles (rad) lies on the film, but for rounding.
    pub(super) fn has(&self, angle: &Range<f64>) -> bool {
        let Some(arc) = self.arc else { return true };
        let rounding = 1e-9 * arc;
        let begins = (angle.start - self.first + rounding).rem_euclid(TAU) - rounding;
        begins + angle.end - angle.start <= arc + rounding
    }

    /// Nodes that lie in a rectangle of the developed bore: over angles (rad) and z (m).
    pub(super) fn within(&self, angle: Range<f64>, z: Range<f64>) -> Vec<usize> {
        let mut found = Vec::new();
        // Nodes on its edges are in it, however these are rounded.
        let [dx, dz] = self.spacing();
        let rounding = 1e-9 * dx / self.radius;
        for j in 0..self.along {
            let here = self.z(j);
            if here < z.start - 1e-9 * dz || here > z.end + 1e-9 * dz {
                continue;
            }
            for i in 0..self.around {
                // Seen from the beginning of the range, once around.
                let turned = (self.angle(i) - angle.start + rounding).rem_euclid(TAU);
                if turned <= angle.end - angle.start + 2.0 * rounding {
                    found.push(j * self.around + i);
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn grid(around: usize, along: usize) -> Grid {
        let cell = [2, 3];
        Grid { around, along, radius: 0.02, length: 0.03, first: 0.1, arc: None, cell }
    }

    fn pad(around: usize, along: usize) -> Grid {
        Grid { arc: Some(1.2), ..grid(around, along) }
    }

    #[test]
    fn areas_add_up_to_the_bore() {
        for (around, along) in [(12, 3), (37, 5), (72, 7)] {
            let grid = grid(around, along);
            let total: f64 = grid.areas().iter().sum();
            assert!((total / (2.0 * PI * 0.02 * 0.03) - 1.0).abs() < 1e-13);
        }
        let grid = pad(13, 5);
        let total: f64 = grid.areas().iter().sum();
        assert!((total / (1.2 * 0.02 * 0.03) - 1.0).abs() < 1e-13);
        assert!((grid.angle(12) - 1.3).abs() < 1e-15 && grid.angle(0) == 0.1);
    }

    #[test]
    fn samples_of_a_node_add_up_to_it() {
        for grid in [grid(12, 7), pad(13, 5)] {
            let mut sums = vec![[0.0; 2]; grid.nodes()];
            for Sample { z, shares, .. } in grid.samples() {
                for (node, share) in shares {
                    sums[node][0] += share;
                    sums[node][1] += share * z;
                }
            }
            for (a, [one, z]) in sums.into_iter().enumerate() {
                assert!((one - 1.0).abs() < 1e-13, "{a}: {one}");
                // What is linear along the film is seen where the node is.
                assert!((z - grid.z(a / grid.around)).abs() < 1e-15, "{a}: {z}");
            }
        }
    }

    #[test]
    fn openings_lie_on_an_arc_or_beyond_it() {
        let grid = pad(13, 5);
        for (range, lies) in [
            (0.1..1.3, true),
            (0.1 - TAU..0.2 - TAU, true),
            (0.0..0.3, false),
            (1.2..1.4, false),
            (2.0..2.1, false),
        ] {
            assert_eq!(grid.has(&range), lies, "{range:?}");
        }
        // Both edges of an arc that begins before the axis.
        let grid = Grid { first: -0.3, ..grid };
        assert!(grid.has(&(0.1..0.9)) && !grid.has(&(0.1..0.91)));
        assert_eq!(grid.within(-0.3..-0.3, 0.0..0.0), [26]);
    }

    #[test]
    fn neighbours_stay_within_the_band() {
        for grid in [grid(11, 7), grid(12, 7), grid(37, 7), pad(9, 7)] {
            let order = grid.order();
            let mut seen = vec![false; grid.nodes()];
            order.iter().for_each(|place| seen[*place] = true);
            assert!(seen.iter().all(|seen| *seen));
            let mut furthest = 0;
            let [across, up] = grid.cells();
            for (c, k) in (0..across).flat_map(|c| (0..up).map(move |k| (c, k))) {
                for (a, b) in (0..6).flat_map(|a| (0..6).map(move |b| (a, b))) {
                    let [a, b] = [a, b].map(|own| order[grid.node(c, k, own)]);
                    furthest = furthest.max(a.abs_diff(b));
                }
            }
            assert_eq!(furthest, grid.half_band());
        }
    }
}

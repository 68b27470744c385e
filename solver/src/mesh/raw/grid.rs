//! Points of space in the cells of a grid, found again in constant time.

/// Indices of points by the cell of a cubic grid in which each stands.
///
/// Cells are hashed into as many buckets as there are points. A bucket may hold points of several cells, so that whoever
/// asks compares distances.
pub(super) struct PointGrid {
    /// Edge of a cell (m).
    size: f64,
    mask: u64,
    /// Bucket b has the entries from `starts[b]` to `starts[b + 1]`.
    starts: Vec<usize>,
    entries: Vec<usize>,
}

impl PointGrid {
    /// The points of these indices in cells of this size (m).
    pub(super) fn new(positions: &[[f64; 3]], points: &[usize], size: f64) -> PointGrid {
        let buckets = points.len().next_power_of_two();
        let mask = buckets as u64 - 1;
        let mut own =
            PointGrid { size, mask, starts: vec![0; buckets + 1], entries: vec![0; points.len()] };
        let bucket = |point: usize| own.bucket(own.cell(positions[point]));
        let places: Vec<usize> = points.iter().map(|&point| bucket(point)).collect();
        places.iter().for_each(|&place| own.starts[place + 1] += 1);
        (0..buckets).for_each(|place| own.starts[place + 1] += own.starts[place]);
        let mut next = own.starts.clone();
        for (&point, &place) in points.iter().zip(&places) {
            own.entries[next[place]] = point;
            next[place] += 1;
        }
        own
    }

    fn cell(&self, at: [f64; 3]) -> [i64; 3] {
        at.map(|x| (x / self.size).floor() as i64)
    }

    fn bucket(&self, cell: [i64; 3]) -> usize {
        // Odd multipliers of 64 bits; the upper half of the product is mixed best.
        const BY: [u64; 3] = [0x9e37_79b9_7f4a_7c15, 0xc2b2_ae3d_27d4_eb4f, 0x1656_67b1_9e37_79f9];
        let mixed = cell
            .iter()
            .zip(BY)
            .fold(0_u64, |sum, (&x, by)| (sum ^ x as u64).wrapping_mul(by).rotate_left(31));
        ((mixed ^ (mixed >> 32)) & self.mask) as usize
    }

    /// Calls `found` for every point in the cells that a box meets, each once; others may be among them.
    pub(super) fn each_in(&self, [low, high]: [[f64; 3]; 2], mut found: impl FnMut(usize)) {
        let (from, to) = (self.cell(low), self.cell(high));
        let mut seen: Vec<usize> = Vec::new();
        for x in from[0]..=to[0] {
            for y in from[1]..=to[1] {
                for z in from[2]..=to[2] {
                    let bucket = self.bucket([x, y, z]);
                    if from != to {
                        if seen.contains(&bucket) {
                            continue;
                        }
                        seen.push(bucket);
                    }
                    let entries = &self.entries[self.starts[bucket]..self.starts[bucket + 1]];
                    entries.iter().for_each(|&point| found(point));
                }
            }
        }
    }

    /// Calls `found` for every point within `reach` (m) of a place, with its distance.
    pub(super) fn each_near(
        &self,
        positions: &[[f64; 3]],
        (at, reach): ([f64; 3], f64),
        mut found: impl FnMut(usize, f64),
    ) {
        let ends = [at.map(|x| x - reach), at.map(|x| x + reach)];
        self.each_in(ends, |point| {
            let away = distance(positions[point], at);
            if away <= reach {
                found(point, away);
            }
        });
    }
}

/// From one point to another (m).
pub(super) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// Edge of a cube of which as many as there are points fill the box around them (m).
pub(super) fn spacing(positions: &[[f64; 3]], count: usize) -> f64 {
    let extent = extent(positions);
    // In a plane or on a line fewer cells hold points, and none has many.
    extent / (count.max(1) as f64).cbrt()
}

/// The longest side of the box around points (m).
pub(super) fn extent(positions: &[[f64; 3]]) -> f64 {
    let axis = |i: usize| {
        let values = || positions.iter().map(|x| x[i]);
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    (0..3).map(axis).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_found_across_the_walls_of_cells() {
        // A lattice whose points stand on walls of cells, and one beside each of them.
        let lattice = (0..1000).map(|k| [k % 10, k / 10 % 10, k / 100].map(|x| f64::from(x) * 0.5));
        let positions: Vec<[f64; 3]> = lattice.flat_map(|at| [at, at.map(|x| x - 1e-9)]).collect();
        let all: Vec<usize> = (0..positions.len()).collect();
        let grid = PointGrid::new(&positions, &all, 1.0);
        for (point, &at) in positions.iter().enumerate() {
            let mut near = Vec::new();
            grid.each_near(&positions, (at, 1e-8), |other, _| near.push(other));
            near.sort_unstable();
            assert_eq!(near, [point & !1, point | 1]);
        }
    }
}

//! Bores that mirrors map onto themselves: every row of T_b has images, up to a sign for each coordinate, so that T_b falls into
//! blocks of coordinates with the same signs, over one row of each set of images.

use crate::linalg::{Matrix, add_product, add_transposed, widely};

/// Share of the largest entry of a column by which images may differ: modes are known to no more.
const ALIKE: f64 = 1e-10;
/// Share of the largest entry of a column above which an entry has a sign.
const SIGNED: f64 = 1e-3;
/// Share of the largest entry of all that every column is taken to have: what hardly moves the bores is known by what moves most.
const LEAST: f64 = 0.1;
/// Rows and entries of T_b for which mirrors are looked for.
const ROWS: usize = 4096;
const ENTRIES: usize = 1024;
/// Mirrors that are used: each halves T_b.
const MIRRORS: usize = 2;

/// A mirror: the image of every row, and whether it changes the sign of a coordinate.
#[derive(Debug, Clone, PartialEq)]
struct Mirror {
    image: Vec<usize>,
    changes: Vec<bool>,
}

/// T_b in blocks.
#[derive(Debug)]
pub(super) struct Blocks {
    /// Sets of images.
    sets: usize,
    /// For every row its set, behind `sets` times the mirrors that lead to it from the first row of the set, as bits.
    places: Vec<usize>,
    blocks: Vec<Block>,
}

/// Coordinates of which the same mirrors change the sign.
#[derive(Debug)]
struct Block {
    /// These mirrors, as bits.
    changes: usize,
    coordinates: Vec<usize>,
    /// First rows of the sets × coordinates.
    rows: Matrix,
}

/// Memory for products with T_b.
#[derive(Debug, Clone, Default)]
pub(crate) struct BlockMemory {
    /// By mirrors and set.
    images: Vec<f64>,
    /// By set.
    sums: Vec<f64>,
    /// Of the coordinates of a block.
    coordinates: Vec<f64>,
}

/// Whether the mirrors that lead to a row change the sign of the coordinates of a block there.
fn sign(mirrors: usize, changes: usize) -> f64 {
    if (mirrors & changes).count_ones() % 2 == 1 { -1.0 } else { 1.0 }
}

impl Blocks {
    /// Of a T_b that has mirrors, which is made to have them to the last digit.
    pub(super) fn of(t_b: &mut Matrix) -> Option<Self> {
        let mirrors = mirrors(t_b);
        if mirrors.is_empty() {
            return None;
        }
        let combinations = 1_usize << mirrors.len();
        let image = |combination: usize, row: usize| {
            let used = mirrors.iter().enumerate().filter(|(bit, _)| combination >> bit & 1 == 1);
            used.fold(row, |row, (_, mirror)| mirror.image[row])
        };
        let changes: Vec<usize> = (0..t_b.cols)
            .map(|j| {
                let bits = mirrors.iter().enumerate();
                bits.map(|(bit, own)| usize::from(own.changes[j]) << bit).sum()
            })
            .collect();
        let mut exact = Matrix::zeros(t_b.rows, t_b.cols);
        for (j, &changes) in changes.iter().enumerate() {
            for i in 0..t_b.rows {
                let images =
                    (0..combinations).map(|own| sign(own, changes) * t_b[(image(own, i), j)]);
                exact[(i, j)] = images.sum::<f64>() / combinations as f64;
            }
        }
        // Images of a row that were rounded otherwise are made equal to it.
        let mut firsts = Vec::new();
        let mut places = vec![None; t_b.rows];
        for i in 0..t_b.rows {
            if places[i].is_some() {
                continue;
            }
            for own in 0..combinations {
                let row = image(own, i);
                if places[row].is_none() {
                    places[row] = Some((firsts.len(), own));
                    for (j, &changes) in changes.iter().enumerate() {
                        exact[(row, j)] = sign(own, changes) * exact[(i, j)];
                    }
                }
            }
            firsts.push(i);
        }
        *t_b = exact;
        let sets = firsts.len();
        let places = places.into_iter().flatten().map(|(set, own)| own * sets + set).collect();
        let blocks = (0..combinations).filter_map(|own| {
            let coordinates: Vec<usize> = (0..t_b.cols).filter(|&j| changes[j] == own).collect();
            let entry = |set: usize, j: usize| t_b[(firsts[set], coordinates[j])];
            let rows = Matrix::from_fn(sets, coordinates.len(), entry);
            let block = Block { changes: own, rows, coordinates };
            (!block.coordinates.is_empty()).then_some(block)
        });
        Some(Blocks { sets, places, blocks: blocks.collect() })
    }

    pub(super) fn memory(&self) -> BlockMemory {
        let most = self.blocks.iter().map(|own| own.coordinates.len()).max().unwrap_or(0);
        let combinations = self.places.iter().map(|place| place / self.sets + 1).max();
        BlockMemory {
            images: vec![0.0; combinations.unwrap_or(0) * self.sets],
            sums: vec![0.0; self.sets],
            coordinates: vec![0.0; most],
        }
    }

    /// Adds T_b x.
    pub(super) fn add_motion(&self, x: &[f64], out: &mut [f64], memory: &mut BlockMemory) {
        let BlockMemory { images, sums, coordinates } = memory;
        images.fill(0.0);
        for block in &self.blocks {
            let own = &mut coordinates[..block.coordinates.len()];
            own.iter_mut().zip(&block.coordinates).for_each(|(own, &j)| *own = x[j]);
            sums.fill(0.0);
            add_product(sums, &block.rows, own);
            for (mirrors, images) in images.chunks_exact_mut(self.sets).enumerate() {
                let (sign, own) = (sign(mirrors, block.changes), &sums[..images.len()]);
                widely(|| (0..images.len()).for_each(|set| images[set] += sign * own[set]));
            }
        }
        out.iter_mut().zip(&self.places).for_each(|(out, &place)| *out += images[place]);
    }

    /// Adds T_bᵀ f.
    pub(super) fn add_force(&self, f: &[f64], out: &mut [f64], memory: &mut BlockMemory) {
        let BlockMemory { images, sums, coordinates } = memory;
        images.fill(0.0);
        f.iter().zip(&self.places).for_each(|(f, &place)| images[place] = *f);
        for block in &self.blocks {
            sums.fill(0.0);
            for (mirrors, images) in images.chunks_exact(self.sets).enumerate() {
                let (sign, sums) = (sign(mirrors, block.changes), &mut sums[..images.len()]);
                widely(|| (0..images.len()).for_each(|set| sums[set] += sign * images[set]));
            }
            let own = &mut coordinates[..block.coordinates.len()];
            own.fill(0.0);
            add_transposed(own, &block.rows, sums);
            own.iter().zip(&block.coordinates).for_each(|(own, &j)| out[j] += own);
        }
    }
}

/// Mirrors of T_b that commute, as many as are used.
fn mirrors(t_b: &Matrix) -> Vec<Mirror> {
    let (rows, cols) = (t_b.rows, t_b.cols);
    if rows > ROWS || rows * cols < ENTRIES {
        return Vec::new();
    }
    let largest = |j: usize| t_b.col(j).iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    let mut scales: Vec<f64> = (0..cols).map(largest).collect();
    let least = LEAST * scales.iter().copied().fold(0.0, f64::max);
    scales.iter_mut().for_each(|own| *own = own.max(least));
    let is_signed = |i: usize, j: usize| t_b[(i, j)].abs() > SIGNED * scales[j];
    let signed = |i: &usize| (0..cols).filter(|&j| is_signed(*i, j)).count();
    let Some(sample) = (0..rows).max_by_key(signed) else { return Vec::new() };
    let differ = |a: f64, b: f64, j: usize| (a - b).abs() > ALIKE * scales[j];
    let is_image = |&row: &usize| {
        let mut columns = 0..cols;
        row != sample && columns.all(|j| !differ(t_b[(row, j)].abs(), t_b[(sample, j)].abs(), j))
    };
    let mut found: Vec<Mirror> = Vec::new();
    for row in (0..rows).filter(is_image) {
        let Some(mirror) = mirror(t_b, (sample, row), &is_signed, &differ) else { continue };
        let commutes = |other: &Mirror| {
            (0..rows).all(|i| other.image[mirror.image[i]] == mirror.image[other.image[i]])
        };
        if found.iter().all(|other| *other != mirror && commutes(other)) {
            found.push(mirror);
        }
        if found.len() == MIRRORS {
            break;
        }
    }
    found
}

/// The mirror that makes of row `sample` row `row`, if there is one.
fn mirror(
    t_b: &Matrix,
    (sample, row): (usize, usize),
    is_signed: &impl Fn(usize, usize) -> bool,
    differ: &impl Fn(f64, f64, usize) -> bool,
) -> Option<Mirror> {
    let (rows, cols) = (t_b.rows, t_b.cols);
    let known = (0..cols).filter(|&j| is_signed(sample, j));
    let known: Vec<(usize, f64)> = known
        .map(|j| (j, if (t_b[(row, j)] < 0.0) == (t_b[(sample, j)] < 0.0) { 1.0 } else { -1.0 }))
        .collect();
    let mut taken = vec![false; rows];
    let mut image = Vec::with_capacity(rows);
    for i in 0..rows {
        let is_own = |other: &usize| {
            !taken[*other]
                && known.iter().all(|&(j, sign)| !differ(t_b[(*other, j)], sign * t_b[(i, j)], j))
        };
        let own = (0..rows).find(is_own)?;
        taken[own] = true;
        image.push(own);
    }
    let changes: Vec<bool> = (0..cols)
        .map(|j| {
            let size = |i: &usize| t_b[(*i, j)].abs();
            let most = (0..rows).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(0);
            (t_b[(most, j)] < 0.0) != (t_b[(image[most], j)] < 0.0)
        })
        .collect();
    let is_whole = (0..rows).all(|i| {
        let sign = |j: usize| if changes[j] { -1.0 } else { 1.0 };
        let alike = |j: usize| !differ(t_b[(image[i], j)], sign(j) * t_b[(i, j)], j);
        image[image[i]] == i && (0..cols).all(alike)
    });
    // Rows that are equal are no mirror: each may be its own image.
    let moves = image.iter().enumerate().any(|(i, own)| i != *own);
    (is_whole && moves).then_some(Mirror { image, changes })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points around rings at places along an axis, moved by functions that are even or odd across both mirrors.
    fn bores(rings: usize, around: usize, wrong: f64) -> Matrix {
        let columns = 2 * around;
        let value = |i: usize, j: usize| {
            let (ring, point) = (i / around, i % around);
            let z = 2.0 * ring as f64 / (rings - 1) as f64 - 1.0;
            let angle = std::f64::consts::TAU * point as f64 / around as f64;
            let harmonic = (1 + j / 4) as f64;
            let along = if j.is_multiple_of(2) {
                (1.3 * harmonic * z).cos()
            } else {
                (1.1 * harmonic * z).sin()
            };
            let across = if (j / 2).is_multiple_of(2) {
                (harmonic * angle).cos()
            } else {
                (harmonic * angle).sin()
            };
            let error = wrong * (7.1 * (i + 3 * j) as f64).sin();
            along * (across + 0.2 * across.powi(3)) + error
        };
        Matrix::from_fn(rings * around, columns, value)
    }

    fn product(matrix: &Matrix, x: &[f64]) -> Vec<f64> {
        (0..matrix.rows).map(|i| (0..matrix.cols).map(|j| matrix[(i, j)] * x[j]).sum()).collect()
    }

    #[test]
    fn products_by_blocks_are_those_of_the_whole() {
        for wrong in [0.0, 1e-12] {
            let given = bores(4, 24, wrong);
            let mut t_b = given.clone();
            let blocks = Blocks::of(&mut t_b).expect("two mirrors");
            assert_eq!(blocks.blocks.len(), 4);
            // A quarter of the numbers, but for rows on the mirrors.
            let entries: usize = blocks.blocks.iter().map(|own| own.rows.data.len()).sum();
            assert!(3 * entries < given.data.len(), "{entries} of {}", given.data.len());
            // Angles up to 75 rad are rounded to 1.4e-14.
            for (own, given) in t_b.data.iter().zip(&given.data) {
                assert!((own - given).abs() <= 2.0 * wrong + 1e-13, "{own} for {given}");
            }
            let mut memory = blocks.memory();
            let x: Vec<f64> = (0..t_b.cols).map(|j| (0.3 + 1.9 * j as f64).sin()).collect();
            let f: Vec<f64> = (0..t_b.rows).map(|i| (0.8 + 2.3 * i as f64).sin()).collect();
            let (mut moved, mut force) = (vec![1.0; t_b.rows], vec![-2.0; t_b.cols]);
            blocks.add_motion(&x, &mut moved, &mut memory);
            blocks.add_force(&f, &mut force, &mut memory);
            let exact = product(&t_b, &x);
            moved.iter().zip(&exact).for_each(|(own, exact)| {
                assert!((own - 1.0 - exact).abs() < 1e-13, "{own} for {exact}");
            });
            let exact = product(&t_b.transpose(), &f);
            force.iter().zip(&exact).for_each(|(own, exact)| {
                assert!((own + 2.0 - exact).abs() < 1e-12, "{own} for {exact}");
            });
        }
    }

    #[test]
    fn what_is_not_its_own_image_has_no_blocks() {
        assert!(Blocks::of(&mut bores(4, 24, 1e-6)).is_none());
        let mut t_b = bores(4, 24, 0.0);
        t_b[(5, 7)] += 1e-3;
        assert!(Blocks::of(&mut t_b).is_none());
    }

    #[test]
    fn one_mirror_halves() {
        let both = bores(4, 24, 0.0);
        // Each ring moves more than the one before it: no mirror along the axis is left.
        let scaled = |i: usize, j: usize| both[(i, j)] * (1.0 + 0.1 * (i / 24) as f64);
        let mut t_b = Matrix::from_fn(both.rows, both.cols, scaled);
        let blocks = Blocks::of(&mut t_b).expect("a mirror");
        let entries: usize = blocks.blocks.iter().map(|own| own.rows.data.len()).sum();
        assert!(blocks.blocks.len() >= 2 && entries < 6 * both.data.len() / 10, "{entries}");
    }
}

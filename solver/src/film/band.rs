//! Elimination in a band without pivots: columns of a film's matrix sum to no less than zero, so that the diagonal rules.

use whirl_specs::Registers;
use whirl_specs::registers::{Register, Task};

/// A square band matrix, row by row, and its factors L·U in its place.
#[derive(Debug, Clone)]
pub(super) struct Band {
    size: usize,
    /// Entries on either side of the diagonal.
    half: usize,
    values: Vec<f64>,
}

impl Band {
    pub(super) fn new(size: usize, half: usize) -> Self {
        Band { size, half, values: vec![0.0; size * (2 * half + 1)] }
    }

    fn width(&self) -> usize {
        2 * self.half + 1
    }

    pub(super) fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Where an entry stands, which must lie in the band.
    pub(super) fn place(&self, row: usize, column: usize) -> usize {
        row * self.width() + self.half + column - row
    }

    /// Adds to the entry at a place.
    #[inline]
    pub(super) fn add_at(&mut self, place: usize, value: f64) {
        self.values[place] += value;
    }

    /// Factors the matrix. A row that is left without a pivot is not determined: its unknown stays as it is.
    #[inline(never)]
    pub(super) fn factor(&mut self) {
        Registers::current().run(Factor(self));
    }

    /// x of A x = b in the place of b, from factors.
    #[inline(never)]
    pub(super) fn solve(&self, x: &mut [f64]) {
        let (size, half, width) = (self.size, self.half, self.width());
        for i in 0..size {
            let first = i.saturating_sub(half);
            let row = &self.values[i * width + half - (i - first)..][..i - first];
            let sum: f64 = row.iter().zip(&x[first..i]).map(|(a, b)| a * b).sum();
            x[i] -= sum;
        }
        for i in (0..size).rev() {
            let end = (i + half + 1).min(size);
            let row = &self.values[i * width + half..][..end - i];
            let sum: f64 = row[1..].iter().zip(&x[i + 1..end]).map(|(a, b)| a * b).sum();
            x[i] = (x[i] - sum) / row[0];
        }
    }

    /// X of Aᵀ X = B in the place of B, from factors; `N` right sides, side by side in every row.
    #[inline(never)]
    pub(super) fn solve_transposed<const N: usize>(&self, x: &mut [[f64; N]]) {
        Registers::current().run(SolveTransposed { band: self, x });
    }
}

/// See [`Band::factor`].
struct Factor<'a>(&'a mut Band);

impl Task for Factor<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let (size, half, width) = (self.0.size, self.0.half, self.0.width());
        let values = &mut self.0.values;
        for k in 0..size {
            let end = (k + half + 1).min(size);
            let (before, below) = values.split_at_mut((k + 1) * width);
            let own = &mut before[k * width..];
            if own[half] == 0.0 {
                own.fill(0.0);
                own[half] = f64::INFINITY;
                for (n, row) in below.chunks_exact_mut(width).take(end - k - 1).enumerate() {
                    row[half - 1 - n] = 0.0;
                }
                continue;
            }
            let pivot = 1.0 / own[half];
            let right = &own[half + 1..];
            for (n, row) in below.chunks_exact_mut(width).take(end - k - 1).enumerate() {
                let at = half - 1 - n;
                if row[at] == 0.0 {
                    continue;
                }
                let factor = row[at] * pivot;
                row[at] = factor;
                let rest = &mut row[at + 1..][..half];
                for (value, other) in rest.iter_mut().zip(right) {
                    *value -= factor * other;
                }
            }
        }
    }
}

/// See [`Band::solve_transposed`].
struct SolveTransposed<'a, const N: usize> {
    band: &'a Band,
    x: &'a mut [[f64; N]],
}

impl<const N: usize> Task for SolveTransposed<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let SolveTransposed { band, x } = self;
        let (size, half, width) = (band.size, band.half, band.width());
        for i in 0..size {
            let end = (i + half + 1).min(size);
            let row = &band.values[i * width + half..][..end - i];
            let (own, below) = x[i..end].split_at_mut(1);
            let solved = own[0].map(|value| value / row[0]);
            own[0] = solved;
            for (value, factor) in below.iter_mut().zip(&row[1..]) {
                add::<L>(value, -factor, &solved);
            }
        }
        for i in (0..size).rev() {
            let first = i.saturating_sub(half);
            let row = &band.values[i * width + half - (i - first)..][..i - first];
            let (above, own) = x[first..=i].split_at_mut(i - first);
            let solved = own[0];
            for (value, factor) in above.iter_mut().zip(row) {
                add::<L>(value, -factor, &solved);
            }
        }
    }
}

/// sum += factor · values, not fused.
#[inline(always)]
pub(super) fn add<L: Register>(sum: &mut [f64], factor: f64, values: &[f64]) {
    let whole = sum.len() / L::WIDTH * L::WIDTH;
    let wide = L::splat(factor);
    for (sum, own) in L::chunks_mut(sum).iter_mut().zip(L::chunks(values)) {
        (L::load(sum) + wide * L::load(own)).store(sum);
    }
    for (sum, own) in sum[whole..].iter_mut().zip(&values[whole..]) {
        *sum += factor * own;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A band of numbers without a pattern whose diagonal rules.
    fn example(size: usize, half: usize) -> (Band, Vec<Vec<f64>>) {
        let mut band = Band::new(size, half);
        let mut full = vec![vec![0.0; size]; size];
        for (i, row) in full.iter_mut().enumerate() {
            let inside = i.saturating_sub(half)..(i + half + 1).min(size);
            for (j, own) in row.iter_mut().enumerate().filter(|(j, _)| inside.contains(j)) {
                let value = ((7 * i + 3 * j) as f64 * 1.3).sin()
                    + if i == j { 3.0 * half as f64 } else { 0.0 };
                let place = band.place(i, j);
                band.add_at(place, value);
                *own = value;
            }
        }
        (band, full)
    }

    #[test]
    fn both_ways_of_solving_meet_their_right_sides() {
        for (size, half) in [(1, 1), (7, 3), (60, 16)] {
            let (mut band, full) = example(size, half);
            band.factor();
            let b: Vec<f64> = (0..size).map(|i| (i as f64 * 0.7).cos()).collect();
            let mut x = b.clone();
            band.solve(&mut x);
            let mut both: Vec<[f64; 2]> = b.iter().map(|value| [*value, 2.0 * value]).collect();
            band.solve_transposed(&mut both);
            for i in 0..size {
                let forward: f64 = (0..size).map(|j| full[i][j] * x[j]).sum();
                assert!((forward - b[i]).abs() < 1e-13, "{size} {i}");
                for (n, times) in [1.0, 2.0].into_iter().enumerate() {
                    let back: f64 = (0..size).map(|j| full[j][i] * both[j][n]).sum();
                    assert!((back - times * b[i]).abs() < 1e-13, "{size} {i}");
                }
            }
        }
    }

    #[test]
    fn what_no_row_determines_stays() {
        let mut band = Band::new(3, 1);
        for (i, value) in [(0, 2.0), (2, 4.0)] {
            let place = band.place(i, i);
            band.add_at(place, value);
        }
        band.factor();
        let mut x = vec![2.0, 0.0, 4.0];
        band.solve(&mut x);
        assert_eq!(x, [1.0, 0.0, 1.0]);
    }
}

//! Arnoldi's process: an orthonormal basis of what a linear map makes of a vector again and again, in which the map is small.

use num_complex::Complex64;

use super::metric::norm;
use crate::linalg::{Matrix, dot};

/// A basis of the Krylov space, and the map in it.
pub(super) struct Krylov {
    basis: Vec<Vec<f64>>,
    /// Columns of the Hessenberg matrix: column j has j + 2 values.
    columns: Vec<Vec<f64>>,
}

/// Part of a vector outside of the basis that is rounding.
const ROUNDING: f64 = 1e-14;

impl Krylov {
    /// From a vector on, which is not zero.
    pub(super) fn new(first: &[f64]) -> Self {
        let size = norm(first);
        Krylov { basis: vec![first.iter().map(|own| own / size).collect()], columns: Vec::new() }
    }

    /// How often the map was applied.
    pub(super) fn size(&self) -> usize {
        self.columns.len()
    }

    /// The vector to which the map is to be applied next; none where the space is complete.
    pub(super) fn next(&self) -> Option<&[f64]> {
        self.basis.get(self.columns.len()).map(Vec::as_slice)
    }

    /// Takes what the map made of that.
    pub(super) fn take(&mut self, mut image: Vec<f64>) {
        let whole = norm(&image);
        let mut column = vec![0.0; self.basis.len()];
        for _ in 0..2 {
            for (sum, own) in column.iter_mut().zip(&self.basis) {
                let part = dot(own, &image);
                *sum += part;
                image.iter_mut().zip(own).for_each(|(image, own)| *image -= part * own);
            }
        }
        let left = norm(&image);
        column.push(left);
        self.columns.push(column);
        if left > ROUNDING * whole && self.basis.len() < image.len() {
            image.iter_mut().for_each(|own| *own /= left);
            self.basis.push(image);
        }
    }

    /// The map in the basis, square.
    pub(super) fn matrix(&self) -> Matrix {
        let size = self.size();
        Matrix::from_fn(size, size, |i, j| self.columns[j].get(i).copied().unwrap_or(0.0))
    }

    /// A vector that has these parts in the basis.
    pub(super) fn vector(&self, parts: &[Complex64]) -> Vec<Complex64> {
        let mut sum = vec![Complex64::ZERO; self.basis[0].len()];
        for (own, part) in self.basis.iter().zip(parts) {
            sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += part * own);
        }
        sum
    }

    /// What leads out of the basis.
    pub(super) fn beyond(&self) -> f64 {
        match self.next() {
            Some(_) => self.columns.last().and_then(|own| own.last()).copied().unwrap_or(0.0),
            None => 0.0,
        }
    }

    /// z with the least ‖(map − 1) z − f‖ in the space that begins with f, of norm `size`, and what is left.
    pub(super) fn least(&self, size: f64) -> (Vec<f64>, f64) {
        let m = self.size();
        // Givens rotations of the columns less the unit.
        let mut rows = vec![0.0; m + 1];
        rows[0] = size;
        let mut upper: Vec<Vec<f64>> = Vec::with_capacity(m);
        let mut turns: Vec<[f64; 2]> = Vec::with_capacity(m);
        for j in 0..m {
            let mut column = self.columns[j].clone();
            column[j] -= 1.0;
            for (i, [c, s]) in turns.iter().enumerate() {
                let (a, b) = (column[i], column[i + 1]);
                (column[i], column[i + 1]) = (c * a + s * b, c * b - s * a);
            }
            let length = column[j].hypot(column[j + 1]);
            let turn = if length == 0.0 {
                [1.0, 0.0]
            } else {
                [column[j] / length, column[j + 1] / length]
            };
            column[j] = length;
            let (a, b) = (rows[j], rows[j + 1]);
            (rows[j], rows[j + 1]) = (turn[0] * a + turn[1] * b, turn[0] * b - turn[1] * a);
            turns.push(turn);
            upper.push(column);
        }
        let mut shares = rows[..m].to_vec();
        for j in (0..m).rev() {
            shares[j] /= upper[j][j];
            for i in 0..j {
                shares[i] -= upper[j][i] * shares[j];
            }
        }
        let mut sum = vec![0.0; self.basis[0].len()];
        for (own, share) in self.basis.iter().zip(&shares) {
            sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += share * own);
        }
        (sum, rows[m].abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_are_solved_in_as_many_products_as_there_are_values() {
        let map = Matrix::from_fn(4, 4, |i, j| 0.3 * ((3 * i + 5 * j) as f64).sin());
        let f = [1.0, -2.0, 0.5, 3.0];
        let mut krylov = Krylov::new(&f);
        while let Some(next) = krylov.next() {
            let image = map.apply(next);
            krylov.take(image);
        }
        let (z, left) = krylov.least(norm(&f));
        assert!(left < 1e-13, "{left:e}");
        for (i, image) in map.apply(&z).iter().enumerate() {
            assert!((image - z[i] - f[i]).abs() < 1e-12, "{i}");
        }
    }
}

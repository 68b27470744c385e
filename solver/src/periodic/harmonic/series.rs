//! Sums of harmonics and their samples over a cycle.
//!
//! q = a_0 + Σ (a_k cos kφ + b_k sin kφ), φ = 2πt/T. Coefficients are a matrix: rows are coordinates, columns a_0, a_1, b_1, a_2, …
//! Samples are one, too: rows are coordinates, columns instants.

use std::f64::consts::TAU;

use crate::linalg::{Matrix, multiply};

/// Instants for each harmonic: forces with corners fall as 1/k².
pub(super) const INSTANTS: usize = 8;

/// So many harmonics at so many equal instants of a cycle.
#[derive(Debug, Clone)]
pub(super) struct Series {
    /// ω_k (rad/s) of k = 0, 1, …: by what rates of the harmonics are multiplied.
    frequencies: Vec<f64>,
    /// What a column of coefficients has of q, q̇ and q̈ at each instant; columns × instants.
    shapes: [Matrix; 3],
    /// What a sample adds to each column of coefficients; instants × columns.
    means: Matrix,
}

impl Series {
    /// Of a cycle of T s: ω_k = 2πk/T.
    pub(super) fn new(period: f64, harmonics: usize, instants: usize) -> Series {
        let frequencies = (0..=harmonics).map(|k| TAU * k as f64 / period).collect();
        Series::of(frequencies, instants)
    }

    /// With the rates that the average acceleration in steps from instant to instant has: ω_k = (2/Δt) tan(πk/N).
    #[cfg(test)]
    pub(super) fn of_steps(period: f64, harmonics: usize, instants: usize) -> Series {
        let rate = 2.0 * instants as f64 / period;
        let angle = |k: usize| TAU / 2.0 * k as f64 / instants as f64;
        Series::of((0..=harmonics).map(|k| rate * angle(k).tan()).collect(), instants)
    }

    fn of(frequencies: Vec<f64>, instants: usize) -> Series {
        let columns = 2 * frequencies.len() - 1;
        // k and whether it is the sine.
        let harmonic = |column: usize| (column.div_ceil(2), column > 0 && column.is_multiple_of(2));
        // The angle is reduced in whole numbers, so that all cycles are alike to the bit.
        let turned =
            |k: usize, j: usize| (TAU * ((k * j) % instants) as f64 / instants as f64).sin_cos();
        let shape = |order: usize| {
            Matrix::from_fn(columns, instants, |column, j| {
                let (k, is_sine) = harmonic(column);
                let ((sin, cos), rate) = (turned(k, j), frequencies[k]);
                match (order, is_sine) {
                    (0, false) => cos,
                    (0, true) => sin,
                    (1, false) => -rate * sin,
                    (1, true) => rate * cos,
                    (_, false) => -rate * rate * cos,
                    (_, true) => -rate * rate * sin,
                }
            })
        };
        let shapes = [0, 1, 2].map(shape);
        let means = Matrix::from_fn(instants, columns, |j, column| {
            let times = if column == 0 { 1.0 } else { 2.0 };
            times * shapes[0][(column, j)] / instants as f64
        });
        Series { frequencies, shapes, means }
    }

    /// How many harmonics there are beside the mean.
    pub(super) fn harmonics(&self) -> usize {
        self.frequencies.len() - 1
    }

    /// ω_k (rad/s).
    pub(super) fn frequency(&self, k: usize) -> f64 {
        self.frequencies[k]
    }

    /// Instants.
    pub(super) fn instants(&self) -> usize {
        self.means.rows
    }

    /// q, q̇ and q̈ at all instants.
    pub(super) fn sampled(&self, coefficients: &Matrix) -> [Matrix; 3] {
        self.shapes.each_ref().map(|shape| multiply(coefficients.view(), shape.view()))
    }

    /// The coefficients of what was sampled.
    pub(super) fn coefficients(&self, samples: &Matrix) -> Matrix {
        multiply(samples.view(), self.means.view())
    }
}

/// Coefficients with more harmonics, or with fewer.
pub(super) fn resized(coefficients: &Matrix, harmonics: usize) -> Matrix {
    Matrix::from_fn(coefficients.rows, 2 * harmonics + 1, |i, j| {
        if j < coefficients.cols { coefficients[(i, j)] } else { 0.0 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two coordinates with harmonics up to the third, sampled and found again; rates are those of the closed form.
    #[test]
    fn samples_have_the_coefficients_and_the_rates() {
        let coefficients = Matrix::from_fn(2, 7, |i, j| 1.0 / (1.0 + i as f64 + 2.0 * j as f64));
        let (period, instants) = (0.4, 9);
        let series = Series::new(period, 3, instants);
        let [q, v, a] = series.sampled(&coefficients);
        let again = series.coefficients(&q);
        let apart = again.data.iter().zip(&coefficients.data).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-15);
        for j in 0..instants {
            let t = period * j as f64 / instants as f64;
            for i in 0..2 {
                let of = |order: i32| -> f64 {
                    let harmonics = (0..=3).map(|k| {
                        let rate = TAU * f64::from(k) / period;
                        let column = 2 * k as usize;
                        let cosine = coefficients[(i, column.saturating_sub(1))];
                        let sine = if k == 0 { 0.0 } else { coefficients[(i, column)] };
                        let (sin, cos) = (rate * t).sin_cos();
                        match order {
                            0 => cosine * cos + sine * sin,
                            1 => rate * (sine * cos - cosine * sin),
                            _ => -rate * rate * (cosine * cos + sine * sin),
                        }
                    });
                    harmonics.sum()
                };
                for (order, own) in [&q, &v, &a].into_iter().enumerate() {
                    let exact = of(order as i32);
                    let size = 50.0_f64.powi(order as i32);
                    assert!((own[(i, j)] - exact).abs() < 1e-14 * size, "{order} {i} {j}");
                }
            }
        }
    }
}

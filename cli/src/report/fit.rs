//! Fits of x = A₀ + Σ A cos(n θ + φ) by least squares, over the angles of one body or of several.

/// 1, and cos nθ and sin nθ of all orders, at some angles.
pub(super) struct Terms {
    /// Places of angles, and how often each goes in a revolution of its angle.
    orders: Vec<(usize, f64)>,
    values: Vec<f64>,
}

impl Terms {
    pub(super) fn new(orders: Vec<(usize, f64)>) -> Self {
        let values = vec![1.0; 1 + 2 * orders.len()];
        Terms { orders, values }
    }

    /// Their values at angles (rad).
    pub(super) fn at(&mut self, angles: &[f64]) -> &[f64] {
        for (k, (place, order)) in self.orders.iter().enumerate() {
            let (sin, cos) = (order * angles[*place]).sin_cos();
            (self.values[1 + 2 * k], self.values[2 + 2 * k]) = (cos, sin);
        }
        &self.values
    }
}

/// Normal equations of a weighted fit of several signals.
pub(super) struct Fit {
    pub(super) rows: usize,
    pub(super) terms: usize,
    /// Terms × terms.
    matrix: Vec<f64>,
    /// Signals × terms.
    right: Vec<f64>,
}

impl Fit {
    /// Of so many orders beside the constant, and so many signals.
    pub(super) fn new(orders: usize, signals: usize) -> Fit {
        let terms = 1 + 2 * orders;
        Fit { rows: 0, terms, matrix: vec![0.0; terms * terms], right: vec![0.0; signals * terms] }
    }

    /// Adds a row with the values of the terms and of the signals there.
    pub(super) fn add(&mut self, weight: f64, terms: &[f64], values: &[f64]) {
        let n = self.terms;
        for (row, a) in self.matrix.chunks_exact_mut(n).zip(terms) {
            row.iter_mut().zip(terms).for_each(|(sum, b)| *sum += weight * a * b);
        }
        for (right, value) in self.right.chunks_exact_mut(n).zip(values) {
            right.iter_mut().zip(terms).for_each(|(sum, a)| *sum += weight * a * value);
        }
        self.rows += 1;
    }

    /// The coefficients of the terms, signal by signal; none of rows that do not tell them.
    pub(super) fn solve(mut self) -> Option<Vec<Vec<f64>>> {
        let n = self.terms;
        let least = 1e-9 * self.matrix[0];
        // Gauss without pivots: the matrix is positive definite.
        for k in 0..n {
            let pivot = self.matrix[k * n + k];
            if !(pivot > least) {
                return None;
            }
            for i in k + 1..n {
                let factor = self.matrix[i * n + k] / pivot;
                for j in k..n {
                    self.matrix[i * n + j] -= factor * self.matrix[k * n + j];
                }
                for right in self.right.chunks_exact_mut(n) {
                    right[i] -= factor * right[k];
                }
            }
        }
        for right in self.right.chunks_exact_mut(n) {
            for k in (0..n).rev() {
                let rest: f64 = (k + 1..n).map(|j| self.matrix[k * n + j] * right[j]).sum();
                right[k] = (right[k] - rest) / self.matrix[k * n + k];
            }
        }
        Some(self.right.chunks_exact(n).map(<[f64]>::to_vec).collect())
    }
}

/// Amplitude and phase (°) of the order at a place, x = A cos(n θ + φ): a cos nθ + b sin nθ with a = A cos φ, b = −A sin φ.
pub(super) fn polar(own: &[f64], place: usize) -> [f64; 2] {
    let (a, b) = (own[1 + 2 * place], own[2 + 2 * place]);
    [a.hypot(b), (-b).atan2(a).to_degrees()]
}

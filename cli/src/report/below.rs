//! What moves more slowly than the rotation: the largest part of a motion between two orders, as a whirl of oil or a rub has it.
//!
//! Over a window of N revolutions about a place, with the weights w of a Hann window in θ, the amplitude at the order m is
//! |Σ w r e^{−imθ}| · 2/Σ w of what r the fit of the whole orders leaves. Orders are tried from 1.5/N to 1 − 1.5/N, so that neither
//! a drift nor the edge of 1X counts.

use num_complex::Complex64;

/// Orders that are tried in the width of 1/N of the window's resolution.
const STEPS: f64 = 4.0;
/// Half widths of the window around 0 and 1X that are left out, in 1/N.
const EDGE: f64 = 1.5;

/// Sums over the rows of a window, an order and a column each.
pub(super) struct Below {
    first: f64,
    step: f64,
    weight: f64,
    /// Orders × columns.
    sums: Vec<Complex64>,
    columns: usize,
}

impl Below {
    /// Of so many revolutions and columns.
    pub(super) fn new(revolutions: f64, columns: usize) -> Self {
        let step = 1.0 / (STEPS * revolutions);
        let first = EDGE / revolutions;
        let count = ((1.0 - 2.0 * first) / step + 1e-9).floor() as usize + 1;
        Below { first, step, weight: 0.0, sums: vec![Complex64::ZERO; count * columns], columns }
    }

    /// A row by its weight, its angle (rad), and what the fit leaves of its values.
    pub(super) fn add(&mut self, weight: f64, angle: f64, left: &[f64]) {
        self.weight += weight;
        let mut turned = Complex64::from_polar(weight, -self.first * angle);
        let step = Complex64::from_polar(1.0, -self.step * angle);
        for sums in self.sums.chunks_exact_mut(self.columns) {
            sums.iter_mut().zip(left).for_each(|(sum, own)| *sum += turned * own);
            turned *= step;
        }
    }

    /// Amplitude and order of the largest part of a column.
    pub(super) fn largest(&self, column: usize) -> [f64; 2] {
        let own = self.sums.iter().skip(column).step_by(self.columns).map(|own| own.norm());
        let most =
            own.enumerate().fold((0, 0.0), |most, own| if own.1 > most.1 { own } else { most });
        let amplitude = if self.weight > 0.0 { 2.0 * most.1 / self.weight } else { 0.0 };
        [amplitude, self.first + most.0 as f64 * self.step]
    }
}

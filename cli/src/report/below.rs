//! What moves more slowly than the rotation: the largest part of a motion between two orders, as a whirl of oil or a rub has it.
//!
//! Over a window of N revolutions about a place, with the weights w of a Hann window in θ, the amplitude at the order m is
//! |Σ w r e^{−imθ}| · 2/Σ w of what r the fit of the whole orders leaves. Orders are tried from 2/N to 1 − 2/N, beyond which a drift and 1X
//! reach with the window's main lobe, and only a maximum between them counts; its place and height are those of a parabola.

use num_complex::Complex64;

/// Orders that are tried in the width of 1/N of the window's resolution.
const STEPS: f64 = 4.0;
/// What is left out around 0 and 1X, in 1/N.
const EDGE: f64 = 2.0;

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

    /// Amplitude and order of the largest part of a column; of one without a maximum 0 and no number.
    pub(super) fn largest(&self, column: usize) -> [f64; 2] {
        let own: Vec<f64> =
            self.sums.iter().skip(column).step_by(self.columns).map(|own| own.norm()).collect();
        let place = own.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map(|own| own.0);
        let around = place.and_then(|place| {
            let [before, here, after] = [place.checked_sub(1)?, place, place + 1];
            Some((place, [own[before], own[here], *own.get(after)?]))
        });
        let Some((place, [before, here, after])) = around.filter(|_| self.weight > 0.0) else {
            return [0.0, f64::NAN];
        };
        let bend = before - 2.0 * here + after;
        let off = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
        let height = here - 0.25 * (before - after) * off;
        [2.0 * height / self.weight, self.first + (place as f64 + off) * self.step]
    }
}

//! Where the iteration of a step begins: the corrections of the steps before, carried on.

use serde::{Deserialize, Serialize};

/// Corrections that are kept.
const KEPT: usize = 3;

/// Share of the squares of the kept corrections by which their sum is held from growing where they are alike.
const HELD: f64 = 1e-10;

/// The corrections of the last steps beside their predictions. Whichever of none, the last one, the straight line
/// through the last two, and the sum of the last three that came nearest to their successor would have been nearest to that of the
/// last step is taken for the next one: where accelerations are smooth the last is near, where unresolved modes flip their signs
/// the one before it, and of both at once the sum.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Extrapolation {
    /// Step length (s) of the corrections; others have corrections of another size.
    dt: f64,
    order: Order,
    /// The last correction first.
    kept: [Vec<f64>; KEPT],
    /// Their products with each other.
    products: [[f64; KEPT]; KEPT],
    /// Shares in the sum.
    shares: [f64; KEPT],
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Order {
    None,
    Constant,
    Linear,
    Sum,
}

impl Extrapolation {
    /// Of steps that were not made, for so many unknowns.
    pub(super) fn new(unknowns: usize) -> Self {
        Extrapolation {
            dt: 0.0,
            order: Order::None,
            kept: std::array::from_fn(|_| vec![0.0; unknowns]),
            products: [[0.0; KEPT]; KEPT],
            shares: [0.0; KEPT],
        }
    }

    /// Writes a correction with which a step of `dt` s may begin.
    pub(super) fn begin(&mut self, dt: f64, correction: &mut [f64]) {
        if self.dt != dt {
            self.dt = dt;
            self.order = Order::None;
            self.kept.iter_mut().for_each(|own| own.fill(0.0));
            self.products = [[0.0; KEPT]; KEPT];
            self.shares = [0.0; KEPT];
        }
        let [a, b, c] = match self.order {
            Order::None => return correction.fill(0.0),
            Order::Constant => return correction.copy_from_slice(&self.kept[0]),
            Order::Linear => [2.0, -1.0, 0.0],
            Order::Sum => self.shares,
        };
        let [last, before, first] = &self.kept;
        let known = last.iter().zip(before).zip(first);
        correction
            .iter_mut()
            .zip(known)
            .for_each(|(own, ((x, y), z))| *own = a * x + b * y + c * z);
    }

    /// Takes the correction of a step that was solved; `weights`: 1/s of the unknowns.
    pub(super) fn learn(&mut self, correction: &[f64], weights: &[f64]) {
        let (mut square, mut with) = (0.0, [0.0; KEPT]);
        let [last, before, first] = &self.kept;
        let known = last.iter().zip(before).zip(first);
        for ((own, weight), ((x, y), z)) in correction.iter().zip(weights).zip(known) {
            let weighed = own / weight;
            square += weighed * own;
            with[0] += weighed * x;
            with[1] += weighed * y;
            with[2] += weighed * z;
        }
        // ‖c − Σ a_i c_i‖² by the products.
        let error = |a: [f64; KEPT]| {
            let rows = self.products.iter().zip(a);
            let own: f64 =
                rows.map(|(row, b)| b * row.iter().zip(a).map(|(p, a)| p * a).sum::<f64>()).sum();
            square - 2.0 * with.iter().zip(a).map(|(p, a)| p * a).sum::<f64>() + own
        };
        let ways = [
            (Order::None, square),
            (Order::Constant, error([1.0, 0.0, 0.0])),
            (Order::Linear, error([2.0, -1.0, 0.0])),
            (Order::Sum, error(self.shares)),
        ];
        // What is no number is no reason to leave the prediction.
        self.order =
            ways.iter().fold(ways[0], |best, way| if way.1 < best.1 { *way } else { best }).0;
        self.shares = nearest(&self.products, with).unwrap_or([1.0, 0.0, 0.0]);
        let [a, b, _] = with;
        let [[p, q, _], [_, r, _], _] = self.products;
        self.products = [[square, a, b], [a, p, q], [b, q, r]];
        self.kept.rotate_right(1);
        self.kept[0].copy_from_slice(correction);
    }
}

/// The shares of the sum that is nearest to what has these products with its parts; none where they are no numbers.
fn nearest(products: &[[f64; KEPT]; KEPT], with: [f64; KEPT]) -> Option<[f64; KEPT]> {
    let held = HELD * (0..KEPT).map(|i| products[i][i]).sum::<f64>();
    let (mut a, mut x) = (*products, with);
    (0..KEPT).for_each(|i| a[i][i] += held);
    for i in 0..KEPT {
        for j in i + 1..KEPT {
            let factor = a[j][i] / a[i][i];
            (i..KEPT).for_each(|k| a[j][k] -= factor * a[i][k]);
            x[j] -= factor * x[i];
        }
    }
    for i in (0..KEPT).rev() {
        let known: f64 = (i + 1..KEPT).map(|k| a[i][k] * x[k]).sum();
        x[i] = (x[i] - known) / a[i][i];
    }
    x.iter().all(|own| own.is_finite()).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a step begins with after corrections of one unknown.
    fn after(corrections: &[f64]) -> f64 {
        let mut own = Extrapolation::new(1);
        let mut guess = [f64::NAN];
        own.begin(0.1, &mut guess);
        assert_eq!(guess, [0.0]);
        corrections.iter().for_each(|correction| own.learn(&[*correction], &[0.5]));
        own.begin(0.1, &mut guess);
        guess[0]
    }

    #[test]
    fn what_would_have_been_nearest_is_taken() {
        assert_eq!(after(&[3.0, 3.1]), 3.1);
        assert_eq!(after(&[1.0, 2.0, 3.0]), 4.0);
        // What flips its sign flips it again, as soon as that is seen.
        assert_eq!(after(&[1.0, -1.0]), 0.0);
        assert!((after(&[1.0, -1.0, 1.0]) + 1.0).abs() < 1e-6);
        assert_eq!(after(&[1.0, f64::NAN]), 0.0);
    }

    /// Unknowns of which some grow on and others flip their signs: no single correction is near the next one.
    #[test]
    fn what_grows_and_what_flips_is_carried_on_together() {
        let all = |step: i32| {
            let (flips, grows) = (f64::from(step % 2 * 2 - 1), 1.1_f64.powi(step));
            [flips, 3.0 * grows, flips + grows, 2.0 * flips - grows, 0.5 * grows]
        };
        let weights = [1.0, 0.5, 0.25, 2.0, 1.0];
        let mut own = Extrapolation::new(5);
        let mut guess = [0.0; 5];
        for step in 0..8 {
            own.begin(0.1, &mut guess);
            own.learn(&all(step), &weights);
        }
        own.begin(0.1, &mut guess);
        for (guess, exact) in guess.iter().zip(all(8)) {
            assert!((guess - exact).abs() < 1e-6 * exact.abs().max(1.0), "{guess} for {exact}");
        }
    }

    #[test]
    fn other_steps_begin_anew() {
        let mut own = Extrapolation::new(2);
        let mut guess = [0.0; 2];
        own.begin(0.1, &mut guess);
        own.learn(&[1.0, 2.0], &[1.0; 2]);
        own.learn(&[1.0, 2.0], &[1.0; 2]);
        own.begin(0.05, &mut guess);
        assert_eq!(guess, [0.0; 2]);
    }
}

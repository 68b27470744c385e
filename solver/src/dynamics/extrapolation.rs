//! Where the iteration of a step begins: the corrections of the steps before, carried on.

use serde::{Deserialize, Serialize};

use super::kept_columns::{KeptColumns, MOST, Shares};

/// Corrections that are kept of few unknowns.
const LEAST: usize = 3;
/// Share of their squares by which their sum is held.
const HELD: f64 = 1e-12;

/// The corrections of the last steps beside their predictions. Whichever of none, the last one, the straight line
/// through the last two, and the sum of all that came nearest to their successor would have been nearest to that of the
/// last step is taken for the next one: where accelerations are smooth the last is near, where unresolved modes flip their signs
/// the one before it, and of several motions at once the sum, as each goes on by its own recurrence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Extrapolation {
    /// Step length (s) of the corrections; others have corrections of another size.
    dt: f64,
    kept: KeptColumns,
    /// Shares in the sum of all that came nearest to the last correction, its own first, and in what is taken.
    nearest: Shares,
    taken: Option<Shares>,
}

/// The last correction, and the straight line through the last two.
const CONSTANT: Shares = shares_of([1.0, 0.0]);
const LINEAR: Shares = shares_of([2.0, -1.0]);

const fn shares_of([last, before]: [f64; 2]) -> Shares {
    let mut shares = [0.0; MOST];
    (shares[0], shares[1]) = (last, before);
    shares
}

impl Extrapolation {
    /// Of steps that were not made, for so many unknowns.
    pub(super) fn new(unknowns: usize) -> Self {
        let kept = KeptColumns::new(unknowns, [LEAST, MOST], HELD);
        Extrapolation { dt: 0.0, kept, nearest: [0.0; MOST], taken: None }
    }

    /// Writes a correction with which a step of `dt` s may begin.
    pub(super) fn begin(&mut self, dt: f64, correction: &mut [f64]) {
        if self.dt != dt {
            (self.dt, self.nearest, self.taken) = (dt, [0.0; MOST], None);
            self.kept.clear();
        }
        correction.fill(0.0);
        if let Some(shares) = &self.taken {
            self.kept.add(&self.kept.turned(shares), correction);
        }
    }

    /// Takes the correction of a step that was solved; `weights`: 1/s of the unknowns.
    pub(super) fn learn(&mut self, correction: &[f64], weights: &[f64], memory: &mut [f64]) {
        let products = self.kept.products_with(correction, weights, memory);
        let error = |shares: &Shares| self.kept.distance(products, &self.kept.turned(shares));
        let nearest = self.kept.nearest(&products.1).map(|shares| self.kept.turned(&shares));
        let nearest = nearest.unwrap_or(CONSTANT);
        let mut best = (None, products.0);
        // What would have been taken, and what of that kind is taken next.
        for (judged, next) in [(CONSTANT, CONSTANT), (LINEAR, LINEAR), (self.nearest, nearest)] {
            let error = error(&judged);
            // What is no number is no reason to leave the prediction.
            if error < best.1 {
                best = (Some(next), error);
            }
        }
        (self.nearest, self.taken) = (nearest, best.0);
        self.kept.push(correction, products);
    }
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
        corrections.iter().for_each(|correction| own.learn(&[*correction], &[0.5], &mut [0.0]));
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
            own.learn(&all(step), &weights, &mut [0.0; 5]);
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
        own.learn(&[1.0, 2.0], &[1.0; 2], &mut [0.0; 2]);
        own.learn(&[1.0, 2.0], &[1.0; 2], &mut [0.0; 2]);
        own.begin(0.05, &mut guess);
        assert_eq!(guess, [0.0; 2]);
    }
}

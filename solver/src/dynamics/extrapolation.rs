//! Where the iteration of a step begins: the corrections of the steps before, carried on.

use serde::{Deserialize, Serialize};

/// The corrections of the last steps beside their predictions. Whichever of none, the last one, and the straight line
/// through the last two would have been nearest to that of the last step is taken for the next one: where accelerations
/// are smooth the last is near, and where unresolved modes flip their signs none is nearer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Extrapolation {
    /// Step length (s) of the corrections; others have corrections of another size.
    dt: f64,
    order: Order,
    last: Vec<f64>,
    before: Vec<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Order {
    None,
    Constant,
    Linear,
}

impl Extrapolation {
    /// Of steps that were not made, for so many unknowns.
    pub(super) fn new(unknowns: usize) -> Self {
        let zeros = || vec![0.0; unknowns];
        Extrapolation { dt: 0.0, order: Order::None, last: zeros(), before: zeros() }
    }

    /// Writes a correction with which a step of `dt` s may begin.
    pub(super) fn begin(&mut self, dt: f64, correction: &mut [f64]) {
        if self.dt != dt {
            self.dt = dt;
            self.order = Order::None;
            self.last.fill(0.0);
            self.before.fill(0.0);
        }
        match self.order {
            Order::None => correction.fill(0.0),
            Order::Constant => correction.copy_from_slice(&self.last),
            Order::Linear => {
                let known = self.last.iter().zip(&self.before);
                correction.iter_mut().zip(known).for_each(|(own, (a, b))| *own = 2.0 * a - b);
            }
        }
    }

    /// Takes the correction of a step that was solved; `weights`: 1/s of the unknowns.
    pub(super) fn learn(&mut self, correction: &[f64], weights: &[f64]) {
        let mut squares = [0.0; 3];
        let known = self.last.iter().zip(&self.before).zip(weights);
        for (own, ((last, before), weight)) in correction.iter().zip(known) {
            let (none, constant) = (own, own - last);
            let linear = constant - (last - before);
            squares[0] += none * none / weight;
            squares[1] += constant * constant / weight;
            squares[2] += linear * linear / weight;
        }
        let [none, constant, linear] = squares;
        // What is no number is no reason to leave the prediction.
        self.order = match (constant < none, linear < constant && linear < none) {
            (_, true) => Order::Linear,
            (true, false) => Order::Constant,
            (false, false) => Order::None,
        };
        std::mem::swap(&mut self.last, &mut self.before);
        self.last.copy_from_slice(correction);
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
        corrections.iter().for_each(|correction| own.learn(&[*correction], &[0.5]));
        own.begin(0.1, &mut guess);
        guess[0]
    }

    #[test]
    fn what_would_have_been_nearest_is_taken() {
        assert_eq!(after(&[3.0, 3.1]), 3.1);
        assert_eq!(after(&[1.0, 2.0, 3.0]), 4.0);
        assert_eq!(after(&[1.0, -1.0, 1.0]), 0.0);
        assert_eq!(after(&[1.0, f64::NAN]), 0.0);
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

//! Where the iteration of a step begins: the corrections of the steps before, carried on.

use serde::{Deserialize, Serialize};

use super::kept_columns::{KeptColumns, MOST, Shares};

/// Corrections that are kept of few unknowns.
const LEAST: usize = 3;
/// Corrections of which others are made where steps become longer or shorter by at most so many times.
const FEWEST: usize = 3;
const MOST_TURNED: f64 = 4.0;
/// Share of their squares by which their sum is held.
const HELD: f64 = 1e-12;

/// The corrections of the last steps beside their predictions. Whichever of none, the last one, the straight line
/// through the last two, and the sum of all that came nearest to their successor would have been nearest to that of the
/// last step is taken for the next one: where accelerations are smooth the last is near, where unresolved modes flip their signs
/// the one before it, and of several motions at once the sum, as each goes on by its own recurrence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Extrapolation {
    /// Length (s) of the steps of the corrections, when the last one ended, and how many there are.
    dt: f64,
    end: f64,
    learnt: usize,
    /// Whether steps of other lengths go on with them.
    resamples: bool,
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
    pub(super) fn new(unknowns: usize, resamples: bool) -> Self {
        let kept = KeptColumns::new(unknowns, [LEAST, MOST], HELD);
        Extrapolation {
            dt: 0.0,
            end: 0.0,
            learnt: 0,
            resamples,
            kept,
            nearest: [0.0; MOST],
            taken: None,
        }
    }

    /// Writes a correction with which a step of `dt` s may begin that ends at `t` (s); `weights`: 1/s of the unknowns.
    pub(super) fn begin(
        &mut self,
        (t, dt): (f64, f64),
        (weights, memory): (&[f64], &mut [f64]),
        correction: &mut [f64],
    ) {
        if self.dt != dt {
            self.turn_to((t - dt, dt), (weights, memory), correction);
        }
        self.end = t;
        correction.fill(0.0);
        if let Some(shares) = &self.taken {
            self.kept.add(&self.kept.turned(shares), correction);
        }
    }

    /// Makes of the corrections those of steps of `dt` s before the time `start` (s), where they are halves or doubles of the steps
    /// before: a correction is Δt³ of what moves on smoothly.
    fn turn_to(
        &mut self,
        (start, dt): (f64, f64),
        (weights, memory): (&[f64], &mut [f64]),
        column: &mut [f64],
    ) {
        let (old, before) = (std::mem::replace(&mut self.dt, dt), self.kept.clone());
        let ratio = dt / old;
        let newest = (self.end - start) / old - 0.5;
        let learnt = std::mem::take(&mut self.learnt);
        (self.nearest, self.taken) = ([0.0; MOST], None);
        self.kept.clear();
        if !self.resamples || learnt < FEWEST || !(1.0 / MOST_TURNED..=MOST_TURNED).contains(&ratio)
        {
            return;
        }
        // Middles of steps before `start`, in steps of the old length before the middle of the last one.
        let ages = (0..before.room()).map(|step| newest + ratio * (step as f64 + 0.5));
        let ages: Vec<f64> = ages.take_while(|age| *age <= (learnt - 1) as f64 + 0.25).collect();
        for age in ages.into_iter().rev() {
            column.fill(0.0);
            let shares = interpolated(age, learnt).map(|share| ratio.powi(3) * share);
            before.add(&before.turned(&shares), column);
            self.learn(column, weights, memory);
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
        self.learnt = (self.learnt + 1).min(self.kept.room());
    }
}

/// Shares by age of a value at an age between those of so many: of the cubic through the four nearest.
fn interpolated(age: f64, count: usize) -> Shares {
    let points = count.min(4);
    let first = (age.floor() - 1.0).clamp(0.0, (count - points) as f64) as usize;
    let mut shares = [0.0; MOST];
    for (i, share) in shares.iter_mut().enumerate().skip(first).take(points) {
        let others = (first..first + points).filter(|other| *other != i);
        *share = others.map(|j| (age - j as f64) / (i as f64 - j as f64)).product();
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a step begins with after corrections of one unknown.
    fn after(corrections: &[f64]) -> f64 {
        let mut own = Extrapolation::new(1, false);
        assert_eq!(begin(&mut own, (0.1, 0.1)), 0.0);
        corrections.iter().for_each(|correction| own.learn(&[*correction], &[0.5], &mut [0.0]));
        begin(&mut own, (0.2, 0.1))
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
        let mut own = Extrapolation::new(5, false);
        let mut guess = [0.0; 5];
        for step in 0..8 {
            own.begin((0.1, 0.1), (&weights, &mut [0.0; 5]), &mut guess);
            own.learn(&all(step), &weights, &mut [0.0; 5]);
        }
        own.begin((0.1, 0.1), (&weights, &mut [0.0; 5]), &mut guess);
        for (guess, exact) in guess.iter().zip(all(8)) {
            assert!((guess - exact).abs() < 1e-6 * exact.abs().max(1.0), "{guess} for {exact}");
        }
    }

    /// A step of `dt` s to `t` begins with this.
    fn begin(own: &mut Extrapolation, (t, dt): (f64, f64)) -> f64 {
        let mut guess = [f64::NAN];
        own.begin((t, dt), (&[0.5], &mut [0.0]), &mut guess);
        guess[0]
    }

    #[test]
    fn other_steps_begin_anew() {
        let mut own = Extrapolation::new(1, false);
        for step in 1..3 {
            begin(&mut own, (0.1 * f64::from(step), 0.1));
            own.learn(&[1.0], &[0.5], &mut [0.0]);
        }
        assert_eq!(begin(&mut own, (0.25, 0.05)), 0.0);
    }

    /// Corrections are Δt³ of a jerk in the middle of the step. Where a motion goes on smoothly, so does it in steps of another
    /// length, also behind a step that was left.
    #[test]
    fn a_smooth_motion_goes_on_in_halves_and_doubles() {
        // As many as corrections are kept for all.
        const N: usize = 64;
        let correction = |t: f64, dt: f64| vec![dt.powi(3) * (1.0 + (t - 0.5 * dt)).sqrt(); N];
        for (ratio, left) in [(0.5, 0), (2.0, 0), (0.25, 0), (0.5, 1)] {
            let mut own = Extrapolation::new(N, true);
            let (weights, mut memory, mut guess) = ([0.5; N], [0.0; N], [0.0; N]);
            let dt = 0.1;
            for step in 1..9 {
                let t = dt * f64::from(step);
                own.begin((t, dt), (&weights, &mut memory), &mut guess);
                own.learn(&correction(t, dt), &weights, &mut memory);
            }
            let (end, dt) = (dt * f64::from(8 - left), ratio * dt);
            own.begin((end + dt, dt), (&weights, &mut memory), &mut guess);
            let exact = correction(end + dt, dt)[0];
            assert!(
                (guess[0] / exact - 1.0).abs() < 0.01,
                "{ratio}, {left}: {guess:?} for {exact}"
            );
        }
        // By far other steps say nothing.
        let mut own = Extrapolation::new(1, true);
        for step in 1..9 {
            begin(&mut own, (0.1 * f64::from(step), 0.1));
            own.learn(&[1.0], &[0.5], &mut [0.0]);
        }
        assert_eq!(begin(&mut own, (0.81, 0.01)), 0.0);
    }
}

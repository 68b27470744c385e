//! What is left to change: the changes from cycle to cycle, carried on as they fell so far.
//!
//! If every change is r times the one before, a/(1 − r) is left after a change a. Single ratios say little where transients
//! beat, and the change of what dies fast hides that of what dies slowly. So r is fitted to the changes of many cycles, twice: to
//! the latest ones and to more of them, of which the slower counts; and the estimate has to be small for as many cycles
//! as the shorter fit takes in, so that it no longer knows of what has died.

use serde::{Deserialize, Serialize};

use super::reached::SteadyState;
use super::samples::Samples;
use crate::dynamics::motion::larger;
use crate::linalg::widely;

/// What may be left in a steady state.
const LEFT: f64 = 0.01;
/// Changes to which r is fitted at least and at most: half and an eighth of those there are.
const FITTED: [[usize; 2]; 2] = [[8, 256], [8, 64]];
/// Share of the changes to which r is fitted, as one of so many.
const SHARE: [usize; 2] = [2, 8];
/// The cycle that is compared with, the changes of the first fit, and the cycles for which it must hold, a sample longer each.
pub(super) const LEAST_CYCLES: usize = 1 + FITTED[1][0] + FITTED[1][0];

/// What varies by less than this fraction of the largest peak of its kind is held against that fraction.
const FLOOR: f64 = 0.01;
/// Changes below this fraction of the largest peak of a kind are left by the tolerances of a step.
const UNSOLVED: f64 = 1e-5;
/// How much less the last term of an interpolation is than the one before where a signal is smooth between samples, and how
/// many times that term is missed at a kink between them: 6 in the mean of where it is.
const SMOOTH: f64 = 0.1;
const KINK: f64 = 15.0;

/// Sums changes from cycle to cycle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Remaining {
    /// Smallest and largest of every signal in the cycle that runs.
    ends: [Vec<f64>; 2],
    /// Over the samples of that cycle the squares of the change of every signal since a cycle before, and of what the last two
    /// terms of the interpolation between samples add there.
    squares: [Vec<f64>; 3],
    /// Samples that were compared, and those in the cycle.
    compared: usize,
    taken: usize,
    /// How much every signal changed over the cycle before.
    before: Vec<f64>,
    /// The changes of the last cycles, of the signal that changed most, as fractions of how far it varies now, and how many there
    /// were.
    changes: Vec<f64>,
    cycles: usize,
    /// Cycles in a row after which little was left, and when the first of them ended (s).
    held: usize,
    since: f64,
    pub(super) left: Option<f64>,
}

impl Remaining {
    pub(super) fn new(signals: usize) -> Self {
        let values = || vec![0.0; signals];
        Remaining {
            ends: [vec![f64::INFINITY; signals], vec![f64::NEG_INFINITY; signals]],
            squares: [values(), values(), values()],
            compared: 0,
            taken: 0,
            before: values(),
            changes: Vec::with_capacity(FITTED[0][1]),
            cycles: 0,
            held: 0,
            since: 0.0,
            left: None,
        }
    }

    /// Judges the end of a step at time `t`, which may be a sample.
    pub(super) fn add<'a>(
        &mut self,
        t: f64,
        samples: &Samples,
        is_sample: bool,
        signals: impl Iterator<Item = &'a f64>,
        reached: &mut Option<SteadyState>,
    ) {
        let [least, most] = &mut self.ends;
        for ((least, most), signal) in least.iter_mut().zip(most).zip(signals) {
            (*least, *most) = (least.min(*signal), most.max(*signal));
        }
        if !is_sample {
            return;
        }
        self.compared += usize::from(self.compare(samples));
        self.taken += 1;
        if self.taken < samples.back() {
            return;
        }
        // The first samples that are compared lack those before them.
        if 2 * self.compared > self.taken {
            let change = self.change(samples);
            self.learn(change, t, reached);
        }
        (self.taken, self.compared) = (0, 0);
        self.squares.iter_mut().for_each(|own| own.fill(0.0));
        self.ends[0].fill(f64::INFINITY);
        self.ends[1].fill(f64::NEG_INFINITY);
    }

    /// Compares the last sample with what was a cycle before, if there was.
    fn compare(&mut self, samples: &Samples) -> bool {
        let back = samples.back();
        if samples.count <= back + 2 || back < 3 {
            return false;
        }
        let fraction = back as f64 - samples.steps;
        let (now, rows) = (samples.row(0), [2, 1, 0, -1, -2, -3_isize]);
        let rows = rows.map(|more| &samples.row(back.wrapping_add_signed(more))[..now.len()]);
        let [two, four, six] = [1, 2, 3].map(|half| weights(half, fraction));
        let [changes, last, before] = &mut self.squares;
        let n = now.len();
        let (changes, last, before) = (&mut changes[..n], &mut last[..n], &mut before[..n]);
        widely(|| {
            for i in 0..n {
                let by = |weights: &[f64; 6]| {
                    let mut sum = weights[0] * rows[0][i];
                    for k in 1..6 {
                        sum += weights[k] * rows[k][i];
                    }
                    sum
                };
                let [two, four, six] = [by(&two), by(&four), by(&six)];
                changes[i] += (now[i] - six).powi(2);
                last[i] += (six - four).powi(2);
                before[i] += (four - two).powi(2);
            }
        });
        true
    }

    /// The change over the cycle that ends, of the signal that changed most, as a fraction of how far it varies, and that over the
    /// cycle before, held against the same: √2 times the root mean square, the amplitude of what oscillates. What
    /// interpolation or the tolerances explain is none.
    fn change(&mut self, samples: &Samples) -> [f64; 2] {
        let Remaining { ends: [least, most], squares, before, .. } = self;
        let mut worst = [0.0; 2];
        for kind in samples.kinds() {
            let peak = |i: usize| f64::max(least[i].abs(), most[i].abs());
            let largest = kind.clone().map(peak).fold(0.0, f64::max);
            for i in kind {
                let amplitude = |square: f64| (2.0 * square / self.compared as f64).sqrt();
                let [change, last, lower] = [0, 1, 2].map(|which| amplitude(squares[which][i]));
                let rough = if lower > 0.0 { (last / (SMOOTH * lower)).min(1.0) } else { 0.0 };
                let explained = f64::max(KINK * rough * rough * last, UNSOLVED * largest);
                let change = if change <= explained { 0.0 } else { change };
                let scale = f64::max(0.5 * (most[i] - least[i]), FLOOR * largest);
                for (worst, own) in worst.iter_mut().zip([change, before[i]]) {
                    if own != 0.0 {
                        *worst = larger(*worst, own / scale);
                    }
                }
                before[i] = change;
            }
        }
        worst
    }

    /// Takes the change over a cycle that ended at time `t`.
    fn learn(&mut self, [change, before]: [f64; 2], t: f64, reached: &mut Option<SteadyState>) {
        // What varies more or less than it did has the same changes as other fractions.
        let rescaled = self.changes.last().map_or(1.0, |last| before / last);
        if rescaled.is_finite() && rescaled > 0.0 {
            self.changes.iter_mut().for_each(|own| *own *= rescaled);
        }
        if self.changes.len() == FITTED[0][1] {
            self.changes.rotate_left(1);
            self.changes.pop();
        }
        self.changes.push(change);
        self.cycles += 1;
        if self.cycles < FITTED[1][0] {
            return;
        }
        let fits = [0, 1].map(|which| {
            let [least, most] = FITTED[which];
            (self.cycles / SHARE[which]).clamp(least, most)
        });
        let latest = |cycles: usize| &self.changes[self.changes.len() - cycles..];
        let [many, few] = fits.map(latest);
        let left = match (fitted(many), fitted(few)) {
            (many, Some(few)) => larger(few, many.unwrap_or(0.0)),
            (_, None) => few.iter().copied().fold(0.0, larger),
        };
        self.left = Some(left);
        if !(left < LEFT) {
            (self.held, *reached) = (0, None);
            return;
        }
        if self.held == 0 {
            self.since = t;
        }
        self.held += 1;
        if reached.is_none() && self.held >= fits[1] {
            *reached = Some(SteadyState { time: self.since });
        }
    }
}

/// Weights of six samples one apart with which the polynomial through the 2, 4 or 6 = 2 `half` in the middle has the value at
/// `fraction` between the third and the fourth.
fn weights(half: i32, fraction: f64) -> [f64; 6] {
    let places = 1 - half..=half;
    std::array::from_fn(|k| {
        let own = k as i32 - 2;
        if !places.contains(&own) {
            return 0.0;
        }
        let others = places.clone().filter(|other| *other != own);
        others.map(|other| (fraction - f64::from(other)) / f64::from(own - other)).product()
    })
}

/// What is left after changes that go on to fall as they did: a/(1 − r) with both from the line that fits their logarithms best;
/// infinite where they do not fall. None where most of them are none.
fn fitted(changes: &[f64]) -> Option<f64> {
    let some = || changes.iter().enumerate().filter(|(_, change)| **change != 0.0);
    let count = some().count();
    if 2 * count < changes.len() {
        return None;
    }
    let mean = |of: &dyn Fn(f64, f64) -> f64| {
        some().map(|(place, own)| of(place as f64, own.ln())).sum::<f64>() / count as f64
    };
    let (place, height) = (mean(&|place, _| place), mean(&|_, height| height));
    let slope =
        mean(&|at, own| (at - place) * (own - height)) / mean(&|at, _| (at - place).powi(2));
    let last = height + slope * ((changes.len() - 1) as f64 - place);
    Some(if slope < 0.0 { last.exp() / -slope.exp_m1() } else { f64::INFINITY })
}

//! The paper's steady state: every spring force changes by less than 1 % over a cycle (section 5.1), and so does every
//! displacement of a journal; and the cycles that follow are no larger or smaller than that.

use serde::{Deserialize, Serialize};

use super::reached::SteadyState;
use super::samples::Samples;

/// Largest change of a signal over a cycle, as a fraction of its peak in a cycle: a force that passes through zero is
/// not held against the little that it is there. Largest change of a peak after that, too.
const CHANGE: f64 = 0.01;
/// Signals whose peak is below this fraction of the largest one of their kind are compared with that fraction instead.
const FLOOR: f64 = 0.01;

/// Once the steady state is reached, one sample in so many is compared.
const COMPARED: usize = 16;

/// Compares signals with those of one cycle before, between samples where it is no whole number of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct OneCycle {
    /// Largest |signal| in the last whole cycle, and in the one that runs.
    peaks: [Vec<f64>; 2],
    /// The peaks when the steady state was reached.
    agreed: Vec<f64>,
    /// Samples in a row for which the test held.
    held: usize,
}

impl OneCycle {
    pub(super) fn new(signals: usize) -> Self {
        let values = || vec![0.0; signals];
        OneCycle { peaks: [values(), values()], agreed: values(), held: 0 }
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
        if !is_sample {
            raise(&mut self.peaks[1], signals);
            return;
        }
        let (back, count) = (samples.back(), samples.count);
        self.raise_peaks(signals, count.is_multiple_of(back));
        if count <= back || reached.is_some() && !count.is_multiple_of(COMPARED) {
            return;
        }
        if !self.changes_little(samples) || reached.is_some() && !self.agrees(samples) {
            (self.held, *reached) = (0, None);
            return;
        }
        self.held += 1;
        if self.held == back && reached.is_none() {
            *reached = Some(SteadyState { time: t });
            let peaks = self.peaks[0].iter().zip(&self.peaks[1]).map(|(a, b)| a.max(*b));
            self.agreed = peaks.collect();
        }
    }

    /// Whether the last sample differs little from the one a cycle before.
    fn changes_little(&self, samples: &Samples) -> bool {
        let back = samples.back();
        let fraction = back as f64 - samples.steps;
        let (now, older, newer) = (samples.row(0), samples.row(back), samples.row(back - 1));
        let [last, running] = &self.peaks;
        samples.kinds().all(|kind| {
            let peak = |i: usize| f64::max(last[i], running[i]);
            let largest = kind.clone().map(peak).fold(0.0, f64::max);
            kind.into_iter().all(|i| {
                let before = older[i] + fraction * (newer[i] - older[i]);
                (now[i] - before).abs() <= CHANGE * peak(i).max(FLOOR * largest)
            })
        })
    }

    /// Whether the peaks of the last whole cycle are those of the steady state; of the cycles that it was reached in
    /// the peaks are still taken together.
    fn agrees(&self, samples: &Samples) -> bool {
        let (last, running, agreed) = (&self.peaks[0], &self.peaks[1], &self.agreed);
        samples.kinds().all(|kind| {
            let largest = kind.clone().map(|i| agreed[i]).fold(0.0, f64::max);
            kind.into_iter().all(|i| {
                let peak = f64::max(last[i], running[i]);
                (peak - agreed[i]).abs() <= CHANGE * agreed[i].max(FLOOR * largest)
            })
        })
    }

    /// Takes a sample into the peaks, which may be the first of a cycle.
    fn raise_peaks<'a>(&mut self, signals: impl Iterator<Item = &'a f64>, is_first: bool) {
        let [last, running] = &mut self.peaks;
        if is_first {
            std::mem::swap(last, running);
            running.fill(0.0);
        }
        raise(running, signals);
    }
}

fn raise<'a>(peaks: &mut [f64], signals: impl Iterator<Item = &'a f64>) {
    let mut peaks = peaks.iter_mut();
    // From within: signals are chains of slices.
    signals.for_each(|signal| {
        if let Some(peak) = peaks.next() {
            *peak = peak.max(signal.abs());
        }
    });
}

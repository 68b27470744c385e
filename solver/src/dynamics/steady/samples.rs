//! Signals of the last cycle, sample by sample.

use std::ops::Range;

use serde::{Deserialize, Serialize};

/// Most rows of signals kept of a cycle; of a longer one every k-th step is compared.
pub(super) const MOST_SAMPLES: usize = 4096;
/// As many rows at least, however many signals there are: a sine is interpolated between them to (π/64)²/2.
pub(super) const LEAST_SAMPLES: usize = 64;
/// Numbers kept of a cycle where signals are many, 8 MB.
pub(super) const MOST_NUMBERS: usize = 1 << 20;
/// Rows beyond a cycle that interpolation reaches back.
const BEYOND: usize = 3;

/// Spring forces and displacements of the last cycle. A sample is a step, or one of every few where a cycle has very many:
/// memory is bounded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Samples {
    /// Number of forces and of displacements, which follow them.
    signals: [usize; 2],
    /// Steps from one sample to the next, and those since the last.
    every: usize,
    since: usize,
    /// Samples of a cycle, not whole.
    pub(super) steps: f64,
    /// Signals of the last samples, a ring of rows.
    rows: Vec<f64>,
    pub(super) capacity: usize,
    pub(super) count: usize,
}

impl Samples {
    /// Of so many forces and displacements for a cycle of `cycle` s in steps of `dt` s.
    pub(super) fn new(signals: [usize; 2], cycle: f64, dt: f64) -> Self {
        let all = signals[0] + signals[1];
        let most = (MOST_NUMBERS / all.max(1)).clamp(LEAST_SAMPLES, MOST_SAMPLES);
        let every = (cycle / dt / most as f64).ceil().max(1.0);
        let steps = cycle / dt / every;
        let capacity = steps.ceil() as usize + BEYOND;
        let rows = vec![0.0; capacity * all];
        Samples { signals, every: every as usize, since: 0, steps, rows, capacity, count: 0 }
    }

    /// Takes the signals at the end of a step; whether they are a sample.
    pub(super) fn add<'a>(&mut self, signals: impl Iterator<Item = &'a f64>) -> bool {
        self.since += 1;
        if self.since < self.every {
            return false;
        }
        self.since = 0;
        let all = self.signals[0] + self.signals[1];
        let place = self.count % self.capacity * all;
        let row = &mut self.rows[place..place + all];
        row.iter_mut().zip(signals).for_each(|(kept, own)| *kept = *own);
        self.count += 1;
        true
    }

    /// The samples of a cycle, rounded up.
    pub(super) fn back(&self) -> usize {
        self.steps.ceil() as usize
    }

    /// The signals so many samples before the last.
    pub(super) fn row(&self, samples: usize) -> &[f64] {
        let all = self.signals[0] + self.signals[1];
        let place = (self.count - 1 - samples) % self.capacity * all;
        &self.rows[place..place + all]
    }

    /// Places of forces, and of displacements.
    pub(super) fn kinds(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let [forces, displacements] = self.signals;
        [0..forces, forces..forces + displacements].into_iter()
    }

    /// Numbers for which there is memory.
    #[cfg(test)]
    pub(super) fn memory(&self) -> usize {
        self.rows.capacity()
    }
}

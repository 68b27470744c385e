//! The steady state: every spring force changes by less than 1 % over a cycle (paper, section 5.1), and so does every
//! displacement of a journal; and the cycles that follow are no larger or smaller than that.

use serde::{Deserialize, Serialize};

/// Largest change of a signal over a cycle, as a fraction of its peak in a cycle: a force that passes through zero is
/// not held against the little that it is there. Largest change of a peak after that, too.
const CHANGE: f64 = 0.01;
/// Signals whose peak is below this fraction of the largest one of their kind are compared with that fraction instead.
const FLOOR: f64 = 0.01;

/// Once the steady state is reached, one sample in so many is compared.
const COMPARED: usize = 16;

/// Most rows of signals kept of a cycle; of a longer one every k-th step is compared.
const MOST_SAMPLES: usize = 4096;
/// As many rows at least, however many signals there are: a sine is interpolated between them to (π/64)²/2.
const LEAST_SAMPLES: usize = 64;
/// Numbers kept of a cycle where signals are many, 8 MB.
const MOST_NUMBERS: usize = 1 << 20;

/// When the steady state was reached, if it was.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SteadyState {
    /// End of the first whole cycle over which the test held at every step (s).
    pub time: f64,
}

/// Compares spring forces and displacements with those of one cycle before, between samples where it is no whole number of
/// them. A sample is a step, or one of every few where a cycle has very many: memory is bounded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SteadyTest {
    /// Number of forces and of displacements, which follow them.
    signals: [usize; 2],
    /// Steps from one sample to the next, and those since the last.
    every: usize,
    since: usize,
    /// Samples of a cycle, not whole.
    steps: f64,
    /// Signals of the last samples, a ring of rows.
    rows: Vec<f64>,
    capacity: usize,
    count: usize,
    /// Largest |signal| in the last whole cycle, and in the one that runs.
    peaks: [Vec<f64>; 2],
    /// The peaks when the steady state was reached.
    agreed: Vec<f64>,
    /// Samples in a row for which the test held.
    held: usize,
    pub(crate) reached: Option<SteadyState>,
}

impl SteadyTest {
    /// A test of so many forces and displacements for a cycle of `cycle` s in steps of `dt` s.
    pub(crate) fn new(signals: [usize; 2], cycle: f64, dt: f64) -> Self {
        let all = signals[0] + signals[1];
        let most = (MOST_NUMBERS / all.max(1)).clamp(LEAST_SAMPLES, MOST_SAMPLES);
        let every = (cycle / dt / most as f64).ceil().max(1.0);
        let steps = cycle / dt / every;
        let capacity = steps.ceil() as usize + 2;
        SteadyTest {
            signals,
            every: every as usize,
            since: 0,
            steps,
            rows: vec![0.0; capacity * all],
            capacity,
            count: 0,
            peaks: [vec![0.0; all], vec![0.0; all]],
            agreed: vec![0.0; all],
            held: 0,
            reached: None,
        }
    }

    /// Adds forces and displacements at the end of a step, at time `t`.
    // A phase of its own in tables of where the time goes.
    #[inline(never)]
    pub(crate) fn add<'a>(&mut self, t: f64, signals: impl Iterator<Item = &'a f64> + Clone) {
        self.since += 1;
        if self.since < self.every {
            raise(&mut self.peaks[1], signals);
            return;
        }
        self.since = 0;
        let all = self.signals[0] + self.signals[1];
        let place = self.count % self.capacity * all;
        let row = &mut self.rows[place..place + all];
        row.iter_mut().zip(signals.clone()).for_each(|(kept, own)| *kept = *own);
        self.count += 1;
        let back = self.steps.ceil() as usize;
        self.raise_peaks(signals, back);
        if self.count <= back {
            return;
        }
        if self.reached.is_some() && !self.count.is_multiple_of(COMPARED) {
            return;
        }
        if !self.changes_little(back) || self.reached.is_some() && !self.agrees() {
            (self.held, self.reached) = (0, None);
            return;
        }
        self.held += 1;
        if self.held == back && self.reached.is_none() {
            self.reached = Some(SteadyState { time: t });
            let peaks = self.peaks[0].iter().zip(&self.peaks[1]).map(|(a, b)| a.max(*b));
            self.agreed = peaks.collect();
        }
    }

    /// Whether the last sample differs little from the one a cycle before.
    fn changes_little(&self, back: usize) -> bool {
        let all = self.signals[0] + self.signals[1];
        let row = |steps: usize| {
            let place = (self.count - 1 - steps) % self.capacity * all;
            &self.rows[place..place + all]
        };
        let fraction = back as f64 - self.steps;
        let (now, older, newer) = (row(0), row(back), row(back - 1));
        let [last, running] = &self.peaks;
        self.kinds().all(|kind| {
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
    fn agrees(&self) -> bool {
        let (last, running, agreed) = (&self.peaks[0], &self.peaks[1], &self.agreed);
        self.kinds().all(|kind| {
            let largest = kind.clone().map(|i| agreed[i]).fold(0.0, f64::max);
            kind.into_iter().all(|i| {
                let peak = f64::max(last[i], running[i]);
                (peak - agreed[i]).abs() <= CHANGE * agreed[i].max(FLOOR * largest)
            })
        })
    }

    /// Places of forces, and of displacements.
    fn kinds(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        let [forces, displacements] = self.signals;
        [0..forces, forces..forces + displacements].into_iter()
    }

    /// Takes a sample into the peaks; a new cycle starts every `back` samples.
    fn raise_peaks<'a>(&mut self, signals: impl Iterator<Item = &'a f64>, back: usize) {
        let [last, running] = &mut self.peaks;
        if self.count.is_multiple_of(back) {
            std::mem::swap(last, running);
            running.fill(0.0);
        }
        raise(running, signals);
    }
}

fn raise<'a>(peaks: &mut [f64], signals: impl Iterator<Item = &'a f64>) {
    for (peak, signal) in peaks.iter_mut().zip(signals) {
        *peak = peak.max(signal.abs());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reached(force: impl Fn(f64) -> f64) -> Option<f64> {
        reached_in_steps(0.013, force)
    }

    fn reached_in_steps(dt: f64, force: impl Fn(f64) -> f64) -> Option<f64> {
        let mut test = SteadyTest::new([2, 0], 1.0, dt);
        let memory = test.rows.capacity();
        for step in 1..(26.0 / dt) as usize {
            let t = step as f64 * dt;
            test.add(t, [force(t), 100.0].iter());
        }
        assert!(memory <= 2 * (MOST_SAMPLES + 2) && test.rows.capacity() == memory, "{memory}");
        test.reached.map(|steady| steady.time)
    }

    #[test]
    fn cycles_of_many_steps_are_tested_alike_in_bounded_memory() {
        let wave = |t: f64| 50.0 + 10.0 * (std::f64::consts::TAU * t).sin() + 20.0 * (-t).exp();
        let (step, steps) = (1e-3, 1e-5);
        let coarse = reached_in_steps(step, wave).expect("steady at last");
        let fine = reached_in_steps(steps, wave).expect("steady at last");
        // The change of 20 (e − 1) e^−t, at its limit, is off by the interpolation between 4096 samples, the
        // time by a step of either.
        assert!((fine - coarse).abs() < 2.0 * step, "{fine} {coarse}");
    }

    #[test]
    fn no_cycle_is_too_long_for_the_memory() {
        for (springs, cycle) in [(1, 1e9), (10_000, 1e9), (50_000, 1.0), (3, f64::MAX)] {
            let test = SteadyTest::new([springs, 0], cycle, 1e-9);
            assert!(test.capacity <= MOST_SAMPLES + 2, "{springs} {cycle}");
            let most = MOST_NUMBERS.max(LEAST_SAMPLES * springs);
            assert!(test.capacity * springs <= most + 2 * springs, "{springs} {cycle}");
        }
    }

    #[test]
    fn a_decaying_transient_ends_when_a_cycle_changes_it_by_one_per_cent() {
        let wave = |t: f64| 50.0 + 10.0 * (std::f64::consts::TAU * t).sin();
        let time = reached(|t| wave(t) + 20.0 * (-t).exp()).expect("steady at last");
        // The change over a cycle, 20 (e − 1) e^−t, falls below 1 % of the peak of 60 N at t = 4.05 s; then a
        // whole cycle must pass.
        assert!((4.9..5.2).contains(&time), "{time}");
    }

    #[test]
    fn a_force_that_passes_through_zero_can_be_steady() {
        // Interpolation between steps leaves (2π 0.013)²/8 = 0.08 % of the peak.
        assert!(reached(|t| 50.0 * (std::f64::consts::TAU * t).sin()).is_some());
    }

    #[test]
    fn forces_are_compared_between_steps() {
        // 40.5 steps a cycle: interpolated to (2π/40.5)²/8 = 0.3 %, where half a step off is 8 %.
        let wave = |t: f64| 50.0 * (std::f64::consts::TAU * t).sin();
        assert!(reached_in_steps(1.0 / 40.5, wave).is_some());
    }

    #[test]
    fn forces_near_zero_are_held_against_the_floor() {
        assert!(reached(|t| 5e-3 * (40.0 * t).sin()).is_some());
        assert!(reached(|t| 5.0 * (40.0 * t).sin()).is_none());
    }

    /// When steady, and at the end; of a force of a constant 100 N and a displacement.
    fn with_displacement(end: f64, displacement: impl Fn(f64) -> f64) -> Option<f64> {
        let mut test = SteadyTest::new([1, 1], 1.0, 0.013);
        for step in 1..(end / 0.013) as usize {
            let t = step as f64 * 0.013;
            test.add(t, [100.0, displacement(t)].iter());
        }
        test.reached.map(|steady| steady.time)
    }

    #[test]
    fn displacements_are_steady_too_or_nothing_is() {
        let wave = |t: f64| 1e-3 * (std::f64::consts::TAU * t).sin();
        assert!(with_displacement(26.0, wave).is_some());
        // A resonance without damping, and a journal that creeps.
        assert_eq!(with_displacement(26.0, |t| t * wave(t)), None);
        assert_eq!(with_displacement(26.0, |t| 1e-3 * t), None);
    }

    #[test]
    fn what_changes_again_was_not_steady() {
        let wave = |t: f64| 1e-3 * (std::f64::consts::TAU * t).sin();
        let early = with_displacement(10.0, wave).expect("steady");
        let late = with_displacement(26.0, |t| if t < 10.5 { wave(t) } else { 2.0 * wave(t) });
        assert!(early < 3.0 && late.is_some_and(|late| late > 11.0), "{early} {late:?}");
        // So slow a beat that no cycle differs by 1 % from the one before.
        let beat = |t: f64| wave(t) * (1.0 + 0.3 * (0.02 * t).sin());
        assert!(with_displacement(26.0, beat).is_none_or(|time| time > 20.0));
    }
}

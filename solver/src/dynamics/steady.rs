//! The steady state: every spring force changes by less than 1 % over a cycle (paper, section 5.1).

use serde::{Deserialize, Serialize};

/// Largest change of a spring force over a cycle, as a share of the spring's peak in a cycle: a force that
/// passes through zero is not judged by the little that it is there.
const CHANGE: f64 = 0.01;
/// Springs whose peak is below this share of the largest one are judged by that share instead.
const FLOOR: f64 = 0.01;

/// Most rows of forces kept of a cycle; of a longer one every k-th step is compared.
const MOST_SAMPLES: usize = 4096;
/// As many rows at least, however many springs there are: a sine is interpolated between them to (π/64)²/2.
const LEAST_SAMPLES: usize = 64;
/// Forces kept of a cycle where the springs are many, 8 MB.
const MOST_FORCES: usize = 1 << 20;

/// When the steady state was reached, if it was.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SteadyState {
    /// End of the first whole cycle over which the test held at every step (s).
    pub time: f64,
}

/// Compares spring forces with those of one cycle before, between samples where it is no whole number of
/// them. A sample is a step, or one of every few where a cycle has very many: memory is bounded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SteadyTest {
    springs: usize,
    /// Steps from one sample to the next, and those since the last.
    every: usize,
    since: usize,
    /// Samples of a cycle, not whole.
    steps: f64,
    /// Forces of the last samples, a ring of rows.
    rows: Vec<f64>,
    capacity: usize,
    count: usize,
    /// Largest |Q| of every spring in the last whole cycle, and in the one that runs.
    peaks: [Vec<f64>; 2],
    /// Samples in a row for which the test held.
    held: usize,
    pub(crate) reached: Option<SteadyState>,
}

impl SteadyTest {
    /// A test for a cycle of `cycle` s in steps of `dt` s.
    pub(crate) fn new(springs: usize, cycle: f64, dt: f64) -> Self {
        let most = (MOST_FORCES / springs.max(1)).clamp(LEAST_SAMPLES, MOST_SAMPLES);
        let every = (cycle / dt / most as f64).ceil().max(1.0);
        let steps = cycle / dt / every;
        let capacity = steps.ceil() as usize + 2;
        SteadyTest {
            springs,
            every: every as usize,
            since: 0,
            steps,
            rows: vec![0.0; capacity * springs],
            capacity,
            count: 0,
            peaks: [vec![0.0; springs], vec![0.0; springs]],
            held: 0,
            reached: None,
        }
    }

    /// Adds the forces at the end of a step, at time `t`.
    pub(crate) fn add(&mut self, t: f64, forces: &[f64]) {
        self.since += 1;
        if self.since < self.every {
            raise(&mut self.peaks[1], forces);
            return;
        }
        self.since = 0;
        let place = self.count % self.capacity;
        self.rows[place * self.springs..(place + 1) * self.springs].copy_from_slice(forces);
        self.count += 1;
        if self.reached.is_some() {
            return;
        }
        let back = self.steps.ceil() as usize;
        self.raise_peaks(forces, back);
        if self.count <= back {
            return;
        }
        let share = back as f64 - self.steps;
        let row = |steps: usize| {
            let place = (self.count - 1 - steps) % self.capacity;
            &self.rows[place * self.springs..(place + 1) * self.springs]
        };
        let [last, running] = &self.peaks;
        let peaks = last.iter().zip(running).map(|(a, b)| a.max(*b));
        let largest = peaks.clone().fold(0.0, f64::max);
        let (older, newer) = (row(back), row(back - 1));
        let changes = forces.iter().zip(older.iter().zip(newer)).map(|(force, (a, b))| {
            let before = a + share * (b - a);
            (force - before).abs()
        });
        let steady =
            changes.zip(peaks).all(|(change, peak)| change <= CHANGE * peak.max(FLOOR * largest));
        self.held = if steady { self.held + 1 } else { 0 };
        if self.held >= back {
            self.reached = Some(SteadyState { time: t });
        }
    }

    /// Takes the forces of a sample into the peaks; a new cycle starts every `back` samples.
    fn raise_peaks(&mut self, forces: &[f64], back: usize) {
        let [last, running] = &mut self.peaks;
        if self.count.is_multiple_of(back) {
            std::mem::swap(last, running);
            running.fill(0.0);
        }
        raise(running, forces);
    }
}

fn raise(peaks: &mut [f64], forces: &[f64]) {
    for (peak, force) in peaks.iter_mut().zip(forces) {
        *peak = peak.max(force.abs());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reached(force: impl Fn(f64) -> f64) -> Option<f64> {
        reached_in_steps(0.013, force)
    }

    fn reached_in_steps(dt: f64, force: impl Fn(f64) -> f64) -> Option<f64> {
        let mut test = SteadyTest::new(2, 1.0, dt);
        let room = test.rows.capacity();
        for step in 1..(26.0 / dt) as usize {
            let t = step as f64 * dt;
            test.add(t, &[force(t), 100.0]);
        }
        assert!(room <= 2 * (MOST_SAMPLES + 2) && test.rows.capacity() == room, "{room}");
        test.reached.map(|steady| steady.time)
    }

    #[test]
    fn cycles_of_many_steps_are_judged_alike_in_bounded_memory() {
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
            let test = SteadyTest::new(springs, cycle, 1e-9);
            assert!(test.capacity <= MOST_SAMPLES + 2, "{springs} {cycle}");
            let most = MOST_FORCES.max(LEAST_SAMPLES * springs);
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
    fn forces_near_zero_are_judged_by_the_floor() {
        assert!(reached(|t| 5e-3 * (40.0 * t).sin()).is_some());
        assert!(reached(|t| 5.0 * (40.0 * t).sin()).is_none());
    }
}

//! The steady state: every spring force changes by less than 1 % over a cycle (paper, section 5.1).

/// Largest change of a spring force over a cycle, as a share of the spring's peak in a cycle: a force that
/// passes through zero is not judged by the little that it is there.
const CHANGE: f64 = 0.01;
/// Springs whose peak is below this share of the largest one are judged by that share instead.
const FLOOR: f64 = 0.01;

/// When the steady state was reached, if it was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyState {
    /// End of the first whole cycle over which the test held at every step (s).
    pub time: f64,
}

/// Compares spring forces with those of one cycle before, between steps where it is no whole number of
/// them.
pub(crate) struct SteadyTest {
    springs: usize,
    /// Steps of a cycle, not whole.
    steps: f64,
    /// Forces of the last steps, a ring of rows.
    rows: Vec<f64>,
    capacity: usize,
    count: usize,
    /// Largest |Q| of every spring in the last whole cycle, and in the one that runs.
    peaks: [Vec<f64>; 2],
    /// Steps in a row for which the test held.
    held: usize,
    pub(crate) reached: Option<SteadyState>,
}

impl SteadyTest {
    /// A test for a cycle of `cycle` s in steps of `dt` s.
    pub(crate) fn new(springs: usize, cycle: f64, dt: f64) -> Self {
        let steps = cycle / dt;
        let capacity = steps.ceil() as usize + 2;
        SteadyTest {
            springs,
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

    /// Takes the forces of a step into the peaks; a new cycle starts every `back` steps.
    fn raise_peaks(&mut self, forces: &[f64], back: usize) {
        let [last, running] = &mut self.peaks;
        if self.count.is_multiple_of(back) {
            std::mem::swap(last, running);
            running.fill(0.0);
        }
        for (peak, force) in running.iter_mut().zip(forces) {
            *peak = peak.max(force.abs());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reached(force: impl Fn(f64) -> f64) -> Option<f64> {
        let (cycle, dt) = (1.0, 0.013);
        let mut test = SteadyTest::new(2, cycle, dt);
        for step in 1..2000 {
            let t = f64::from(step) * dt;
            test.add(t, &[force(t), 100.0]);
        }
        test.reached.map(|steady| steady.time)
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
    fn forces_near_zero_are_judged_by_the_floor() {
        assert!(reached(|t| 5e-3 * (40.0 * t).sin()).is_some());
        assert!(reached(|t| 5.0 * (40.0 * t).sin()).is_none());
    }
}

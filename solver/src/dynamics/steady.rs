//! The steady state: every spring force changes by less than 1 % over a cycle (paper, section 5.1).

/// Largest relative change of a spring force over a cycle.
const CHANGE: f64 = 0.01;
/// Forces below this share of the largest one are judged by it instead of by themselves.
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
        if self.count <= back {
            return;
        }
        let share = back as f64 - self.steps;
        let row = |steps: usize| {
            let place = (self.count - 1 - steps) % self.capacity;
            &self.rows[place * self.springs..(place + 1) * self.springs]
        };
        let largest = forces.iter().fold(0.0_f64, |m, force| m.max(force.abs()));
        let (older, newer) = (row(back), row(back - 1));
        let steady = forces.iter().zip(older.iter().zip(newer)).all(|(force, (a, b))| {
            let before = a + share * (b - a);
            (force - before).abs() <= CHANGE * force.abs().max(FLOOR * largest)
        });
        self.held = if steady { self.held + 1 } else { 0 };
        if self.held >= back {
            self.reached = Some(SteadyState { time: t });
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
        // The change over a cycle, 20 (e − 1) e^−t, falls below 1 % of at least 40 N at t = 4.45 s, of 50 N
        // and more before; then a whole cycle must pass.
        assert!((4.9..5.6).contains(&time), "{time}");
    }

    #[test]
    fn forces_near_zero_are_judged_by_the_floor() {
        assert!(reached(|t| 5e-3 * (40.0 * t).sin()).is_some());
        assert!(reached(|t| 5.0 * (40.0 * t).sin()).is_none());
    }
}

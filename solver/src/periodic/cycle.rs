//! What a cycle of a machine is: a stretch of time after which all that it is told is as it was.

use std::f64::consts::TAU;

use crate::bodies::Rotation;
use crate::equations::{State, instant};
use crate::error::{Error, PeriodicError};
use crate::machine::Machine;

/// Part of a turn, or of a load, that may be missing at the end of a cycle: rounding of periods that are written with all digits.
const MISSED: f64 = 1e-9;
/// Times within a cycle at which loads are compared with those a cycle later.
const COMPARED: usize = 61;

/// A cycle, in equal steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// When it begins (s).
    pub start: f64,
    /// T (s).
    pub period: f64,
    /// N.
    pub steps: usize,
}

impl Cycle {
    /// Δt = T/N (s).
    pub fn time_step(&self) -> f64 {
        self.period / self.steps as f64
    }

    /// So many of it as one, in steps as long.
    pub(super) fn times(self, count: usize) -> Cycle {
        let times = count as f64;
        Cycle { period: times * self.period, steps: count * self.steps, ..self }
    }

    /// The same in twice as many steps.
    pub(super) fn doubled(self) -> Cycle {
        Cycle { steps: 2 * self.steps, ..self }
    }

    /// By how much rotations advance in it (rad), at their places in q.
    ///
    /// # Errors
    /// A rotation or a load that is not as it was after it; one that is not known.
    pub(super) fn turns(&self, machine: &Machine) -> Result<Vec<f64>, Error> {
        let [start, end] = [self.start, self.start + self.period].map(|t| {
            let mut state = State::new(machine.size());
            machine.set_given(t, false, [&mut state.q, &mut state.v, &mut state.a]);
            state
        });
        let name = |place: usize| machine.bodies[machine.owner(place).body].name().to_owned();
        let mut turns = vec![0.0; machine.rotations()];
        for (place, turn) in turns.iter_mut().enumerate().take(machine.first_unknown()) {
            let speed = start.v[place];
            let changes = (end.v[place] - speed).abs() > MISSED * speed.abs()
                || self.changes_between(machine, place);
            if changes {
                return Err(PeriodicError::SpeedChanges { body: name(place) }.into());
            }
            *turn = self.whole(name(place), end.q[place] - start.q[place])?;
        }
        let trains = machine.trains();
        for place in machine.first_unknown()..machine.rotations() {
            let body = machine.owner(place).body;
            let told = (0..machine.first_unknown())
                .find(|other| trains.train(machine.owner(*other).body) == trains.train(body));
            let Some(told) = told else {
                return Err(PeriodicError::TurnsFreely { body: name(place) }.into());
            };
            let ratio = trains.ratio(body) / trains.ratio(machine.owner(told).body);
            turns[place] = self.whole(name(place), ratio * turns[told])?;
        }
        for body in machine.bodies.iter().filter(|own| own.rotation().is_some()) {
            if let Some(speed) = body.rotation().and_then(Rotation::spin) {
                self.whole(body.name().to_owned(), speed * self.period)?;
            }
        }
        self.compare_loads(machine, &turns)?;
        Ok(turns)
    }

    /// An angle that should be whole turns, made so.
    fn whole(&self, body: String, angle: f64) -> Result<f64, PeriodicError> {
        let turns = angle / TAU;
        let missed = (turns - turns.round()).abs();
        match missed <= MISSED * turns.abs().max(1.0) {
            true => Ok(TAU * turns.round()),
            false => Err(PeriodicError::NotWhole { body, turns, period: self.period }),
        }
    }

    /// Whether the speed of a rotation that is told changes within it.
    fn changes_between(&self, machine: &Machine, place: usize) -> bool {
        match machine.bodies[machine.owner(place).body].rotation() {
            Some(Rotation::Prescribed { acceleration, .. }) => *acceleration != 0.0,
            Some(Rotation::Scheduled(schedule)) => self.start < schedule.last(),
            _ => false,
        }
    }

    /// Compares every load at times within the cycle with what it is a cycle later, all rotations turning as they are told.
    fn compare_loads(&self, machine: &Machine, turns: &[f64]) -> Result<(), PeriodicError> {
        let mut state = State::new(machine.size());
        let all = 0..machine.loads.len();
        let mut factors = |t: f64| -> Vec<f64> {
            machine.set_given(t, false, [&mut state.q, &mut state.v, &mut state.a]);
            let unknown = machine.first_unknown()..machine.rotations();
            for (place, turn) in unknown.clone().zip(&turns[unknown]) {
                state.v[place] = turn / self.period;
                state.q[place] = state.v[place] * t;
            }
            let now = instant(machine, t, &state);
            let loads = machine.loads.iter();
            // What ends at a speed has ended or has not.
            loads
                .map(|own| if own.target().is_some() { 0.0 } else { own.factor(&now, false) })
                .collect()
        };
        let mut largest = vec![0.0_f64; all.len()];
        let mut apart = vec![0.0_f64; all.len()];
        for k in 0..COMPARED {
            let t = self.start + self.period * k as f64 / COMPARED as f64;
            let (now, later) = (factors(t), factors(t + self.period));
            for load in all.clone() {
                largest[load] = largest[load].max(now[load].abs()).max(later[load].abs());
                apart[load] = apart[load].max((now[load] - later[load]).abs());
            }
        }
        // What a load passes through in a cycle, rounding of many turns included.
        match all.into_iter().find(|&load| apart[load] > 1e3 * MISSED * largest[load]) {
            None => Ok(()),
            Some(load) => Err(PeriodicError::NotRepeated {
                load: machine.loads[load].name.clone(),
                period: self.period,
            }),
        }
    }
}

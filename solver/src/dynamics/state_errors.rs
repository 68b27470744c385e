//! Local errors of the states of laws.
//!
//! A step takes ṡ for what the rates at its ends make of it; what it misses of s goes by s̈ and by d³s/dt³, which follow from the
//! rates of this step and the one before. A state that is far faster than the step alternates, which shows the same way. Errors are
//! fractions of the range of a state so far; one that hardly moves is measured by the others of its unit.

use serde::{Deserialize, Serialize};

use super::histogram::Histogram;
use super::newmark::Integrator;
use crate::bearing::{LawStates, Springs};
use crate::equations::State;

/// A state that moves by a smaller share of the range of others of its unit is measured by that share of it.
const SMALLEST: f64 = 1e-3;

/// The worst local error of states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateError {
    /// That 95 % of the steps stay below, as a fraction of the range of the state.
    pub share: f64,
    /// The bearing where it is that, counted from 0.
    pub bearing: usize,
    /// The fastest rate at which a state came to rest by itself (1/s).
    pub fastest: f64,
}

/// What is carried from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct StateSums {
    /// Of all states s̈ of the last step, its length (s), 0 before the first, and the least and largest value so far.
    seconds: Vec<f64>,
    dt: f64,
    ranges: Vec<[f64; 2]>,
    /// By states of laws, over all springs of the law.
    errors: Vec<Histogram>,
    fastest: f64,
}

/// Measures the errors of all states.
pub(super) struct StateMeter {
    pub(super) sums: StateSums,
    /// By states of laws how many there are of each, its unit, and the bearing.
    rows: Vec<(usize, String, usize)>,
    /// What a step misses of s: this times Δt² s̈, and this times Δt³ d³s/dt³.
    missed: [f64; 2],
}

impl StateMeter {
    pub(super) fn new(springs: &Springs, method: Integrator, state: &State) -> Self {
        let rows = springs.laws.iter().flat_map(|law| {
            let bearing = springs.planes[law.planes.clone()].first().map_or(0, |own| own.bearing);
            law.bound.states.iter().map(move |own| (law.springs, own.unit.clone(), bearing))
        });
        let rows: Vec<_> = rows.collect();
        let LawStates { known, .. } = &state.laws;
        StateMeter {
            sums: StateSums {
                seconds: vec![0.0; known.len()],
                dt: 0.0,
                ranges: known.iter().map(|own| [*own; 2]).collect(),
                errors: rows.iter().map(|_| Histogram::new()).collect(),
                fastest: 0.0,
            },
            rows,
            missed: method.missed_of_states(),
        }
    }

    /// What a step of `dt` s between two states is worth: its largest error, as a fraction of the range so far; 0 without states.
    pub(super) fn judge(&self, dt: f64, [start, end]: [&State; 2]) -> f64 {
        let all = 0..self.sums.ranges.len();
        all.fold(0.0, |worst, place| {
            let error = self.error(place, dt, [start, end]);
            let [low, high] = self.sums.ranges[place];
            let value = end.laws.known[place];
            let reach = high.max(value) - low.min(value);
            larger(worst, if error == 0.0 { 0.0 } else { error / reach })
        })
    }

    /// What a step misses of a state.
    fn error(&self, place: usize, dt: f64, [start, end]: [&State; 2]) -> f64 {
        let second = (end.laws.rates[place] - start.laws.rates[place]) / dt;
        let StateSums { seconds, dt: last, .. } = &self.sums;
        let third = match *last {
            0.0 => 0.0,
            last => (second - seconds[place]) / (0.5 * (dt + last)),
        };
        let [by_second, by_third] = self.missed;
        dt * dt * (by_second * second.abs() + by_third * dt * third.abs())
    }

    /// Adds a step of `dt` s; the springs relax at most at `fastest` (1/s) at its end.
    pub(super) fn add(&mut self, dt: f64, ends: [&State; 2], fastest: f64) {
        let mut first = 0;
        for row in 0..self.rows.len() {
            let places = first..first + self.rows[row].0;
            first = places.end;
            let errors = places.map(|place| self.error(place, dt, ends));
            let worst = errors.fold(0.0, larger);
            self.sums.errors[row].add(worst);
        }
        let [start, end] = ends;
        for (place, range) in self.sums.ranges.iter_mut().enumerate() {
            let (value, laws) = (end.laws.known[place], &end.laws);
            *range = [range[0].min(value), range[1].max(value)];
            self.sums.seconds[place] = (laws.rates[place] - start.laws.rates[place]) / dt;
        }
        self.sums.dt = dt;
        self.sums.fastest = self.sums.fastest.max(fastest);
    }

    /// Rates have changed at once: what was before says nothing of what follows.
    pub(super) fn jump(&mut self) {
        self.sums.dt = 0.0;
    }

    /// The worst error; none without states.
    pub(super) fn worst(&self) -> Option<StateError> {
        let mut first = 0;
        let reaches: Vec<f64> = self
            .rows
            .iter()
            .map(|(count, ..)| {
                let own = &self.sums.ranges[first..first + count];
                first += count;
                own.iter().map(|[low, high]| high - low).fold(0.0, larger)
            })
            .collect();
        let worst = (self.rows.iter().zip(&self.sums.errors).zip(&reaches)).map(
            |((row, errors), reach)| {
                let same = self.rows.iter().zip(&reaches).filter(|(other, _)| other.1 == row.1);
                let most = same.map(|(_, reach)| *reach).fold(0.0, larger);
                let error = errors.below(0.95);
                let share =
                    if error == 0.0 { 0.0 } else { error / larger(*reach, SMALLEST * most) };
                StateError { share, bearing: row.2, fastest: self.sums.fastest }
            },
        );
        worst.reduce(
            |worst, own| if own.share <= worst.share || worst.share.is_nan() { worst } else { own },
        )
    }
}

/// The larger of two; what is no number is larger than any, and stays it.
fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

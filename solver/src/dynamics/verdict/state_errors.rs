//! Local errors of the states of laws.
//!
//! A step takes ṡ for what the rates at its ends make of it; what it misses of s goes by s̈ and by d³s/dt³, which follow from the
//! rates of this step and the one before. A state that is far faster than the step alternates, which shows the same way. Errors are
//! fractions of the range of a state so far; one that hardly moves is measured by the others of its unit, and by the range in which
//! its law expects it.
//!
//! What most steps miss says nothing of what happens in few of them, a blow or a stop. So the error is carried on, too: what a
//! step misses stays, but for what the state forgets by itself.

use serde::{Deserialize, Serialize};

use super::histogram::Histogram;
use crate::bearing::{LawStates, Springs};
use crate::dynamics::iteration::Integrator;
use crate::dynamics::motion::{larger, ratio, worse};
use crate::equations::State;

/// A state that moves by a smaller share of the range of others of its unit, or of the range that its law declares, is measured by
/// that share of it.
const SMALLEST: f64 = 1e-3;

/// Share of its value below which a state without a declared range counts as standing still.
const STILL: f64 = 1e-9;

/// The worst errors of states, as fractions of their ranges, each with the bearing where it is, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateError {
    /// The local error that 95 % of the steps stay below.
    pub local: (f64, usize),
    /// The largest that steps added up to, less what the state forgot.
    pub summed: (f64, usize),
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
    /// Of all states what steps added up to, and by states of laws the largest of it.
    summed: Vec<f64>,
    largest_sums: Vec<f64>,
    fastest: f64,
}

/// Measures the errors of all states.
pub(super) struct StateMeter {
    pub(super) sums: StateSums,
    /// States of laws.
    rows: Vec<Row>,
    /// What a step misses of s: this times Δt² s̈, and this times Δt³ d³s/dt³.
    missed: [f64; 2],
}

/// A state of a law, at all its springs.
struct Row {
    springs: usize,
    unit: String,
    bearing: usize,
    /// How wide the range is that the law declares; 0 without one.
    declared: f64,
}

impl Row {
    /// The least that errors of a state are measured by, which has been between two values.
    fn least(&self, [low, high]: [f64; 2]) -> f64 {
        let value = low.abs().max(high.abs());
        if self.declared > 0.0 { SMALLEST * self.declared } else { STILL * value }
    }
}

impl StateMeter {
    pub(super) fn new(springs: &Springs, method: Integrator, state: &State) -> Self {
        let rows = springs.laws.iter().flat_map(|law| {
            let bearing = springs.planes[law.planes.clone()].first().map_or(0, |own| own.bearing);
            law.bound.states.iter().map(move |own| Row {
                springs: law.springs,
                unit: own.unit.clone(),
                bearing,
                declared: own.range.map_or(0.0, |[low, high]| high - low),
            })
        });
        let rows: Vec<_> = rows.collect();
        let LawStates { known, .. } = &state.laws;
        StateMeter {
            sums: StateSums {
                seconds: vec![0.0; known.len()],
                dt: 0.0,
                ranges: known.iter().map(|own| [*own; 2]).collect(),
                errors: rows.iter().map(|_| Histogram::new()).collect(),
                summed: vec![0.0; known.len()],
                largest_sums: vec![0.0; rows.len()],
                fastest: 0.0,
            },
            rows,
            missed: method.missed_of_states(),
        }
    }

    /// What a step of `dt` s between two states is worth: its largest error, as a fraction of the range so far; 0 without states.
    pub(super) fn judge(&self, dt: f64, [start, end]: [&State; 2]) -> f64 {
        let rows = self.rows.iter().flat_map(|row| std::iter::repeat_n(row, row.springs));
        rows.enumerate().fold(0.0, |worst, (place, row)| {
            let [low, high] = self.sums.ranges[place];
            let value = end.laws.known[place];
            let range = [low.min(value), high.max(value)];
            let reach = (range[1] - range[0]).max(row.least(range));
            larger(worst, ratio(self.error(place, dt, [start, end]), reach))
        })
    }

    /// What a step misses of a state by its second and by its third derivative.
    fn missed(&self, place: usize, dt: f64, [start, end]: [&State; 2]) -> [f64; 2] {
        let second = (end.laws.rates[place] - start.laws.rates[place]) / dt;
        let StateSums { seconds, dt: last, .. } = &self.sums;
        let third = match *last {
            0.0 => 0.0,
            last => (second - seconds[place]) / (0.5 * (dt + last)),
        };
        let [by_second, by_third] = self.missed;
        [dt * dt * by_second * second, dt * dt * dt * by_third * third]
    }

    /// The most that it may be.
    fn error(&self, place: usize, dt: f64, ends: [&State; 2]) -> f64 {
        let [by_second, by_third] = self.missed(place, dt, ends);
        by_second.abs() + by_third.abs()
    }

    /// Adds a step of `dt` s; `relaxing`: the rates at which the states come to rest by themselves at its end (1/s).
    pub(super) fn add(
        &mut self,
        dt: f64,
        ends: [&State; 2],
        mut relaxing: impl Iterator<Item = f64>,
    ) {
        let mut first = 0;
        for row in 0..self.rows.len() {
            let places = first..first + self.rows[row].springs;
            first = places.end;
            let errors = places.clone().map(|place| self.error(place, dt, ends));
            let worst = errors.fold(0.0, larger);
            self.sums.errors[row].add(worst);
            for (place, rate) in places.zip(relaxing.by_ref()) {
                let missed: f64 = self.missed(place, dt, ends).iter().sum();
                let half = 0.5 * dt * rate;
                // What grows by itself is an error of the motion then.
                let left = ((1.0 - half) / (1.0 + half)).clamp(0.0, 1.0);
                let sums = &mut self.sums;
                sums.summed[place] = left * sums.summed[place] + missed;
                let most = &mut sums.largest_sums[row];
                *most = larger(*most, sums.summed[place].abs());
                sums.fastest = sums.fastest.max(rate);
            }
        }
        let [start, end] = ends;
        for (place, range) in self.sums.ranges.iter_mut().enumerate() {
            let (value, laws) = (end.laws.known[place], &end.laws);
            *range = [range[0].min(value), range[1].max(value)];
            self.sums.seconds[place] = (laws.rates[place] - start.laws.rates[place]) / dt;
        }
        self.sums.dt = dt;
    }

    /// Rates have changed at once: what was before says nothing of what follows.
    pub(super) fn jump(&mut self) {
        self.sums.dt = 0.0;
    }

    /// The worst error; none without states.
    pub(super) fn worst(&self) -> Option<StateError> {
        let mut first = 0;
        let reaches = self.rows.iter().map(|row| {
            let own = &self.sums.ranges[first..first + row.springs];
            first += row.springs;
            let moved = own.iter().map(|[low, high]| high - low).fold(0.0, larger);
            (moved, own.iter().map(|range| row.least(*range)).fold(0.0, larger))
        });
        let reaches: Vec<(f64, f64)> = reaches.collect();
        let sums = self.sums.errors.iter().zip(&self.sums.largest_sums);
        let shares =
            (self.rows.iter().zip(sums).zip(&reaches)).map(|((row, (errors, summed)), own)| {
                let (moved, least) = *own;
                let same =
                    self.rows.iter().zip(&reaches).filter(|(other, _)| other.unit == row.unit);
                let most = same.map(|(_, (moved, _))| *moved).fold(0.0, larger);
                let reach = larger(larger(moved, SMALLEST * most), least);
                [errors.below(0.95), *summed].map(|error| (ratio(error, reach), row.bearing))
            });
        let worst = shares.reduce(|a, b| [worse(a[0], b[0]), worse(a[1], b[1])]);
        worst.map(|[local, summed]| StateError { local, summed, fastest: self.sums.fastest })
    }
}

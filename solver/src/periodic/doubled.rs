//! The same motion with steps half as long: by what it changes, the motion and its multipliers are judged.

use num_complex::Complex64;

use super::map::{CycleMap, Orbit};
use super::metric::norm;
use super::multipliers::{MORE, largest};
use super::options::PeriodicOptions;
use super::solve::{Observe, solve};
use super::weighed::Weighed;
use crate::error::Error;
use crate::history::History;
use crate::machine::Machine;

/// What steps half as long change of a motion, as a fraction of the largest value of its kind over the cycle: of the error of
/// the motion itself it is three quarters where all is smooth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepError {
    /// Of reactions of joints.
    pub force: f64,
    /// Of displacements of journals.
    pub displacement: f64,
    /// Of the state at the start, in the energy norm.
    pub state: f64,
}

/// Multipliers of the motion in twice as many steps, and by what it differs.
///
/// # Errors
/// As of the motion itself.
pub(super) fn finer(
    map: &CycleMap,
    options: &PeriodicOptions,
    (x, orbit): (&[f64], &Orbit),
    observe: Observe,
) -> Result<(Vec<Complex64>, StepError), Error> {
    let machine = map.machine();
    let mut twice = map.doubled()?;
    let mut weighed = Weighed::new(&mut twice, x)?;
    let y = weighed.weighed(x);
    let options = PeriodicOptions { marched: Some(0), ..options.clone() };
    let found = solve(&mut weighed, y, &options, observe)?;
    let values = largest(&mut weighed, &found.y, options.multipliers + MORE)?;
    let state = weighed.state(&found.y);
    let states = [x, &state].map(|own| weighed.weighed(own));
    let other = twice.orbit(&state)?;
    let both = ([&orbit.history, &other.history], 2);
    let error = StepError::between(machine, both, [&states[0], &states[1]]);
    Ok((values, error))
}

impl StepError {
    /// Between two histories of a cycle, the second with so many rows for one of the first, and two states in the energy norm.
    pub(super) fn between(
        machine: &Machine,
        (both, rows): ([&History; 2], usize),
        [own, other]: [&[f64]; 2],
    ) -> StepError {
        let bearings = machine.monitors.len();
        let moved = norm(&own.iter().zip(other).map(|(a, b)| b - a).collect::<Vec<f64>>());
        StepError {
            force: changed(both, rows, 3..3 + 2 * bearings),
            displacement: changed(both, rows, 3 + 2 * bearings..3 + 4 * bearings),
            state: if moved == 0.0 { 0.0 } else { moved / norm(other) },
        }
    }
}

/// The largest change in columns, over the largest value of one.
fn changed([own, finer]: [&History; 2], rows: usize, columns: std::ops::Range<usize>) -> f64 {
    let (mut largest, mut change) = (0.0_f64, 0.0_f64);
    for row in 0..own.rows() {
        let (own, finer) = (own.row(row), finer.row(rows * (row + 1) - 1));
        for column in columns.clone() {
            largest = largest.max(own[column].abs());
            change = change.max((own[column] - finer[column]).abs());
        }
    }
    if change == 0.0 { 0.0 } else { change / largest }
}

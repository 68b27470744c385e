//! The same motion with steps half as long: by what it changes, the motion and its multipliers are judged.

use num_complex::Complex64;

use super::map::{CycleMap, Orbit};
use super::multipliers::largest;
use super::options::PeriodicOptions;
use super::solve::{Observe, solve};
use super::weighed::Weighed;
use crate::error::Error;
use crate::history::History;

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
    let mut twice = CycleMap::new(machine, map.cycle().doubled(), options.newton)?;
    let mut weighed = Weighed::new(&mut twice, x)?;
    let y = weighed.weighed(x);
    let options = PeriodicOptions { marched: Some(0), ..options.clone() };
    let found = solve(&mut weighed, y, &options, observe)?;
    let values = largest(&mut weighed, &found.y, options.multipliers)?;
    let state = weighed.state(&found.y);
    let apart: Vec<f64> = state.iter().zip(x).map(|(a, b)| a - b).collect();
    let size = weighed.weighed(&state).iter().map(|own| own * own).sum::<f64>().sqrt();
    let moved = weighed.weighed(&apart).iter().map(|own| own * own).sum::<f64>().sqrt();
    let other = twice.orbit(&state)?;
    let bearings = machine.monitors.len();
    let both = [&orbit.history, &other.history];
    let error = StepError {
        force: changed(both, 3..3 + 2 * bearings),
        displacement: changed(both, 3 + 2 * bearings..3 + 4 * bearings),
        state: if moved == 0.0 { 0.0 } else { moved / size },
    };
    Ok((values, error))
}

/// The largest change in columns, over the largest value of one.
fn changed([own, finer]: [&History; 2], columns: std::ops::Range<usize>) -> f64 {
    let (mut largest, mut change) = (0.0_f64, 0.0_f64);
    for row in 0..own.rows() {
        let (own, finer) = (own.row(row), finer.row(2 * row + 1));
        for column in columns.clone() {
            largest = largest.max(own[column].abs());
            change = change.max((own[column] - finer[column]).abs());
        }
    }
    if change == 0.0 { 0.0 } else { change / largest }
}

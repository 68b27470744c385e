//! A periodic motion with all that is known of it.

use super::cycle::Cycle;
use super::doubled::{StepError, finer};
use super::harmonic::{Harmonics, balanced};
use super::map::{CycleMap, Orbit};
use super::multipliers::{Multiplier, Stability, largest, paired, stability};
use super::options::{Method, PeriodicOptions};
use super::solve::{Observe, Solved, solve};
use super::weighed::Weighed;
use crate::dynamics::{BodyStart, Outcome};
use crate::error::Error;
use crate::history::History;
use crate::machine::Machine;

/// A periodic motion.
#[derive(Debug, Clone)]
pub struct Periodic {
    /// Its cycle.
    pub cycle: Cycle,
    /// x at the start: positions of the unknowns, then their rates.
    pub state: Vec<f64>,
    /// The method that found it.
    pub method: Method,
    /// Cycles that were marched for it.
    pub cycles: usize,
    /// ‖x(T) − x(0)‖/‖x‖ in the energy norm.
    pub miss: f64,
    /// The rows of its cycle, one a step, the end of the cycle the last.
    pub history: History,
    /// What the steps of the cycle were worth.
    pub outcome: Outcome,
    /// The largest multipliers first; all of them where states are few.
    pub multipliers: Vec<Multiplier>,
    /// What they say.
    pub stability: Stability,
    /// What steps half as long change, where that was found; nothing of harmonics, which have no steps.
    pub step_error: Option<StepError>,
    /// Of what it is the sum, where harmonics were balanced.
    pub harmonics: Option<Harmonics>,
    /// Steps of the shortest contact of a spring that is free at other times; none where there is none.
    pub contact_steps: Option<usize>,
}

/// Finds the periodic motion of a machine that is reached from a start, with its multipliers. `observe` is called after every
/// cycle and may end the search.
///
/// # Errors
/// What the machine is told does not repeat; none is found; an interruption; a step that does not converge.
pub fn periodic(
    machine: &Machine,
    options: &PeriodicOptions,
    start: &[BodyStart],
    observe: Observe,
) -> Result<Periodic, Error> {
    let mut map = CycleMap::new(machine, options.cycle, options.newton)?;
    let x = map.beginning(start);
    periodic_from(&mut map, options, &x, observe)
}

/// As [`periodic`], of a map and from a state x.
///
/// # Errors
/// As there.
pub fn periodic_from(
    map: &mut CycleMap,
    options: &PeriodicOptions,
    x: &[f64],
    observe: Observe,
) -> Result<Periodic, Error> {
    if options.method == Some(Method::Harmonic) {
        return balanced(map, options, x, observe);
    }
    let before = map.cycles();
    let mut weighed = Weighed::new(map, x)?;
    let y = weighed.weighed(x);
    let Solved { y, miss, method } = solve(&mut weighed, y, options, observe)?;
    let cycles = weighed.map.cycles() - before;
    let own = largest(&mut weighed, &y, options.multipliers)?;
    let state = weighed.state(&y);
    let orbit = map.orbit(&state)?;
    let judged = options.judged.then(|| finer(map, options, (&state, &orbit), observe));
    let (multipliers, step_error) = match judged.transpose()? {
        Some((finer, error)) => (paired(&own, &finer), Some(error)),
        None => (paired(&own, &[]), None),
    };
    let Orbit { history, outcome, forces } = orbit;
    Ok(Periodic {
        cycle: map.cycle(),
        state,
        method,
        cycles,
        miss,
        history,
        outcome,
        stability: stability(&multipliers),
        multipliers,
        step_error,
        harmonics: None,
        contact_steps: super::contacts::fewest(&forces),
    })
}

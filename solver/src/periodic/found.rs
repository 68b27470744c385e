//! A periodic motion with all that is known of it.

use super::doubled::finer;
use super::harmonic::balanced;
use super::map::{CycleMap, Orbit};
use super::motion::Periodic;
use super::multipliers::{Largest, stability};
use super::options::{Method, PeriodicOptions};
use super::solve::{Observe, Solved, solve};
use super::weighed::Weighed;
use crate::dynamics::BodyStart;
use crate::error::Error;
use crate::machine::Machine;

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
    let x = map.beginning(start, false);
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
    let own = Largest::of(&mut weighed, &y, options.multipliers)?;
    let (state, metric) = (weighed.state(&y), weighed.metric());
    let orbit = map.orbit(&state)?;
    let judged = options.judged.then(|| finer(map, options, (&state, &orbit), observe));
    let (finer, step_error) = match judged.transpose()? {
        Some((finer, error)) => (finer, Some(error)),
        None => (Vec::new(), None),
    };
    let multipliers = own.with((&mut Weighed::with(map, metric), &y), &finer)?;
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

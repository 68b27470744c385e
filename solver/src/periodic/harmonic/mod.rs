//! Harmonic balance: the motion over a cycle as a sum of harmonics of which the equations of the machine have no residual on
//! average.
//!
//! Coefficients of the harmonics, seen from space ([`series`]) → the motion at equal instants of the cycle, each body in its own
//! frame ([`super::in_space`]) → residuals and tangents of the machine there, as every analysis has them ([`balance`]) → harmonics of
//! the residual → Newton's method with the exact derivative of what was sampled ([`solve`], [`mean`]). It begins with a few cycles of
//! the march, or with one that grows into a motion of the machine itself ([`own`]). The motion is that without steps: its error is that
//! of the harmonics that are left out, which twice as many tell. Multipliers are those of a march about it.

mod balance;
mod mean;
mod own;
mod series;
mod solve;
#[cfg(test)]
mod tests;

use self::balance::Balance;
use self::series::{Series, resized};
use self::solve::{Equilibrating, Motion, Solved};
use super::common::{Repeating, driven, repeating, speeds};
use super::cycle::Cycle;
use super::doubled::StepError;
use super::in_space::InSpace;
use super::map::{CycleMap, Orbit};
use super::metric::Metric;
use super::motion::{Harmonics, Periodic};
use super::multipliers::{Largest, MORE, largest, name_phase, stability};
use super::options::{Method, PeriodicOptions};
use super::solve::Observe;
use super::weighed::Weighed;
use crate::dynamics::{BodyStart, write_row};
use crate::error::{Error, PeriodicError};
use crate::history::History;
use crate::linalg::Matrix;
use crate::machine::Machine;

/// Harmonics beyond the fastest of what repeats in a cycle.
const HARMONICS: usize = 20;
/// Harmonics that are taken of a march between whose steps motions are read.
const FEW: usize = 8;
/// What twice as many harmonics may change of the motion so that they are enough, and how many are tried.
const CHANGE: f64 = 1e-3;
const MOST: usize = 200;
/// Cycles marched at first, of few states and of many.
const MARCHED: [usize; 2] = [8, 2];

/// Finds the periodic motion from a state x.
///
/// # Errors
/// None is found; an interruption; a step that does not converge where the motion is judged by a march.
pub(super) fn balanced(
    map: &mut CycleMap,
    options: &PeriodicOptions,
    x: &[f64],
    observe: Observe,
) -> Result<Periodic, Error> {
    remembers_nothing(map.machine())?;
    let before = map.cycles();
    let least = least_harmonics(map.machine(), map.cycle().period, options.harmonics)?;
    let count = options.harmonics.unwrap_or(HARMONICS + least);
    let metric = Metric::new(map, x)?;
    let space = InSpace::new(map.machine(), &speeds(map.machine())?)?;
    let beginning = beginning(map, options, x, &space)?;
    let cycles = map.cycles() - before;
    let cycle = map.cycle();
    let balance = Balance::new(map.machine(), cycle, (map.speeds(), space));
    let mut search = Search { balance, metric, map, options, cycles, reference: None };
    let from = Motion { coefficients: beginning, period: cycle.period };
    let (own, change) = search.enough(&from, count, observe)?;
    search.periodic(own, change)
}

/// How many harmonics a motion over a time (s) has at least: as often as the fastest of all loads and rotations repeats in it, or as
/// many as are given.
///
/// # Errors
/// As [`repeating`]; what as many harmonics as are given leave out.
pub fn least_harmonics(machine: &Machine, time: f64, given: Option<usize>) -> Result<usize, Error> {
    let times = |own: &Repeating| (own.hertz * time).round() as usize;
    let fastest = repeating(machine)?.into_iter().max_by_key(times);
    match (fastest, given) {
        (Some(own), Some(harmonics)) if times(&own) > harmonics => {
            Err(PeriodicError::LeftOut { harmonics, times: times(&own), what: own.what }.into())
        }
        (fastest, given) => Ok(given.or(fastest.as_ref().map(times)).unwrap_or(0)),
    }
}

/// That no law of a machine has states, and none of its joints a film, of which harmonics know nothing.
///
/// # Errors
/// One does.
pub fn remembers_nothing(machine: &Machine) -> Result<(), PeriodicError> {
    let springs = &machine.springs;
    match springs.remembering(|_| true).or_else(|| springs.with_film(|_| true)) {
        Some(plane) => {
            let (joint, law) = machine.names_of(plane);
            Err(PeriodicError::Remembers { joint, law })
        }
        None => Ok(()),
    }
}

/// What marches a machine on which nothing acts that changes.
///
/// # Errors
/// Something does; a law that remembers; a speed that is not known; a mass matrix that cannot be inverted.
pub fn undriven<'m>(
    machine: &'m Machine,
    options: &PeriodicOptions,
) -> Result<CycleMap<'m>, Error> {
    remembers_nothing(machine)?;
    match driven(machine)? {
        Some(what) => Err(PeriodicError::Driven { what }.into()),
        None => CycleMap::free(machine, options.cycle, options.newton),
    }
}

/// Finds the motion that a machine has by itself from a state x. The cycle of the options is about as long as its period, in so many
/// steps.
///
/// # Errors
/// There is none, or what the machine is told changes; an interruption; a step that does not converge.
pub fn self_excited(
    machine: &Machine,
    options: &PeriodicOptions,
    start: &[BodyStart],
    observe: Observe,
) -> Result<Periodic, Error> {
    let mut map = undriven(machine, options)?;
    let space = InSpace::new(machine, &speeds(machine)?)?;
    let x = map.beginning(start, false);
    let metric = Metric::new(&mut map, &x)?;
    let count = options.harmonics.unwrap_or(HARMONICS);
    let few = count.min(FEW);
    let mut balance = Balance::new(machine, options.cycle, (map.speeds(), space.clone()));
    let mut metric = metric;
    let mut least = options.marched.unwrap_or(own::LEAST);
    // A march that has not grown enough is no beginning for Newton's method: twice as long.
    let (from, reference, cycles) = loop {
        let known = (&metric, &space);
        let grown = own::grown(&mut map, known, (options, least), &x, observe)?;
        let (reference, cycles) = (Some(grown.reference), grown.cycles);
        let from = grown.motion(few).ok_or(PeriodicError::NotBalanced { harmonics: few }.into());
        let mut search = Search { balance, metric, map: &mut map, options, cycles, reference };
        let found = from.and_then(|from| search.with(&from, few, observe));
        Search { balance, metric, .. } = search;
        match found {
            Ok(found) => break (found.motion, reference, cycles),
            Err(Error::Periodic(PeriodicError::NotBalanced { .. }))
                if cycles < options.most_cycles =>
            {
                least = (2 * cycles).min(options.most_cycles);
            }
            Err(error) => return Err(error),
        }
    };
    let mut search = Search { balance, metric, map: &mut map, options, cycles, reference };
    let (own, change) = search.enough(&from, count, observe)?;
    let cycle = Cycle { period: own.motion.period, ..options.cycle };
    let Search { balance, metric, .. } = search;
    let mut map = CycleMap::free(machine, cycle, options.newton)?;
    let search = Search { balance, metric, map: &mut map, options, cycles, reference };
    search.periodic(own, change)
}

/// Coefficients of the motion after some cycles of the march; of rest at x where it does not get through them.
fn beginning(
    map: &mut CycleMap,
    options: &PeriodicOptions,
    x: &[f64],
    space: &InSpace,
) -> Result<Matrix, Error> {
    let few = map.is_small();
    let marched = options.marched.unwrap_or(MARCHED[usize::from(!few)]);
    let mut moved = x.to_vec();
    let n = map.unknowns();
    for _ in 1..marched {
        if map.apply(&mut moved).is_err() {
            moved = x.to_vec();
            break;
        }
    }
    let sampled = if marched == 0 { None } else { map.positions(&mut moved).ok() };
    Ok(match sampled {
        Some(mut samples) => {
            let instants = samples.cols;
            for j in 0..instants {
                space
                    .positions(samples.col_mut(j), map.cycle().period * j as f64 / instants as f64);
            }
            Series::new(map.cycle().period, (instants - 1) / 2, instants).coefficients(&samples)
        }
        None => Matrix { rows: n, cols: 1, data: x[..n].to_vec() },
    })
}

/// What looks for the harmonics of a machine.
struct Search<'a, 'm> {
    map: &'a mut CycleMap<'m>,
    balance: Balance<'m>,
    metric: Metric,
    options: &'a PeriodicOptions,
    cycles: usize,
    /// As [`Equilibrating::reference`].
    reference: Option<usize>,
}

impl Search<'_, '_> {
    /// A motion with as many harmonics as are enough, from one nearby, and what twice as many change.
    fn enough(
        &mut self,
        from: &Motion,
        count: usize,
        observe: Observe,
    ) -> Result<(Solved, Option<StepError>), Error> {
        let mut own = self.with(from, count, observe)?;
        if !self.options.judged {
            return Ok((own, None));
        }
        loop {
            let twice = self.with(&own.motion, 2 * own.motion.count(), observe)?;
            let change = self.change(&own.motion, &twice.motion);
            let is_enough = change.state.max(change.force).max(change.displacement) <= CHANGE;
            let next = 2 * twice.motion.count();
            if is_enough || self.options.harmonics.is_some() || next > MOST {
                return Ok((own, Some(change)));
            }
            own = twice;
        }
    }

    fn with(&mut self, from: &Motion, count: usize, observe: Observe) -> Result<Solved, Error> {
        let from = Motion { coefficients: resized(&from.coefficients, count), ..from.clone() };
        let told = (self.options.tolerance, self.cycles);
        let mut equilibrating = Equilibrating {
            balance: &mut self.balance,
            metric: &self.metric,
            series: Series::new,
            reference: self.reference,
        };
        let found = equilibrating.solve(from, told, observe)?;
        found.ok_or_else(|| PeriodicError::NotBalanced { harmonics: count }.into())
    }

    /// The state at the start.
    fn state(&mut self, own: &Motion) -> Vec<f64> {
        self.balance.set_period(own.period);
        self.balance.at_start(&own.series(&mut Series::new), &own.coefficients)
    }

    fn history(&mut self, own: &Motion) -> History {
        let machine = self.map.machine();
        let mut history = History::for_machine(machine);
        let asked: usize = machine.outputs.iter().map(|own| own.columns().len()).sum();
        let mut row = vec![0.0; history.names().len()];
        let usual = row.len() - asked;
        let steps = self.map.cycle().steps;
        self.balance.set_period(own.period);
        self.balance.rows(&own.coefficients, steps, |equations, state, time| {
            let (first, outputs) = row.split_at_mut(usual);
            write_row(equations, state, time, 0, first);
            equations.write_outputs(state, time, outputs);
            history.push(&row);
        });
        history
    }

    /// By what one motion differs from another one with more harmonics.
    fn change(&mut self, own: &Motion, other: &Motion) -> StepError {
        let [a, b] = [own, other].map(|own| self.history(own));
        let states = [own, other].map(|own| {
            let state = self.state(own);
            self.metric.weighed(&state)
        });
        StepError::between(self.map.machine(), ([&a, &b], 1), [&states[0], &states[1]])
    }

    /// All that is known of a motion.
    fn periodic(mut self, own: Solved, change: Option<StepError>) -> Result<Periodic, Error> {
        let state = self.state(&own.motion);
        let history = self.history(&own.motion);
        let Search { map, options, cycles, .. } = self;
        let mut weighed = Weighed::new(map, &state)?;
        let y = weighed.weighed(&state);
        let largest_of_march = Largest::of(&mut weighed, &y, options.multipliers)?;
        let metric = weighed.metric();
        let finer = if options.judged {
            let mut twice = map.doubled()?;
            let mut weighed = Weighed::new(&mut twice, &state)?;
            let y = weighed.weighed(&state);
            largest(&mut weighed, &y, options.multipliers + MORE)?
        } else {
            Vec::new()
        };
        let Orbit { history: marched, outcome, forces } = map.orbit(&state)?;
        let mut multipliers =
            largest_of_march.with((&mut Weighed::with(map, metric), &y), &finer)?;
        if map.is_free() {
            name_phase(&mut multipliers);
        }
        let steps = StepError::between(map.machine(), ([&history, &marched], 1), [&[], &[]]);
        Ok(Periodic {
            cycle: map.cycle(),
            state,
            method: Method::Harmonic,
            cycles,
            miss: own.left,
            history,
            outcome,
            stability: stability(&multipliers),
            multipliers,
            step_error: None,
            harmonics: Some(Harmonics {
                count: own.motion.count(),
                instants: own.motion.series(&mut Series::new).instants(),
                corrections: own.corrections,
                change,
                steps,
            }),
            contact_steps: super::contacts::fewest(&forces),
        })
    }
}

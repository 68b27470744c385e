//! Harmonic balance: the motion over a cycle as a sum of harmonics of which the equations of the machine have no residual on average.
//!
//! Coefficients of the harmonics, seen from space ([`series`]) → the motion at equal instants of the cycle, each body in its own frame
//! ([`in_space`]) → residuals and tangents of the machine there, as every analysis has them ([`balance`]) → harmonics of the residual → Newton's method with the exact
//! derivative of what was sampled ([`solve`], [`mean`]). It begins with a few cycles of the march. The motion is that without steps:
//! its error is that of the harmonics that are left out, which twice as many tell. Multipliers are those of a march about it.

mod balance;
mod in_space;
mod mean;
mod series;
mod solve;
#[cfg(test)]
mod tests;

use self::balance::Balance;
use self::in_space::InSpace;
use self::series::{Series, resized};
use self::solve::{Equilibrating, Solved};
use super::doubled::StepError;
use super::map::{CycleMap, Orbit};
use super::metric::Metric;
use super::motion::{Harmonics, Periodic};
use super::multipliers::{largest, paired, stability};
use super::options::{Method, PeriodicOptions};
use super::shooting::WHOLE;
use super::solve::Observe;
use super::weighed::Weighed;
use crate::dynamics::write_row;
use crate::error::{Error, PeriodicError};
use crate::history::History;
use crate::linalg::Matrix;

/// Harmonics beside those by which bodies turn, and instants for each: forces with corners fall as 1/k².
const HARMONICS: usize = 20;
const INSTANTS: usize = 8;
/// What twice as many harmonics may change of the motion so that they are enough, and how many are tried.
const CHANGE: f64 = 1e-3;
const MOST: usize = 200;
/// Cycles marched at first, of few states and of many.
const MARCHED: [usize; 2] = [8, 2];

/// Coefficients of so many harmonics, and what they are worth.
struct Balanced {
    solved: Solved,
    series: Series,
}

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
    let before = map.cycles();
    let metric = Metric::new(map, x)?;
    let space = InSpace::new(map)?;
    let beginning = beginning(map, options, x, &space)?;
    let cycles = map.cycles() - before;
    let count = options.harmonics.unwrap_or(HARMONICS + space.turns());
    let mut search = Search { balance: Balance::new(map, space), metric, map, options, cycles };
    let mut own = search.with(&beginning, count, observe)?;
    let mut change = None;
    if options.judged {
        loop {
            let twice =
                search.with(&own.solved.coefficients, 2 * own.series.harmonics(), observe)?;
            let found = search.change(&own, &twice);
            change = Some(found);
            let is_enough = found.state.max(found.force).max(found.displacement) <= CHANGE;
            let count = 2 * twice.series.harmonics();
            if is_enough || options.harmonics.is_some() || count > MOST {
                break;
            }
            own = twice;
        }
    }
    search.periodic(own, change)
}

/// Coefficients of the motion after some cycles of the march; of rest at x where it does not get through them.
fn beginning(
    map: &mut CycleMap,
    options: &PeriodicOptions,
    x: &[f64],
    space: &InSpace,
) -> Result<Matrix, Error> {
    let few = x.len() <= WHOLE;
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
                space.positions(samples.col_mut(j), j as f64 / instants as f64);
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
}

impl Search<'_, '_> {
    fn with(&mut self, from: &Matrix, count: usize, observe: Observe) -> Result<Balanced, Error> {
        let series = Series::new(self.map.cycle().period, count, INSTANTS * count.max(1));
        let told = (self.options.tolerance, self.cycles);
        let mut equilibrating =
            Equilibrating { balance: &mut self.balance, series: &series, metric: &self.metric };
        match equilibrating.solve(resized(from, count), told, observe)? {
            Some(solved) => Ok(Balanced { solved, series }),
            None => Err(PeriodicError::NotBalanced { harmonics: count }.into()),
        }
    }

    /// The state at the start.
    fn state(&mut self, own: &Balanced) -> Vec<f64> {
        self.balance.at_start(&own.series, &own.solved.coefficients)
    }

    fn history(&mut self, own: &Balanced) -> History {
        let machine = self.map.machine();
        let mut history = History::for_machine(machine);
        let asked: usize = machine.outputs.iter().map(|own| own.columns().len()).sum();
        let mut row = vec![0.0; history.names().len()];
        let usual = row.len() - asked;
        let steps = self.map.cycle().steps;
        self.balance.rows(&own.solved.coefficients, steps, |equations, state, time| {
            let (first, outputs) = row.split_at_mut(usual);
            write_row(equations, state, time, 0, first);
            equations.write_outputs(state, time, outputs);
            history.push(&row);
        });
        history
    }

    /// By what one motion differs from another one with more harmonics.
    fn change(&mut self, own: &Balanced, other: &Balanced) -> StepError {
        let [a, b] = [own, other].map(|own| self.history(own));
        let states = [own, other].map(|own| {
            let state = self.state(own);
            self.metric.weighed(&state)
        });
        StepError::between(self.map.machine(), ([&a, &b], 1), [&states[0], &states[1]])
    }

    /// All that is known of a motion.
    fn periodic(mut self, own: Balanced, change: Option<StepError>) -> Result<Periodic, Error> {
        let state = self.state(&own);
        let history = self.history(&own);
        let Search { map, options, cycles, .. } = self;
        let values = {
            let mut weighed = Weighed::new(map, &state)?;
            let y = weighed.weighed(&state);
            largest(&mut weighed, &y, options.multipliers)?
        };
        let finer = if options.judged {
            let mut twice = CycleMap::new(map.machine(), map.cycle().doubled(), options.newton)?;
            let mut weighed = Weighed::new(&mut twice, &state)?;
            let y = weighed.weighed(&state);
            largest(&mut weighed, &y, options.multipliers)?
        } else {
            Vec::new()
        };
        let Orbit { history: marched, outcome, forces } = map.orbit(&state)?;
        let multipliers = paired(&values, &finer);
        let steps = StepError::between(map.machine(), ([&history, &marched], 1), [&[], &[]]);
        Ok(Periodic {
            cycle: map.cycle(),
            state,
            method: Method::Harmonic,
            cycles,
            miss: own.solved.left,
            history,
            outcome,
            stability: stability(&multipliers),
            multipliers,
            step_error: None,
            harmonics: Some(Harmonics {
                count: own.series.harmonics(),
                instants: own.series.instants(),
                corrections: own.solved.corrections,
                change,
                steps,
            }),
            contact_steps: super::contacts::fewest(&forces),
        })
    }
}

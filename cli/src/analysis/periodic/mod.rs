//! Motions that repeat themselves: over a cycle of loads and speeds, each with its multipliers.
//!
//! A case at a speed → its machine → what repeats in it, and the common period → a state that a cycle leaves as it is → the cycle as
//! rows of a history, multipliers, what speaks against them.

mod branch;
mod figure;
mod files;
mod place;
mod text;
mod turned;

use std::ops::ControlFlow;

use whirl_solver::Error;
use whirl_solver::cache::Cache;
use whirl_solver::dynamics::{BodyStart, equilibrium};
use whirl_solver::error::PeriodicError;
use whirl_solver::periodic::{
    Cycle, CycleMap, CycleProgress, Periodic, PeriodicOptions, Repeating, common_period,
    periodic_from, repeating, start,
};

use super::facts::{Facts, truth};
use super::found::{Found, nothing};
use crate::case::{Analysis, Beginning, Case, CaseText};
use crate::errors::Failure;
use crate::machine::{self, Built};
use crate::report::VerdictFacts;
use crate::signals::Interruption;

/// Steps of a cycle where neither the analysis nor the march says them.
const STEPS: usize = 360;
/// Steps at least, whatever the time step of the march.
const LEAST: f64 = 8.0;

/// A periodic motion at a speed.
struct Motion {
    /// Of the body whose speed it is (rad/s); none where the case has the speeds.
    speed: Option<f64>,
    /// What repeats in a cycle.
    repeating: Vec<Repeating>,
    periodic: Periodic,
    verdict: VerdictFacts,
    /// Names of the columns of its rows.
    columns: Vec<String>,
}

/// The motions of a case, and those that were not found.
struct Motions<'a> {
    case: &'a Case,
    analysis: &'a Analysis,
    of: Option<usize>,
    all: Vec<Motion>,
    /// Speeds (rad/s) with why there is nothing.
    lost: Vec<(Option<f64>, String)>,
    /// What is to be known of all.
    notes: Vec<String>,
}

/// The motion at each speed of an analysis, as a text, files and figures.
///
/// # Errors
/// What does not repeat; no motion at any of the speeds; an interruption before the first.
pub(super) fn found(
    (case, text): (&Case, Option<&CaseText>),
    analysis: &Analysis,
    (cache, warnings): (Option<&Cache>, &mut Vec<String>),
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    place::without_jumps(case)?;
    if let (Some(varying), Some(text)) = (&analysis.periodic.vary, text) {
        let both = (cache, warnings);
        return branch::found((case, text), (analysis, varying), both, interruption, figures);
    }
    let of = turned::of(case, analysis)?;
    let speeds: Vec<Option<f64>> = match analysis.speeds.as_slice() {
        [] => vec![None],
        own => own.iter().map(|speed| Some(*speed)).collect(),
    };
    let mut motions = Motions {
        case,
        analysis,
        of,
        all: Vec::new(),
        lost: Vec::new(),
        notes: notes(case, analysis),
    };
    let (mut near, mut interrupted): (Option<Vec<f64>>, bool) = (None, false);
    for &speed in &speeds {
        let own = turned::at(case, analysis, of.zip(speed));
        let built = machine::build_planned(&own, cache, warnings)?;
        let sought = Sought { case: &own, analysis, built: &built, speed };
        match sought.found(near.as_deref(), interruption) {
            Ok(motion) => {
                near = Some(motion.periodic.state.clone());
                motions.all.push(motion);
            }
            Err(Error::Periodic(PeriodicError::Interrupted { .. })) => {
                interrupted = true;
                break;
            }
            Err(error) if not_there(&error) => motions.lost.push((speed, error.to_string())),
            Err(error) => return Err(place::of(case, error)),
        }
    }
    if motions.all.is_empty() {
        return Err(match motions.lost.pop() {
            Some((_, reason)) => unfound(reason),
            None => nothing(),
        });
    }
    let name = &analysis.name;
    let mut files = files::written(name, &motions);
    if figures {
        files.extend(figure::drawn(name, &motions));
    }
    let facts = facts(&motions);
    Ok(Found { text: text::of(&motions), files, interrupted, facts })
}

/// Whether it says that at this speed there is no motion, as there may be at others.
fn not_there(error: &Error) -> bool {
    matches!(
        error,
        Error::Periodic(PeriodicError::NotFound { .. })
            | Error::NewtonDiverged { .. }
            | Error::NoForce { .. }
    )
}

fn unfound(reason: String) -> Failure {
    let help = "look for it from another `begin`, after more `marched` cycles, with more `steps` or the other `method`; if the motion \
                repeats after several periods, say so by `periods = 2`";
    Failure::Unfinished { reason, kept: None, help: Some(help.to_owned()) }
}

/// Why there is nothing, where that is an error of the solver.
fn failed(case: &Case, error: Error) -> Failure {
    match error {
        Error::Periodic(PeriodicError::Interrupted { .. }) => nothing(),
        error if not_there(&error) => unfound(error.to_string()),
        error => place::of(case, error),
    }
}

/// What of the march of a case is not that of its periodic motions.
fn notes(case: &Case, analysis: &Analysis) -> Vec<String> {
    let Some(march) = &case.march else { return Vec::new() };
    let mut notes = Vec::new();
    if march.spectral_radius.is_some() {
        notes.push(
            "steps are those of the average acceleration, not of generalized-alpha as in `[march]`"
                .to_owned(),
        );
    }
    if march.automatic.is_some() && analysis.periodic.steps.is_none() {
        notes.push(format!(
            "a cycle is taken in {STEPS} equal steps, as `[march]` gives no time step"
        ));
    }
    notes
}

/// A motion that is looked for.
struct Sought<'a> {
    case: &'a Case,
    analysis: &'a Analysis,
    built: &'a Built,
    speed: Option<f64>,
}

impl Sought<'_> {
    /// The motion, from the state of another one or from the beginning.
    fn found(&self, near: Option<&[f64]>, interruption: &Interruption) -> Result<Motion, Error> {
        let Sought { case, analysis, built, speed } = *self;
        let keys = &analysis.periodic;
        let repeating = repeating(&built.machine)?;
        let period = keys.periods as f64 * common_period(&repeating)?;
        let cycle =
            Cycle { start: start(&built.machine, period), period, steps: self.steps(period) };
        let mut options = PeriodicOptions::of(cycle);
        (options.method, options.marched) = (keys.method, keys.marched);
        (options.most_cycles, options.multipliers) = (keys.cycles, analysis.count);
        let mut map = CycleMap::new(&built.machine, cycle, options.newton)?;
        let mut observe = |_: &CycleProgress| match interruption.asked() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let from_near = near.filter(|x| x.len() == 2 * map.unknowns());
        let followed = from_near.map(|x| periodic_from(&mut map, &options, x, &mut observe));
        let periodic = match followed {
            Some(Ok(found)) => found,
            Some(Err(error)) if !not_there(&error) => return Err(error),
            _ => {
                let x = map.beginning(&self.beginning(cycle)?);
                periodic_from(&mut map, &options, &x, &mut observe)?
            }
        };
        let length = (cycle.time_step(), None);
        let verdict = VerdictFacts::new(
            (&built.machine, &case.supports()),
            &periodic.outcome,
            length,
            (None, None),
        );
        let columns = periodic.history.names().to_vec();
        Ok(Motion { speed, repeating, periodic, verdict, columns })
    }

    /// What repeats, and the cycle, in so many steps if they are told.
    fn cycle(&self, steps: Option<usize>) -> Result<(Vec<Repeating>, Cycle), Error> {
        let machine = &self.built.machine;
        let repeating = repeating(machine)?;
        let period = self.analysis.periodic.periods as f64 * common_period(&repeating)?;
        let steps = steps.unwrap_or_else(|| self.steps(period));
        Ok((repeating, Cycle { start: start(machine, period), period, steps }))
    }

    fn options(&self, cycle: Cycle) -> PeriodicOptions {
        let (keys, multipliers) = (&self.analysis.periodic, self.analysis.count);
        let (method, marched, most_cycles) = (keys.method, keys.marched, keys.cycles);
        PeriodicOptions { method, marched, most_cycles, multipliers, ..PeriodicOptions::of(cycle) }
    }

    /// Steps of a cycle: as they are told, or as near to the time step of the march as they can be.
    fn steps(&self, period: f64) -> usize {
        let march = self.case.march.as_ref().filter(|own| own.automatic.is_none());
        let of_march = march.map(|own| (period / own.time_step).round().max(LEAST) as usize);
        self.analysis.periodic.steps.or(of_march).unwrap_or(STEPS)
    }

    /// Where the search begins.
    fn beginning(&self, cycle: Cycle) -> Result<Vec<BodyStart>, Error> {
        let speeds: Vec<Option<f64>> =
            self.case.machine.bodies.iter().map(|body| body.initial_speed).collect();
        let balanced =
            || Ok(equilibrium(&self.built.machine, &speeds, Some(cycle.time_step()))?.bodies);
        match self.analysis.periodic.begin {
            Some(Beginning::Rest) => Ok(self.built.initial.clone()),
            Some(Beginning::Equilibrium) => balanced(),
            None => balanced().or_else(|_: Error| Ok(self.built.initial.clone())),
        }
    }
}

/// Numbers of the last motion, and notes of all.
fn facts(motions: &Motions) -> Facts {
    let mut facts = Facts::default();
    if let Some(Motion { periodic, columns, verdict, .. }) = motions.all.last() {
        let stable = text::is_stable(periodic.stability);
        facts.put("period_s", periodic.cycle.period);
        facts.put("stable", stable.map(truth));
        facts.put("sound", truth(verdict.sound));
        facts.put("largest_multiplier", text::leading(periodic).map(|own| own.value.norm()));
        facts.put("miss", periodic.miss);
        facts.put("cycles", periodic.cycles as f64);
        for (place, column) in columns.iter().enumerate().filter(|own| files::is_summed_up(own.1)) {
            let [least, most] = files::range(&periodic.history, place);
            facts.put(format!("{column}.min"), least);
            facts.put(format!("{column}.max"), most);
        }
    }
    text::notes(motions).iter().for_each(|own| facts.note(own));
    facts
}

//! Motions that repeat themselves: over a cycle of loads and speeds, each with its multipliers.
//!
//! A case at a speed → its machine → what repeats in it, and the common period → a state that a cycle leaves as it is → the cycle as
//! rows of a history, multipliers, what speaks against them.

mod branch;
mod figure;
mod files;
mod followed;
mod motions;
mod place;
mod sought;
mod text;
mod turned;

use whirl_solver::Error;
use whirl_solver::cache::Cache;
use whirl_solver::error::PeriodicError;

use self::motions::{Motion, Motions};
use self::sought::Sought;
use super::facts::{Facts, truth};
use super::found::{Found, nothing};
use crate::case::{Analysis, Case, CaseText};
use crate::errors::Failure;
use crate::machine;
use crate::signals::Interruption;

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
    case.without_frequencies()?;
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
            Err(error) if place::not_there(&error) => motions.lost.push((speed, error.to_string())),
            Err(error) => return Err(place::of(case, error)),
        }
    }
    if motions.all.is_empty() {
        return Err(match motions.lost.pop() {
            Some((_, reason)) => place::unfound(reason, analysis.periodic.self_excited),
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

/// What keeps the first motion from being looked for.
///
/// # Errors
/// As [`found`] before its search.
pub(super) fn foreseen(
    (case, text): (&Case, Option<&CaseText>),
    analysis: &Analysis,
    cache: Option<&Cache>,
) -> Result<(), Failure> {
    case.without_frequencies()?;
    place::without_jumps(case)?;
    if let Some(varying) = &analysis.periodic.vary {
        return text
            .map_or(Ok(()), |text| branch::foreseen((case, text), (analysis, varying), cache));
    }
    let of = turned::of(case, analysis)?;
    let speed = analysis.speeds.first().copied();
    let own = turned::at(case, analysis, of.zip(speed));
    let built = machine::build_planned(&own, cache, &mut Vec::new())?;
    let sought = Sought { case: &own, analysis, built: &built, speed };
    sought.foreseen().map_err(|error| place::of(case, error))
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
        notes.push("a cycle is taken in equal steps, as `[march]` gives no time step".to_owned());
    }
    notes
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
        let change = |own: whirl_solver::periodic::StepError| own.force.max(own.displacement);
        facts.put("step_change", periodic.step_error.map(change));
        let harmonics = periodic.harmonics.and_then(|own| own.change);
        facts.put("harmonic_change", harmonics.map(change));
        if !verdict.sound {
            facts.note("the steps of the motion are NOT SOUND: see the verdict of its analysis");
        }
        for (place, column) in columns.iter().enumerate().filter(|own| motions::is_summed_up(own.1))
        {
            let [least, most] = motions::range(&periodic.history, place);
            facts.put(format!("{column}.min"), least);
            facts.put(format!("{column}.max"), most);
        }
    }
    text::notes(motions).iter().for_each(|own| facts.note(own));
    facts
}

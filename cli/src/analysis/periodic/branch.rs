//! Periodic motions over a key of the case, followed from one to the next.

use std::ops::ControlFlow;

use whirl_solver::Error;
use whirl_solver::cache::Cache;
use whirl_solver::error::PeriodicError;
use whirl_solver::machine::Machine;
use whirl_solver::periodic::{
    At, BranchEnd, BranchEvent, BranchOptions, Cycle, CycleMap, CycleProgress, EventKind,
    PeriodicOptions, branch, switched,
};

use super::followed::{Followed, Own};
use super::place;
use super::sought::Sought;
use crate::analysis::found::{Found, drawn};
use crate::case::{Analysis, Case, CaseText, Varying};
use crate::errors::Failure;
use crate::machine;
use crate::signals::Interruption;

/// First step, of the range.
const STEP: f64 = 0.01;

/// Branches at most.
const BRANCHES: usize = 32;

/// The case with a value of the key, and its machine.
fn read(
    text: &CaseText,
    (analysis, varying): (&Analysis, &Varying),
    value: f64,
    cache: Option<&Cache>,
) -> Result<(Case, machine::Built), Failure> {
    let values = [(varying.key.as_str(), varying.literal(value))].into_iter();
    let place = format!("`vary` of [analysis.{}]", analysis.name);
    let own = text.with_more_values(values).with_values_of(&place);
    let mut own = machine::read_text_to_analyse(&own, &mut Vec::new())?;
    own.fields = None;
    let built = machine::build_planned(&own, cache, &mut Vec::new())?;
    Ok((own, built))
}

/// What keeps a branch from being followed, as far as its ends show that.
///
/// # Errors
/// The key, or what it leads to, is wrong; what does not repeat there.
pub(super) fn foreseen(
    (case, text): (&Case, &CaseText),
    (analysis, varying): (&Analysis, &Varying),
    cache: Option<&Cache>,
) -> Result<(), Failure> {
    for value in varying.ends {
        let (own, built) = read(text, (analysis, varying), value, cache)?;
        let sought = Sought { case: &own, analysis, built: &built, speed: None };
        sought.foreseen().map_err(|error| place::of(case, error))?;
    }
    Ok(())
}

/// The branch from the motion at the first value on.
///
/// # Errors
/// The key, or what it leads to, is wrong; no motion there; an interruption before the second.
pub(super) fn found(
    (case, text): (&Case, &CaseText),
    (analysis, varying): (&Analysis, &Varying),
    (cache, warnings): (Option<&Cache>, &mut Vec<String>),
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let read = |value: f64| read(text, (analysis, varying), value, cache);
    let [from, to] = varying.ends;
    let (first, built) = read(from)?;
    let of = |case: &Case, error: Error| place::of(case, error);
    let sought = Sought { case: &first, analysis, built: &built, speed: None };
    let (_, cycle) = sought.cycle(None).map_err(|error| of(&first, error))?;
    let options = sought.options(cycle);
    let map = CycleMap::new(&built.machine, cycle, options.newton);
    let map = map.map_err(|error| of(&first, error))?;
    let (bodies, laws_at_rest) = sought.beginning(cycle).map_err(|error| of(&first, error))?;
    let x = map.beginning(&bodies, laws_at_rest);
    drop(map);
    // An error that is not one of the solver is kept beside it.
    let mut failure: Option<Failure> = None;
    let mut at = |value: f64| -> Result<(Machine, Cycle), Error> {
        let made = read(value).and_then(|(own, built)| {
            let sought = Sought { case: &own, analysis, built: &built, speed: None };
            let (_, found) = sought.cycle(Some(cycle.steps)).map_err(|error| of(&own, error))?;
            Ok((built.machine, found))
        });
        made.map_err(|error| {
            // Beyond its range a key may have no values.
            if value < from.min(to) || value > from.max(to) {
                return PeriodicError::NoMachine { value }.into();
            }
            let words = error.to_string();
            failure.get_or_insert(error);
            Error::Machine(words)
        })
    };
    let mut observe = |_: &CycleProgress| match interruption.asked() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    let options = BranchOptions {
        range: varying.ends,
        points: analysis.periodic.points,
        step: STEP,
        first: PeriodicOptions { judged: false, ..options },
    };
    let made = branches(&mut at, &options, (&x, analysis.periodic.doublings), &mut observe);
    let branches = match (made, failure) {
        (Ok(made), _) => made,
        (Err(_), Some(failure)) => return Err(failure),
        (Err(error), None) => return Err(place::failed(case, error)),
    };
    let columns = branches[0].branch.points[0].history.names().to_vec();
    let followed = Followed { case, varying, branches, columns };
    let name = &analysis.name;
    let mut written = followed.files(name);
    if figures {
        written.extend(drawn(name, &followed.figure()));
    }
    warnings.extend(followed.branches.iter().filter_map(Own::note));
    Ok(Found {
        text: followed.text(),
        files: written,
        interrupted: followed.branches.iter().any(Own::is_interrupted),
        facts: followed.facts(),
    })
}

/// The branch, and those from its doublings on, from theirs, and so on as often as is wanted. One that comes back to the branch it
/// began at is that of the doubling there, too.
fn branches(
    at: At,
    options: &BranchOptions,
    (x, doublings): (&[f64], usize),
    observe: &mut dyn FnMut(&CycleProgress) -> ControlFlow<()>,
) -> Result<Vec<Own>, Error> {
    let first = branch(&mut *at, options, x, observe)?;
    let mut all = vec![Own { branch: first, periods: 1, begun: None }];
    let mut place = 0;
    while place < all.len() && all[place].periods < 1 << doublings {
        let periods = all[place].periods;
        let is_doubling = |own: &&BranchEvent| own.kind == EventKind::Doubling;
        let mut events: Vec<BranchEvent> =
            all[place].branch.events.iter().filter(is_doubling).cloned().collect();
        events.reverse();
        while let Some(event) = events.pop() {
            if all.len() == BRANCHES || all.iter().any(Own::is_interrupted) {
                return Ok(all);
            }
            let Some(found) = switched(&mut *at, options, (&event, periods), observe)? else {
                continue;
            };
            if let (BranchEnd::Meets, Some(last)) = (&found.end, found.points.last()) {
                let apart = |own: &BranchEvent| (own.value - last.value).abs();
                let nearest = (0..events.len())
                    .min_by(|&a, &b| apart(&events[a]).total_cmp(&apart(&events[b])));
                // Unless it has come back to where it began.
                if let Some(nearest) = nearest.filter(|&own| apart(&events[own]) < apart(&event)) {
                    events.remove(nearest);
                }
            }
            let begun = Some(event.value);
            all.push(Own { branch: found, periods: 2 * periods, begun });
        }
        place += 1;
    }
    Ok(all)
}

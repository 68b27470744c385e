//! A point: from its values to its row.

use std::num::NonZero;

use whirl_solver::cache::{Cache, Key};

use super::definition::{Keep, Sweep};
use super::figures;
use super::folder::SweepFolder;
use super::points::Point;
use super::row::Row;
use super::trace::Trace;
use crate::analysis::{self, AtPoint};
use crate::case::Case;
use crate::errors::Failure;
use crate::machine::Built;
use crate::signals::Interruption;
use crate::simulate::{Watch, summed_up};
use crate::{machine, start};

/// A point that is done.
#[derive(Default)]
pub(super) struct Done {
    /// Of the numbers of its row.
    pub(super) names: Vec<String>,
    pub(super) row: Row,
    /// The state after its last step, if it has come to that.
    pub(super) state: Option<Vec<u8>>,
    pub(super) warnings: Vec<String>,
}

/// Why a point is not done.
pub(super) enum Undone {
    /// The user did not want to wait.
    Interrupted,
    /// What is to be kept of it cannot be written.
    NotKept(String),
}

/// Runs a point, which `key` tells from all others, or analyses it, from the state in which another one ended if there is one. Whatever is wrong with it is a row.
///
/// # Errors
/// It is interrupted, or cannot be kept.
pub(super) fn run(
    (sweep, point, key): (&Sweep, &Point, Key),
    from: Option<&[u8]>,
    (cache, results): (&Cache, &SweepFolder),
    (watch, (interruption, threads)): (&dyn Watch, (&Interruption, NonZero<usize>)),
) -> Result<Done, Undone> {
    let mut warnings = Vec::new();
    let built = sweep.case(point, &mut warnings).and_then(|mut case| {
        if let Some(state) = from {
            start::go_on(&mut case, state);
        }
        let analyses = analysis::named(&case, &sweep.analyses)?;
        let built = match sweep.marches || analysis::need_machine(&analyses) {
            true => Some(machine::build_planned(&case, Some(cache), &mut warnings)?),
            false => None,
        };
        Ok((case, analyses, built))
    });
    let (case, analyses, built) = match built {
        Ok(built) => built,
        Err(failure) => return Ok(failed(&failure, warnings)),
    };
    let mut all = match (&built, sweep.marches) {
        (Some(built), true) => match marched((sweep, &case, built), ((point, key), results), watch)
        {
            Ok(all) => all,
            Err(NotMarched::Undone(undone)) => return Err(undone),
            Err(NotMarched::Failed(failure)) => return Ok(failed(&failure, warnings)),
        },
        _ => Done::default(),
    };
    if !analyses.is_empty() {
        let (case, built) = (&case, built.as_ref());
        let at = AtPoint { case, built, cache, interruption, threads };
        match at.facts(&analyses, &mut warnings) {
            Ok(facts) => {
                let (names, values): (Vec<_>, Vec<_>) = facts.numbers.into_iter().unzip();
                all.names.extend(names);
                all.row.values.extend(values);
                facts.notes.iter().for_each(|own| all.row.remark(own));
            }
            Err(_) if watch.asked() => return Err(Undone::Interrupted),
            // What the march came to is kept.
            Err(failure) => {
                let row = Row::failed(&failure);
                all.row.verdict = row.verdict;
                all.row.remark(&row.words);
            }
        }
    }
    warnings.append(&mut all.warnings);
    Ok(Done { warnings, ..all })
}

/// A point that came to nothing.
fn failed(failure: &Failure, warnings: Vec<String>) -> Done {
    Done { row: Row::failed(failure), warnings, ..Done::default() }
}

/// Why a march left nothing.
enum NotMarched {
    Undone(Undone),
    Failed(Failure),
}

fn marched(
    (sweep, case, built): (&Sweep, &Case, &Built),
    (point, results): ((&Point, Key), &SweepFolder),
    watch: &dyn Watch,
) -> Result<Done, NotMarched> {
    let (run, facts) = summed_up(case, built, watch).map_err(|failure| match failure {
        Failure::Unfinished { .. } if watch.asked() => NotMarched::Undone(Undone::Interrupted),
        failure => NotMarched::Failed(failure),
    })?;
    if run.interrupted {
        return Err(NotMarched::Undone(Undone::Interrupted));
    }
    let mut warnings = Vec::new();
    let trace = match figures::need_traces(sweep) {
        true => Trace::of(case, built, &run.history)
            .map_err(|error| warnings.push(format!("no figure shows this point: {error}")))
            .ok(),
        false => None,
    };
    if sweep.keep == Keep::Histories {
        let kept = results.keep_point(point, &run);
        kept.map_err(|reason| NotMarched::Undone(Undone::NotKept(reason)))?;
    }
    let (names, row) = Row::of(case, &facts, run.reason.as_deref());
    let row = Row { trace, ..row };
    warnings.extend(run.warnings);
    Ok(Done { names, row, state: run.state, warnings })
}

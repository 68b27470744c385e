//! A point: from its values to its row.

use whirl_solver::cache::Cache;

use super::definition::{Keep, Sweep};
use super::figures;
use super::folder::SweepFolder;
use super::points::Point;
use super::row::Row;
use super::trace::Trace;
use crate::errors::Failure;
use crate::simulate::{Watch, summed_up};
use crate::{machine, start};

/// A point that is done.
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

/// Runs a point, from the state in which another one ended if there is one. Whatever is wrong with it is a row.
///
/// # Errors
/// It is interrupted, or cannot be kept.
pub(super) fn run(
    (sweep, point): (&Sweep, &Point),
    from: Option<&[u8]>,
    (cache, results): (&Cache, &SweepFolder),
    watch: &dyn Watch,
) -> Result<Done, Undone> {
    let mut warnings = Vec::new();
    let ran = sweep.case(point, &mut warnings).and_then(|mut case| {
        if let Some(state) = from {
            start::go_on(&mut case, state);
        }
        let built = machine::build_planned(&case, Some(cache), &mut warnings)?;
        let (run, facts) = summed_up(&case, &built, watch)?;
        let trace = match figures::need_traces(sweep) {
            true => Trace::of(&case, &built, &run.history)
                .map_err(|error| warnings.push(format!("no figure shows this point: {error}")))
                .ok(),
            false => None,
        };
        Ok((case, run, facts, trace))
    });
    let (case, run, facts, trace) = match ran {
        Ok(ran) => ran,
        Err(Failure::Unfinished { .. }) if watch.asked() => return Err(Undone::Interrupted),
        Err(failure) => {
            let row = Row::failed(&failure);
            return Ok(Done { names: Vec::new(), row, state: None, warnings });
        }
    };
    if run.interrupted {
        return Err(Undone::Interrupted);
    }
    if sweep.keep == Keep::Histories {
        results.keep_point(point.number(), &run).map_err(Undone::NotKept)?;
    }
    let (names, row) = Row::of(&case, &facts, run.reason.as_deref());
    let row = Row { trace, ..row };
    warnings.extend(run.warnings);
    Ok(Done { names, row, state: run.state, warnings })
}

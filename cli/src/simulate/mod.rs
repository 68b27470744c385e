//! The run of a case, wherever its rows go: march, then sum up. Nothing is printed here, and nothing is shared with other
//! runs of the process: what there is to say, [`Watch`] hears.

mod folder;
mod in_memory;
mod march;
#[cfg(test)]
mod tests;

use std::io;
use std::time::Instant;

use whirl_solver::dynamics::{March, MarchOptions};

use crate::case::Case;
use crate::checkpoint::Point;
use crate::errors::Failure;
use crate::fields::Motions;
use crate::machine::Built;
use crate::report::{Summary, Times};
use crate::start;
pub use crate::watch::{Quiet, Watch};

pub(crate) use self::folder::FolderStore;
pub(crate) use self::in_memory::summed_up;
pub use self::in_memory::{InMemory, in_memory};
pub(crate) use self::march::{End, Marched, Store};

/// A run up to its end.
pub(crate) struct Simulated<'a> {
    /// How the march went.
    pub(crate) marched: Marched,
    /// Why it has ended early, if it has.
    pub(crate) reason: Option<String>,
    /// What the rows come to; why they cannot be read.
    pub(crate) made: io::Result<Summary>,
    /// The motions of whole bodies, if the case wants some; why they cannot be made.
    pub(crate) motions: Option<Result<Motions<'a>, String>>,
}

/// Runs a case that is built, from its start or from a point of an earlier run. `start`: when the work began.
///
/// # Errors
/// The march cannot begin, or is interrupted before its first step.
pub(crate) fn simulate<'a>(
    (case, built): (&Case, &'a Built),
    store: &mut dyn Store,
    from: Option<Point>,
    (watch, start): (&dyn Watch, Instant),
) -> Result<Simulated<'a>, Failure> {
    case.marched()?;
    let marched = march::march((case, built), store, from, watch)?;
    let time = times(built, &marched, start);
    let reason = marched.end.reason(marched.step, case.march().steps);
    let motions = Motions::read((case, built), || store.frames(), marched.step);
    let made = store.history().and_then(|history| {
        let converged = !matches!(marched.end, End::Diverged(_));
        let run = ((&marched.outcome, history), (marched.step, converged));
        let ended = (marched.verdict.clone(), reason.clone());
        let mut summary = Summary::new((case, built), run.0, run.1, time, ended)?;
        let read = motions.as_ref().and_then(|read| read.as_ref().ok());
        summary.stresses = read.map(Motions::largest).unwrap_or_default();
        Ok(summary)
    });
    Ok(Simulated { marched, reason, made, motions })
}

/// The march of a case that is built before its first step, and how it is marched, for programs that make the steps
/// themselves.
///
/// # Errors
/// No equilibrium, or no state that fits.
pub fn begin<'m>(case: &Case, built: &'m Built) -> Result<(March<'m>, MarchOptions), Failure> {
    let options = start::options(case, built);
    let march = start::begin((case, built), &options, None, &Quiet)?;
    Ok((march, options))
}

fn times(built: &Built, marched: &Marched, start: Instant) -> Times {
    let bodies = built.bodies.as_ref();
    Times {
        simulated_s: marched.time,
        reduction_wall_s: bodies.map_or(0.0, |bodies| bodies.wall),
        march_wall_s: marched.wall,
        total_wall_s: start.elapsed().as_secs_f64(),
        real_time_factor: marched.time / marched.wall,
        reduction_cached: bodies.is_some_and(|bodies| bodies.cached),
    }
}

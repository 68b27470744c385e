//! The march of a run, with its rows going to a store while it is under way.

use std::io;
use std::path::Path;
use std::time::Instant;

use whirl_solver::dynamics::{Checkpoint, LastState, March, Outcome};

use super::Watch;
use crate::case::Case;
use crate::checkpoint::Point;
use crate::errors::Failure;
use crate::history::{NotWritten, ReadHistory};
use crate::machine::Built;
use crate::report::VerdictFacts;
use crate::start;

/// Where rows go.
pub(crate) trait Store {
    /// The folder of results, if there is one.
    fn folder(&self) -> Option<&Path>;

    /// What cannot be done where rows cannot be kept.
    fn failing(&self) -> &'static str;

    /// Whether there is anything of this run yet.
    fn has_begun(&self) -> bool;

    /// Keeps the row of the last step, if it is one of those that are kept.
    ///
    /// # Errors
    /// It cannot be kept.
    fn record(&mut self, march: &March, every: usize) -> Result<(), NotWritten>;

    /// Whether it is time to keep a point to resume from.
    fn is_due(&self) -> bool;

    /// Keeps where the march is. `wall`: of the march so far (s).
    fn keep(&mut self, point: Checkpoint, wall: f64);

    /// Keeps what is left; gives a warning where no point to resume from could be kept.
    ///
    /// # Errors
    /// Not all rows could be kept.
    fn finish(&mut self) -> Result<Option<String>, NotWritten>;

    /// Keeps the state after the last step of a run that is sound or not; why it cannot.
    fn keep_last(&mut self, state: LastState, sound: bool) -> Option<String>;

    /// All rows, once the store has finished.
    ///
    /// # Errors
    /// They cannot be read.
    fn history(&mut self) -> io::Result<&dyn ReadHistory>;

    /// The states that were kept of a case that wants fields; read once.
    ///
    /// # Errors
    /// They cannot be read, in words.
    fn frames(&mut self) -> Result<Vec<u8>, String>;
}

/// How a march has ended.
pub(crate) enum End {
    /// All steps are done.
    Done,
    /// A step does not converge; why.
    Diverged(String),
    /// The user did not want to wait.
    Interrupted,
    /// The history cannot be kept; what cannot be done, and why.
    NotWritten(&'static str, String),
}

impl End {
    /// Why the march has ended early, if it has.
    pub(crate) fn reason(&self, step: usize, steps: usize) -> Option<String> {
        match self {
            End::Done => None,
            End::Diverged(reason) => Some(reason.clone()),
            End::Interrupted => Some(format!("interrupted after step {step} of {steps}")),
            End::NotWritten(what, reason) => {
                Some(format!("{what} after step {step} of {steps}: {reason}"))
            }
        }
    }
}

/// A march up to its end.
pub(crate) struct Marched {
    pub(crate) outcome: Outcome,
    pub(crate) verdict: VerdictFacts,
    /// Steps done, and the time that they take (s).
    pub(crate) step: usize,
    pub(crate) time: f64,
    pub(crate) end: End,
    /// Wall time, that of the runs before included where this one goes on (s).
    pub(crate) wall: f64,
    /// Why a point to resume from, or the last state, could not be kept, if it could not.
    pub(crate) warning: Option<String>,
}

/// Marches a case from its start or from a point of an earlier run. In a folder the first step that is done takes the
/// earlier run's files away.
///
/// # Errors
/// The march cannot begin, or is interrupted before its first step; results of earlier runs are as they were.
pub(super) fn march(
    (case, built): (&Case, &Built),
    store: &mut dyn Store,
    from: Option<Point>,
    watch: &dyn Watch,
) -> Result<Marched, Failure> {
    let options = start::options(case, built);
    // What it went on from is that of its start, whatever becomes of that meanwhile.
    let before = start::unsound(&case.start);
    let passed = from.as_ref().map_or(0.0, |point| point.wall);
    let mut march = match from {
        Some(point) => March::resume(&built.machine, &options, point.march)?,
        None => start::begin((case, built), &options, store.folder(), watch)?,
    };
    if let (Some(fields), true) = (&case.fields, case.run().goes_on) {
        fields.check_times([march.begun(), march.begun() + case.march().duration()])?;
    }
    watch.begun(options.steps, march.progress().step);
    let start = Instant::now();
    let end = loop {
        if march.is_done() {
            break End::Done;
        }
        if watch.asked() {
            break End::Interrupted;
        }
        if let Err(error) = march.advance() {
            break End::Diverged(error.to_string());
        }
        if let Err(NotWritten(reason)) = store.record(&march, case.march().output_every) {
            break End::NotWritten(store.failing(), reason);
        }
        if store.is_due() {
            store.keep(march.checkpoint(), passed + start.elapsed().as_secs_f64());
        }
        let progress = march.progress();
        watch.progressed(progress.step, progress.time);
    };
    let wall = passed + start.elapsed().as_secs_f64();
    watch.ended();
    let (step, time) = (march.progress().step, march.time() - march.begun());
    if !store.has_begun() && matches!(end, End::Interrupted) {
        let reason = format!("interrupted before the first step of {}", options.steps);
        return Err(Failure::Unfinished { reason, kept: None, help: None });
    }
    if matches!(end, End::Interrupted) {
        store.keep(march.checkpoint(), wall);
    }
    let state = matches!(end, End::Done).then(|| march.last_state());
    let outcome = march.outcome();
    let diverged = matches!(end, End::Diverged(_)).then_some([step, case.march().steps]);
    let verdict = VerdictFacts::new(
        (&built.machine, &case.supports()),
        &outcome,
        (case.march().time_step, case.march().automatic),
        (diverged, before.as_deref()),
    );
    let (end, warning) = match (store.finish(), end) {
        (Err(NotWritten(reason)), End::Done | End::Interrupted) => {
            (End::NotWritten(store.failing(), reason), None)
        }
        (finished, end) => (end, finished.ok().flatten()),
    };
    let warning = warning.or_else(|| store.keep_last(state?, verdict.sound));
    Ok(Marched { outcome, verdict, step, time, end, wall, warning })
}

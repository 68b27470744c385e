//! The march of a run: its rows go to disk while it is under way, with points to resume from.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use whirl_solver::dynamics::{Checkpoint, March, MarchOptions, Newmark, NewtonOptions, Outcome};
use whirl_solver::history::History;

use crate::case::Case;
use crate::checkpoint::{self, Identity, Point};
use crate::errors::Failure;
use crate::fields::{FRAMES, FrameWriter, Schedule};
use crate::history::{self, HistoryWriter, NotWritten};
use crate::machine::Built;
use crate::progress::{self, ProgressMode};
use crate::results::{CHECKPOINT, Results, STATE};
use crate::signals::Interruption;
use crate::start;

/// How a march has ended.
pub(crate) enum End {
    /// All steps are done.
    Done,
    /// A step does not converge; why.
    Diverged(String),
    /// The user did not want to wait.
    Interrupted,
    /// The history cannot be written; why.
    NotWritten(String),
}

impl End {
    /// Why the march has ended early, if it has.
    pub(crate) fn reason(&self, step: usize, steps: usize) -> Option<String> {
        match self {
            End::Done => None,
            End::Diverged(reason) => Some(reason.clone()),
            End::Interrupted => Some(format!("interrupted after step {step} of {steps}")),
            End::NotWritten(reason) => Some(format!(
                "cannot write `{}` after step {step} of {steps}: {reason}",
                history::NAME
            )),
        }
    }
}

/// A march up to its end.
pub(crate) struct Marched {
    pub(crate) outcome: Outcome,
    /// Steps done, and the time that they take (s).
    pub(crate) step: usize,
    pub(crate) time: f64,
    pub(crate) end: End,
    /// Wall time, that of the runs before included where this one goes on (s).
    pub(crate) wall: f64,
    /// Why a point to resume from could not be written, if it could not.
    pub(crate) warning: Option<String>,
}

/// Marches a case from its start or from a point of an earlier run. The first step that is done takes the earlier
/// run's files away.
///
/// # Errors
/// The march cannot begin, or is interrupted before its first step; results of earlier runs are as they were.
pub(crate) fn march(
    (case, built): (&Case, &Built),
    (results, identity): (&mut Results, Identity),
    from: Option<Point>,
    interruption: &Interruption,
    show: ProgressMode,
) -> Result<Marched, Failure> {
    let options = options(case, built);
    let names = History::for_machine(&built.machine).names().to_vec();
    let before = from.as_ref().map(|point| (point.history, point.wall));
    let mut march = match from {
        Some(point) => March::resume(&built.machine, &options, point.march)?,
        None => start::begin((case, built), &options, results.folder(), show)?,
    };
    let shown = progress::steps(show, options.steps, march.progress().step);
    let start = Instant::now();
    let passed = before.map_or(0.0, |(_, wall)| wall);
    let mut recorder = Recorder::new(results, identity, (names, before.map(|(length, _)| length)));
    recorder.schedule = Schedule::new(case);
    let end = loop {
        if march.is_done() {
            break End::Done;
        }
        if interruption.asked() {
            break End::Interrupted;
        }
        if let Err(error) = march.advance() {
            break End::Diverged(error.to_string());
        }
        if let Err(NotWritten(reason)) = recorder.record(&march, case.march.output_every) {
            break End::NotWritten(reason);
        }
        if recorder.is_due() {
            recorder.keep(march.checkpoint(), passed + start.elapsed().as_secs_f64());
        }
        let progress = march.progress();
        shown.done(progress.step, progress.time);
    };
    let wall = passed + start.elapsed().as_secs_f64();
    shown.clear();
    let (step, time) = (march.progress().step, march.time() - march.begun());
    if recorder.writer.is_none() && matches!(end, End::Interrupted) {
        let reason = format!("interrupted before the first step of {}", options.steps);
        return Err(Failure::Unfinished { reason, kept: None, help: None });
    }
    if matches!(end, End::Interrupted) {
        recorder.keep(march.checkpoint(), wall);
    }
    let state = matches!(end, End::Done).then(|| march.last_state());
    let state_path = recorder.results.path(STATE);
    let (end, warning) = match (recorder.finish(), end) {
        (Err(NotWritten(reason)), End::Done | End::Interrupted) => (End::NotWritten(reason), None),
        (finished, end) => (end, finished.ok().flatten()),
    };
    let warning = warning.or_else(|| {
        let written = start::write(&state_path, state.as_ref()?);
        let path = state_path.display();
        written.err().map(|error| format!("cannot write `{path}`: {error}"))
    });
    Ok(Marched { outcome: march.outcome(), step, time, end, wall, warning })
}

fn options(case: &Case, built: &Built) -> MarchOptions {
    MarchOptions {
        time_step: case.march.time_step,
        automatic: case.march.automatic,
        steps: case.march.steps,
        newmark: Newmark::default(),
        newton: NewtonOptions {
            force_tolerance: case.march.force_tolerance,
            ..NewtonOptions::default()
        },
        cycle: case.march.steady_cycle(),
        stop_when_steady: case.march.stop_when_steady,
        initial: built.initial.clone(),
    }
}

/// The history on its way to disk, with points from which the march can be resumed. The files of earlier runs are
/// there until it has its first row.
struct Recorder<'r> {
    results: &'r mut Results,
    identity: Arc<Identity>,
    /// Names of the columns; bytes of the history after which this one goes on, if it does.
    head: (Vec<String>, Option<u64>),
    writer: Option<HistoryWriter>,
    /// Which states are kept, until their file is open.
    schedule: Option<Schedule>,
    frames: Option<FrameWriter>,
    path: PathBuf,
    /// When the last point was kept.
    kept: Option<Instant>,
}

/// Time from one point to resume from to the next, at least: which of them are made changes nothing that is computed.
const BETWEEN_POINTS: Duration = Duration::from_secs(1);

impl<'r> Recorder<'r> {
    fn new(results: &'r mut Results, identity: Identity, head: (Vec<String>, Option<u64>)) -> Self {
        let path = results.path(CHECKPOINT);
        Recorder {
            results,
            identity: Arc::new(identity),
            head,
            writer: None,
            schedule: None,
            frames: None,
            path,
            kept: None,
        }
    }

    /// The history, begun or gone on with.
    fn writer(&mut self) -> Result<&mut HistoryWriter, NotWritten> {
        if self.writer.is_none() {
            let path = self.results.path(history::NAME);
            let (names, length) = &self.head;
            let kept: &[&str] =
                if length.is_some() { &[history::NAME, CHECKPOINT, FRAMES] } else { &[] };
            let opened = self.results.begin(kept).and_then(|()| match *length {
                Some(length) => HistoryWriter::go_on(&path, length, names.len()),
                None => HistoryWriter::create(&path, names),
            });
            self.writer = Some(opened.map_err(|error| NotWritten(error.to_string()))?);
            if let Some(schedule) = self.schedule.take() {
                let path = self.results.path(FRAMES);
                let opened = FrameWriter::open(&path, schedule, length.is_some());
                self.frames = Some(opened.map_err(|error| NotWritten(error.to_string()))?);
            }
        }
        Ok(self.writer.as_mut().expect("it was just opened"))
    }

    /// Writes the row of the last step, if it is one of those that are kept.
    fn record(&mut self, march: &March, every: usize) -> Result<(), NotWritten> {
        self.writer()?;
        if let Some(frames) = &mut self.frames {
            let step = march.progress().step as u64;
            let written = frames.record(step, march.time(), &march.state().q);
            written.map_err(|error| NotWritten(error.to_string()))?;
        }
        let writer = self.writer()?;
        match march.progress().step.is_multiple_of(every) {
            true => writer.push(march.row()),
            false => Ok(()),
        }
    }

    /// Whether it is time to keep a point again.
    fn is_due(&self) -> bool {
        self.kept.is_none_or(|kept| kept.elapsed() >= BETWEEN_POINTS)
    }

    /// Keeps where the march is. `wall`: of the march so far (s).
    fn keep(&mut self, point: Checkpoint, wall: f64) {
        self.kept = Some(Instant::now());
        if let Some(writer) = &mut self.writer {
            let (path, identity) = (self.path.clone(), self.identity.clone());
            writer.keep(Box::new(move |length| {
                checkpoint::write(&path, &identity, length, (point, wall))
            }));
        }
    }

    /// Writes what is left; gives a warning where no point to resume from could be written. A march without a first
    /// step leaves the names of its columns.
    fn finish(mut self) -> Result<Option<String>, NotWritten> {
        self.writer()?;
        let checkpoint_error = self.writer.take().map_or(Ok(None), HistoryWriter::finish)?;
        let path = self.path.display();
        Ok(checkpoint_error.map(|reason| format!("cannot write `{path}`: {reason}")))
    }
}

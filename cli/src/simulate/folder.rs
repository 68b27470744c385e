//! A run whose rows go to a folder of results, with points from which the march can be resumed.

use std::fs;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use whirl_solver::dynamics::{Checkpoint, LastState, March};
use whirl_solver::history::History;

use super::march::Store;
use crate::case::Case;
use crate::checkpoint::{self, Identity, Point};
use crate::fields::{FRAMES, FrameWriter, Schedule};
use crate::history::{self, Groups, HistoryFile, HistoryWriter, NotWritten, ReadHistory};
use crate::machine::Built;
use crate::results::{CHECKPOINT, Results, STATE};
use crate::start;

/// The history on its way to disk. The files of earlier runs are there until it has its first row.
pub(crate) struct FolderStore<'r> {
    results: &'r mut Results,
    identity: Arc<Identity>,
    /// Names of the columns; bytes of the history after which this one goes on, if it does.
    head: (Vec<String>, Option<u64>),
    writer: Option<HistoryWriter>,
    /// After how many rows all are kept with all their digits, too, if they are.
    keeping: Option<u64>,
    /// The whole history, once it is read.
    written: Option<HistoryFile>,
    /// Which states are kept, until their file is open.
    schedule: Option<Schedule>,
    frames: Option<FrameWriter<File>>,
    path: PathBuf,
    /// When the last point was kept.
    kept: Option<Instant>,
}

/// Time from one point to resume from to the next, at least: which of them are made changes nothing that is computed.
const BETWEEN_POINTS: Duration = Duration::from_secs(1);

impl<'r> FolderStore<'r> {
    /// For a run that begins, or goes on from a point of the one in the folder.
    pub(crate) fn new(
        (case, built): (&Case, &Built),
        results: &'r mut Results,
        identity: Identity,
        from: Option<&Point>,
    ) -> Self {
        let names = History::for_machine(&built.machine).names().to_vec();
        let path = results.path(CHECKPOINT);
        FolderStore {
            results,
            identity: Arc::new(identity),
            head: (names, from.map(|point| point.history.length)),
            writer: None,
            keeping: None,
            written: None,
            schedule: Schedule::new(case),
            frames: None,
            path,
            kept: None,
        }
    }

    /// With all digits of the rows beside the history, if that is wanted: after how many that are there.
    pub(crate) fn keeping(self, rows: Option<u64>) -> Self {
        FolderStore { keeping: rows, ..self }
    }

    /// The history, begun or gone on with.
    fn writer(&mut self) -> Result<&mut HistoryWriter, NotWritten> {
        if self.writer.is_none() {
            let path = self.results.path(history::NAME);
            let (names, length) = &self.head;
            let all = [history::NAME, CHECKPOINT, FRAMES, history::PART, history::REST];
            let kept: &[&str] = match (length, self.keeping) {
                (None, _) => &[],
                (Some(_), None) => &all[..3],
                (Some(_), Some(_)) => &all,
            };
            let opened = self.results.begin(kept).and_then(|()| {
                let (folder, columns) = (self.results.folder(), names.len());
                let writer = match *length {
                    Some(length) => HistoryWriter::go_on(&path, length, columns)?,
                    None => HistoryWriter::create(&path, names)?,
                };
                Ok(match (self.keeping, length) {
                    (None, _) => writer,
                    (Some(_), None) => writer.beside(Groups::create(folder, columns)?),
                    (Some(rows), Some(_)) => writer.beside(Groups::go_on(folder, columns, rows)?),
                })
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
}

impl Store for FolderStore<'_> {
    fn folder(&self) -> Option<&Path> {
        Some(self.results.folder())
    }

    fn failing(&self) -> &'static str {
        match self.keeping {
            None => "cannot write `history.csv`",
            Some(_) => "cannot write the history",
        }
    }

    fn has_begun(&self) -> bool {
        self.writer.is_some()
    }

    fn record(&mut self, march: &March, every: usize) -> Result<(), NotWritten> {
        self.writer()?;
        if let Some(frames) = &mut self.frames {
            let written = frames.record(march);
            written.map_err(|error| NotWritten(error.to_string()))?;
        }
        let writer = self.writer()?;
        match march.progress().step.is_multiple_of(every) {
            true => writer.push(march.row()),
            false => Ok(()),
        }
    }

    fn is_due(&self) -> bool {
        self.kept.is_none_or(|kept| kept.elapsed() >= BETWEEN_POINTS)
    }

    fn keep(&mut self, point: Checkpoint, wall: f64) {
        self.kept = Some(Instant::now());
        if let Some(writer) = &mut self.writer {
            let (path, identity) = (self.path.clone(), self.identity.clone());
            writer.keep(Box::new(move |written| {
                checkpoint::write(&path, &identity, written, (point, wall))
            }));
        }
    }

    /// A march without a first step leaves the names of its columns.
    fn finish(&mut self) -> Result<Option<String>, NotWritten> {
        self.writer()?;
        let checkpoint_error = self.writer.take().map_or(Ok(None), HistoryWriter::finish)?;
        let path = self.path.display();
        Ok(checkpoint_error.map(|reason| format!("cannot write `{path}`: {reason}")))
    }

    fn keep_last(&mut self, state: LastState, sound: bool) -> Option<String> {
        let path = self.results.path(STATE);
        let written = start::write(&path, &state, sound);
        written.err().map(|error| format!("cannot write `{}`: {error}", path.display()))
    }

    fn history(&mut self) -> io::Result<&dyn ReadHistory> {
        let path = self.results.path(history::NAME);
        Ok(self.written.insert(HistoryFile::of_run(&path, &self.head.0)?))
    }

    fn frames(&mut self) -> Result<Vec<u8>, String> {
        let path = self.results.path(FRAMES);
        fs::read(&path).map_err(|error| format!("cannot read `{}`: {error}", path.display()))
    }
}

//! A run whose rows stay in memory: nothing is written to disk, and the numbers are those of a run in a folder.

use std::cell::RefCell;
use std::io::{self, Cursor};
use std::path::Path;
use std::time::Instant;

use whirl_solver::dynamics::{Checkpoint, LastState, March};
use whirl_solver::history::History;

use super::march::Store;
use super::{End, Simulated, Watch, simulate};
use crate::case::Case;
use crate::errors::Failure;
use crate::fields::{FrameWriter, Schedule};
use crate::history::{HistoryTable, NotWritten, ReadHistory};
use crate::machine::Built;
use crate::start;

/// What a run in memory leaves.
#[derive(Debug, Clone)]
pub struct InMemory {
    /// The rows.
    pub history: HistoryTable,
    /// summary.json: numbers of the run, and the verdict on it.
    pub summary: String,
    /// state.bin, from which other runs can start; none where the run did not come to its end.
    pub state: Option<Vec<u8>>,
    /// Why the march ended early, if it did: an interruption, or a step that does not converge.
    pub reason: Option<String>,
    /// Whether it was interrupted.
    pub interrupted: bool,
    /// Whether it came to a steady state, in words.
    pub steady: String,
    /// What may be wrong with it, beside the verdict.
    pub warnings: Vec<String>,
    /// What is to be known of its start.
    pub notes: Vec<String>,
}

/// Runs a case in memory. What [`Watch::warn`] and [`Watch::note`] hear is returned, too.
///
/// # Errors
/// The march cannot begin, or is interrupted before its first step.
pub fn in_memory(case: &Case, built: &Built, watch: &dyn Watch) -> Result<InMemory, Failure> {
    Ok(summed_up(case, built, watch)?.0)
}

/// As [`in_memory`], with the summary as a value: its numbers to the bit.
///
/// # Errors
/// As there.
pub(crate) fn summed_up(
    case: &Case,
    built: &Built,
    watch: &dyn Watch,
) -> Result<(InMemory, serde_json::Value), Failure> {
    let start = Instant::now();
    let kept = Kept { watch, warnings: RefCell::default(), notes: RefCell::default() };
    let mut store = TableStore::new(case, built);
    let Simulated { marched, reason, made, motions } =
        simulate((case, built), &mut store, None, (&kept, start))?;
    let unfinished = |error: io::Error| Failure::Unfinished {
        reason: format!("no summary: {error}"),
        kept: None,
        help: None,
    };
    let summary = made.map_err(unfinished)?;
    let mut warnings = kept.warnings.take();
    warnings.extend(marched.warning);
    match motions {
        Some(Err(problem)) => warnings.push(problem),
        Some(Ok(own)) => warnings.extend(own.without_frames().map(str::to_owned)),
        None => {}
    }
    let facts = serde_json::to_value(&summary).expect("the keys of a summary are strings");
    let run = InMemory {
        history: store.table,
        state: store.last,
        summary: summary.json(),
        steady: summary.steadiness(case.march()),
        reason,
        interrupted: matches!(marched.end, End::Interrupted),
        warnings,
        notes: kept.notes.take(),
    };
    Ok((run, facts))
}

/// Keeps what there is to say, and says it to another one.
struct Kept<'w> {
    watch: &'w dyn Watch,
    warnings: RefCell<Vec<String>>,
    notes: RefCell<Vec<String>>,
}

impl Watch for Kept<'_> {
    fn begun(&self, steps: usize, first: usize) {
        self.watch.begun(steps, first);
    }

    fn progressed(&self, step: usize, time: f64) {
        self.watch.progressed(step, time);
    }

    fn ended(&self) {
        self.watch.ended();
    }

    fn asked(&self) -> bool {
        self.watch.asked()
    }

    fn note(&self, words: &str) {
        self.notes.borrow_mut().push(words.to_owned());
        self.watch.note(words);
    }

    fn warn(&self, words: &str) {
        self.warnings.borrow_mut().push(words.to_owned());
        self.watch.warn(words);
    }
}

/// Rows and frames in memory.
struct TableStore {
    table: HistoryTable,
    frames: Option<FrameWriter<Cursor<Vec<u8>>>>,
    last: Option<Vec<u8>>,
    begun: bool,
}

impl TableStore {
    fn new(case: &Case, built: &Built) -> Self {
        let names = History::for_machine(&built.machine).names().to_vec();
        let frames = Schedule::new(case).map(FrameWriter::in_memory);
        TableStore { table: HistoryTable::new(names), frames, last: None, begun: false }
    }
}

impl Store for TableStore {
    fn folder(&self) -> Option<&Path> {
        None
    }

    fn failing(&self) -> &'static str {
        "cannot keep the history in memory"
    }

    fn has_begun(&self) -> bool {
        self.begun
    }

    fn record(&mut self, march: &March, every: usize) -> Result<(), NotWritten> {
        self.begun = true;
        let step = march.progress().step;
        if let Some(frames) = &mut self.frames {
            let written = frames.record(march);
            written.map_err(|error| NotWritten(error.to_string()))?;
        }
        if step.is_multiple_of(every) {
            self.table.push(march.row()).map_err(|error| NotWritten(error.to_string()))?;
        }
        Ok(())
    }

    /// Nothing is there after the end of the process from which it could be resumed.
    fn is_due(&self) -> bool {
        false
    }

    fn keep(&mut self, _: Checkpoint, _: f64) {}

    fn finish(&mut self) -> Result<Option<String>, NotWritten> {
        Ok(None)
    }

    fn keep_last(&mut self, state: LastState, sound: bool) -> Option<String> {
        let packed = start::packed(&state, sound);
        let failed =
            packed.as_ref().err().map(|error| format!("cannot keep the last state: {error}"));
        self.last = packed.ok();
        failed
    }

    fn history(&mut self) -> io::Result<&dyn ReadHistory> {
        Ok(&self.table)
    }

    fn frames(&mut self) -> Result<Vec<u8>, String> {
        Ok(self.frames.take().map(FrameWriter::into_bytes).unwrap_or_default())
    }
}

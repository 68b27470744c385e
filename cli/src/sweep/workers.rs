//! The points of a sweep on all cores, one point a core, and their rows on the way to disk.

use std::collections::BTreeSet;
use std::num::NonZero;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

use whirl_solver::cache::{Cache, Key};

use super::definition::Sweep;
use super::folder::SweepFolder;
use super::journal::{self, Journal};
use super::kept::Kept;
use super::point::{self, Done, Undone};
use super::row::{Row, Verdict};
use crate::checkpoint::Identity;
use crate::progress::{PointsShown, ProgressMode};
use crate::signals::Interruption;
use crate::watch::Watch;

/// How the work on a sweep has ended.
pub(super) struct Ended {
    /// Whether there is a journal of it.
    pub(super) begun: bool,
    /// Why points are left, if there are some.
    pub(super) stopped: Option<String>,
    /// Each once.
    pub(super) warnings: BTreeSet<String>,
}

/// Most rows that are written at once.
const BATCH: usize = 256;
/// How often progress is shown.
const PAUSE: Duration = Duration::from_millis(100);

/// A row on its way to the journal.
struct Sent {
    number: usize,
    point: Key,
    done: Done,
}

/// Points at a time where nothing says otherwise.
pub(super) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Runs all points that `kept` does not have. What is done is on disk when it counts as done.
pub(super) fn run(
    (sweep, identity): (&Sweep, &Identity),
    results: &mut SweepFolder,
    kept: Option<Kept>,
    (cache, jobs): (&Cache, usize),
    (show, interruption): (ProgressMode, &Interruption),
) -> Ended {
    let mut ended = Ended { begun: false, stopped: None, warnings: BTreeSet::new() };
    let opened = results.begin(kept.is_some()).and_then(|()| match &kept {
        Some(kept) => kept.journal(results),
        None => Journal::create(&results.path(journal::NAME)),
    });
    let mut journal = match opened.and_then(|mut journal| journal.begin(identity).map(|()| journal))
    {
        Ok(journal) => journal,
        Err(error) => {
            ended.stopped = Some(not_written(&results.path(journal::NAME), &error.to_string()));
            return ended;
        }
    };
    ended.begun = true;
    let shown = PointsShown::new(show, sweep.count(), kept.as_ref().map_or(0, Kept::done), jobs);
    let (stop, next) = (Arc::new(AtomicBool::new(false)), AtomicUsize::new(0));
    let chains = sweep.chains();
    let workers = jobs.min(chains).max(1);
    // Analyses have threads of their own where there are fewer points at a time than processors.
    let threads = NonZero::new(cores() / workers).unwrap_or(NonZero::<usize>::MIN);
    let interruption = &interruption.or_by(stop.clone());
    let results = &*results;
    thread::scope(|scope| {
        let (sender, receiver) = sync_channel(BATCH);
        for worker in 0..workers {
            let (sender, next, kept, shown) = (sender.clone(), &next, kept.as_ref(), &shown);
            scope.spawn(move || {
                let watch = Stop { interruption, shown, worker, threads };
                loop {
                    let chain = next.fetch_add(1, Ordering::Relaxed);
                    if chain >= chains || watch.asked() {
                        return;
                    }
                    if follow((sweep, chain), kept, (cache, results), &sender, &watch).is_break() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        let all = (&shown, &mut ended.warnings, &*stop);
        let written = keep_rows((sweep, results), &mut journal, &receiver, all);
        if let Err(reason) = written {
            ended.stopped = Some(reason);
            stop.store(true, Ordering::Relaxed);
            // Workers must not wait for someone who takes their rows.
            receiver.iter().for_each(drop);
        }
    });
    shown.end();
    if ended.stopped.is_none() && !interruption.asked() {
        results.forget_states();
    }
    if ended.stopped.is_none() && interruption.asked() {
        ended.stopped = Some("interrupted".to_owned());
    }
    ended
}

/// Runs the points of a chain that are not done, one after the other.
fn follow(
    (sweep, chain): (&Sweep, usize),
    kept: Option<&Kept>,
    (cache, results): (&Cache, &SweepFolder),
    sender: &SyncSender<Result<Sent, String>>,
    watch: &Stop,
) -> std::ops::ControlFlow<()> {
    use std::ops::ControlFlow::{Break, Continue};
    let first = chain * sweep.chain();
    let is_done = |number: &usize| kept.is_some_and(|kept| kept.has(*number));
    let points: Vec<(usize, Key)> = (first..).zip(sweep.identities(chain)).collect();
    let mut passed = points.iter().take_while(|(number, _)| is_done(number)).count();
    let mut state = None;
    if passed > 0 && passed < points.len() {
        match results.state(points[passed - 1]) {
            Some(kept) => state = kept,
            // Without it all points of the chain are run once more, to the state that they end in.
            None => passed = 0,
        }
    }
    // The last point before that came to its end.
    let ended =
        |number: &usize| is_done(number) && !kept.is_some_and(|own| own.has_failed(*number));
    let mut last = (first..first + passed).rev().find(ended);
    for &(number, key) in &points[passed..] {
        let point = sweep.point(number);
        let beside = (number > first && last != Some(number - 1)).then(|| goes_on_from(last));
        watch.shown.begun(watch.worker);
        let analysed = (watch.interruption, watch.threads);
        let from = state.as_deref();
        let mut done =
            match point::run((sweep, &point, key), from, (cache, results), (watch, analysed)) {
                Ok(done) => done,
                Err(Undone::Interrupted) => return Break(()),
                Err(Undone::NotKept(reason)) => {
                    let _ = sender.send(Err(reason));
                    return Break(());
                }
            };
        if done.state.is_some() {
            last = Some(number);
        }
        if let Some(words) = beside {
            done.warnings.push(format!("point {number} {words}"));
            done.row.remark(&words);
        }
        if sweep.chain() > 1 {
            // The next one goes on from the last point that came to its end.
            state = done.state.take().or(state);
            if let Err(reason) = results.keep_state((number, key), state.as_deref()) {
                let _ = sender.send(Err(reason));
                return Break(());
            }
        }
        if is_done(&number) {
            continue;
        }
        done.state = None;
        if sender.send(Ok(Sent { number, point: key, done })).is_err() {
            return Break(());
        }
    }
    Continue(())
}

/// How a point begins that does not go on from the one before it.
fn goes_on_from(last: Option<usize>) -> String {
    match last {
        Some(number) => format!(
            "continues from point {number}, because the points between failed: it may be on another branch of solutions"
        ),
        None => "starts as the case says, because the points before it failed".to_owned(),
    }
}

/// Writes rows as they come, as many at once as there are. A point that cannot be kept stops the others, whose rows are kept.
///
/// # Errors
/// Something cannot be written, in words.
fn keep_rows(
    (sweep, results): (&Sweep, &SweepFolder),
    journal: &mut Journal,
    receiver: &Receiver<Result<Sent, String>>,
    (shown, warnings, stop): (&PointsShown, &mut BTreeSet<String>, &AtomicBool),
) -> Result<(), String> {
    let mut not_kept = None;
    loop {
        let first = match receiver.recv_timeout(PAUSE) {
            Ok(first) => first,
            Err(RecvTimeoutError::Timeout) => {
                shown.update();
                continue;
            }
            Err(RecvTimeoutError::Disconnected) => return not_kept.map_or(Ok(()), Err),
        };
        let (mut rows, mut numbers): (Vec<(Key, Vec<String>, Row)>, Vec<usize>) =
            Default::default();
        for sent in std::iter::once(first).chain(receiver.try_iter().take(BATCH)) {
            let Sent { number, point, done } = match sent {
                Ok(sent) => sent,
                Err(reason) => {
                    stop.store(true, Ordering::Relaxed);
                    not_kept.get_or_insert(reason);
                    continue;
                }
            };
            shown.done(done.row.verdict != Verdict::Sound);
            warnings.extend(done.warnings);
            rows.push((point, done.names, done.row));
            numbers.push(number);
        }
        let added = journal.add(rows);
        added.map_err(|error| not_written(&results.path(journal::NAME), &error.to_string()))?;
        for number in numbers {
            // The state before a point that is on disk is needed no more, nor is that after the last.
            let place = number % sweep.chain();
            if place > 0 {
                results.forget_state(number - 1);
            }
            if place + 1 == sweep.chain() && sweep.chain() > 1 {
                results.forget_state(number);
            }
        }
        shown.update();
    }
}

fn not_written(path: &Path, reason: &str) -> String {
    format!("cannot write `{}`: {reason}", path.display())
}

/// Ends a point where the user wants that, or another one cannot be kept.
struct Stop<'s> {
    interruption: &'s Interruption,
    shown: &'s PointsShown,
    worker: usize,
    /// Of an analysis.
    threads: NonZero<usize>,
}

impl Watch for Stop<'_> {
    fn begun(&self, steps: usize, _: usize) {
        self.shown.steps(self.worker, steps);
    }

    fn progressed(&self, step: usize, _: f64) {
        self.shown.step(self.worker, step);
    }

    fn asked(&self) -> bool {
        self.interruption.asked()
    }
}

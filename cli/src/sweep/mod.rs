//! `whirl sweep`: a case at many points, on all cores, with a row a point in a table.

mod axis;
mod check;
mod column;
mod definition;
mod examine;
mod figures;
mod files;
mod folder;
mod histories;
mod identity;
mod journal;
mod kept;
mod point;
mod points;
mod random;
mod read;
mod row;
mod schema;
mod table;
mod trace;
mod vary;
mod workers;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use whirl_solver::cache::Cache;

pub(crate) use self::check::check;
use self::column::Column;
pub use self::definition::Sweep;
use self::examine::examine;
use self::folder::SweepFolder;
use self::kept::Kept;
pub use self::points::Point;
pub(crate) use self::read::is_sweep;
use self::table::Counts;
use self::workers::Ended;
use crate::errors::Failure;
use crate::page::{self, SweepFacts};
use crate::progress::{self, ProgressMode};
use crate::results::{REPORT, SWEEP};
use crate::signals::Interruption;
use crate::streams;

/// What the command is asked for.
pub(crate) struct Order<'a> {
    /// A sweep file, or a case with what varies of it.
    pub(crate) file: &'a str,
    pub(crate) vary: &'a [String],
    /// Names of analyses in place of runs.
    pub(crate) analyses: &'a [String],
    /// Folder of the results; one by the name of the sweep if there is none.
    pub(crate) out: Option<&'a Path>,
    pub(crate) figures: bool,
    pub(crate) report: bool,
    /// Points at a time; as many as there are cores if there is none.
    pub(crate) jobs: Option<NonZeroUsize>,
    pub(crate) resume: bool,
    pub(crate) quiet: bool,
    pub(crate) cache: Option<Cache>,
}

/// The points of a sweep file in their order, the last key varying fastest.
///
/// # Errors
/// As [`Sweep::of_file`].
pub fn points(path: &Path) -> Result<Vec<Point>, Failure> {
    Ok(Sweep::of_file(path)?.points().collect())
}

/// Runs a sweep: read, examine, run what is not done, tabulate. What was done is kept however it ends.
///
/// # Errors
/// Bad input, a folder that cannot be written, or a sweep that does not come to its end.
pub(crate) fn sweep(order: &Order) -> Result<(), Failure> {
    let show = ProgressMode::fitting(order.quiet);
    let sweep = asked(order)?;
    let jobs = jobs(order);
    let interruption = Interruption::install().map_err(|error| Failure::Output {
        path: folder(order, &sweep),
        reason: format!("signal handlers cannot be installed: {error}"),
    })?;
    let stop = || interruption.asked();
    let identity = streams::warned(|warnings| examine(&sweep, jobs, &stop, warnings))?;
    let mut results =
        streams::warned(|warnings| SweepFolder::open(&folder(order, &sweep), warnings))?;
    let mut kept = match order.resume {
        true => Kept::resumed(&results, &sweep, &identity)?,
        false => None,
    };
    if order.resume {
        let lost = kept.as_mut().map_or(Ok(0), |kept| kept.without_histories(&results, &sweep));
        let lost = lost
            .map_err(|reason| Failure::Output { path: results.folder().to_path_buf(), reason })?;
        show.note(&kept::going_on(kept.as_ref(), lost, &results, &sweep));
    }
    let cache = Cache::shared(order.cache.clone());
    let ended = workers::run(
        (&sweep, &identity),
        &mut results,
        kept,
        (&cache, jobs),
        (show, &interruption),
    );
    report((&sweep, order), &results, ended, (show, &interruption))
}

/// The sweep that the command line asks for.
///
/// # Errors
/// Everything that is wrong with it.
fn asked(order: &Order) -> Result<Sweep, Failure> {
    let name = order.file;
    if let (true, [_, ..]) = (is_sweep(name), order.analyses) {
        return Err(Failure::Argument {
            message: format!("`{name}` says itself what is done at its points"),
            help: "add a line such as `analyse = [\"stability\"]` to it".to_owned(),
        });
    }
    match (is_sweep(name), order.vary) {
        (true, []) => Sweep::of_file(Path::new(name)),
        (true, _) => Err(Failure::Argument {
            message: format!("both `{name}` and `--vary` say what varies"),
            help: "change its `[vary]`, or name a case in place of it".to_owned(),
        }),
        (false, []) => read::of_no_sweep(name),
        (false, varied) => read::of_arguments(name, varied, order.analyses),
    }
}

fn jobs(order: &Order) -> usize {
    order.jobs.map_or_else(workers::cores, usize::from)
}

fn folder(order: &Order, sweep: &Sweep) -> PathBuf {
    let usual = || Path::new("results").join(&sweep.name);
    order.out.map_or_else(usual, Path::to_path_buf)
}

/// Writes the table of all that is done and, once that is all there is to do, the figures; says how the sweep has ended.
fn report(
    (sweep, order): (&Sweep, &Order),
    results: &SweepFolder,
    ended: Ended,
    (show, interruption): (ProgressMode, &Interruption),
) -> Result<(), Failure> {
    let unfinished = |reason: String| Failure::Unfinished {
        reason,
        kept: None,
        help: Some("run the same command with `--resume` to continue".to_owned()),
    };
    let Ended { begun, stopped, warnings } = ended;
    if !begun {
        let reason = stopped.unwrap_or_else(|| "nothing was begun".to_owned());
        return Err(Failure::Unfinished { reason, kept: None, help: None });
    }
    warnings.iter().for_each(streams::warn);
    let folder = results.folder().display();
    let read = Kept::read(results, sweep);
    let done = read.as_ref().map_or(0, Kept::done);
    let tabulated = read.and_then(|mut kept| {
        let counts = table::write(sweep, &mut kept, results)?;
        Ok((kept, counts))
    });
    let lacks = || format!("`{}` was changed while the sweep was at work", journal::NAME);
    let stopped = stopped
        .or_else(|| (tabulated.is_ok() && done < sweep.count()).then(lacks))
        .map(|reason| format!("{reason}; {done} of {} points are kept in {folder}", sweep.count()));
    let (mut kept, counts) = match (stopped, tabulated) {
        (None, Ok(found)) => found,
        (None, Err(reason)) => return Err(unfinished(reason)),
        (Some(reason), tabulated) => {
            // Of what is done there is a page, too.
            let told = tabulated.and_then(|(_, counts)| {
                let far = format!("{done} of {} points are done", sweep.count());
                tell((sweep, order), (&counts, Some(far)), results)
            });
            told.err().iter().for_each(streams::warn);
            return Err(unfinished(reason));
        }
    };
    if order.figures {
        let write = |name: &str, content: &[u8]| results.write(name, content);
        let stop = || interruption.asked();
        let draw = || figures::draw(sweep, &mut kept, &write, &stop);
        let mut missing = progress::during(show, "drawing figures", draw).into_iter();
        if let Some(reason) = missing.next() {
            missing.for_each(streams::warn);
            return Err(unfinished(reason));
        }
    }
    tell((sweep, order), (&counts, None), results).map_err(unfinished)?;
    match show {
        ProgressMode::Nothing => Ok(()),
        _ => streams::say(&format!(
            "{}: {done} {}\n{}results in {folder}\n",
            sweep.name,
            if done == 1 { "point" } else { "points" },
            counts.words()
        )),
    }
}

/// Writes what the sweep was, and the page that tells of it; `far`: how much of it is done, if not all.
///
/// # Errors
/// Why not, with the path.
fn tell(
    (sweep, order): (&Sweep, &Order),
    (counts, far): (&Counts, Option<String>),
    results: &SweepFolder,
) -> Result<(), String> {
    let counts = counts.words();
    let remarks: Vec<String> = far.into_iter().chain(counts.lines().map(str::to_owned)).collect();
    let facts = SweepFacts::new(
        (&sweep.name, &sweep.title),
        (check::varied(sweep), remarks),
        sweep.keys.iter().map(|own| Column::of(own).head).collect(),
    );
    results.write(SWEEP, facts.json().as_bytes())?;
    if order.report {
        results.write(REPORT, page::made(results.folder())?.as_bytes())?;
    }
    Ok(())
}

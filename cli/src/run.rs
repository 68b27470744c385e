//! `whirl run`: a case from its file to its results.
//!
//! The stops of a case on the way from text to history.csv:
//!
//! 1. [`crate::case`]: text → [`Case`]. Files are read with those that they include into one tree of values that know where
//!    they stand; each key is read through its declaration, in SI, and all errors are reported at once. The short form
//!    of a machine becomes the same value as named bodies and joints.
//! 2. [`machine::plan`]: the meshes are read or made, the sets that the case names are found in them, journals and bores
//!    are measured and compared, and laws get what they take from their bearings. Nothing is solved yet.
//! 3. [`machine::build`]: the plan becomes the solver's model, with where the case says each of its parts, so that
//!    an error of the solver is reported at the user's own words; bodies are reduced, or found in the cache, and joined.
//! 4. [`crate::start`]: the state from which it begins: at rest, in equilibrium, or as another run ended; on `--resume` that of
//!    the checkpoint.
//! 5. [`crate::simulate`]: the march. Each row goes to a store, here a locked folder: the writer's own thread brings whole
//!    lines to history.csv, and about once a second a checkpoint is written that names the rows before it.
//! 6. [`crate::report`], [`crate::figures`], [`crate::fields`]: the rows are read again from the store, and summary, tables and
//!    figures made of them; the verdict comes from what the march measured of its own steps.
//! 7. [`crate::page`]: report.html, of what is in the folder then.

use std::io;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::Builder;
use std::time::{Duration, Instant};

use whirl_solver::history::History;

use crate::arguments::{CacheArguments, RunArguments};
use crate::case::Case;
use crate::checkpoint::{self, Identity};
use crate::errors::Failure;
use crate::history::HistoryFile;
use crate::machine::{self, Built};
use crate::other_files::About as AboutFiles;
use crate::page::{About, FilmMaps};
use crate::progress::{self, ProgressMode, Terminal};
use crate::report::{Summary, of_orders, stops, supports};
use crate::results::{ABOUT, FILMS, REPORT, Results, SHAPES, SUMMARY};
use crate::signals::Interruption;
use crate::simulate::{End, FolderStore, Simulated, simulate};
use crate::told::Told;
use crate::{fields, figures, history, page, streams};

/// How often a run that is being built looks for an interruption.
const PAUSE: Duration = Duration::from_millis(20);
/// Of the thread that builds it (bytes): as much as that of a program.
const STACK: usize = 8 << 20;

/// Runs a case: read, build, march, report. What was computed is kept however the run ends; the history is on disk
/// before anything is made of it.
///
/// # Errors
/// Bad input, a folder that cannot be written, or a run that does not come to its end.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let start = Instant::now();
    let show = ProgressMode::fitting(arguments.quiet);
    let case = streams::warned(|warnings| machine::read(&arguments.case, warnings))?;
    case.marched()?;
    let files = arguments.other_files;
    let folder = folder(arguments, &case);
    let mut results = streams::warned(|warnings| Results::open(&folder, warnings))?;
    let interruption = Interruption::install().map_err(|error| Failure::Output {
        path: results.folder().to_path_buf(),
        reason: format!("signal handlers cannot be installed: {error}"),
    })?;
    let (built, told) = build(&case, &arguments.cache, (show, &interruption))?;
    let identity = Identity::of(&case, &built);
    let from = match arguments.resume {
        true => checkpoint::read(&results, &identity)?,
        false => None,
    };
    if arguments.resume {
        show.note(&match &from {
            Some(point) => format!("resuming after step {}", point.march.step()),
            None => {
                format!(
                    "no checkpoint in {}: starting from the beginning",
                    results.folder().display()
                )
            }
        });
    }
    let names = History::for_machine(&built.machine).names().to_vec();
    let kept = match &from {
        Some(point) if files.any() => files.gone_on_with(&results, &names, point)?,
        _ => 0,
    };
    let own = identity.clone();
    let store = FolderStore::new((&case, &built), &mut results, own, from.as_ref());
    let mut store = store.keeping(files.any().then_some(kept));
    let terminal = Terminal::new(show, &interruption);
    let simulated = simulate((&case, &built), &mut store, from, (&terminal, start))?;
    drop(store);
    results.free_room();
    simulated.marched.warning.iter().for_each(streams::warn);
    let both = (&results, &identity);
    report(arguments, (&case, &built, told), both, (simulated, &interruption), show)
}

fn folder(arguments: &RunArguments, case: &Case) -> PathBuf {
    let usual = || Path::new("results").join(&case.name);
    arguments.out.clone().unwrap_or_else(usual)
}

/// Reads meshes and reduces bodies, on a thread of its own: an interruption does not wait for it. Says what the case is, too.
fn build(
    case: &Case,
    arguments: &CacheArguments,
    (show, interruption): (ProgressMode, &Interruption),
) -> Result<(Built, Told), Failure> {
    let cache = arguments.open();
    let (own, (sender, receiver)) = (case.clone(), channel());
    let work = move || {
        let mut warnings = Vec::new();
        let built = machine::plan(&own, &mut warnings).and_then(|plan| {
            let built = machine::build(&own, &plan, cache.as_ref(), &mut warnings)?;
            Ok((built, Told::of(&own, &plan)?))
        });
        // Nobody waits for it any more where the run has been interrupted.
        let _ = sender.send((built, warnings));
    };
    let failed = |error: io::Error| Failure::Unfinished {
        reason: format!("no thread can be started: {error}"),
        kept: None,
        help: None,
    };
    let thread = Builder::new().stack_size(STACK).spawn(work).map_err(failed)?;
    streams::warned(|warnings| {
        let wait = || loop {
            match receiver.recv_timeout(PAUSE) {
                Ok((built, found)) => {
                    warnings.extend(found);
                    return built;
                }
                Err(RecvTimeoutError::Timeout) if interruption.asked() => {
                    let reason = "interrupted before the first step, while the machine was built";
                    return Err(Failure::Unfinished {
                        reason: reason.to_owned(),
                        kept: None,
                        help: None,
                    });
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    let panic = thread.join().expect_err("it sends what it has made");
                    resume_unwind(panic);
                }
            }
        };
        progress::during(show, case.reducing(), wait)
    })
}

/// Writes what was made of a history that is on disk, draws its figures, and says how the run has ended.
fn report(
    arguments: &RunArguments,
    (case, built, told): (&Case, &Built, Told),
    (results, identity): (&Results, &Identity),
    (simulated, interruption): (Simulated, &Interruption),
    show: ProgressMode,
) -> Result<(), Failure> {
    let Simulated { marched, reason, made, motions } = simulated;
    let mut problems = Vec::new();
    let mut closing_words = None;
    let motions = motions.and_then(|read| read.map_err(|problem| problems.push(problem)).ok());
    if let Some(words) = motions.as_ref().and_then(fields::Motions::without_frames) {
        streams::warn(words);
    }
    let files = arguments.other_files;
    // Rows that are not all in one file or the other make none of a third kind.
    let complete = matches!(marched.end, End::Done);
    let about = (!matches!(marched.end, End::NotWritten(..)) && made.is_ok())
        .then(|| AboutFiles::new((case, built), identity, complete));
    let path = results.path(history::NAME);
    let names = History::for_machine(&built.machine).names().to_vec();
    let made = made.and_then(|summary| Ok((HistoryFile::of_run(&path, &names)?, summary)));
    match made {
        Err(error) => problems.push(format!("no summary and no figures: {error}")),
        Ok((history, summary)) => {
            problems.extend(results.write(SUMMARY, summary.json().as_bytes()).err());
            let steady = summary.steadiness(case.march());
            let page = About::of_run((case, built), told.words, steady);
            problems.extend(results.write(ABOUT, page.json().as_bytes()).err());
            if let Some(shapes) = told.shapes {
                let moved = match &motions {
                    Some(motions) => shapes.moved(motions),
                    None => shapes,
                };
                problems.extend(results.write(SHAPES, moved.json().as_bytes()).err());
            }
            if let Some(maps) = motions.as_ref().and_then(FilmMaps::of) {
                problems.extend(results.write(FILMS, maps.json().as_bytes()).err());
            }
            problems.extend(motions.and_then(|own| write_fields(&own, results)));
            problems.extend(files.write_npz(&history, results));
            if let Some(about) = &about {
                problems.extend(files.write_copies(about, results));
            }
            // On a full disk the numbers come first.
            if !arguments.no_figures && !matches!(marched.end, End::NotWritten(..)) {
                let write = |name: &str, content: &[u8]| results.write(name, content);
                // One signal has ended the march, and figures are wanted of what is done.
                let stop = || matches!(marched.end, End::Done) && interruption.asked();
                let marked = (case, summary.verdict.sound);
                problems.extend(figures::draw(marked, built, &history, &write, &stop));
            }
            closing_words = match show {
                ProgressMode::Nothing if summary.verdict.sound => None,
                ProgressMode::Nothing => {
                    streams::print_error(&summary.verdict.words());
                    None
                }
                _ => Some(closing(case, &summary, results.folder())),
            };
        }
    }
    // A step that does not converge would not do so in the next run either.
    let mut over = problems.is_empty() && matches!(marched.end, End::Done | End::Diverged(_));
    if let Some(about) = &about {
        let problem = files.write_last(about, results, over);
        over &= problem.is_none();
        problems.extend(problem);
    }
    if over {
        results.forget_checkpoint();
    }
    // It tells of all other files.
    if about.is_some() && !arguments.no_report && results.path(ABOUT).exists() {
        let made = match matches!(marched.end, End::Done) && interruption.asked() {
            true => Err("interrupted before the report was made".to_owned()),
            false => page::made(results.folder()),
        };
        problems.extend(made.and_then(|page| results.write(REPORT, page.as_bytes())).err());
    }
    let printed = closing_words.map_or(Ok(()), |words| streams::say(&words));
    let Some(reason) = reason.or_else(|| problems.first().cloned()) else { return printed };
    problems.iter().filter(|problem| **problem != reason).for_each(streams::warn);
    // What others did to the folder meanwhile counts.
    let goes_on = checkpoint::read(results, identity).is_ok_and(|point| point.is_some())
        && files.can_go_on(results);
    let rows = HistoryFile::of_run(&path, &names).is_ok_and(|own| own.has_rows());
    Err(Failure::Unfinished {
        reason,
        kept: rows.then(|| results.folder().to_path_buf()),
        help: goes_on.then(|| match marched.end {
            End::NotWritten(..) => {
                "see that the disk has room, then run the same command with `--resume` to continue"
                    .to_string()
            }
            _ => "run the same command with `--resume` to continue".to_string(),
        }),
    })
}

/// Writes the motions of whole bodies; why they cannot be written.
fn write_fields(motions: &fields::Motions, results: &Results) -> Option<String> {
    let folder = results.path(fields::FOLDER);
    let written = motions.write(results.folder());
    written.err().map(|error| format!("cannot write `{}`: {error}", folder.display()))
}

/// What a run leaves on the terminal.
fn closing(case: &Case, summary: &Summary, folder: &Path) -> String {
    let time = summary.time;
    let names: Vec<String> = case.supports().into_iter().map(|own| own.title).collect();
    let table = match case.machine.is_mass() {
        true => stops(&names, &summary.supports),
        false => supports(&names, &summary.supports),
    };
    let orders = match of_orders(summary.orders.as_ref()) {
        none if none.is_empty() => none,
        some => some + "\n",
    };
    let steady = summary.steadiness(case.march());
    let stresses: String = (summary.stresses.iter())
        .map(|(body, own)| format!("largest stress of {body}: {}\n", own.words()))
        .collect();
    format!(
        "{}: {}\n\nlast cycle ({:.2} ms), {steady}\n{table}\n{}\
         {stresses}{}{}\
         {:.4} s simulated in {:.3} s ({:.3} of real time), reduction {:.2} s{}\n\
         results in {}\n",
        case.name,
        case.title,
        1e3 * case.march().cycle,
        orders,
        summary.verdict.words(),
        summary.steps_taken(),
        time.simulated_s,
        time.march_wall_s,
        time.real_time_factor,
        time.reduction_wall_s,
        if time.reduction_cached { " (cached)" } else { "" },
        folder.display()
    )
}

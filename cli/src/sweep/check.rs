//! `whirl check` of a sweep: its points, the bodies that they need, and what it takes to run it.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::num::NonZero;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use whirl_solver::cache::{Cache, Key};
use whirl_text::rounded;

use super::axis::Along;
use super::column::{Column, Shown};
use super::definition::{Keep, Sweep};
use super::examine::examine;
use super::points::Point;
use super::workers;
use crate::analysis::{self, AtPoint};
use crate::case::Case;
use crate::errors::Failure;
use crate::progress::{self, ProgressMode};
use crate::signals::Interruption;
use crate::simulate::{Watch, in_memory};
use crate::values::level::digits;
use crate::{machine, streams};

/// Adds a line to a text.
macro_rules! line {
    ($text:expr, $($what:tt)*) => {
        writeln!($text, $($what)*).expect("text can be written")
    };
}

/// How long the first point is run, to see how fast it is.
const TRIAL: Duration = Duration::from_millis(500);
/// Points whose bodies are looked at, at most.
const MOST_LOOKED_AT: usize = 500;
/// Bytes of a number in a history, as digits, and of one in a table.
const DIGITS_OF_HISTORY: f64 = 13.0;
const DIGITS_OF_TABLE: f64 = 20.0;
/// Bytes of a number in the state after the last step and in the journal.
const BINARY: f64 = 8.0;

/// Reads a sweep as a run of it would, builds its first point, and runs it for a moment.
///
/// # Errors
/// Whatever keeps the sweep from being run.
pub(crate) fn check(path: &Path, cache: Option<Cache>) -> Result<String, Failure> {
    let sweep = Sweep::of_file(path)?;
    let jobs = workers::cores();
    streams::warned(|warnings| examine(&sweep, jobs, &|| false, warnings))?;
    let mut text = String::new();
    say_points(&mut text, &sweep);
    let first = sweep.point(0);
    let case = sweep.case(&first, &mut Vec::new())?;
    line!(text, "case {}: {}\n", case.name, case.title);
    say_done(&mut text, &sweep);
    say_bodies(&mut text, &sweep, cache.as_ref());
    say_effort(&mut text, &sweep, (&case, &first), (cache, jobs))?;
    Ok(text)
}

/// What varies, as lines of a text.
pub(super) fn varied(sweep: &Sweep) -> Vec<String> {
    let mut text = String::new();
    say_points(&mut text, sweep);
    text.lines().skip(2).map(|own| own.trim().to_owned()).collect()
}

fn say_points(text: &mut String, sweep: &Sweep) {
    match sweep.title.as_str() {
        "" => line!(text, "{}", sweep.name),
        title => line!(text, "{}: {title}", sweep.name),
    }
    let several = sweep.axes.iter().filter(|axis| axis.count > 1);
    let counts: Vec<String> = several.map(|axis| axis.count.to_string()).collect();
    let product =
        if counts.len() > 1 { format!(" ({})", counts.join(" × ")) } else { String::new() };
    let kind = if sweep.samples.is_some() { " of a Latin hypercube" } else { "" };
    let points = if sweep.count() == 1 { "point" } else { "points" };
    line!(text, "\n{} {points}{kind}{product}:", sweep.count());
    for (place, key) in sweep.keys.iter().enumerate() {
        let axis = sweep.axes.iter().find(|axis| axis.keys.contains(&place));
        let together = axis.is_some_and(|axis| axis.keys[0] != place) && sweep.samples.is_none();
        let column = Column::of(key);
        let shown = |level| match column.shown(&level) {
            Shown::Number(value) => digits(rounded(value, 6)),
            Shown::Text(text) => text,
        };
        let values = match key.is_ranged() {
            true => key.written().into_iter().map(shown).collect::<Vec<_>>().join(" .. "),
            false => key.written().into_iter().map(shown).collect::<Vec<_>>().join(", "),
        };
        let step = if together { ", in step with the one before" } else { "" };
        line!(text, "  {}: {values}{step}", column.head);
    }
    if let Some(along) = sweep.along {
        let way = match along {
            Along::Up => "up",
            Along::Down => "down",
            Along::Both => "up and down again",
        };
        line!(
            text,
            "  {} of them one after the other, each from the state of the previous one, {way}",
            sweep.chain()
        );
    }
}

/// What is done of every point, where that is not a run alone.
fn say_done(text: &mut String, sweep: &Sweep) {
    if sweep.analyses.is_empty() {
        return;
    }
    let names: Vec<String> = sweep.analyses.iter().map(|own| format!("`{}`", own.text())).collect();
    let run = if sweep.marches { "run, and " } else { "" };
    line!(text, "each is {run}analysed: {}", names.join(", "));
}

/// Bodies by what they depend on. Axes act on them independently of each other, as far as this looks.
fn say_bodies(text: &mut String, sweep: &Sweep, cache: Option<&Cache>) {
    let keys = |point: &Point| -> Vec<Key> {
        let case = sweep.case(point, &mut Vec::new());
        case.and_then(|case| machine::keys(&case)).unwrap_or_default()
    };
    let first = keys(&sweep.point(0));
    let mut times = vec![1_usize; first.len()];
    let mut all: BTreeSet<Key> = first.iter().copied().collect();
    for (k, axis) in sweep.axes.iter().enumerate() {
        let mut own: Vec<BTreeSet<Key>> = first.iter().map(|key| BTreeSet::from([*key])).collect();
        let pace =
            axis.count.div_ceil(MOST_LOOKED_AT / sweep.axes.len().min(MOST_LOOKED_AT)).max(1);
        for place in (1..axis.count).step_by(pace) {
            let mut places = vec![0; sweep.axes.len()];
            places[k] = place;
            for (own, key) in own.iter_mut().zip(keys(&sweep.at(0, &places))) {
                own.insert(key);
                all.insert(key);
            }
        }
        times
            .iter_mut()
            .zip(&own)
            .for_each(|(times, own)| *times *= own.len() * pace.min(own.len()));
    }
    let count: usize = times.iter().sum();
    if count == 0 {
        return line!(text, "no body is reduced");
    }
    let there = |key: &Key| {
        cache
            .and_then(Cache::folder)
            .is_some_and(|own| own.join(format!("{}.bin", key.hex())).exists())
    };
    let kept = all.iter().filter(|key| there(key)).count();
    let often: Vec<String> = times.iter().map(ToString::to_string).collect();
    let each = if count > times.len() {
        format!(" ({} of the bodies of a point)", often.join(" + "))
    } else {
        String::new()
    };
    let have = if kept > 0 { format!("; {kept} of them are in the cache") } else { String::new() };
    line!(
        text,
        "{count} {} reduced, each once{each}{have}",
        if count == 1 { "body is" } else { "bodies are" }
    );
}

/// Time and disk, by a run of the first point for a moment.
fn say_effort(
    text: &mut String,
    sweep: &Sweep,
    (case, first): (&Case, &Point),
    (cache, jobs): (Option<Cache>, usize),
) -> Result<(), Failure> {
    if !sweep.marches {
        return say_analyses(text, sweep, (case, first), (cache, jobs));
    }
    let build = || machine::build_planned(case, cache.as_ref(), &mut Vec::new());
    let built = progress::during(ProgressMode::on_terminal(), case.reducing(), build)?;
    let trial = Trial { start: Instant::now(), steps: Cell::new(0) };
    let ran = in_memory(case, &built, &trial);
    let (wall, steps) = (trial.start.elapsed().as_secs_f64(), trial.steps.get());
    let all: f64 = sweep.mean_steps(case) * sweep.count() as f64;
    match ran {
        Ok(_) | Err(Failure::Unfinished { .. }) if steps > 0 => {
            let each = wall / steps as f64;
            let total = Duration::from_secs_f64((each * all / jobs as f64).min(1e15));
            line!(
                text,
                "{} on {jobs} {}, if all steps take as long as the first {steps}",
                match total.as_secs() {
                    0 => "less than a second".to_owned(),
                    _ => format!("about {}", progress::words(total)),
                },
                if jobs == 1 { "core" } else { "cores" }
            );
        }
        Ok(_) | Err(Failure::Unfinished { .. }) => {
            line!(text, "a step takes longer than {TRIAL:?}")
        }
        Err(failure) => line!(text, "point {} cannot be started: {failure}", first.number()),
    }
    let columns = built.columns().len() as f64;
    let supports = case.supports().len() as f64;
    let numbers = 40.0 + 25.0 * supports + sweep.keys.len() as f64;
    let mut bytes = sweep.count() as f64 * numbers * (DIGITS_OF_TABLE + 2.0 * BINARY);
    if sweep.keep == Keep::Histories {
        let rows = sweep.mean_steps(case) / case.march().output_every as f64;
        bytes += sweep.count() as f64 * rows * columns * DIGITS_OF_HISTORY;
    }
    line!(text, "about {} on disk", size(bytes));
    Ok(())
}

/// The same of points that are only analysed, by the first of them.
fn say_analyses(
    text: &mut String,
    sweep: &Sweep,
    (case, first): (&Case, &Point),
    (cache, jobs): (Option<Cache>, usize),
) -> Result<(), Failure> {
    let analyses = analysis::named(case, &sweep.analyses)?;
    let show = ProgressMode::on_terminal();
    let cache = Cache::shared(cache);
    let build = || machine::build_planned(case, Some(&cache), &mut Vec::new());
    let built = match analysis::need_machine(&analyses) {
        true => Some(progress::during(show, case.reducing(), build)?),
        false => None,
    };
    let interruption = Interruption::by(Arc::default());
    let (built, threads) = (built.as_ref(), NonZero::<usize>::MIN);
    let at = AtPoint { case, built, cache: &cache, interruption: &interruption, threads };
    let start = Instant::now();
    let work = || at.facts(&analyses, &mut Vec::new());
    match progress::during(show, "analysing the first point", work) {
        Ok(facts) => {
            let total = start.elapsed().as_secs_f64() * sweep.count() as f64 / jobs as f64;
            let total = Duration::from_secs_f64(total.min(1e15));
            line!(
                text,
                "{} on {jobs} {}, if all points take as long as the first",
                match total.as_secs() {
                    0 => "less than a second".to_owned(),
                    _ => format!("about {}", progress::words(total)),
                },
                if jobs == 1 { "core" } else { "cores" }
            );
            let numbers = (10 + facts.numbers.len() + sweep.keys.len()) as f64;
            let bytes = sweep.count() as f64 * numbers * (DIGITS_OF_TABLE + 2.0 * BINARY);
            line!(text, "about {} on disk", size(bytes));
        }
        Err(failure) => line!(text, "point {} cannot be analysed: {failure}", first.number()),
    }
    Ok(())
}

impl Sweep {
    /// Steps of a point on average, by the values of every key alone.
    fn mean_steps(&self, first: &Case) -> f64 {
        let base = first.steps() as f64;
        let mut factor = 1.0;
        for (k, axis) in self.axes.iter().enumerate() {
            let pace = axis.count.div_ceil(MOST_LOOKED_AT).max(1);
            let (mut sum, mut count) = (0.0, 0.0);
            for place in (0..axis.count).step_by(pace) {
                let mut places = vec![0; self.axes.len()];
                places[k] = place;
                if let Ok(case) = self.case(&self.at(0, &places), &mut Vec::new()) {
                    sum += case.steps() as f64 / base;
                    count += 1.0;
                }
            }
            factor *= if count > 0.0 { sum / count } else { 1.0 };
        }
        base * factor
    }
}

/// Ends a run after a moment.
struct Trial {
    start: Instant,
    steps: Cell<usize>,
}

impl Watch for Trial {
    fn progressed(&self, step: usize, _: f64) {
        self.steps.set(step);
    }

    fn asked(&self) -> bool {
        self.start.elapsed() > TRIAL
    }
}

/// Bytes as people say them.
fn size(bytes: f64) -> String {
    let units = ["bytes", "kB", "MB", "GB", "TB"];
    let thousands = units.len() - 1;
    let place = (0..thousands)
        .find(|place| bytes < 1000.0_f64.powi(*place as i32 + 1))
        .unwrap_or(thousands);
    format!("{} {}", rounded(bytes / 1000.0_f64.powi(place as i32), 2), units[place])
}

//! The table of a sweep: a row for every point that is done, in the order of the points.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use whirl_solver::cache::write_aside_by;

use super::column::{Column, Shown};
use super::definition::Sweep;
use super::files::{CSV, PARQUET};
use super::folder::SweepFolder;
use super::kept::Kept;
use super::row::{Row, Verdict};
use crate::parquet::{GROUP, Parquet, Values};
use crate::values::level::digits;

/// How many points came to what.
#[derive(Debug, Default)]
pub(super) struct Counts {
    unsound: usize,
    failed: usize,
    /// Sound, and tested for a steady state in vain.
    unsteady: usize,
}

impl Counts {
    fn add(&mut self, row: &Row, names: &[String]) {
        let of =
            |name: &str| names.iter().zip(&row.values).find(|own| own.0 == name).map(|own| *own.1);
        match row.verdict {
            Verdict::Sound => {
                let tested = of("steady_state.checked") == Some(1.0);
                self.unsteady += usize::from(tested && of("steady_state.reached") == Some(0.0));
            }
            Verdict::NotSound => self.unsound += 1,
            Verdict::Failed => self.failed += 1,
        }
    }

    /// In words, a line each; nothing of a sweep without such points.
    pub(super) fn words(&self) -> String {
        let mut text = String::new();
        let mut say = |count: usize, what: &str| {
            if count > 0 {
                writeln!(text, "{count} {what}").expect("text can be written");
            }
        };
        say(self.failed, "failed: `remark` in table.csv says why");
        say(self.unsound, "NOT SOUND: `remark` in table.csv says what was found");
        say(
            self.unsteady,
            "sound, but not in a steady state: see `steady_state.left` in table.csv",
        );
        text
    }
}

/// Columns of a table.
pub(super) struct Layout {
    pub(super) varied: Vec<Column>,
    /// Numbers of points, in the order in which these have them.
    pub(super) numbers: Vec<String>,
    /// For each list of names of the journal: where its numbers stand among these.
    places: Vec<Vec<usize>>,
}

impl Layout {
    /// Of all points that are done.
    ///
    /// # Errors
    /// The journal cannot be read, in words.
    fn new(sweep: &Sweep, kept: &mut Kept) -> Result<Self, String> {
        let mut used = vec![false; kept.names.len()];
        let mut numbers: Vec<String> = Vec::new();
        for number in 0..sweep.count() {
            let Some((list, _)) = kept.row(number)? else { continue };
            if !std::mem::replace(&mut used[list], true) {
                merge(&mut numbers, &kept.names[list]);
            }
        }
        let known: BTreeMap<&String, usize> = numbers.iter().zip(0..).collect();
        let place = |name: &String| known.get(name).copied().unwrap_or(0);
        let places = kept.names.iter().map(|own| own.iter().map(place).collect()).collect();
        Ok(Layout { varied: sweep.keys.iter().map(Column::of).collect(), numbers, places })
    }

    /// Names of all columns.
    fn heads(&self, sweep: &Sweep) -> Vec<String> {
        let mut heads = vec!["point".to_owned()];
        heads.extend(self.varied.iter().map(|own| own.head.clone()));
        heads.extend(sweep.along.map(|_| "direction".to_owned()));
        heads.push("verdict".to_owned());
        heads.extend(self.numbers.iter().cloned());
        heads.push("remark".to_owned());
        heads
    }

    /// The numbers of a row in the order of the columns; NaN where it has none.
    fn numbers(&self, list: usize, row: &Row) -> Vec<f64> {
        let mut numbers = vec![f64::NAN; self.numbers.len()];
        for (place, value) in self.places[list].iter().zip(&row.values) {
            numbers[*place] = *value;
        }
        numbers
    }
}

/// Adds the names that are not there, each behind the one before it.
fn merge(numbers: &mut Vec<String>, names: &[String]) {
    if numbers.is_empty() {
        return numbers.extend(names.iter().cloned());
    }
    let known: BTreeSet<String> = numbers.iter().cloned().collect();
    let mut behind: Option<&String> = None;
    for name in names {
        if !known.contains(name) {
            let last = behind.and_then(|own| numbers.iter().position(|other| other == own));
            numbers.insert(last.map_or(0, |last| last + 1), name.clone());
        }
        behind = Some(name);
    }
}

/// Writes the table of all points that are done, as CSV and as Parquet, each whole or not at all, and counts them.
///
/// # Errors
/// It cannot be written, or the journal not be read, in words.
pub(super) fn write(
    sweep: &Sweep,
    kept: &mut Kept,
    results: &SweepFolder,
) -> Result<Counts, String> {
    let layout = Layout::new(sweep, kept)?;
    let mut counts = Counts::default();
    written(&results.path(CSV), &mut |file| {
        counts = Counts::default();
        let heads: Vec<String> = layout.heads(sweep).iter().map(|own| cell(own)).collect();
        writeln!(file, "{}", heads.join(","))?;
        for number in 0..sweep.count() {
            let Some((list, row)) = kept.row(number).map_err(io::Error::other)? else { continue };
            counts.add(&row, &kept.names[list]);
            writeln!(file, "{}", line(sweep, &layout, number, (list, &row)))?;
        }
        Ok(())
    })?;
    written(&results.path(PARQUET), &mut |file| {
        let mut parquet = Parquet::new(file, layout.heads(sweep))?;
        for first in (0..sweep.count()).step_by(GROUP) {
            let mut group = layout.empty(sweep);
            for number in first..sweep.count().min(first + GROUP) {
                let Some(row) = kept.row(number).map_err(io::Error::other)? else { continue };
                layout.push(sweep, &mut group, number, row);
            }
            parquet.add(&group)?;
        }
        parquet.finish(concat!("whirl ", env!("CARGO_PKG_VERSION"))).map(|_| ())
    })?;
    Ok(counts)
}

/// Writes a file whole or not at all.
fn written(
    path: &Path,
    fill: &mut dyn FnMut(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), String> {
    let aside = write_aside_by(path, &mut |file| {
        let mut file = BufWriter::new(file);
        fill(&mut file)?;
        file.flush()
    });
    let put = aside.and_then(|put| put());
    put.map_err(|error| format!("cannot write `{}`: {error}", path.display()))
}

impl Layout {
    /// Columns of Parquet without rows.
    fn empty(&self, sweep: &Sweep) -> Vec<Values> {
        let (number, text) = (Values::Numbers(Vec::new()), Values::Texts(Vec::new()));
        let mut all = vec![Values::Whole(Vec::new())];
        all.extend(
            self.varied
                .iter()
                .map(|own| if own.is_number() { number.clone() } else { text.clone() }),
        );
        all.extend(sweep.along.map(|_| text.clone()));
        all.push(text.clone());
        all.extend(self.numbers.iter().map(|_| number.clone()));
        all.push(text);
        all
    }

    fn push(&self, sweep: &Sweep, group: &mut [Values], number: usize, (list, row): (usize, Row)) {
        let point = sweep.point(number);
        let shown = self.varied.iter().zip(&point.levels).map(|(own, level)| own.shown(level));
        let way = point.way.map(|way| Shown::Text(way.to_owned()));
        let numbers = self.numbers(list, &row).into_iter().map(Shown::Number);
        let cells = shown
            .chain(way)
            .chain([Shown::Text(row.verdict.word().to_owned())])
            .chain(numbers)
            .chain([Shown::Text(row.words.clone())]);
        if let Values::Whole(own) = &mut group[0] {
            own.push(number as i64);
        }
        for (column, cell) in group[1..].iter_mut().zip(cells) {
            match (column, cell) {
                (Values::Numbers(own), Shown::Number(value)) => own.push(value),
                (Values::Texts(own), Shown::Text(text)) => own.push(text),
                (Values::Numbers(own), Shown::Text(_)) => own.push(f64::NAN),
                (Values::Texts(own), Shown::Number(value)) => own.push(digits(value)),
                (Values::Whole(own), _) => own.push(0),
            }
        }
    }
}

fn line(sweep: &Sweep, layout: &Layout, number: usize, (list, row): (usize, &Row)) -> String {
    let point = sweep.point(number);
    let mut cells = vec![number.to_string()];
    for (column, level) in layout.varied.iter().zip(&point.levels) {
        cells.push(match column.shown(level) {
            Shown::Number(value) => digits(value),
            Shown::Text(text) => cell(&text),
        });
    }
    cells.extend(point.way.map(str::to_owned));
    cells.push(row.verdict.word().to_owned());
    let shown = |value: f64| if value.is_finite() { digits(value) } else { String::new() };
    cells.extend(layout.numbers(list, row).into_iter().map(shown));
    cells.push(cell(&row.words));
    cells.join(",")
}

/// A text as a cell of CSV.
fn cell(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

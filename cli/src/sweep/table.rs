//! The table of a sweep: a row for every point that is done, in the order of the points.

use std::fmt::Write;
use std::io::Write as _;

use whirl_solver::cache::write_aside_by;

use super::Sweep;
use super::column::{Column, Shown};
use super::folder::SweepFolder;
use super::kept::Kept;
use super::level::digits;
use super::row::Verdict;

/// Name of the file.
pub(super) const CSV: &str = "table.csv";

/// How many points came to what.
#[derive(Debug, Default)]
pub(super) struct Counts {
    unsound: usize,
    failed: usize,
}

impl Counts {
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
        text
    }
}

/// Columns of a table.
pub(super) struct Layout {
    pub(super) varied: Vec<Column>,
    /// Numbers of summaries, in the order in which points have them first.
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
        let mut known = std::collections::BTreeMap::new();
        for number in 0..sweep.count() {
            let Some((list, _)) = kept.row(number)? else { continue };
            if !std::mem::replace(&mut used[list], true) {
                for name in &kept.names[list] {
                    known.entry(name.clone()).or_insert_with(|| {
                        numbers.push(name.clone());
                        numbers.len() - 1
                    });
                }
            }
        }
        let place = |name: &String| known.get(name).copied().unwrap_or(0);
        let places = kept.names.iter().map(|own| own.iter().map(place).collect()).collect();
        Ok(Layout { varied: sweep.keys.iter().map(Column::of).collect(), numbers, places })
    }

    fn head(&self, sweep: &Sweep) -> String {
        let mut cells = vec!["point".to_owned()];
        cells.extend(self.varied.iter().map(|own| cell(&own.head)));
        cells.extend(sweep.along.map(|_| "direction".to_owned()));
        cells.push("verdict".to_owned());
        cells.extend(self.numbers.iter().map(|own| cell(own)));
        cells.push("remark".to_owned());
        cells.join(",") + "\n"
    }
}

/// Writes the table of all points that are done, whole or not at all, and counts them.
///
/// # Errors
/// It cannot be written, or the journal not be read, in words.
pub(super) fn write(
    sweep: &Sweep,
    kept: &mut Kept,
    results: &SweepFolder,
) -> Result<Counts, String> {
    let layout = Layout::new(sweep, kept)?;
    let path = results.path(CSV);
    let (mut counts, mut unread) = (Counts::default(), None);
    let aside = write_aside_by(&path, &mut |file| {
        let mut file = std::io::BufWriter::new(file);
        file.write_all(layout.head(sweep).as_bytes())?;
        for number in 0..sweep.count() {
            let row = match kept.row(number) {
                Ok(Some(row)) => row,
                Ok(None) => continue,
                Err(reason) => {
                    unread = Some(reason);
                    return Err(std::io::Error::other("the journal cannot be read"));
                }
            };
            match row.1.verdict {
                Verdict::Sound => {}
                Verdict::NotSound => counts.unsound += 1,
                Verdict::Failed => counts.failed += 1,
            }
            file.write_all(line(sweep, &layout, number, row).as_bytes())?;
        }
        file.flush()
    });
    let written = aside.and_then(|put| put());
    match (written, unread) {
        (Ok(()), _) => Ok(counts),
        (Err(_), Some(reason)) => Err(reason),
        (Err(error), None) => Err(format!("cannot write `{}`: {error}", path.display())),
    }
}

fn line(
    sweep: &Sweep,
    layout: &Layout,
    number: usize,
    (list, row): (usize, super::row::Row),
) -> String {
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
    let mut numbers = vec![String::new(); layout.numbers.len()];
    for (place, value) in layout.places[list].iter().zip(&row.values) {
        if value.is_finite() {
            numbers[*place] = digits(*value);
        }
    }
    cells.extend(numbers);
    cells.push(cell(&row.words));
    cells.join(",") + "\n"
}

/// A text as a cell of CSV.
fn cell(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

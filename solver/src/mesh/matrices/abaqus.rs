//! What Abaqus writes with `*MATRIX OUTPUT`: a line an entry, with commas or blanks.
//!
//! With `FORMAT=MATRIX INPUT` (the usual one) or `LABELS` a line is `node, dof, node, dof, value`, of a load
//! `node, dof, value`; with `FORMAT=COORDINATE` it is `row, column, value`. Of symmetric matrices one half may be listed.

use std::collections::HashSet;
use std::hash::Hash;

use super::super::bdf::{Dmig, DmigColumn, DmigEntry};
use super::super::raw::{LinePosition, MeshReport, count, list};
use super::entries::{Entries, Entry, Form};

const WRITTEN: &str = "let Abaqus write it with `*MATRIX GENERATE` and `*MATRIX OUTPUT`";
const CUT: &str = "the file may have been cut off: write it again";

/// How entries are listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Listed {
    /// By rows and columns.
    Coordinate,
    /// By nodes and their dofs.
    Labels,
}

fn words(line: &str) -> Vec<&str> {
    line.split([',', ' ', '\t']).filter(|word| !word.is_empty()).collect()
}

/// Lines with their numbers, without comments and empty ones.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = (1..).zip(text.lines().map(str::trim));
    lines.filter(|(_, line)| !line.is_empty() && !line.starts_with("**"))
}

/// How a file lists its entries, by its first line; none of another file.
pub(super) fn listed(text: &str) -> Option<Listed> {
    let mut lines = lines(text).map(|(_, line)| line);
    let input = |line: &&str| line.get(..7).is_some_and(|own| own.eq_ignore_ascii_case("*MATRIX"));
    let first = lines.find(|line| !input(line))?;
    let words = words(first);
    let (value, labels) = words.split_last()?;
    let whole = |word: &&str| word.parse::<i64>().is_ok();
    if value.parse::<f64>().is_err() || !labels.iter().all(whole) {
        return None;
    }
    match labels.len() {
        2 => Some(Listed::Coordinate),
        4 => Some(Listed::Labels),
        _ => None,
    }
}

/// Takes the entries of a file, `N` labels and a value each, with their lines.
fn each<const N: usize>(
    text: &str,
    (name, file): (&str, usize),
    form: &str,
    report: &mut MeshReport,
    mut take: impl FnMut([i64; N], f64, LinePosition, &mut MeshReport),
) {
    for (number, line) in lines(text) {
        let place = LinePosition { file, line: number, column: 1 };
        if line.starts_with('*') {
            // The card of a matrix that is read again.
            let own = line.to_ascii_uppercase().replace(' ', "");
            if !own.starts_with("*MATRIXINPUT") && !own.starts_with("*MATRIXASSEMBLE") {
                let shown: String = line.chars().take(24).collect();
                let what = format!("`{shown}` is no entry of {name}, which is `{form}`");
                let help = "matrices of elements and of substructures are not read: write those of the model, with `*MATRIX OUTPUT`";
                report.error(place, what, help);
                return;
            }
            continue;
        }
        let words = words(line);
        if words.len() != N + 1 {
            let what = format!(
                "an entry of {name} is `{form}`, this line has {}",
                count(words.len(), "word")
            );
            report.error(place, what, CUT);
            continue;
        }
        let labels: Option<Vec<i64>> = words[..N].iter().map(|own| own.parse().ok()).collect();
        let Some(labels) = labels.and_then(|own| <[i64; N]>::try_from(own).ok()) else {
            let what = format!("({}) is no place in {name}", words[..N].join(", "));
            report.error(place, what, WRITTEN);
            continue;
        };
        let plain =
            |word: &str| word.bytes().all(|c| c.is_ascii_digit() || b"+-.eEdD".contains(&c));
        let value = words[N].replace(['D', 'd'], "e").parse::<f64>().ok();
        let Some(value) = value.filter(|own| own.is_finite() && plain(words[N])) else {
            let shown: String = words[N].chars().take(24).collect();
            let what = format!("a value of {name} must be a finite number, found `{shown}`");
            report.error(place, what, WRITTEN);
            continue;
        };
        take(labels, value, place, report);
    }
}

/// Whether both halves of a matrix are listed.
fn form<T: Eq + Hash + Copy>(entries: impl Iterator<Item = (T, T)> + Clone) -> Form {
    let known: HashSet<(T, T)> = entries.clone().collect();
    let both = entries
        .filter(|(row, column)| row != column)
        .any(|(row, column)| known.contains(&(column, row)));
    if both { Form::General } else { Form::Symmetric }
}

/// Reads a matrix of `size` rows by rows and columns, called `name`.
pub(super) fn coordinate(
    text: &str,
    (name, file): (&str, usize),
    size: usize,
    report: &mut MeshReport,
) -> Option<Entries> {
    let before = report.error_count();
    let mut list = Vec::new();
    each(
        text,
        (name, file),
        "row, column, value",
        report,
        |[row, column], value, place, report| {
            let [own, other] = [row, column]
                .map(|own| usize::try_from(own).ok().filter(|own| (1..=size).contains(own)));
            match (own, other) {
                (Some(row), Some(column)) => {
                    list.push(Entry { row: row - 1, column: column - 1, value, line: place.line });
                }
                _ => {
                    let what = format!("({row}, {column}) is no place in {name} of {size} rows");
                    let help = "list each dof once, in the order of the rows of K and M; rows are counted from 1";
                    report.error(place, what, help);
                }
            }
        },
    );
    if report.error_count() > before {
        return None;
    }
    let form = form(list.iter().map(|own: &Entry| (own.row, own.column)));
    let own = Entries { name: name.to_owned(), file, form, list };
    Some(own)
}

/// Reads a matrix by nodes and dofs, called `name`, as cards DMIG list them.
pub(super) fn labelled(
    text: &str,
    (name, file): (&str, usize),
    report: &mut MeshReport,
) -> Option<Dmig> {
    let before = report.error_count();
    let mut columns: Vec<DmigColumn> = Vec::new();
    let mut places: Vec<([u64; 2], [u64; 2])> = Vec::new();
    let form_of_line = "node, dof, node, dof, value";
    each(
        text,
        (name, file),
        form_of_line,
        report,
        |[row, own, column, other], value, place, report| {
            let (Some(row), Some(column)) =
                (dof(row, own, place, report), dof(column, other, place, report))
            else {
                return;
            };
            places.push((row, column));
            let entry = DmigEntry { node: row[0], component: row[1], value, place };
            match columns.last_mut().filter(|last| [last.node, last.component] == column) {
                Some(last) => last.entries.push(entry),
                None => {
                    let [node, component] = column;
                    columns.push(DmigColumn { node, component, place, entries: vec![entry] });
                }
            }
        },
    );
    if report.error_count() > before {
        return None;
    }
    // As cards say it.
    let form = if form(places.iter().copied()) == Form::Symmetric { 6 } else { 1 };
    Some(Dmig { place: LinePosition { file, line: 0, column: 0 }, form, columns })
}

/// Reads a load by nodes and dofs, called `name`, as a card DMIG with one column lists it.
pub(super) fn load(
    text: &str,
    (name, file): (&str, usize),
    report: &mut MeshReport,
) -> Option<Dmig> {
    let before = report.error_count();
    let mut entries = Vec::new();
    each(text, (name, file), "node, dof, value", report, |[node, own], value, place, report| {
        if let Some([node, component]) = dof(node, own, place, report) {
            entries.push(DmigEntry { node, component, value, place });
        }
    });
    let place = LinePosition { file, line: 0, column: 0 };
    let columns = vec![DmigColumn { node: 0, component: 0, place, entries }];
    (report.error_count() == before).then_some(Dmig { place, form: 2, columns })
}

/// A node and its dof.
fn dof(node: i64, dof: i64, place: LinePosition, report: &mut MeshReport) -> Option<[u64; 2]> {
    if node <= 0 {
        let what = format!("node {node} is one that Abaqus adds to the model");
        let help = "write the matrices without hybrid elements, contact, connectors and multi-point constraints";
        report.error(place, what, help);
        return None;
    }
    if !(1..=6).contains(&dof) {
        let what = format!("{dof} is no displacement or rotation of node {node}");
        report.error(
            place,
            what,
            "dofs are 1 to 6; leave out elements with pressures, warping or temperatures",
        );
        return None;
    }
    Some([node.unsigned_abs(), dof.unsigned_abs()])
}

/// Notes dofs that K has no entries of, and warns of those that have no mass: the files name no numbers of entries.
pub(super) fn complete(
    [stiffness, mass]: [&Entries; 2],
    called: impl Fn(usize) -> String,
    size: usize,
    report: &mut MeshReport,
) {
    for own in [stiffness, mass] {
        let mut known = vec![false; size];
        own.list.iter().for_each(|entry| {
            [entry.row, entry.column].map(|dof| known[dof] = true).into_iter().for_each(drop)
        });
        let lost: Vec<usize> = (0..size).filter(|dof| !known[*dof]).collect();
        if lost.is_empty() {
            continue;
        }
        let place = LinePosition { file: own.file, line: 0, column: 0 };
        let what = format!(
            "{} has no entries of {}: {}",
            own.name,
            count(lost.len(), "dof"),
            list(lost.iter().map(|dof| called(*dof)))
        );
        match std::ptr::eq(own, stiffness) {
            true => report.error(
                place,
                what,
                "use the matrices of one run, and write them again if they were cut off",
            ),
            false => report.warn(place, what, "is the file complete?"),
        }
    }
}

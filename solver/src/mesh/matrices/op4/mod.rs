//! Matrices that Nastran writes with OUTPUT4: as text or binary with either byte order, dense or as strings of values.
//!
//! A matrix is a head (columns, rows, form, type, name), a record for each column that is not zero, and one behind the last
//! column. A column has one run of values (dense), or strings of them, of which the head tells length and row: in two
//! numbers (big matrices, whose number of rows is negative or at least 65536) or packed into one. Lengths count words.

mod binary;
mod text;

use super::super::raw::{LinePosition, MeshReport, list};
use super::entries::{Entries, Entry, Form};
use super::market::rows_differ;

/// What to do with a file that does not say what it should.
const DAMAGED: &str = "the file may have been cut off: write it again";
/// Matrices with more rows have the heads of their strings in two numbers.
const BIG: i64 = 65536;

/// Why reading cannot go on.
struct Stop {
    /// From 1; 0 in a binary file.
    line: usize,
    what: String,
}

/// A matrix as it is written.
struct Matrix {
    name: String,
    /// Of its head.
    line: usize,
    rows: usize,
    columns: usize,
    form: i64,
    complex: bool,
    list: Vec<Entry>,
}

/// What the head of a matrix says, and where its values go.
struct Building {
    matrix: Matrix,
    big: bool,
    /// Words of a value.
    words: i64,
    /// Last column and row that were written.
    last: (usize, usize),
}

impl Building {
    /// By the numbers of a head; `words` of a real value in double precision.
    fn new(
        [columns, rows, form, kind]: [i64; 4],
        name: &str,
        line: usize,
        words: i64,
    ) -> Result<Building, Stop> {
        // In words of eight bytes there are four characters, and blanks.
        let name = name.replace([' ', '\0'], "").to_ascii_uppercase();
        let size = |number: i64| usize::try_from(number).ok().filter(|own| *own > 0);
        let (Some(size_columns), Some(size_rows)) = (size(columns), size(rows.saturating_abs()))
        else {
            let what = format!("{name} has {rows} rows and {columns} columns");
            return Err(Stop { line, what });
        };
        if !(1..=4).contains(&kind) {
            let what = format!("{name} has values of type {kind}, and known are 1 to 4");
            return Err(Stop { line, what });
        }
        let matrix = Matrix {
            name,
            line,
            rows: size_rows,
            columns: size_columns,
            form,
            complex: kind > 2,
            list: Vec::new(),
        };
        let words = if kind % 2 == 0 { words } else { 1 };
        Ok(Building { matrix, big: !(0..BIG).contains(&rows), words, last: (0, 0) })
    }

    /// A column begins; none where it is behind the last one.
    fn column(&mut self, column: i64, line: usize) -> Result<Option<usize>, Stop> {
        let own = usize::try_from(column).unwrap_or(0);
        if own == self.matrix.columns.saturating_add(1) {
            return Ok(None);
        }
        if own <= self.last.0 || own > self.matrix.columns {
            let (name, last) = (&self.matrix.name, self.last.0);
            let what = format!(
                "column {column} of {name} stands behind column {last} of {}",
                self.matrix.columns
            );
            return Err(Stop { line, what });
        }
        self.last = (own, 0);
        Ok(Some(own))
    }

    /// Length in words and first row of a string, by the number or the two numbers before it; how many words both take.
    fn string(&self, first: i64, second: Option<i64>) -> (i64, i64, i64) {
        match second {
            Some(row) => (first.saturating_sub(1), row, first.saturating_add(1)),
            None => ((first >> 16) - 1, first & 0xffff, first >> 16),
        }
    }

    /// How many real numbers a string of so many words has.
    fn count(&self, words: i64, line: usize) -> Result<usize, Stop> {
        let count = usize::try_from(words / self.words).ok().filter(|_| words % self.words == 0);
        count.filter(|own| *own > 0).ok_or_else(|| {
            let what = format!(
                "a string of column {} of {} has {words} words",
                self.last.0, self.matrix.name
            );
            Stop { line, what }
        })
    }

    /// The next values of the column, from a row on; their lines.
    fn values(
        &mut self,
        row: i64,
        values: impl Iterator<Item = (f64, usize)>,
        line: usize,
    ) -> Result<(), Stop> {
        let (column, last) = self.last;
        let first = usize::try_from(row).ok().filter(|own| *own > last);
        let Some(first) = first else {
            let what = format!(
                "row {row} of column {column} of {} stands behind row {last}",
                self.matrix.name
            );
            return Err(Stop { line, what });
        };
        let parts = if self.matrix.complex { 2 } else { 1 };
        for (place, (value, line)) in values.enumerate() {
            let row = first + place / parts;
            if row > self.matrix.rows {
                let Matrix { name, rows, .. } = &self.matrix;
                let what = format!("column {column} of {name} goes beyond its {rows} rows");
                return Err(Stop { line, what });
            }
            if !value.is_finite() {
                let what = format!(
                    "row {row} of column {column} of {} is no finite number",
                    self.matrix.name
                );
                return Err(Stop { line, what });
            }
            self.last.1 = row;
            // Zeros within runs are no entries.
            if value != 0.0 && !self.matrix.complex {
                self.matrix.list.push(Entry { row: row - 1, column: column - 1, value, line });
            }
        }
        Ok(())
    }
}

/// Whether a file begins as one of OUTPUT4 does.
pub(super) fn is_op4(bytes: &[u8]) -> bool {
    binary::order(bytes).is_some() || text::is_head(bytes)
}

/// Reads a square matrix of `size` rows, called `name`: that with the name `wanted`, or the only one of the file.
pub(super) fn matrix(
    bytes: &[u8],
    (name, file): (&str, usize),
    wanted: Option<&str>,
    size: usize,
    report: &mut MeshReport,
) -> Option<Entries> {
    let own = read(bytes, (name, file), wanted, size, report)?;
    let at = LinePosition { file, line: own.line, column: 0 };
    if own.rows != own.columns {
        let what =
            format!("{name} has {} rows and {} columns, and must be square", own.rows, own.columns);
        report.error(at, what, "export the whole matrix");
        return None;
    }
    // Of a symmetric matrix Nastran writes both halves, other programs one.
    let halves = [
        own.list.iter().any(|entry| entry.row > entry.column),
        own.list.iter().any(|entry| entry.row < entry.column),
    ];
    let form = match own.form {
        6 if halves != [true, true] => Form::Symmetric,
        1 | 2 | 6 => Form::General,
        other => {
            let what = format!(
                "{name} ({}) has the form {other}, and must be square (1) or symmetric (6)",
                own.name
            );
            report.error(at, what, "export it as a square or symmetric matrix");
            return None;
        }
    };
    Some(Entries { name: format!("{name} ({})", own.name), file, form, list: own.list })
}

/// Reads one column of `size` values, called `name`.
pub(super) fn column(
    bytes: &[u8],
    (name, file): (&str, usize),
    wanted: Option<&str>,
    size: usize,
    report: &mut MeshReport,
) -> Option<Vec<f64>> {
    let own = read(bytes, (name, file), wanted, size, report)?;
    if own.columns != 1 {
        let what = format!("{name} has {} columns, and must have one", own.columns);
        let at = LinePosition { file, line: own.line, column: 0 };
        report.error(at, what, "write one value a dof, in the order of the dofs");
        return None;
    }
    let mut values = vec![0.0; size];
    own.list.iter().for_each(|entry| values[entry.row] = entry.value);
    Some(values)
}

/// The matrix that is wanted, real and with so many rows.
fn read(
    bytes: &[u8],
    (name, file): (&str, usize),
    wanted: Option<&str>,
    size: usize,
    report: &mut MeshReport,
) -> Option<Matrix> {
    let read = match binary::order(bytes) {
        Some(order) => binary::matrices(bytes, order),
        None => text::matrices(bytes),
    };
    let place = |line: usize| LinePosition { file, line, column: 0 };
    let all = match read {
        Ok(all) => all,
        Err(Stop { line, what }) => {
            report.error(place(line), what, DAMAGED);
            return None;
        }
    };
    let names = list(all.iter().map(|own| &own.name));
    let mut found = all
        .into_iter()
        .filter(|own| wanted.is_none_or(|wanted| own.name.eq_ignore_ascii_case(wanted)));
    let (first, second) = (found.next(), found.next());
    let own = match (first, second) {
        (Some(own), None) => own,
        (None, _) => {
            let what = match wanted {
                Some(wanted) => format!("the file has no matrix `{wanted}`"),
                None => "the file has no matrix".to_owned(),
            };
            let help = match names.is_empty() {
                true => DAMAGED.to_owned(),
                false => format!("the file has {names}"),
            };
            report.error(place(0), what, help);
            return None;
        }
        (Some(first), Some(_)) => {
            let what = format!("the file has more than one matrix that may be {name}: {names}");
            let help = format!(
                "write the name of {name} behind that of the file, such as `model.op4:{}`; each name must be there once",
                first.name
            );
            report.error(place(0), what, help);
            return None;
        }
    };
    if own.complex {
        let what = format!("{name} ({}) has complex values, and must have real ones", own.name);
        report.error(place(own.line), what, "export the real matrix, without structural damping");
        return None;
    }
    if own.rows != size {
        rows_differ(name, own.rows, size, place(own.line), report);
        return None;
    }
    Some(own)
}

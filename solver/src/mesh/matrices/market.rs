//! Matrices in the Matrix Market format: coordinate or array, real or integer, general, symmetric or skew-symmetric.

use super::super::raw::{LinePosition, MeshReport, count};
use super::entries::{Entries, Entry, Form};

/// Notes that a matrix has not a row for each dof.
pub(super) fn rows_differ(
    name: &str,
    rows: usize,
    dofs: usize,
    at: LinePosition,
    report: &mut MeshReport,
) {
    let what = format!("{name} has {rows} rows, but {} listed", are(dofs));
    let help = "list each dof once, in the order of the rows of K and M";
    report.error(at, what, help);
}

const HEAD: &str = "begin the file with `%%MatrixMarket matrix coordinate real symmetric`; scipy.io.mmwrite writes such files";

/// A line with its number, from 1.
struct Line<'a> {
    text: &'a str,
    number: usize,
}

/// Reads a square matrix of `size` rows, called `name`; none after an error.
pub(super) fn matrix(
    text: &str,
    (name, file): (&str, usize),
    size: usize,
    report: &mut MeshReport,
) -> Option<Entries> {
    let before = report.error_count();
    let (rows, columns, form, list) = read(text, (name, file), size, report)?;
    let at = LinePosition { file, line: 0, column: 0 };
    if rows != columns {
        let what = format!("{name} has {rows} rows and {columns} columns, and must be square");
        report.error(at, what, "export the whole matrix");
    }
    (report.error_count() == before).then(|| Entries { name: name.to_owned(), file, form, list })
}

fn are(dofs: usize) -> String {
    format!("{} {}", count(dofs, "dof"), if dofs == 1 { "is" } else { "are" })
}

/// Reads one column of `size` values, called `name`; none after an error.
pub(super) fn column(
    text: &str,
    (name, file): (&str, usize),
    size: usize,
    report: &mut MeshReport,
) -> Option<Vec<f64>> {
    let before = report.error_count();
    let (_, columns, _, list) = read(text, (name, file), size, report)?;
    if columns != 1 {
        let what = format!("{name} has {columns} columns, and must have one");
        let at = LinePosition { file, line: 0, column: 0 };
        report.error(at, what, "write one value a dof, in the order of the dofs");
    }
    if report.error_count() > before {
        return None;
    }
    let mut values = vec![0.0; size];
    list.iter().for_each(|entry| values[entry.row] = entry.value);
    Some(values)
}

type Read = (usize, usize, Form, Vec<Entry>);

fn read(
    text: &str,
    (name, file): (&str, usize),
    wanted: usize,
    report: &mut MeshReport,
) -> Option<Read> {
    let before = report.error_count();
    let mut lines = text.lines().enumerate();
    let place = |line: usize| LinePosition { file, line, column: 0 };
    let head = lines.next().map_or("", |(_, line)| line).to_ascii_lowercase();
    let words: Vec<&str> = head.split_whitespace().collect();
    let ["%%matrixmarket", "matrix", layout, field, symmetry] = words[..] else {
        let what = format!("{name} is not in the Matrix Market format: its first line is no head");
        report.error(place(1), what, HEAD);
        return None;
    };
    let array = match layout {
        "array" => true,
        "coordinate" => false,
        other => {
            let what = format!("`{other}` is neither `coordinate` nor `array`");
            report.error(place(1), what, HEAD);
            return None;
        }
    };
    if !["real", "integer", "double"].contains(&field) {
        let what = format!("{name} has {field} values, and must have real ones");
        report.error(place(1), what, "export the real matrix, without structural damping");
        return None;
    }
    let form = match symmetry {
        "general" => Form::General,
        "symmetric" => Form::Symmetric,
        "skew-symmetric" => Form::Skew,
        other => {
            let what = format!("`{other}` is no symmetry of a real matrix");
            report.error(place(1), what, "write `general`, `symmetric` or `skew-symmetric`");
            return None;
        }
    };
    let mut lines = lines
        .map(|(number, text)| Line { text, number: number + 1 })
        .filter(|line| !line.text.trim().is_empty() && !line.text.starts_with('%'));
    let Some(sizes) = lines.next() else {
        let help = "below the head stand the numbers of rows, columns and entries";
        report.error(place(0), format!("{name} ends before its size"), help);
        return None;
    };
    let numbers: Vec<Option<usize>> =
        sizes.text.split_whitespace().map(|word| word.parse().ok()).collect();
    let (rows, columns, listed) = match (&numbers[..], array) {
        (&[Some(rows), Some(columns)], true) => (rows, columns, None),
        (&[Some(rows), Some(columns), Some(listed)], false) => (rows, columns, Some(listed)),
        _ => {
            let help = match array {
                true => "write rows and columns",
                false => "write rows, columns and the number of entries",
            };
            report.error(place(sizes.number), format!("{name} has no size in this line"), help);
            return None;
        }
    };
    if rows != wanted {
        rows_differ(name, rows, wanted, place(sizes.number), report);
        return None;
    }
    if form != Form::General && rows != columns {
        let what = format!("{name} is {symmetry}, but has {rows} rows and {columns} columns");
        report.error(place(sizes.number), what, "a matrix with a symmetry is square");
        return None;
    }
    let mut values = Values { name, file, form, size: (rows, columns), list: Vec::new() };
    let mut last = sizes.number;
    match listed {
        Some(listed) => {
            for line in lines {
                last = line.number;
                values.entry(&line, report);
            }
            values.ends(listed, last, report);
        }
        None => {
            let mut at =
                Column { row: if form == Form::Skew { 1 } else { 0 }, column: 0, count: 0 };
            for line in lines {
                last = line.number;
                values.next(&line, &mut at, report);
            }
            let wanted = values.wanted();
            if wanted != Some(at.count) {
                let wanted = wanted.map_or("more".to_owned(), |wanted| wanted.to_string());
                let what = format!("{name} lists {} values, and its size wants {wanted}", at.count);
                report.error(place(last), what, "the file may have been cut off: write it again");
            }
        }
    }
    (report.error_count() == before).then_some((rows, columns, form, values.list))
}

/// Where the next value of an array stands.
struct Column {
    row: usize,
    column: usize,
    count: usize,
}

struct Values<'a> {
    name: &'a str,
    file: usize,
    form: Form,
    /// Rows and columns.
    size: (usize, usize),
    list: Vec<Entry>,
}

impl Values<'_> {
    fn at(&self, line: &Line) -> LinePosition {
        LinePosition { file: self.file, line: line.number, column: 1 }
    }

    /// Reads `row column value`.
    fn entry(&mut self, line: &Line, report: &mut MeshReport) {
        let words: Vec<&str> = line.text.split_whitespace().collect();
        let [row, column, value] = words[..] else {
            let what = format!(
                "an entry of {} is `row column value`, this line has {}",
                self.name,
                count(words.len(), "word")
            );
            report.error(self.at(line), what, "the file may have been cut off: write it again");
            return;
        };
        let index = |word: &str, most: usize| {
            word.parse::<usize>().ok().filter(|&i| i > 0 && i <= most).map(|i| i - 1)
        };
        let (rows, columns) = self.size;
        let (Some(row), Some(column)) = (index(row, rows), index(column, columns)) else {
            let what =
                format!("({row}, {column}) is no place in {} of {rows} × {columns}", self.name);
            report.error(self.at(line), what, "rows and columns are counted from 1");
            return;
        };
        let Some(value) = number(value, self, line, report) else { return };
        if self.form == Form::Skew && row == column && value != 0.0 {
            let what = format!("{} is skew-symmetric, and its diagonal is zero", self.name);
            report.error(self.at(line), what, "leave the entry out");
            return;
        }
        self.list.push(Entry { row, column, value, line: line.number });
    }

    fn ends(&self, listed: usize, last: usize, report: &mut MeshReport) {
        // Lines with errors are errors by themselves.
        if self.list.len() != listed && report.error_count() == 0 {
            let what = format!(
                "{} lists {} entries, and its line of sizes says {listed}",
                self.name,
                self.list.len()
            );
            let at = LinePosition { file: self.file, line: last, column: 0 };
            report.error(at, what, "the file may have been cut off: write it again");
        }
    }

    /// Values of an array of this size; none beyond all numbers.
    fn wanted(&self) -> Option<usize> {
        let (rows, columns) = self.size;
        match self.form {
            Form::General => rows.checked_mul(columns),
            Form::Symmetric => {
                rows.checked_add(1).and_then(|next| rows.checked_mul(next)).map(|n| n / 2)
            }
            Form::Skew => rows.checked_mul(rows.saturating_sub(1)).map(|n| n / 2),
        }
    }

    /// Takes the values of a line of an array, column after column.
    fn next(&mut self, line: &Line, at: &mut Column, report: &mut MeshReport) {
        let (rows, columns) = self.size;
        for word in line.text.split_whitespace() {
            let Some(value) = number(word, self, line, report) else { return };
            at.count += 1;
            if at.column >= columns || at.row >= rows {
                // Too many, which is noted at the end.
                continue;
            }
            if value != 0.0 {
                let (row, column) = (at.row, at.column);
                self.list.push(Entry { row, column, value, line: line.number });
            }
            at.row += 1;
            if at.row == rows {
                at.column += 1;
                at.row = match self.form {
                    Form::General => 0,
                    Form::Symmetric => at.column,
                    Form::Skew => at.column + 1,
                };
            }
        }
    }
}

fn number(word: &str, own: &Values, line: &Line, report: &mut MeshReport) -> Option<f64> {
    let shown: String = word.chars().take(24).collect();
    let plain = word.bytes().all(|c| c.is_ascii_digit() || b"+-.eE".contains(&c));
    match word.parse::<f64>().ok().filter(|_| plain) {
        Some(value) if value.is_finite() => Some(value),
        Some(_) => {
            report.error(
                own.at(line),
                format!("`{shown}` is beyond all numbers"),
                "check its exponent",
            );
            None
        }
        None => {
            let what = format!("a value of {} must be a finite number, found `{shown}`", own.name);
            report.error(own.at(line), what, "write it with a point, such as 1.5e-3");
            None
        }
    }
}

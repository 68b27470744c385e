//! Matrices that Nastran writes with OUTPUT4: as text or binary with either byte order, dense or as strings of values.
//!
//! A matrix is a head (columns, rows, form, type, name), a record for each column that is not zero, and one behind the last
//! column. A column has one run of values (dense), or strings of them, of which the head tells length and row: in two
//! numbers (big matrices, whose number of rows is negative or at least 65536) or packed into one. Lengths count words.

mod binary;
mod building;
mod text;

use self::building::{Matrix, Stop};
use super::super::raw::{LinePosition, MeshReport, list};
use super::entries::{Entries, Form};
use super::market::rows_differ;

/// What to do with a file that does not say what it should.
const DAMAGED: &str = "the file may have been cut off: write it again";
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

//! history.mat: a history with all its digits for MATLAB, a variable for each column.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use whirl_solver::cache::write_aside_by;

use super::format::Format;
use super::kept_rows::KeptRows;
use crate::matlab;
use crate::parquet::Facts;

/// Rows at most: the format counts the bytes of a variable in 31 bits. No case has as many.
const MOST: u64 = (1 << 28) - 64;
/// Variables that are no columns: names as in history.csv, units by the names of variables, facts of the run.
const OTHERS: [&str; 3] = ["columns", "units", "run"];

/// What it is called and asked for by.
pub(crate) const MAT: Format = Format {
    name: "history.mat",
    option: "--mat",
    meaning: "the history with all digits for MATLAB",
    part: None,
};

/// Writes the rows that a run has kept, whole or not at all.
///
/// # Errors
/// They cannot be read, or are more than a variable has; the file cannot be written.
pub(crate) fn write_mat(
    rows: &KeptRows,
    names: &[String],
    facts: &Facts,
    to: &Path,
) -> io::Result<()> {
    if rows.count() > MOST {
        return Err(io::Error::other(format!("a variable of MATLAB has at most {MOST} rows")));
    }
    write_aside_by(to, &mut |file| fill(rows, (names, facts), file))?()
}

fn fill(rows: &KeptRows, (names, facts): (&[String], &Facts), file: &mut File) -> io::Result<()> {
    let mut file = BufWriter::new(file);
    let variables = matlab::variables(names, &OTHERS);
    let units = variables.iter().map(String::as_str).zip(facts.units.iter().map(String::as_str));
    // `case` is a word of MATLAB.
    let field = |name| if name == "case" { "case_name" } else { name };
    let whole = facts.whole.iter().map(|(name, own)| (field(name), own.as_str()));
    file.write_all(&matlab::head())?;
    file.write_all(&matlab::texts(OTHERS[0], names.iter().map(String::as_str)))?;
    file.write_all(&matlab::structure(OTHERS[1], units))?;
    file.write_all(&matlab::structure(OTHERS[2], whole))?;
    for (column, name) in variables.iter().enumerate() {
        file.write_all(&matlab::before_column(name, rows.count() as usize))?;
        rows.column(column, &mut |values| file.write_all(values))?;
    }
    file.flush()
}

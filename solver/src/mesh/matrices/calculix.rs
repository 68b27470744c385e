//! What CalculiX writes with `*FREQUENCY, SOLVER=MATRIXSTORAGE`: `JOB.sti` (K), `JOB.mas` (M) and `JOB.dof`.
//!
//! A line of `.dof` is `node.direction` for each row; one of `.sti` or `.mas` is `row column value`, of one half of the
//! matrix. Dofs that a boundary condition holds have no row.

use super::super::body_matrices::Slot;
use super::super::raw::{LinePosition, MeshReport};
use super::build::RawDof;
use super::entries::{Entries, Entry, Form};

const WRITTEN: &str = "let CalculiX write it with `*FREQUENCY, SOLVER=MATRIXSTORAGE`";

/// Reads `.dof`.
pub(super) fn dofs(text: &str, file: usize, report: &mut MeshReport) -> Vec<RawDof> {
    let mut dofs = Vec::new();
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let place = LinePosition { file, line: number + 1, column: 1 };
        let parts = line.trim().split_once('.');
        let read = parts.and_then(|(node, direction)| {
            let label: u64 = node.parse().ok().filter(|&label| label > 0)?;
            let slot = match direction.parse::<usize>().ok()? {
                i @ 1..=3 => Slot::Translation(i - 1),
                i @ 4..=6 => Slot::Turn(i - 4),
                _ => return None,
            };
            Some(RawDof { label, slot, place })
        });
        match read {
            Some(dof) => dofs.push(dof),
            None => {
                let shown: String = line.trim().chars().take(24).collect();
                let what = format!(
                    "`{shown}` is no dof, which is `node.direction` with a direction from 1 to 6"
                );
                report.error(place, what, WRITTEN);
            }
        }
    }
    if dofs.is_empty() && report.error_count() == 0 {
        let place = LinePosition { file, line: 0, column: 0 };
        report.error(place, "the file lists no dofs", WRITTEN);
    }
    dofs
}

/// Reads `.sti` or `.mas`, of so many dofs.
pub(super) fn matrix(
    text: &str,
    (name, file): (&str, usize),
    size: usize,
    report: &mut MeshReport,
) -> Entries {
    let mut list = Vec::new();
    let mut rows = vec![false; size];
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let place = LinePosition { file, line: number + 1, column: 1 };
        let words: Vec<&str> = line.split_whitespace().collect();
        let [row, column, value] = words[..] else {
            let what = format!(
                "an entry of {name} is `row column value`, this line has {} words",
                words.len()
            );
            report.error(place, what, "the file may have been cut off: write it again");
            continue;
        };
        let index = |word: &str| word.parse::<usize>().ok().filter(|&i| i > 0);
        let (Some(row), Some(column)) = (index(row), index(column)) else {
            let what = format!("({row}, {column}) is no place in {name}");
            report.error(place, what, WRITTEN);
            continue;
        };
        if row.max(column) > size {
            let what = format!("({row}, {column}) is beyond the {size} dofs of the job");
            report.error(place, what, "use the .dof, .sti and .mas of one run");
            continue;
        }
        let plain = value.bytes().all(|c| c.is_ascii_digit() || b"+-.eE".contains(&c));
        let Some(value) = value.parse::<f64>().ok().filter(|value| value.is_finite() && plain)
        else {
            let shown: String = value.chars().take(24).collect();
            let what = format!("a value of {name} must be a finite number, found `{shown}`");
            report.error(place, what, WRITTEN);
            continue;
        };
        rows[row - 1] = true;
        rows[column - 1] = true;
        list.push(Entry { row: row - 1, column: column - 1, value, line: number + 1 });
    }
    if let Some(row) = rows.iter().position(|known| !known).filter(|_| report.error_count() == 0) {
        // CalculiX writes every diagonal.
        let place = LinePosition { file, line: 0, column: 0 };
        let what = format!("{name} has no entries in row {} of {size}", row + 1);
        report.error(
            place,
            what,
            "use the .dof, .sti and .mas of one run, and write them again if they were cut off",
        );
    }
    Entries { name: name.to_owned(), file, form: Form::Symmetric, list }
}

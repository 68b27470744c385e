//! Entries of matrices as files list them, and sparse matrices of them.

use std::collections::HashMap;

use super::super::raw::{LinePosition, MeshReport};

/// Entries (i, j) and (j, i) of a symmetric matrix agree to this part of √(|A_ii A_jj|): single precision keeps no more.
const SYMMETRIC: f64 = 1e-6;
/// Of the largest entry.
const ROUNDING: f64 = 1e-6;
/// Errors of one kind that are listed for a matrix.
const LISTED: usize = 5;

/// Which entries of a matrix are listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// One of (i, j) and (j, i), which are equal.
    Symmetric,
    /// One of (i, j) and (j, i), of which one is the negative of the other.
    Skew,
    /// All.
    General,
}

/// An entry with its line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Entry {
    pub(super) row: usize,
    pub(super) column: usize,
    pub(super) value: f64,
    pub(super) line: usize,
}

/// A matrix as its file lists it, by the dofs of the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entries {
    /// What messages call it, such as `K`.
    pub(super) name: String,
    /// Index of its file among those of the report.
    pub(super) file: usize,
    pub(super) form: Form,
    pub(super) list: Vec<Entry>,
}

/// How large the entries of a matrix are.
struct Scales {
    /// |A_ii| of each row that has it.
    diagonal: HashMap<usize, f64>,
    largest: f64,
}

/// What a matrix must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Symmetric,
    Skew,
}

impl Entries {
    /// The place of an entry.
    pub(super) fn at(&self, entry: &Entry) -> LinePosition {
        LinePosition { file: self.file, line: entry.line, column: 0 }
    }

    /// The entries on and below the diagonal, once each, of a matrix of this kind, which are made of both halves where both
    /// are listed. What contradicts is noted; `called` are the dofs' names.
    pub(super) fn lower(
        &self,
        kind: Kind,
        called: &[String],
        report: &mut MeshReport,
    ) -> Vec<Entry> {
        let sign = if kind == Kind::Skew { -1.0 } else { 1.0 };
        if self.form == Form::Skew && kind == Kind::Symmetric {
            let what = format!("{} is skew-symmetric, and must be symmetric", self.name);
            report.error(self.top(), what, "write the matrix that is meant");
            return Vec::new();
        }
        if self.form == Form::Symmetric && kind == Kind::Skew {
            let what = format!("{} is symmetric, and must be skew-symmetric", self.name);
            report.error(self.top(), what, "write all of its entries, or as skew-symmetric");
            return Vec::new();
        }
        let largest = self.list.iter().fold(0.0, |most: f64, entry| most.max(entry.value.abs()));
        let mut diagonal = HashMap::new();
        let mut known: HashMap<(usize, usize), usize> = HashMap::with_capacity(self.list.len());
        let mut twice = 0;
        for (place, entry) in self.list.iter().enumerate() {
            if entry.row == entry.column {
                diagonal.insert(entry.row, entry.value.abs());
            }
            let Some(first) = known.insert((entry.row, entry.column), place) else { continue };
            twice += 1;
            if twice <= LISTED {
                let [row, column] = [entry.row, entry.column].map(|dof| &called[dof]);
                let what = format!("the entry ({row}, {column}) of {} is given twice", self.name);
                let help = format!("line {} has the first; give it once", self.list[first].line);
                report.error(self.at(entry), what, help);
            }
        }
        let scales = Scales { diagonal, largest };
        let mut unequal = 0;
        let mut lower = Vec::with_capacity(self.list.len());
        for entry in &self.list {
            let (row, column) = (entry.row, entry.column);
            let other = known.get(&(column, row)).map(|&place| self.list[place]);
            let below = row >= column;
            let own = if below { entry.value } else { sign * entry.value };
            let (row, column) = (row.max(column), row.min(column));
            match other {
                // The half below the diagonal speaks for both.
                Some(_) if !below => {}
                None if self.form == Form::General => {
                    self.compare(entry, 0.0, (sign, &scales), called, &mut unequal, report);
                    lower.push(Entry { row, column, value: 0.5 * own, ..*entry });
                }
                None => lower.push(Entry { row, column, value: own, ..*entry }),
                Some(other) => {
                    self.compare(entry, other.value, (sign, &scales), called, &mut unequal, report);
                    let value = 0.5 * (own + sign * other.value);
                    lower.push(Entry { row, column, value, ..*entry });
                }
            }
        }
        if unequal > LISTED {
            let what = format!("{} has {} more such entries", self.name, unequal - LISTED);
            report.error(self.top(), what, "correct those above first");
        }
        lower
    }

    /// Notes an entry whose mirror image has another value.
    fn compare(
        &self,
        entry: &Entry,
        other: f64,
        (sign, scales): (f64, &Scales),
        called: &[String],
        unequal: &mut usize,
        report: &mut MeshReport,
    ) {
        let own = |dof: usize| scales.diagonal.get(&dof).copied().unwrap_or(0.0);
        let scale = (own(entry.row) * own(entry.column)).sqrt();
        // A skew matrix has no diagonal; what is small beside all of it may be rounding.
        let largest = scales.largest;
        let scale = scale.max(entry.value.abs().min(other.abs())).max(ROUNDING * largest);
        if (entry.value - sign * other).abs() <= SYMMETRIC * scale {
            return;
        }
        *unequal += 1;
        if *unequal > LISTED {
            return;
        }
        let [row, column] = [entry.row, entry.column].map(|dof| &called[dof]);
        let what = match sign < 0.0 {
            false => format!(
                "{} is not symmetric: ({row}, {column}) is {:e}, but ({column}, {row}) is {other:e}",
                self.name, entry.value
            ),
            true => format!(
                "{} is not skew-symmetric: ({row}, {column}) is {:e}, but ({column}, {row}) is {other:e}",
                self.name, entry.value
            ),
        };
        let help = "export the matrix without gyroscopic or follower terms and friction; of a symmetric file write one half, \
                    and say so in its head";
        report.error(self.at(entry), what, help);
    }

    fn top(&self) -> LinePosition {
        LinePosition { file: self.file, line: 0, column: 0 }
    }
}

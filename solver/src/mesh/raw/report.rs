//! What is wrong or odd in a file of a mesh, as it is found.

use crate::error::{InputError, InputErrors};

/// As many errors of a file are listed; the others are counted.
const LISTED: usize = 100;

/// Line and column of an error, and the file that they are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct LinePosition {
    /// Index into [`MeshReport::files`]: 0 is the mesh's own file, the others are those that it includes.
    pub(crate) file: usize,
    /// From 1; 0 where the whole file is meant.
    pub(crate) line: usize,
    /// In characters, from 1; 0 where the whole line is meant.
    pub(crate) column: usize,
}

/// Errors and warnings as they are found.
pub(crate) struct MeshReport {
    /// Paths of the files, the mesh's own first.
    pub(crate) files: Vec<String>,
    errors: Vec<(LinePosition, InputError)>,
    warnings: Vec<(LinePosition, InputError)>,
    error_count: usize,
    /// Of these such as are listed already.
    repeated: usize,
}

impl MeshReport {
    pub(crate) fn new(path: &str) -> MeshReport {
        let (errors, warnings) = (Vec::new(), Vec::new());
        MeshReport { files: vec![path.to_owned()], errors, warnings, error_count: 0, repeated: 0 }
    }

    fn entry(&self, place: LinePosition, what: String, help: String) -> (LinePosition, InputError) {
        let file = self.files[place.file].clone();
        (place, InputError { file, line: place.line, column: place.column, what, help })
    }

    /// Notes what makes the file unreadable, once.
    pub(crate) fn error(
        &mut self,
        at: impl Into<LinePosition>,
        what: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.error_count += 1;
        let error = self.entry(at.into(), what.into(), help.into());
        if self.errors.contains(&error) {
            self.repeated += 1;
        } else if self.errors.len() < LISTED {
            self.errors.push(error);
        }
    }

    /// Notes an error of the whole file.
    pub(crate) fn error_in_file(&mut self, what: impl Into<String>, help: impl Into<String>) {
        self.error(LinePosition::default(), what, help);
    }

    /// Notes what is left out or looks odd.
    pub(crate) fn warn(
        &mut self,
        at: impl Into<LinePosition>,
        what: impl Into<String>,
        help: impl Into<String>,
    ) {
        let warning = self.entry(at.into(), what.into(), help.into());
        self.warnings.push(warning);
    }

    /// `line 3`, or `line 3 of PATH` where it is in another file than `seen_from`.
    pub(crate) fn line(&self, place: LinePosition, seen_from: LinePosition) -> String {
        match place.file == seen_from.file {
            true => format!("line {}", place.line),
            false => format!("line {} of {}", place.line, self.files[place.file]),
        }
    }

    /// How many errors there were so far.
    pub(crate) fn error_count(&self) -> usize {
        self.error_count
    }

    /// The errors in the order of the lines; of very many the first.
    pub(crate) fn into_errors(mut self) -> InputErrors {
        self.errors.sort_by_key(|(place, _)| *place);
        let more = self.error_count - self.repeated - self.errors.len();
        if more > 0 {
            let what = format!("and {more} more");
            let help = "correct these first: one of them may be the cause of many";
            let last = self.entry(LinePosition::default(), what, help.to_owned());
            self.errors.push(last);
        }
        InputErrors(self.errors.into_iter().map(|(_, error)| error).collect())
    }

    /// The warnings in the order of the lines.
    pub(crate) fn into_warnings(mut self) -> Vec<InputError> {
        self.warnings.sort_by_key(|(place, _)| *place);
        self.warnings.into_iter().map(|(_, warning)| warning).collect()
    }
}

/// The first few of a list, in words.
pub(crate) fn list<T: ToString>(items: impl IntoIterator<Item = T>) -> String {
    let mut items = items.into_iter();
    let first: Vec<String> = items.by_ref().take(5).map(|item| item.to_string()).collect();
    let more = if items.next().is_some() { ", …" } else { "" };
    format!("{}{more}", first.join(", "))
}

/// A number of things, in words.
pub(crate) fn count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

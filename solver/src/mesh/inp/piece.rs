//! A piece of the text of an input file.

use std::ops::Range;
use std::rc::Rc;

/// Lines of a file that stand together.
#[derive(Debug)]
pub(super) struct Piece {
    /// Index into the files of the report.
    pub(super) file: usize,
    /// Number of its first line.
    pub(super) first_line: usize,
    pub(super) text: Rc<str>,
    pub(super) range: Range<usize>,
}

impl Piece {
    pub(super) fn text(&self) -> &str {
        &self.text[self.range.clone()]
    }
}

//! What reports and figures read a history by, wherever its rows are.

use std::io;

/// A history whose rows are all there. Times never fall from row to row.
pub(crate) trait ReadHistory {
    /// Names of the columns.
    fn names(&self) -> &[String];

    /// Number of rows.
    ///
    /// # Errors
    /// It cannot be read, here and below.
    fn count(&self) -> io::Result<u64>;

    /// Where the rows begin, for [`ReadHistory::scan`]: a place means something to its own history only.
    fn start(&self) -> u64;

    /// Time of the last row (s), if there is a row.
    fn last_time(&self) -> io::Result<Option<f64>>;

    /// Where the first row at `time` (s) or later begins; the end if there is none.
    fn place_of_time(&self, time: f64) -> io::Result<u64>;

    /// Calls `each` with the values of `columns`, row after row from the place `from` on.
    ///
    /// # Panics
    /// If there is no column of one of these names.
    fn scan(&self, from: u64, columns: &[&str], each: &mut dyn FnMut(&[f64])) -> io::Result<()>;

    /// As [`ReadHistory::scan`], for the first row only, if there is one.
    fn first_row(
        &self,
        from: u64,
        columns: &[&str],
        each: &mut dyn FnMut(&[f64]),
    ) -> io::Result<()>;
}

/// Places of columns among all.
///
/// # Panics
/// If there is no column of one of these names.
pub(super) fn places<'a>(names: &'a [String], columns: &'a [&str]) -> impl Iterator<Item = usize> {
    columns.iter().map(|name| {
        let found = names.iter().position(|own| own == name);
        found.unwrap_or_else(|| panic!("histories have a column {name}"))
    })
}

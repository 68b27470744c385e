//! Results of a run: files and tables.

mod history_csv;
mod summary;
mod table;

use std::ops::Range;

use whirl_solver::history::History;

pub(crate) use history_csv::history_csv;
pub(crate) use summary::{Summary, Times};
pub(crate) use table::{stops, supports, table};

/// The values of a column that every history has.
///
/// # Panics
/// If it has none of that name.
pub(crate) fn column(history: &History, name: &str) -> Vec<f64> {
    history.column(name).unwrap_or_else(|| panic!("histories have a column {name}"))
}

/// Rows of the last `cycle` seconds.
pub(crate) fn last_cycle(time: &[f64], cycle: f64) -> Range<usize> {
    let end = time.last().copied().unwrap_or(0.0);
    // A row that lies a rounding error before the cycle belongs to it.
    let first = time.partition_point(|&t| t < end - cycle * (1.0 + 1e-9));
    first..time.len()
}

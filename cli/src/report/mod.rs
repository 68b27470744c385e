//! Results of a run: columns, files, tables.

mod columns;
mod history_csv;

pub use columns::Columns;
pub(crate) use history_csv::history_csv;

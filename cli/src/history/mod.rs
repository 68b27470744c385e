//! The history of a run: a file, history.csv, that is written while it is computed and read again for summary and figures,
//! or a table in memory with the same numbers. Memory does not grow with the file.

mod file;
mod npz;
mod read;
mod rounded;
mod table;
mod text;
mod thinned;
mod writer;

pub(crate) use file::HistoryFile;
pub(crate) use npz::write_npz;
pub(crate) use read::ReadHistory;
pub use table::HistoryTable;
pub(crate) use thinned::{Bucket, Thinned};
pub(crate) use writer::{HistoryWriter, NotWritten, Written};

/// Name of the file among the results.
pub(crate) const NAME: &str = "history.csv";
/// Name of the same for NumPy, where it is wanted.
pub(crate) const NPZ: &str = "history.npz";

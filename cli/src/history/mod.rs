//! history.csv: written while it is computed, read again for summary and figures. Memory does not grow with it.

mod file;
mod npz;
mod text;
mod thinned;
mod writer;

pub(crate) use file::HistoryFile;
pub(crate) use npz::write_npz;
pub(crate) use thinned::{Bucket, Thinned};
pub(crate) use writer::{HistoryWriter, NotWritten};

/// Name of the file among the results.
pub(crate) const NAME: &str = "history.csv";
/// Name of the same for NumPy, where it is wanted.
pub(crate) const NPZ: &str = "history.npz";

//! The history of a run: a file, history.csv, that is written while it is computed and read again for summary and figures,
//! or a table in memory with the same numbers. Memory does not grow with the file.

mod file;
mod format;
mod groups;
mod growing;
mod hdf5;
mod kept_rows;
mod mat;
mod npz;
mod parquet;
mod read;
mod rounded;
mod table;
mod text;
mod thinned;
mod writer;
mod written;

pub(crate) use file::HistoryFile;
pub(crate) use format::Format;
pub(crate) use groups::Groups;
pub(crate) use hdf5::{HDF5, write_hdf5};
pub(crate) use kept_rows::{KeptRows, PART, REST};
pub(crate) use mat::{MAT, write_mat};
pub(crate) use npz::{NPZ, write_npz};
pub(crate) use parquet::{PARQUET, write_parquet};
pub(crate) use read::ReadHistory;
pub use table::HistoryTable;
pub(crate) use thinned::{Bucket, Thinned};
pub(crate) use writer::{HistoryWriter, NotWritten};
pub(crate) use written::Written;

/// Name of the file among the results.
pub(crate) const NAME: &str = "history.csv";

/// All files for other programs.
pub(crate) const FORMATS: [Format; 4] = [NPZ, PARQUET, MAT, HDF5];

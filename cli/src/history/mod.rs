//! The history of a run: a file, history.csv, that is written while it is computed and read again for summary and figures,
//! or a table in memory with the same numbers. Memory does not grow with the file.

mod file;
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
pub(crate) use groups::Groups;
pub(crate) use hdf5::{PART as HDF5_PART, write_hdf5};
pub(crate) use kept_rows::{KeptRows, PART, REST};
pub(crate) use mat::write_mat;
pub(crate) use npz::write_npz;
pub(crate) use parquet::write_parquet;
pub(crate) use read::ReadHistory;
pub use table::HistoryTable;
pub(crate) use thinned::{Bucket, Thinned};
pub(crate) use writer::{HistoryWriter, NotWritten};
pub(crate) use written::Written;

/// Name of the file among the results.
pub(crate) const NAME: &str = "history.csv";
/// Name of the same for NumPy, where it is wanted.
pub(crate) const NPZ: &str = "history.npz";
/// The same for programs that read columns, and for MATLAB.
pub(crate) const PARQUET: &str = "history.parquet";
pub(crate) const MAT: &str = "history.mat";
/// The same as HDF5.
pub(crate) const HDF5: &str = "history.h5";

//! history.h5: a history with all its digits as HDF5, a dataset for each column.

use std::fs;
use std::io;
use std::path::Path;

use hdf5_pure::{
    AttrValue, Error, File, FileAccessProperties, FileBuilder, MaxExtent, MemoryStrategy,
    SyncPolicy,
};

use super::format::Format;
use super::kept_rows::KeptRows;
use crate::parquet::{Facts, GROUP};

/// The file while it is written.
const PART: &str = "history.h5.part";

/// What it is called and asked for by.
pub(crate) const HDF5: Format = Format {
    name: "history.h5",
    option: "--hdf5",
    meaning: "the history with all digits as HDF5",
    part: Some(PART),
};

/// Writes the rows that a run has kept, whole or not at all.
///
/// # Errors
/// They cannot be read, or the file cannot be written.
pub(crate) fn write_hdf5(
    rows: &KeptRows,
    names: &[String],
    facts: &Facts,
    to: &Path,
) -> io::Result<()> {
    let part = to.with_file_name(PART);
    let written = fill(rows, names, facts, &part).and_then(|()| fs::rename(&part, to));
    if written.is_err() {
        let _ = fs::remove_file(&part);
    }
    written
}

fn fill(rows: &KeptRows, names: &[String], facts: &Facts, part: &Path) -> io::Result<()> {
    let text = |own: &str| AttrValue::VarLenString(own.to_owned());
    let mut empty = FileBuilder::new();
    for (name, value) in &facts.whole {
        empty.set_attr(name, text(value));
    }
    for (name, unit) in names.iter().zip(&facts.units) {
        let column = empty.create_dataset(name).with_f64_data(&[]).with_shape(&[0]);
        let column = column.with_maxshape(&[MaxExtent::Unlimited]).with_chunks(&[GROUP as u64]);
        column.set_attr("units", text(unit));
    }
    empty.write(part).map_err(said)?;
    let options = FileAccessProperties::new()
        .with_memory_strategy(MemoryStrategy::Bounded)
        .with_sync_policy(SyncPolicy::OnClose);
    let file = File::open_rw_with_options(part, options).map_err(said)?;
    for (place, name) in names.iter().enumerate() {
        let mut column = file.dataset(name).map_err(said)?;
        rows.column(place, &mut |values| match values.is_empty() {
            true => Ok(()),
            false => column.append_raw(values).map_err(said),
        })?;
    }
    file.close().map_err(said)
}

fn said(error: Error) -> io::Error {
    io::Error::other(error.to_string())
}

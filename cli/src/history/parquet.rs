//! history.parquet: a history with all its digits for programs that read columns, with the units of these.

use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

use whirl_solver::cache::write_aside_by;

use super::format::Format;
use super::kept_rows::{KeptRows, PART};
use crate::parquet::{Facts, Numbers};

/// Who writes it.
const CREATOR: &str = concat!("whirl ", env!("CARGO_PKG_VERSION"));

/// What it is called and asked for by.
pub(crate) const PARQUET: Format = Format {
    name: "history.parquet",
    option: "--parquet",
    meaning: "the history with all digits and its units, for programs that read columns",
    part: None,
};

/// Writes the rows that a run has kept in the folder of `to`, whole or not at all. Of a run that is `over` the file that they
/// are in becomes this one, as nobody goes on with them.
///
/// # Errors
/// The rows cannot be read, or the file cannot be written.
pub(crate) fn write_parquet(
    rows: &KeptRows,
    names: &[String],
    (facts, over): (&Facts, bool),
    to: &Path,
) -> io::Result<()> {
    let (length, shape) = rows.shape();
    let foot = Numbers(names.len()).foot(names, shape, facts, CREATOR);
    if !over {
        let mut fill = |file: &mut File| {
            rows.write(file)?;
            file.write_all(&foot)
        };
        return write_aside_by(to, &mut fill)?();
    }
    let part = to.with_file_name(PART);
    let mut file = File::options().write(true).open(&part)?;
    file.set_len(length)?;
    file.seek(SeekFrom::End(0))?;
    rows.write_rest(&mut file)?;
    file.write_all(&foot)?;
    file.sync_all()?;
    fs::rename(&part, to)
}

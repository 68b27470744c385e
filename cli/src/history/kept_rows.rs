//! The rows of a run with all their digits, read again.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::Path;

use super::text;
use crate::parquet::{GROUP, MAGIC, Numbers};

/// Whole groups, a file of Parquet without its end.
pub(crate) const PART: &str = "history.part";
/// The number of the group that is not whole, and its rows.
pub(crate) const REST: &str = "history.rest";

/// Bytes of a value, and of the number before those of the rest.
const VALUE: usize = 8;

/// Whole groups in one file, and the rows that follow them.
pub(crate) struct KeptRows {
    part: File,
    numbers: Numbers,
    whole: u64,
    /// Row after row.
    rest: Vec<f64>,
}

impl KeptRows {
    /// The rows that a run of so many columns keeps in a folder.
    ///
    /// # Errors
    /// They cannot be read, or are none.
    pub(crate) fn open(folder: &Path, columns: usize) -> io::Result<Self> {
        let (numbers, part) = (Numbers(columns), File::open(folder.join(PART))?);
        let there = part.metadata()?.len();
        let bytes = fs::read(folder.join(REST))?;
        let (whole, rest) = match bytes.split_first_chunk() {
            Some((head, rows)) => (u64::from_le_bytes(*head), doubles(rows)),
            // A process that was ended when it had just made a group whole.
            None => (there.saturating_sub(MAGIC.len() as u64) / numbers.length(GROUP), Vec::new()),
        };
        let needed = numbers.length(GROUP).checked_mul(whole);
        if needed.is_none_or(|needed| needed + MAGIC.len() as u64 > there) {
            return Err(io::Error::other(format!("`{PART}` has fewer rows than `{REST}` says")));
        }
        let rows = rest.len() / columns;
        let rest = rest.into_iter().take(rows * columns).collect();
        Ok(KeptRows { part, numbers, whole, rest })
    }

    /// How many there are.
    pub(crate) fn count(&self) -> u64 {
        self.whole * GROUP as u64 + self.left() as u64
    }

    /// Rows behind the whole groups.
    fn left(&self) -> usize {
        self.rest.len() / self.numbers.0
    }

    /// The first rows of a group, one after the other.
    ///
    /// # Errors
    /// It has fewer, or they cannot be read.
    pub(super) fn rows_of_group(&self, group: u64, rows: usize) -> io::Result<Vec<f64>> {
        let columns = self.numbers.0;
        if group == self.whole && rows <= self.left() {
            return Ok(self.rest[..rows * columns].to_vec());
        }
        if group >= self.whole {
            return Err(io::Error::other(format!("`{REST}` has fewer rows")));
        }
        let mut all = vec![0.0; rows * columns];
        for column in 0..columns {
            let values = doubles(&self.values(group, column, rows)?);
            all.iter_mut()
                .skip(column)
                .step_by(columns)
                .zip(values)
                .for_each(|(to, own)| *to = own);
        }
        Ok(all)
    }

    /// The bytes of the first values of a column in a whole group.
    fn values(&self, group: u64, column: usize, rows: usize) -> io::Result<Vec<u8>> {
        let mut bytes = vec![0; VALUE * rows];
        let mut part = &self.part;
        part.seek(SeekFrom::Start(self.numbers.start(group) + Numbers::values(column)))?;
        part.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    /// Calls `each` with the values of a column, as bytes, part after part.
    ///
    /// # Errors
    /// They cannot be read; what `each` fails with.
    pub(super) fn column(
        &self,
        column: usize,
        each: &mut dyn FnMut(&[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        for group in 0..self.whole {
            each(&self.values(group, column, GROUP)?)?;
        }
        let rest = self.rest.iter().skip(column).step_by(self.numbers.0);
        each(&rest.flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>())
    }

    /// Writes them as Parquet, but for what stands at its end.
    ///
    /// # Errors
    /// They cannot be read or written.
    pub(super) fn write(&self, to: &mut File) -> io::Result<()> {
        let mut part = &self.part;
        part.rewind()?;
        io::copy(&mut part.take(self.numbers.start(self.whole)), to)?;
        self.write_rest(to)
    }

    /// Writes the group that is not whole.
    pub(super) fn write_rest(&self, to: &mut File) -> io::Result<()> {
        if self.rest.is_empty() {
            return Ok(());
        }
        to.write_all(&self.numbers.group(&self.rest))
    }

    /// Bytes of the whole groups, with what stands before them; how many these are, and the rows behind them.
    pub(super) fn shape(&self) -> (u64, (u64, usize)) {
        (self.numbers.start(self.whole), (self.whole, self.left()))
    }

    /// Rows in the first `length` bytes of history.csv, if they are those that are kept here.
    ///
    /// # Errors
    /// Something cannot be read.
    pub(crate) fn agree(&self, history: &Path, length: u64) -> io::Result<Option<u64>> {
        let mut lines = BufReader::with_capacity(1 << 18, File::open(history)?.take(length));
        let (mut line, mut own) = (Vec::new(), Vec::new());
        lines.read_until(b'\n', &mut line)?;
        let mut count = 0;
        for group in 0..=self.whole {
            let rows = if group == self.whole { self.left() } else { GROUP };
            for row in self.rows_of_group(group, rows)?.chunks_exact(self.numbers.0) {
                line.clear();
                own.clear();
                if lines.read_until(b'\n', &mut line)? == 0 {
                    return Ok(Some(count));
                }
                text::line(&mut own, row);
                if line != own {
                    return Ok(None);
                }
                count += 1;
            }
        }
        line.clear();
        Ok((lines.read_until(b'\n', &mut line)? == 0).then_some(count))
    }
}

fn doubles(bytes: &[u8]) -> Vec<f64> {
    let (values, _) = bytes.as_chunks();
    values.iter().map(|own| f64::from_le_bytes(*own)).collect()
}

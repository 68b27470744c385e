//! What is done of a sweep, on disk: records that are added one after the other, each with its length and a checksum, and
//! none that is changed.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};
use whirl_solver::cache::{Key, pack, unpack};

use super::row::Row;
use crate::checkpoint::Identity;

/// Name of the file.
pub(super) const NAME: &str = "sweep.journal";
/// Layout of the records.
const LAYOUT: &str = "whirl sweep 3";
/// Bytes of a record, at most: a length that is larger is none.
const LONGEST: u32 = 1 << 26;

/// A record.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Record {
    /// A sweep begins, or goes on: on what its numbers depend.
    Begin(Identity),
    /// Names of numbers that rows have from here on.
    Names(Vec<String>),
    /// A point that is done.
    Done {
        /// What makes it another one than all others.
        point: Key,
        /// Which of the lists of names it has, from 0.
        names: u32,
        row: Row,
    },
}

/// Records that were read, and where the last whole one ends.
pub(super) struct Records {
    reader: io::BufReader<File>,
    /// Bytes of whole records.
    whole: u64,
}

impl Records {
    /// Of a file from its beginning.
    ///
    /// # Errors
    /// It cannot be opened.
    pub(super) fn open(path: &Path) -> io::Result<Self> {
        Ok(Records { reader: io::BufReader::new(File::open(path)?), whole: 0 })
    }

    /// The next record, with where it begins; none at the end, or where one is torn or damaged.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn next(&mut self) -> io::Result<Option<(u64, Record)>> {
        let Some(length) = read_exactly(&mut self.reader, 4)? else { return Ok(None) };
        let length = u32::from_le_bytes(length.try_into().expect("four bytes"));
        if length > LONGEST {
            return Ok(None);
        }
        let Some(bytes) = read_exactly(&mut self.reader, length as usize)? else { return Ok(None) };
        let Some(record) = unpack(&Key::of(&LAYOUT), &bytes) else { return Ok(None) };
        let start = self.whole;
        self.whole += 4 + u64::from(length);
        Ok(Some((start, record)))
    }

    /// The record that begins at a place.
    ///
    /// # Errors
    /// The file cannot be read, or has changed.
    pub(super) fn at(&mut self, place: u64) -> io::Result<Record> {
        self.reader.seek(SeekFrom::Start(place))?;
        self.whole = place;
        let changed = || io::Error::other(format!("`{NAME}` has changed while it was read"));
        self.next()?.map(|(_, record)| record).ok_or_else(changed)
    }

    /// Bytes up to the end of the last record that was read.
    pub(super) fn whole(&self) -> u64 {
        self.whole
    }
}

/// So many bytes, if there are as many.
fn read_exactly(reader: &mut impl Read, count: usize) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    reader.take(count as u64).read_to_end(&mut bytes)?;
    Ok((bytes.len() == count).then_some(bytes))
}

/// The end of the file, where records are added.
pub(super) struct Journal {
    file: File,
    /// Lists of names that stand in it.
    names: Vec<Vec<String>>,
}

impl Journal {
    /// A new file.
    ///
    /// # Errors
    /// It cannot be made.
    pub(super) fn create(path: &Path) -> io::Result<Self> {
        let file = File::create(path)?;
        Ok(Journal { file, names: Vec::new() })
    }

    /// Goes on after the first `whole` bytes, which have these lists of names; what follows is dropped.
    ///
    /// # Errors
    /// The file cannot be opened or cut.
    pub(super) fn go_on(path: &Path, whole: u64, names: Vec<Vec<String>>) -> io::Result<Self> {
        let mut file = File::options().write(true).open(path)?;
        file.set_len(whole)?;
        file.seek(SeekFrom::End(0))?;
        Ok(Journal { file, names })
    }

    /// Adds who begins, and has it on disk.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn begin(&mut self, identity: &Identity) -> io::Result<()> {
        let bytes = framed(&Record::Begin(identity.clone()))?;
        self.file.write_all(&bytes)?;
        self.file.sync_data()
    }

    /// Adds points that are done, with the names of their numbers, and has them on disk. What is written of them where there
    /// is an error is dropped by whoever goes on.
    ///
    /// # Errors
    /// They cannot be written.
    pub(super) fn add(&mut self, done: Vec<(Key, Vec<String>, Row)>) -> io::Result<()> {
        let mut bytes = Vec::new();
        for (point, own, row) in done {
            let names = match self.names.iter().position(|names| *names == own) {
                Some(place) => place,
                None => {
                    bytes.extend(framed(&Record::Names(own.clone()))?);
                    self.names.push(own);
                    self.names.len() - 1
                }
            };
            bytes.extend(framed(&Record::Done { point, names: names as u32, row })?);
        }
        self.file.write_all(&bytes)?;
        self.file.sync_data()
    }
}

/// Bytes of the record with which a sweep begins: a journal that has fewer holds nothing.
///
/// # Errors
/// There is no such record.
pub(super) fn beginning(identity: &Identity) -> io::Result<usize> {
    Ok(framed(&Record::Begin(identity.clone()))?.len())
}

fn framed(record: &Record) -> io::Result<Vec<u8>> {
    let bytes = pack(&Key::of(&LAYOUT), record)?;
    let length = u32::try_from(bytes.len()).ok().filter(|length| *length <= LONGEST);
    let length = length.ok_or_else(|| io::Error::other("a record is too long"))?;
    Ok([&length.to_le_bytes()[..], &bytes].concat())
}

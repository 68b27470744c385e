//! history.npz: a history for NumPy. An archive (zip, nothing compressed) with a file of doubles for each column, so that
//! all places in it are known from the number of rows, and one pass over the history fills it.
//!
//! Formats: NumPy, NEP 1, version 1.0; PKWARE, APPNOTE.TXT 6.3, with its extension for files beyond 4 GiB.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

use whirl_solver::cache::write_aside_by;

use super::ReadHistory;

/// Rows that are in memory at a time.
const ROWS: usize = 4096;
/// Bytes of a local header without its name.
const LOCAL: u64 = 30;
/// Larger sizes and places stand in an extension.
const LARGEST: u64 = 0xFFFF_FFFF;
/// 1 January 1980, the first day of the format: the same history gives the same bytes.
const DAY: u16 = 0x21;

/// A file of the archive.
struct Entry {
    name: String,
    /// Where its local header begins.
    place: u64,
    /// Bytes of its content.
    length: u64,
    check: crc32fast::Hasher,
}

/// Writes a history, whole or not at all.
///
/// # Errors
/// The history cannot be read, or the file cannot be written; more rows than a column of the format has.
pub(crate) fn write_npz(history: &dyn ReadHistory, to: &Path) -> io::Result<()> {
    let rows = history.count()?;
    write_aside_by(to, &mut |file| fill(history, rows, file))?()
}

fn fill(history: &dyn ReadHistory, rows: u64, file: &mut File) -> io::Result<()> {
    let head = header(rows);
    let length = head.len() as u64 + 8 * rows;
    if length >= LARGEST {
        return Err(io::Error::other("a column has at most 5e8 rows"));
    }
    let mut place = 0;
    let mut entries = Vec::with_capacity(history.names().len());
    for name in history.names() {
        let mut check = crc32fast::Hasher::new();
        check.update(&head);
        let name = format!("{name}.npy");
        let next = place + LOCAL + name.len() as u64 + length;
        entries.push(Entry { name, place, length, check });
        place = next;
    }
    let first = |entry: &Entry| entry.place + LOCAL + entry.name.len() as u64;
    for entry in &entries {
        file.seek(SeekFrom::Start(first(entry)))?;
        file.write_all(&head)?;
    }
    let names: Vec<&str> = history.names().iter().map(String::as_str).collect();
    let mut columns: Vec<Vec<u8>> = names.iter().map(|_| Vec::with_capacity(8 * ROWS)).collect();
    let mut done = head.len() as u64;
    let mut flush = |columns: &mut [Vec<u8>]| -> io::Result<()> {
        for (entry, column) in entries.iter_mut().zip(columns.iter_mut()) {
            file.seek(SeekFrom::Start(first(entry) + done))?;
            file.write_all(column)?;
            entry.check.update(column);
        }
        done += columns.first().map_or(0, |column| column.len() as u64);
        columns.iter_mut().for_each(Vec::clear);
        Ok(())
    };
    let mut failed = None;
    history.scan(history.start(), &names, &mut |row| {
        for (column, value) in columns.iter_mut().zip(row) {
            column.extend(value.to_le_bytes());
        }
        if columns[0].len() == 8 * ROWS {
            failed = failed.take().or(flush(&mut columns).err());
        }
    })?;
    failed.map_or(Ok(()), Err)?;
    flush(&mut columns)?;
    for entry in &entries {
        file.seek(SeekFrom::Start(entry.place))?;
        file.write_all(&local(entry))?;
    }
    file.seek(SeekFrom::Start(place))?;
    let directory: Vec<u8> = entries.iter().flat_map(central).collect();
    file.write_all(&directory)?;
    file.write_all(&end(entries.len(), place, directory.len() as u64))
}

/// The header of an array of doubles; with it the numbers begin at a multiple of 64 bytes of the file.
fn header(rows: u64) -> Vec<u8> {
    let mut text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows},), }}");
    while (10 + text.len() + 1) % 64 != 0 {
        text.push(' ');
    }
    text.push('\n');
    let mut head = b"\x93NUMPY\x01\x00".to_vec();
    head.extend((text.len() as u16).to_le_bytes());
    head.extend(text.as_bytes());
    head
}

/// Version, flags, no compression, time and day, check, both sizes, length of the name.
fn shared(entry: &Entry, bytes: &mut Vec<u8>) {
    for value in [45_u16, 0, 0, 0, DAY] {
        bytes.extend(value.to_le_bytes());
    }
    let length = u32::try_from(entry.length).expect("checked before");
    for value in [entry.check.clone().finalize(), length, length] {
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend((entry.name.len() as u16).to_le_bytes());
}

fn local(entry: &Entry) -> Vec<u8> {
    let mut bytes = b"PK\x03\x04".to_vec();
    shared(entry, &mut bytes);
    bytes.extend(0_u16.to_le_bytes());
    bytes.extend(entry.name.as_bytes());
    bytes
}

fn central(entry: &Entry) -> Vec<u8> {
    let far = entry.place >= LARGEST;
    let mut bytes = b"PK\x01\x02".to_vec();
    bytes.extend(45_u16.to_le_bytes());
    shared(entry, &mut bytes);
    // The extension, a comment, the disk, attributes within and without.
    for value in [12 * u16::from(far), 0, 0, 0, 0, 0] {
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend((entry.place.min(LARGEST) as u32).to_le_bytes());
    bytes.extend(entry.name.as_bytes());
    if far {
        bytes.extend([1, 0, 8, 0]);
        bytes.extend(entry.place.to_le_bytes());
    }
    bytes
}

/// What stands behind the directory, which begins at `place`.
fn end(entries: usize, place: u64, length: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    let far = place >= LARGEST || entries >= 0xFFFF;
    if far {
        bytes.extend(b"PK\x06\x06");
        bytes.extend(44_u64.to_le_bytes());
        bytes.extend([45, 0, 45, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        for value in [entries as u64, entries as u64, length, place] {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend(b"PK\x06\x07");
        bytes.extend(0_u32.to_le_bytes());
        bytes.extend((place + length).to_le_bytes());
        bytes.extend(1_u32.to_le_bytes());
    }
    let count = entries.min(0xFFFF) as u16;
    bytes.extend(b"PK\x05\x06\0\0\0\0");
    bytes.extend(count.to_le_bytes());
    bytes.extend(count.to_le_bytes());
    bytes.extend((length.min(LARGEST) as u32).to_le_bytes());
    bytes.extend((place.min(LARGEST) as u32).to_le_bytes());
    bytes.extend([0, 0]);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::HistoryFile;

    fn number(bytes: &[u8], at: usize, count: usize) -> usize {
        bytes[at..at + count].iter().rev().fold(0, |sum, byte| 256 * sum + usize::from(*byte))
    }

    /// Names and contents, by the directory at the end; every check holds.
    fn read(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
        let last = bytes.len() - 22;
        assert_eq!(&bytes[last..last + 4], b"PK\x05\x06");
        let mut at = number(bytes, last + 16, 4);
        assert_eq!(at + number(bytes, last + 12, 4), last);
        let mut entries = Vec::new();
        for _ in 0..number(bytes, last + 10, 2) {
            assert_eq!(&bytes[at..at + 4], b"PK\x01\x02");
            let (size, name) = (number(bytes, at + 24, 4), number(bytes, at + 28, 2));
            let (check, local) = (number(bytes, at + 16, 4), number(bytes, at + 42, 4));
            let own = String::from_utf8(bytes[at + 46..at + 46 + name].to_vec()).unwrap();
            assert_eq!(&bytes[local..local + 4], b"PK\x03\x04");
            // From the check to the length of the name both headers say the same.
            assert_eq!(bytes[local + 14..local + 28], bytes[at + 16..at + 30]);
            assert_eq!(&bytes[local + 30..local + 30 + name], own.as_bytes());
            let content = &bytes[local + 30 + name..local + 30 + name + size];
            assert_eq!(crc32fast::hash(content) as usize, check, "{own}");
            entries.push((own, content.to_vec()));
            at += 46 + name + number(bytes, at + 30, 2);
        }
        entries
    }

    #[test]
    fn columns_are_arrays_by_their_names() {
        for rows in [0, 1, ROWS, 2 * ROWS + 5] {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("history.csv");
            let mut text = String::from("t_s,RX1_N\n");
            (0..rows).for_each(|i| text.push_str(&format!("{i},-{i}.5e-3\n")));
            std::fs::write(&path, text).unwrap();
            let to = folder.path().join("history.npz");
            write_npz(&HistoryFile::open(&path).unwrap(), &to).unwrap();
            let entries = read(&std::fs::read(&to).unwrap());
            let names: Vec<&str> = entries.iter().map(|(name, _)| name.as_str()).collect();
            assert_eq!(names, ["t_s.npy", "RX1_N.npy"]);
            for (k, (_, content)) in entries.iter().enumerate() {
                let start = content.len() - 8 * rows;
                assert_eq!((&content[..8], start % 64), (&b"\x93NUMPY\x01\x00"[..], 0));
                assert_eq!(number(content, 8, 2) + 10, start);
                let said = format!("'shape': ({rows},)");
                assert!(String::from_utf8_lossy(&content[..start]).contains(&said));
                for (i, value) in content[start..].chunks_exact(8).enumerate() {
                    let found = f64::from_le_bytes(value.try_into().unwrap());
                    let want =
                        if k == 0 { i as f64 } else { format!("-{i}.5e-3").parse().unwrap() };
                    assert_eq!(found, want);
                }
            }
        }
    }

    #[test]
    fn far_places_stand_in_the_extension() {
        let place = 5 << 32;
        let entry =
            Entry { name: "x.npy".into(), place, length: 128, check: crc32fast::Hasher::new() };
        let central = central(&entry);
        assert_eq!(number(&central, 42, 4) as u64, LARGEST);
        assert_eq!(number(&central, central.len() - 8, 8) as u64, place);
        let end = end(3, place, 100);
        assert_eq!((end.len(), number(&end, 48, 8) as u64), (56 + 20 + 22, place));
        assert_eq!(number(&end, 64, 8) as u64, place + 100);
    }
}

//! history.npz: a history for NumPy. An archive with a file of doubles for each column, so that all places in it are known
//! from the number of rows, and one pass over the history fills it.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

use whirl_solver::cache::write_aside_by;

use super::ReadHistory;
use super::format::Format;
use crate::archive::{Entry, LARGEST, end, header};

/// Rows that are in memory at a time.
const ROWS: usize = 4096;

/// What it is called and asked for by.
pub(crate) const NPZ: Format =
    Format { name: "history.npz", option: "--npz", meaning: "the history for NumPy", part: None };

/// Writes a history, whole or not at all.
///
/// # Errors
/// The history cannot be read, or the file cannot be written; more rows than a column of the format has.
pub(crate) fn write_npz(history: &dyn ReadHistory, to: &Path) -> io::Result<()> {
    let rows = history.count()?;
    write_aside_by(to, &mut |file| fill(history, rows, file))?()
}

fn fill(history: &dyn ReadHistory, rows: u64, file: &mut File) -> io::Result<()> {
    let head = header("<f8", false, &format!("({rows},)"));
    let length = head.len() as u64 + 8 * rows;
    if length >= LARGEST {
        return Err(io::Error::other("a column has at most 5e8 rows"));
    }
    let mut place = 0;
    let mut entries = Vec::with_capacity(history.names().len());
    for name in history.names() {
        let mut entry = Entry::new(name, place, length);
        entry.check.update(&head);
        place = entry.end();
        entries.push(entry);
    }
    for entry in &entries {
        file.seek(SeekFrom::Start(entry.content()))?;
        file.write_all(&head)?;
    }
    let names: Vec<&str> = history.names().iter().map(String::as_str).collect();
    let mut columns: Vec<Vec<u8>> = names.iter().map(|_| Vec::with_capacity(8 * ROWS)).collect();
    let mut done = head.len() as u64;
    let mut flush = |columns: &mut [Vec<u8>]| -> io::Result<()> {
        for (entry, column) in entries.iter_mut().zip(columns.iter_mut()) {
            file.seek(SeekFrom::Start(entry.content() + done))?;
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
        file.write_all(&entry.local())?;
    }
    file.seek(SeekFrom::Start(place))?;
    let directory: Vec<u8> = entries.iter().flat_map(Entry::central).collect();
    file.write_all(&directory)?;
    file.write_all(&end(entries.len(), place, directory.len() as u64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::archive::reading::{number, read};
    use crate::history::HistoryFile;

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
}

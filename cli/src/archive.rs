//! Archives: zip. Those of arrays for NumPy have nothing compressed, so that all places are known before anything is written.
//!
//! Formats: NumPy, NEP 1, version 1.0; PKWARE, APPNOTE.TXT 6.3, with its extension for files beyond 4 GiB.

use std::io::{self, Write};

use flate2::Compression;
use flate2::write::DeflateEncoder;

/// Bytes of a local header without its name.
const LOCAL: u64 = 30;
/// Larger sizes and places stand in an extension.
pub(crate) const LARGEST: u64 = 0xFFFF_FFFF;
/// 1 January 1980, the first day of the format: the same arrays give the same bytes.
const DAY: u16 = 0x21;

/// That a name has letters beyond ASCII, as UTF-8.
const UTF8: u16 = 1 << 11;
/// The method of compression that every reader has.
const DEFLATED: u16 = 8;

/// A file of the archive.
pub(crate) struct Entry {
    name: String,
    /// Where its local header begins.
    pub(crate) place: u64,
    /// Bytes of its content.
    length: u64,
    /// Bytes that stand for it, where it is compressed.
    packed: Option<u64>,
    /// Of its content.
    pub(crate) check: crc32fast::Hasher,
}

impl Entry {
    /// That of an array of so many bytes, at most [`LARGEST`], at a place of the archive.
    pub(crate) fn new(array: &str, place: u64, length: u64) -> Self {
        Entry::of(format!("{array}.npy"), (place, length), None)
    }

    fn of(name: String, (place, length): (u64, u64), packed: Option<u64>) -> Self {
        Entry { name, place, length, packed, check: crc32fast::Hasher::new() }
    }

    /// Where its content begins.
    pub(crate) fn content(&self) -> u64 {
        self.place + LOCAL + self.name.len() as u64
    }

    /// Where the next one begins.
    pub(crate) fn end(&self) -> u64 {
        self.content() + self.packed.unwrap_or(self.length)
    }

    /// What stands before its content.
    pub(crate) fn local(&self) -> Vec<u8> {
        let mut bytes = b"PK\x03\x04".to_vec();
        self.shared(&mut bytes);
        bytes.extend(0_u16.to_le_bytes());
        bytes.extend(self.name.as_bytes());
        bytes
    }

    /// What the directory says of it.
    pub(crate) fn central(&self) -> Vec<u8> {
        let far = self.place >= LARGEST;
        let mut bytes = b"PK\x01\x02".to_vec();
        bytes.extend(45_u16.to_le_bytes());
        self.shared(&mut bytes);
        // The extension, a comment, the disk, attributes within and without.
        for value in [12 * u16::from(far), 0, 0, 0, 0, 0] {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend((self.place.min(LARGEST) as u32).to_le_bytes());
        bytes.extend(self.name.as_bytes());
        if far {
            bytes.extend([1, 0, 8, 0]);
            bytes.extend(self.place.to_le_bytes());
        }
        bytes
    }

    /// Version, flags, compression, time and day, check, both sizes, length of the name.
    fn shared(&self, bytes: &mut Vec<u8>) {
        let method = if self.packed.is_some() { DEFLATED } else { 0 };
        let flags = if self.name.is_ascii() { 0 } else { UTF8 };
        for value in [45_u16, flags, method, 0, DAY] {
            bytes.extend(value.to_le_bytes());
        }
        let [length, packed] = [self.length, self.packed.unwrap_or(self.length)]
            .map(|length| u32::try_from(length).expect("checked before"));
        for value in [self.check.clone().finalize(), packed, length] {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend((self.name.len() as u16).to_le_bytes());
    }
}

/// What stands behind the directory, which begins at `place`.
pub(crate) fn end(entries: usize, place: u64, length: u64) -> Vec<u8> {
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

/// The header of an array: numbers of a kind in a shape, as NumPy writes both, and whether they stand column after column.
/// With it the numbers begin at a multiple of 64 bytes of the file.
pub(crate) fn header(kind: &str, by_columns: bool, shape: &str) -> Vec<u8> {
    let order = if by_columns { "True" } else { "False" };
    let mut text = format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': {shape}, }}");
    while (10 + text.len() + 1) % 64 != 0 {
        text.push(' ');
    }
    text.push('\n');
    let mut head = b"\x93NUMPY\x01\x00".to_vec();
    head.extend((text.len() as u16).to_le_bytes());
    head.extend(text.as_bytes());
    head
}

/// An array with its header, as a file of an archive.
pub(crate) struct Array(Vec<u8>);

impl Array {
    /// A matrix of rows and columns, column after column.
    pub(crate) fn columns([rows, cols]: [usize; 2], values: &[f64]) -> Self {
        let head = header("<f8", true, &format!("({rows}, {cols})"));
        Array(head.into_iter().chain(values.iter().flat_map(|own| own.to_le_bytes())).collect())
    }

    /// Numbers in a row.
    pub(crate) fn numbers(values: &[f64]) -> Self {
        let head = header("<f8", false, &format!("({},)", values.len()));
        Array(head.into_iter().chain(values.iter().flat_map(|own| own.to_le_bytes())).collect())
    }

    /// Words in a row, each as long as the longest.
    pub(crate) fn words(words: &[String]) -> Self {
        let longest = words.iter().map(|own| own.chars().count()).max().unwrap_or(0).max(1);
        let mut bytes = header(&format!("<U{longest}"), false, &format!("({},)", words.len()));
        for word in words {
            let letters = word.chars().map(u32::from).chain(std::iter::repeat(0));
            bytes.extend(letters.take(longest).flat_map(u32::to_le_bytes));
        }
        Array(bytes)
    }
}

/// An archive of arrays by their names, each of fewer than [`LARGEST`] bytes.
pub(crate) fn archive(arrays: &[(&str, Array)]) -> Vec<u8> {
    let (mut bytes, mut entries) = (Vec::new(), Vec::with_capacity(arrays.len()));
    for (name, Array(content)) in arrays {
        let mut entry = Entry::new(name, bytes.len() as u64, content.len() as u64);
        entry.check.update(content);
        bytes.extend(entry.local());
        bytes.extend(content);
        entries.push(entry);
    }
    let place = bytes.len() as u64;
    let directory: Vec<u8> = entries.iter().flat_map(Entry::central).collect();
    bytes.extend(&directory);
    bytes.extend(end(entries.len(), place, directory.len() as u64));
    bytes
}

/// An archive of files by their paths in it, compressed: the same files give the same bytes.
///
/// # Errors
/// A file of [`LARGEST`] bytes or more.
pub(crate) fn packed(files: &[(String, Vec<u8>)]) -> io::Result<Vec<u8>> {
    let (mut bytes, mut entries) = (Vec::new(), Vec::with_capacity(files.len()));
    for (name, content) in files {
        if content.len() as u64 >= LARGEST {
            return Err(io::Error::other(format!("`{name}` has 4 GiB or more")));
        }
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
        encoder.write_all(content)?;
        let own = encoder.finish()?;
        let (place, length) = (bytes.len() as u64, content.len() as u64);
        let mut entry = Entry::of(name.clone(), (place, length), Some(own.len() as u64));
        entry.check.update(content);
        bytes.extend(entry.local());
        bytes.extend(own);
        entries.push(entry);
    }
    let place = bytes.len() as u64;
    let directory: Vec<u8> = entries.iter().flat_map(Entry::central).collect();
    bytes.extend(&directory);
    bytes.extend(end(entries.len(), place, directory.len() as u64));
    Ok(bytes)
}

/// What an archive holds, for tests.
#[cfg(test)]
pub(crate) mod reading {
    pub(crate) fn number(bytes: &[u8], at: usize, count: usize) -> usize {
        bytes[at..at + count].iter().rev().fold(0, |sum, byte| 256 * sum + usize::from(*byte))
    }

    /// Names and contents, by the directory at the end; every check holds.
    pub(crate) fn read(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
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
}

#[cfg(test)]
mod tests {
    use super::reading::{number, read};
    use super::*;

    #[test]
    fn far_places_stand_in_the_extension() {
        let place = 5 << 32;
        let central = Entry::new("x", place, 128).central();
        assert_eq!(number(&central, 42, 4) as u64, LARGEST);
        assert_eq!(number(&central, central.len() - 8, 8) as u64, place);
        let end = end(3, place, 100);
        assert_eq!((end.len(), number(&end, 48, 8) as u64), (56 + 20 + 22, place));
        assert_eq!(number(&end, 64, 8) as u64, place + 100);
    }

    #[test]
    fn packed_files_come_out_as_they_were() {
        let files =
            [("a/b.txt".to_owned(), b"abcabcabcabc".repeat(50)), ("ähm".to_owned(), Vec::new())];
        let bytes = packed(&files).unwrap();
        assert!(bytes.len() < 300, "{}", bytes.len());
        assert_eq!(bytes, packed(&files).unwrap());
        let mut at = number(&bytes, bytes.len() - 6, 4);
        for (name, content) in &files {
            assert_eq!(&bytes[at..at + 4], b"PK\x01\x02");
            assert_eq!(number(&bytes, at + 10, 2), usize::from(DEFLATED));
            let [check, packed, length] = [16, 20, 24].map(|own| number(&bytes, at + own, 4));
            let (named, local) = (number(&bytes, at + 28, 2), number(&bytes, at + 42, 4));
            assert_eq!(&bytes[at + 46..at + 46 + named], name.as_bytes());
            let flags = [number(&bytes, at + 8, 2), number(&bytes, local + 6, 2)];
            assert_eq!(flags, [if name.is_ascii() { 0 } else { usize::from(UTF8) }; 2]);
            let own = local + 30 + named;
            let mut out = Vec::new();
            let mut reader = flate2::read::DeflateDecoder::new(&bytes[own..own + packed]);
            std::io::Read::read_to_end(&mut reader, &mut out).unwrap();
            assert_eq!((&out, out.len(), crc32fast::hash(&out) as usize), (content, length, check));
            at += 46 + named;
        }
    }

    #[test]
    fn an_archive_holds_matrices_numbers_and_words() {
        let words = ["µm, x".to_owned(), "z".to_owned()];
        let bytes = archive(&[
            ("A", Array::columns([2, 3], &[1.0, 2.0, 3.0, 4.0, 5.0, -6.5])),
            ("speeds", Array::numbers(&[314.0])),
            ("names", Array::words(&words)),
            ("none", Array::words(&[])),
        ]);
        let entries = read(&bytes);
        let names: Vec<&str> = entries.iter().map(|own| own.0.as_str()).collect();
        assert_eq!(names, ["A.npy", "speeds.npy", "names.npy", "none.npy"]);
        let said = [
            "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }",
            "{'descr': '<U5', 'fortran_order': False, 'shape': (2,), }",
            "{'descr': '<U1', 'fortran_order': False, 'shape': (0,), }",
        ];
        let data: Vec<&[u8]> = entries
            .iter()
            .zip(said)
            .map(|((_, content), said)| {
                let start = 10 + number(content, 8, 2);
                assert!(
                    start.is_multiple_of(64) && content[10..start].starts_with(said.as_bytes())
                );
                &content[start..]
            })
            .collect();
        assert_eq!((data[0].len(), &data[0][40..]), (48, &(-6.5_f64).to_le_bytes()[..]));
        assert_eq!(data[1], 314.0_f64.to_le_bytes());
        let letters: Vec<u8> =
            "µm, xz\0\0\0\0".chars().flat_map(|own| u32::from(own).to_le_bytes()).collect();
        assert_eq!((data[2], data[3].len()), (&letters[..], 0));
    }
}

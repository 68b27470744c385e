//! MATLAB: files of variables of level 5, without compression; texts as cells or in structures.
//!
//! Format: MathWorks, MAT-File Format, level 5: elements of a type, a length and data, padded to 8 bytes.

use std::collections::BTreeSet;

/// Types of data.
const INT8: u32 = 1;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
const UTF8: u32 = 16;
/// Classes of arrays.
const CELLS: u32 = 1;
const STRUCTURE: u32 = 2;
const LETTERS: u32 = 4;
const DOUBLES: u32 = 6;
/// Bytes of the text with which a file begins.
const HEAD: usize = 116;
/// Letters of a name, at most, and bytes of one of a field.
const LONGEST: usize = 63;
const FIELD: usize = LONGEST + 1;

/// With what a file begins. No date: the same numbers give the same bytes.
pub(crate) fn head() -> Vec<u8> {
    let mut bytes = format!("{:HEAD$}", "MATLAB 5.0 MAT-file, written by whirl").into_bytes();
    bytes.extend([0; 8]);
    bytes.extend(0x0100_u16.to_le_bytes());
    bytes.extend(b"IM");
    bytes
}

/// An element: its tag, its data, and what fills it up.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let length = u32::try_from(data.len()).expect("sizes are checked before");
    let mut bytes = Vec::with_capacity(data.len() + 16);
    bytes.extend(kind.to_le_bytes());
    bytes.extend(length.to_le_bytes());
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

/// A variable or a cell: its class, its size, its name, and elements of its values.
fn array(class: u32, name: &str, size: [usize; 2], values: &[u8]) -> Vec<u8> {
    let flags: Vec<u8> = [class, 0].into_iter().flat_map(u32::to_le_bytes).collect();
    let size: Vec<u8> = size.iter().flat_map(|own| (*own as i32).to_le_bytes()).collect();
    let parts = [element(UINT32, &flags), element(INT32, &size), element(INT8, name.as_bytes())];
    let mut data = parts.concat();
    data.extend(values);
    element(MATRIX, &data)
}

/// A variable of numbers, column after column.
pub(crate) fn doubles(name: &str, size: [usize; 2], values: impl Iterator<Item = f64>) -> Vec<u8> {
    let values: Vec<u8> = values.flat_map(f64::to_le_bytes).collect();
    array(DOUBLES, name, size, &element(DOUBLE, &values))
}

/// What stands before the numbers of a variable that is a column, as long as there are fewer than 2²⁸.
pub(crate) fn before_column(name: &str, rows: usize) -> Vec<u8> {
    let whole = doubles(name, [0, 1], std::iter::empty());
    let mut bytes = whole[..whole.len() - 8].to_vec();
    let length = (bytes.len() - 8 + 8 + 8 * rows) as u32;
    bytes[4..8].copy_from_slice(&length.to_le_bytes());
    // Its size stands behind the tag, the flags and a tag of its own.
    bytes[32..36].copy_from_slice(&(rows as i32).to_le_bytes());
    bytes.extend(DOUBLE.to_le_bytes());
    bytes.extend(((8 * rows) as u32).to_le_bytes());
    bytes
}

/// A variable of texts, a column of cells.
pub(crate) fn texts<'t>(name: &str, texts: impl ExactSizeIterator<Item = &'t str>) -> Vec<u8> {
    let count = texts.len();
    let cells: Vec<u8> = texts.flat_map(letters).collect();
    array(CELLS, name, [count, 1], &cells)
}

/// A variable of texts by their names, a structure.
pub(crate) fn structure<'t>(
    name: &str,
    fields: impl Iterator<Item = (&'t str, &'t str)>,
) -> Vec<u8> {
    let fields: Vec<_> = fields.collect();
    // How long a name is stands in its own tag.
    let length = [4 << 16 | INT32, FIELD as u32];
    let mut values: Vec<u8> = length.into_iter().flat_map(u32::to_le_bytes).collect();
    let mut names = Vec::with_capacity(FIELD * fields.len());
    for (count, (field, _)) in fields.iter().enumerate() {
        names.extend(field.bytes().take(LONGEST));
        names.resize(FIELD * (count + 1), 0);
    }
    values.extend(element(INT8, &names));
    values.extend(fields.iter().flat_map(|(_, text)| letters(text)));
    array(STRUCTURE, name, [1, 1], &values)
}

/// Names of variables: a letter, then letters, digits and `_`; each once, and none of `others`.
pub(crate) fn variables(names: &[String], others: &[&str]) -> Vec<String> {
    let mut taken: BTreeSet<String> = others.iter().map(|own| (*own).to_owned()).collect();
    let mut all = Vec::with_capacity(names.len());
    for name in names {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let first = if name.starts_with(|c: char| c.is_ascii_alphabetic()) { "" } else { "x" };
        let own: String = first.chars().chain(name.chars().map(plain)).take(LONGEST).collect();
        let mut called = own.clone();
        let mut number = 1;
        while !taken.insert(called.clone()) {
            number += 1;
            let end = format!("_{number}");
            called = own[..own.len().min(LONGEST - end.len())].to_owned() + &end;
        }
        all.push(called);
    }
    all
}

/// A row of letters, as many as UTF-16 has. Readers other than MATLAB take the 16 bits of a letter for a letter only where it is
/// of ASCII.
fn letters(text: &str) -> Vec<u8> {
    let units: Vec<u16> = text.encode_utf16().collect();
    let values = match text.is_ascii() {
        true => {
            element(UINT16, &units.iter().flat_map(|own| own.to_le_bytes()).collect::<Vec<u8>>())
        }
        false => element(UTF8, text.as_bytes()),
    };
    array(LETTERS, "", [1, units.len()], &values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_begins_as_the_same_numbers_at_once_do() {
        for rows in [0, 1, 7] {
            let whole = doubles("RX1_N", [rows, 1], (0..rows).map(|k| k as f64));
            let before = before_column("RX1_N", rows);
            assert_eq!(before, whole[..whole.len() - 8 * rows]);
        }
    }

    #[test]
    fn a_name_is_a_row_of_letters_without_a_name() {
        let own = letters("z, µ");
        let word = |at: usize| u32::from_le_bytes(own[at..at + 4].try_into().expect("four bytes"));
        let size = own.len() as u32;
        // Its tag, flags, 1 × 4, no name, and two bytes a letter.
        let said = [0, 4, 8, 12, 16, 32, 36, 40, 44].map(word);
        assert_eq!(said, [14, size - 8, 6, 8, 4, 1, 4, 1, 0]);
        assert_eq!([48, 52].map(word), [16, 5]);
        assert_eq!(own[56..], [b'z', b',', b' ', 0xC2, 0xB5, 0, 0, 0]);
        let own = letters("z1");
        assert_eq!(own[48..], [4, 0, 0, 0, 4, 0, 0, 0, b'z', 0, b'1', 0, 0, 0, 0, 0]);
    }

    #[test]
    fn every_column_has_a_name_that_matlab_takes() {
        let long = "x".repeat(80);
        let names =
            ["t_s", "RX_a-b_N", "RX_a_b_N", "units", "1_m", &long, &long].map(str::to_owned);
        let found = variables(&names, &["units"]);
        assert_eq!(found[..5], ["t_s", "RX_a_b_N", "RX_a_b_N_2", "units_2", "x1_m"]);
        assert_eq!((found[5].len(), found[6].len()), (63, 63));
        assert!(found[5] != found[6]);
    }
}

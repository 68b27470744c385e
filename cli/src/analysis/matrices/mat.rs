//! MATLAB: one file of variables, of level 5, without compression; names as columns of cells.
//!
//! Format: MathWorks, MAT-File Format, level 5: elements of a type, a length and data, padded to 8 bytes.

use whirl_solver::linalg::Matrix;

use super::content::Content;

/// Types of data.
const INT8: u32 = 1;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
/// Classes of arrays.
const CELLS: u32 = 1;
const LETTERS: u32 = 4;
const DOUBLES: u32 = 6;
/// Bytes of the text with which a file begins.
const HEAD: usize = 116;

/// The file under a name.
pub(super) fn files(name: &str, content: &Content) -> Vec<(String, Vec<u8>)> {
    // No date: the same case gives the same bytes.
    let mut bytes = format!("{:HEAD$}", "MATLAB 5.0 MAT-file, written by whirl").into_bytes();
    bytes.extend([0; 8]);
    bytes.extend(0x0100_u16.to_le_bytes());
    bytes.extend(b"IM");
    for (own, matrix) in content.matrices() {
        bytes.extend(doubles(own, matrix));
    }
    for (own, names) in &content.names {
        let cells: Vec<u8> = names.iter().flat_map(|name| letters(name)).collect();
        bytes.extend(array(CELLS, own, [names.len(), 1], &cells));
    }
    for (own, values) in &content.numbers {
        let column = Matrix::from_fn(values.len(), 1, |i, _| values[i]);
        bytes.extend(doubles(own, &column));
    }
    vec![(format!("{name}.mat"), bytes)]
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

fn doubles(name: &str, matrix: &Matrix) -> Vec<u8> {
    let values: Vec<u8> = matrix.data.iter().flat_map(|value| value.to_le_bytes()).collect();
    array(DOUBLES, name, [matrix.rows, matrix.cols], &element(DOUBLE, &values))
}

/// A row of letters, as UTF-16.
fn letters(text: &str) -> Vec<u8> {
    let units: Vec<u16> = text.encode_utf16().collect();
    let values: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
    array(LETTERS, "", [1, units.len()], &element(UINT16, &values))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bytes of a variable of two numbers, one after the other, as the format has them.
    #[test]
    fn a_variable_has_the_bytes_of_the_format() {
        let own = doubles("A", &Matrix::from_fn(2, 1, |i, _| [1.0, -2.5][i]));
        let mut want = Vec::new();
        // 8 of its tag; 16 of flags, 16 of its size, 16 of its name, 8 and 16 of two numbers.
        for value in [14_u32, 72, 6, 8, 6, 0, 5, 8, 2, 1, 1, 1] {
            want.extend(value.to_le_bytes());
        }
        want.extend(b"A\0\0\0\0\0\0\0");
        want.extend([9_u32, 16].into_iter().flat_map(u32::to_le_bytes));
        want.extend([1.0_f64, -2.5].into_iter().flat_map(f64::to_le_bytes));
        assert_eq!(own, want);
    }

    #[test]
    fn a_name_is_a_row_of_letters_without_a_name() {
        let own = letters("z, µ");
        let word = |at: usize| u32::from_le_bytes(own[at..at + 4].try_into().expect("four bytes"));
        let size = own.len() as u32;
        // Its tag, flags, 1 × 4, no name, and two bytes a letter.
        let said = [0, 4, 8, 12, 16, 32, 36, 40, 44].map(word);
        assert_eq!(said, [14, size - 8, 6, 8, 4, 1, 4, 1, 0]);
        assert_eq!([48, 52].map(word), [4, 8]);
        assert_eq!(own[56..], [b'z', 0, b',', 0, b' ', 0, 0xB5, 0]);
    }
}

//! MATLAB: one file of variables, of level 5.

use whirl_solver::linalg::Matrix;

use super::content::Content;
use crate::matlab;

/// The file under a name.
pub(super) fn files(name: &str, content: &Content) -> Vec<(String, Vec<u8>)> {
    let mut bytes = matlab::head();
    for (own, matrix) in content.matrices() {
        bytes.extend(doubles(own, matrix));
    }
    for (own, names) in &content.names {
        bytes.extend(matlab::texts(own, names.iter().map(String::as_str)));
    }
    for (own, values) in &content.numbers {
        bytes.extend(matlab::doubles(own, [values.len(), 1], values.iter().copied()));
    }
    vec![(format!("{name}.mat"), bytes)]
}

fn doubles(name: &str, matrix: &Matrix) -> Vec<u8> {
    matlab::doubles(name, [matrix.rows, matrix.cols], matrix.data.iter().copied())
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
}

//! NumPy: one archive of arrays.

use super::content::Content;
use crate::archive::{Array, archive};

/// The file under a name.
pub(super) fn files(name: &str, content: &Content) -> Vec<(String, Vec<u8>)> {
    let matrices = content
        .matrices()
        .map(|(own, matrix)| (own, Array::columns([matrix.rows, matrix.cols], &matrix.data)));
    let names = content.names.iter().map(|(own, names)| (*own, Array::words(names)));
    let numbers = content.numbers.iter().map(|(own, values)| (*own, Array::numbers(values)));
    let arrays: Vec<(&str, Array)> = matrices.chain(names).chain(numbers).collect();
    vec![(format!("{name}.npz"), archive(&arrays))]
}

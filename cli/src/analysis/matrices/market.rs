//! Matrix Market: a file for each matrix, and a table of the names.
//!
//! Format: Boisvert, Pozo, Remington, The Matrix Market Exchange Formats, NISTIR 5935 (1996): array (or coordinate, where there is none),
//! real, general.

use std::fmt::Write;

use whirl_solver::linalg::Matrix;

use super::content::Content;

/// Files under a name.
pub(super) fn files(name: &str, content: &Content) -> Vec<(String, Vec<u8>)> {
    let matrices = content
        .matrices()
        .map(|(own, matrix)| (format!("{name}.{own}.mtx"), text(matrix).into_bytes()));
    let mut table = String::from("of,place,name\n");
    let named = content.names.iter().map(|(of, names)| (*of, names.clone()));
    let numbers = content
        .numbers
        .iter()
        .map(|(of, values)| (*of, values.iter().map(f64::to_string).collect()));
    for (of, names) in named.chain(numbers) {
        let names: Vec<String> = names;
        for (place, own) in names.iter().enumerate() {
            // Names of coordinates have commas.
            writeln!(table, "{of},{},\"{}\"", place + 1, own.replace('"', "\"\""))
                .expect("text can be written");
        }
    }
    let table = (format!("{name}.names.csv"), table.into_bytes());
    matrices.chain([table]).collect()
}

fn text(matrix: &Matrix) -> String {
    let Matrix { rows, cols, data } = matrix;
    if data.is_empty() {
        // Readers take no array without rows or columns.
        return format!("%%MatrixMarket matrix coordinate real general\n{rows} {cols} 0\n");
    }
    let mut text = format!("%%MatrixMarket matrix array real general\n{rows} {cols}\n");
    for value in data {
        writeln!(text, "{value:e}").expect("text can be written");
    }
    text
}

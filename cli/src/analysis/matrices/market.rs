//! Matrix Market: a file for each matrix, and a table of the names.
//!
//! Format: Boisvert, Pozo, Remington, The Matrix Market Exchange Formats, NISTIR 5935 (1996): array, real, general.

use std::fmt::Write;

use super::content::Content;

/// Files under a name.
pub(super) fn files(name: &str, content: &Content) -> Vec<(String, Vec<u8>)> {
    let matrices = content.matrices().map(|(own, matrix)| {
        let mut text = String::from("%%MatrixMarket matrix array real general\n");
        let mut line =
            |words: std::fmt::Arguments| writeln!(text, "{words}").expect("text can be written");
        line(format_args!("{} {}", matrix.rows, matrix.cols));
        matrix.data.iter().for_each(|value| line(format_args!("{value:e}")));
        (format!("{name}.{own}.mtx"), text.into_bytes())
    });
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

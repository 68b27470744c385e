//! Rows as lines of CSV.

use std::io::Write;

/// The line of names.
pub(super) fn head(names: &[String]) -> String {
    names.join(",") + "\n"
}

/// Adds a row as a line.
pub(super) fn line(text: &mut Vec<u8>, row: &[f64]) {
    for (place, value) in row.iter().enumerate() {
        if place > 0 {
            text.push(b',');
        }
        number(text, *value);
    }
    text.push(b'\n');
}

/// Significant digits after the first: two more than forces are compared with.
const DIGITS: usize = 9;

fn number(text: &mut Vec<u8>, value: f64) {
    let start = text.len();
    write!(text, "{value:.DIGITS$e}").expect("memory can be written");
    let written = std::str::from_utf8(&text[start..]).ok();
    let rounded: f64 = written.and_then(|text| text.parse().ok()).unwrap_or(value);
    text.truncate(start);
    let plain = rounded == 0.0 || (1e-4..1e9).contains(&rounded.abs());
    let written = if plain { write!(text, "{rounded}") } else { write!(text, "{rounded:e}") };
    written.expect("memory can be written");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_digits_are_kept() {
        let mut text = head(&["t_s".to_string(), "RX1_N".to_string()]).into_bytes();
        for row in [[7.4e-5, -396.512345678912], [0.000148, 7.3059871e-20], [0.0, 1e12 / 3.0]] {
            line(&mut text, &row);
        }
        let expected = "t_s,RX1_N\n7.4e-5,-396.5123457\n0.000148,7.3059871e-20\n0,3.333333333e11\n";
        assert_eq!(String::from_utf8(text).unwrap(), expected);
    }
}

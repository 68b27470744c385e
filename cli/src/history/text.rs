//! history.csv.

use std::fmt::Write;

use whirl_solver::history::History;

/// The history as CSV: a line of names, then a line a row.
pub(crate) fn history_csv(history: &History) -> String {
    let mut text = history.names().join(",");
    text.push('\n');
    for row in 0..history.rows() {
        for (place, value) in history.row(row).iter().enumerate() {
            if place > 0 {
                text.push(',');
            }
            number(&mut text, *value);
        }
        text.push('\n');
    }
    text
}

/// Significant digits after the first: two more than forces are compared with.
const DIGITS: usize = 9;

fn number(text: &mut String, value: f64) {
    let rounded: f64 = format!("{value:.DIGITS$e}").parse().unwrap_or(value);
    let plain = rounded == 0.0 || (1e-4..1e9).contains(&rounded.abs());
    let written = if plain { write!(text, "{rounded}") } else { write!(text, "{rounded:e}") };
    written.expect("text can be written");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_digits_are_kept() {
        let mut history = History::new(vec!["t_s".to_string(), "RX1_N".to_string()]);
        history.push(&[7.4e-5, -396.512345678912]);
        history.push(&[0.000148, 7.3059871e-20]);
        history.push(&[0.0, 1e12 / 3.0]);
        let expected = "t_s,RX1_N\n7.4e-5,-396.5123457\n0.000148,7.3059871e-20\n0,3.333333333e11\n";
        assert_eq!(history_csv(&history), expected);
    }
}

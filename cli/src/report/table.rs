//! Tables of text for the terminal.

use super::OrderFacts;
use super::orders::FEW_ROWS;
use super::summary::{Statistics, SupportSummary};

/// Rows of text in columns, the first one to the left, the others to the right.
pub(crate) fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (place, (cell, width)) in row.iter().zip(&widths).enumerate() {
            if place > 0 {
                line.push_str("  ");
            }
            match place {
                0 => line.push_str(&format!("{cell:<width$}")),
                _ => line.push_str(&format!("{cell:>width$}")),
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// Least, mean and largest values of every support over the last cycle.
pub(crate) fn supports(names: &[String], summaries: &[SupportSummary]) -> String {
    let heads = ["RX (N)", "RY (N)", "EX (µm)", "EY (µm)"];
    statistics(names, &heads, summaries.iter().map(|s| vec![s.rx, s.ry, s.ex, s.ey]))
}

/// The same of every stop of a mass: its force, and the displacement of the mass.
pub(crate) fn stops(names: &[String], summaries: &[SupportSummary]) -> String {
    let in_mm =
        |s: Statistics| Statistics { min: 1e-3 * s.min, mean: 1e-3 * s.mean, max: 1e-3 * s.max };
    statistics(names, &["force (N)", "x (mm)"], summaries.iter().map(|s| vec![s.rx, in_mm(s.x)]))
}

/// 1X and 2X of every signal over the last revolutions; nothing where nothing turns.
pub(crate) fn of_orders(facts: Option<&OrderFacts>) -> String {
    let Some(facts) = facts else { return String::new() };
    let mut rows = vec![["", "1X", "phase (°)", "2X", "phase (°)"].map(String::from).to_vec()];
    for own in &facts.signals {
        let mut row = vec![own.title.clone()];
        for order in [own.first, own.second] {
            row.push(format!("{:.3}", order.amplitude));
            row.push(format!("{:.1}", order.phase_deg));
        }
        rows.push(row);
    }
    let fewest = facts.signals.iter().map(|own| own.revolutions).min().unwrap_or(0);
    let over = match fewest {
        1 => "the last revolution".to_string(),
        many => format!("the last {many} revolutions"),
    };
    let rows_each = facts.signals.iter().map(|own| own.rows_per_revolution);
    let fewest_rows = rows_each.fold(f64::INFINITY, f64::min);
    let few = match fewest_rows < FEW_ROWS {
        true => format!(
            "few rows: {:.0} a revolution; components at {:.0} times the speed or more may alias to 1X or 2X; \
             compare with a shorter `output_step` or `time_step`\n",
            fewest_rows,
            fewest_rows.round() - 2.0
        ),
        false => String::new(),
    };
    let mixed = facts.signals.iter().filter(|own| !own.mixed_with.is_empty());
    let mixed: Vec<&str> = mixed.map(|own| own.title.as_str()).collect();
    let mixed = match mixed.is_empty() {
        true => String::new(),
        false => format!(
            "1X or 2X of another body is at the same frequency as in {}, or cannot be told apart from them in this run\n",
            if mixed.len() == facts.signals.len() {
                "all of these".to_owned()
            } else {
                mixed.join(", ")
            }
        ),
    };
    format!("orders of {over}: A cos(nθ + φ), A zero to peak\n{}{few}{mixed}", table(&rows))
}

fn statistics(
    names: &[String],
    heads: &[&str],
    values: impl Iterator<Item = Vec<Statistics>>,
) -> String {
    let (mut first, mut second) = (vec![String::new()], vec![String::new()]);
    for head in heads {
        first.extend(["", head, ""].map(String::from));
        second.extend(["min", "mean", "max"].map(String::from));
    }
    let mut rows = vec![first, second];
    for (name, values) in names.iter().zip(values) {
        let mut row = vec![name.clone()];
        for Statistics { min, mean, max } in values {
            row.extend([min, mean, max].map(short));
        }
        rows.push(row);
    }
    table(&rows)
}

/// A number as a person reads it: two decimals, nothing below them.
fn short(value: f64) -> String {
    // Keeps −0.00 away.
    let rounded = (value * 100.0).round() / 100.0 + 0.0;
    if rounded.abs() < 1e7 { format!("{rounded:.2}") } else { format!("{value:.4e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let rows = [["a", "1.00"], ["long", "-12.50"]];
        let text = table(&rows.map(|row| row.map(String::from).to_vec()));
        assert_eq!(text, "a       1.00\nlong  -12.50\n");
        assert_eq!(short(-0.001), "0.00");
    }
}

//! A law drawn with characters.

use whirl_codegen::kinds::law::{LawSpec, short};
use whirl_codegen::kinds::page::Page;

use crate::figures::{Curve, curves};

/// Characters from left to right, and from top to bottom.
const COLUMNS: usize = 64;
const ROWS: usize = 15;

/// Draws a law on its page, where it can be drawn.
pub(super) fn explain(page: &mut Page, law: &LawSpec) {
    if let Some(plot) = self::law(law) {
        page.heading(&plot.title);
        plot.lines.iter().for_each(|line| page.item(line));
    }
}

/// A small picture.
struct Plot {
    title: String,
    lines: Vec<String>,
}

/// The first output of a law over its first input, all other inputs as the figure has them.
fn law(law: &LawSpec) -> Option<Plot> {
    let curve = curves(law).into_iter().next()?;
    let lines = draw(&curve)?;
    let others = if curve.held.is_empty() { String::new() } else { format!(", {}", curve.held) };
    let title =
        format!("Plot of {} ({}) over {} ({}){others}", curve.y.0, curve.y.1, curve.x.0, curve.x.1);
    Some(Plot { title, lines })
}

fn draw(curve: &Curve) -> Option<Vec<String>> {
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
            [least.min(x), most.max(x)]
        })
    };
    let [left, right] = ends(&mut curve.points.iter().map(|point| point.0));
    let [mut low, mut high] = ends(&mut curve.points.iter().map(|point| point.1));
    if !(left < right && low <= high) {
        return None;
    }
    if low == high {
        (low, high) = (low - 1.0, high + 1.0);
    }
    let place = |x: f64, [low, high]: [f64; 2], last: usize| {
        ((x - low) / (high - low) * last as f64).round() as usize
    };
    let mut field = vec![[' '; COLUMNS]; ROWS];
    if low < 0.0 && high > 0.0 {
        field[ROWS - 1 - place(0.0, [low, high], ROWS - 1)] = ['-'; COLUMNS];
    }
    // Points lie closer than characters; a step between columns is filled from one height to the next.
    let mut before: Option<(usize, usize)> = None;
    for (x, y) in &curve.points {
        let (column, height) =
            (place(*x, [left, right], COLUMNS - 1), place(*y, [low, high], ROWS - 1));
        let from =
            before.filter(|(last, _)| column - last <= 1).map_or(height, |(_, height)| height);
        for between in from.min(height)..=from.max(height) {
            let edge = between == from.min(height) || between == from.max(height);
            let mark = &mut field[ROWS - 1 - between][column];
            if edge || *mark == ' ' || *mark == '-' {
                *mark = '*';
            }
        }
        before = Some((column, height));
    }
    let labels = [short(high), short(low)];
    let width = labels.iter().map(|label| label.chars().count()).max().unwrap_or(0);
    let mut lines: Vec<String> = Vec::with_capacity(ROWS + 2);
    for (row, marks) in field.iter().enumerate() {
        let label = match row {
            0 => &labels[0],
            row if row == ROWS - 1 => &labels[1],
            _ => "",
        };
        let marks: String = marks.iter().collect();
        lines.push(format!("{label:>width$} |{}", marks.trim_end()));
    }
    let (first, last) = (short(left), short(right));
    let gap = COLUMNS.saturating_sub(first.chars().count() + last.chars().count());
    lines.push(format!("{:>width$} +{}", "", "-".repeat(COLUMNS)));
    lines.push(format!("{:>width$}  {first}{}{last}", "", " ".repeat(gap)));
    Some(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(f: impl Fn(f64) -> f64) -> Curve {
        let points = (0..=400).map(|i| -1.0 + 2.0 * f64::from(i) / 400.0);
        Curve {
            x: ("h".into(), "mm".into()),
            y: ("Q".into(), "N".into()),
            held: String::new(),
            points: points.map(|x| (x, f(x))).collect(),
        }
    }

    #[test]
    fn a_line_goes_from_corner_to_corner() {
        let lines = draw(&curve(|x| -3.0 * x)).unwrap();
        assert_eq!(lines.len(), ROWS + 2);
        assert!(lines[0].starts_with(" 3 |*") && lines[0].trim_end().len() < 12, "{}", lines[0]);
        assert!(lines[ROWS - 1].starts_with("-3 |") && lines[ROWS - 1].ends_with('*'));
        // The axis y = 0 goes through the middle.
        assert!(lines[ROWS / 2].contains("---") && lines[ROWS / 2].contains('*'));
        assert_eq!(lines[ROWS + 1].split_whitespace().collect::<Vec<_>>(), ["-1", "1"]);
    }

    #[test]
    fn a_jump_is_a_vertical_stroke_and_a_constant_a_level_one() {
        let lines = draw(&curve(|x| if x < 0.0 { 5.0 } else { 0.0 })).unwrap();
        assert!(lines[1..ROWS - 1].iter().all(|line| line.matches('*').count() == 1), "{lines:#?}");
        let lines = draw(&curve(|_| 2.0)).unwrap();
        assert_eq!(lines.iter().filter(|line| line.contains('*')).count(), 1);
    }
}

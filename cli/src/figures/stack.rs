//! Spectra one above the other: over a run-up, or over what varies.

use super::figure::{Line, Panel, Style};
use super::orders::ORDERS;

/// A spectrum of several that stand one above the other.
pub(crate) struct Stacked {
    /// Where its line of zero is.
    pub(crate) height: f64,
    /// How fast it turns (Hz); 0 where it does not.
    pub(crate) speed: f64,
    pub(crate) points: Vec<(f64, f64)>,
}

/// Spectra one above the other, two at least with rising heights, up to a frequency; the orders are lines across. `largest`: of
/// all amplitudes, with their unit; `heights`: what they are, and their unit.
pub(crate) fn stack(
    all: &[Stacked],
    end: f64,
    (largest, amplitudes): (f64, &str),
    (title, heights): (String, (&str, &str)),
) -> Panel {
    let spacing = (all[all.len() - 1].height - all[0].height) / (all.len() - 1) as f64;
    // The largest reaches over three spectra; a bar that people can read says how much that is.
    let scale = 3.0 * spacing / largest;
    let mut lines = Vec::new();
    for own in all.iter().rev() {
        let points = own.points.iter().filter(|point| point.0 <= end);
        lines.push(Line {
            points: points.map(|(x, y)| (*x, own.height + scale * y)).collect(),
            style: Style::Thin,
            name: "amplitude spectra".to_string(),
        });
    }
    let styles = [Style::Third, Style::Second, Style::Fourth];
    for ((order, name), style) in ORDERS.iter().zip(styles) {
        let turning = all.iter().filter(|own| own.speed > 0.0);
        let points = turning.map(|own| (order * own.speed, own.height));
        let points: Vec<_> = points.filter(|point| point.0 <= end).collect();
        if !points.is_empty() {
            lines.push(Line { points, style, name: (*name).to_string() });
        }
    }
    let (bar, height) = (whirl_text::rounded(largest, 3), 3.0 * spacing);
    let (quantity, unit) = heights;
    let in_unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    Panel {
        title,
        x: format!(
            "frequency (Hz); amplitude scale: {bar} {amplitudes} per {}{in_unit}",
            whirl_text::rounded(height, 2)
        ),
        y: if unit.is_empty() { quantity.to_string() } else { format!("{quantity} ({unit})") },
        lines,
        ..Panel::default()
    }
}

//! The root locus: eigenvalues of the modes over speed in their plane.

use whirl_solver::linear::Campbell;

use super::words;
use crate::figures::{Cloud, Figure, Label, Line, Mark, Panel, Style};

/// Speeds that the legend names.
const NAMED: usize = 5;

/// λ of all branches: a line each, with a point a speed, coloured by it.
pub(super) fn figure(name: &str, body: &str, all: &Campbell) -> Figure {
    let mut panel = Panel {
        title: "root locus".to_owned(),
        x: "Re λ (1/s); right of 0 a motion grows".to_owned(),
        y: "Im λ (1/s)".to_owned(),
        marks: vec![Mark { x: 0.0, name: String::new() }],
        is_loose: true,
        ..Panel::default()
    };
    for (number, branch) in all.branches.iter().enumerate() {
        // A mode that is not listed at some speeds is no line across them.
        for piece in branch.split(Option::is_none) {
            let modes = piece.iter().flatten();
            let points: Vec<_> = modes.map(|own| (own.value.re, own.value.im)).collect();
            if points.len() > 1 {
                let name = "a mode over speed".to_owned();
                panel.lines.push(Line { points, style: Style::Limit, name });
            }
        }
        if let Some(first) = branch.iter().flatten().next() {
            let at = (first.value.re, first.value.im);
            panel.labels.push(Label { at, text: (number + 1).to_string() });
        }
    }
    let last = all.speeds.len().saturating_sub(1);
    let named: Vec<usize> = (0..NAMED).map(|k| k * last / (NAMED - 1)).collect();
    for (place, &speed) in all.speeds.iter().enumerate() {
        let modes = all.branches.iter().filter_map(|branch| branch[place].as_ref());
        let points: Vec<(f64, f64)> = modes.map(|own| (own.value.re, own.value.im)).collect();
        if points.is_empty() {
            continue;
        }
        let name = match named.contains(&place) {
            true => format!("{} rpm", words::speed(speed)),
            false => String::new(),
        };
        let style = Style::Shade(shade(place, last));
        panel.clouds.push(Cloud { points, style, radius: 2.5, name });
    }
    let title = format!("{name}: roots over the speed of {body}");
    Figure { title, panels: vec![panel], columns: 1 }
}

/// Where one of several stands on the scale of colours.
fn shade(place: usize, last: usize) -> u8 {
    // The end of the scale is too bright for white paper.
    const BRIGHTEST: usize = 225;
    (place * BRIGHTEST).checked_div(last).unwrap_or(0) as u8
}

//! Q–h of laws.

use std::sync::Arc;

use whirl_codegen::spec::law::LawSpec;

use super::figure::{Figure, Line, Panel, Style};

/// Points of a curve.
const POINTS: usize = 400;
/// Range of h for laws that do not say theirs, in m.
const DEFAULT_RANGE: [f64; 2] = [-1e-5, 1e-4];

/// Q against h of every law, all other inputs zero, where the law declares its range.
pub(crate) fn laws(laws: &[Arc<LawSpec>]) -> Figure {
    let styles = [Style::First, Style::Second, Style::Third, Style::Fourth];
    let lines: Vec<Line> = laws
        .iter()
        .zip(styles.iter().cycle())
        .filter_map(|(law, style)| {
            Some(Line { points: curve(law)?, style: *style, name: law.name.clone() })
        })
        .collect();
    let panel = Panel {
        x: "clearance h (µm)".to_string(),
        y: "force of one spring Q (N)".to_string(),
        lines,
        ..Panel::default()
    };
    Figure { title: "Force against clearance".to_string(), panels: vec![panel], columns: 1 }
}

fn curve(law: &LawSpec) -> Option<Vec<(f64, f64)>> {
    let h = law.inputs.iter().position(|input| input.name == "h")?;
    let q = law.outputs.iter().position(|output| output.name == "Q")?;
    let [first, last] = law.inputs[h].range.unwrap_or(DEFAULT_RANGE);
    let point = |i: usize| {
        let mut inputs = vec![0.0; law.inputs.len()];
        inputs[h] = first + (last - first) * i as f64 / POINTS as f64;
        let outputs = law.evaluate(&inputs).ok()?;
        Some((1e6 * inputs[h], outputs[q])).filter(|point| point.1.is_finite())
    };
    Some((0..=POINTS).filter_map(point).collect())
}

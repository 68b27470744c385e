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

/// One output of a law, or one of its derivatives, along one input, in the units of its file.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    /// The input and its unit.
    pub(crate) x: (String, String),
    /// The output or derivative and its unit.
    pub(crate) y: (String, String),
    /// Values of the other inputs, such as `h_dot = 0 mm/s`; empty where there is none.
    pub(crate) held: String,
    /// Finite values from left to right.
    pub(crate) points: Vec<(f64, f64)>,
}

/// Every output of a law along every input, over the range of the law's report; the other inputs are
/// zero, or in the middle of their range where zero lies outside.
pub(crate) fn curves(law: &LawSpec) -> Vec<Curve> {
    let ranges = &law.report.ranges;
    let held: Vec<f64> = ranges
        .iter()
        .map(
            |(_, _, [low, high])| {
                if *low <= 0.0 && 0.0 <= *high { 0.0 } else { (low + high) / 2.0 }
            },
        )
        .collect();
    let mut curves = Vec::new();
    for (o, output) in law.outputs.iter().enumerate() {
        for (i, (name, unit, [low, high])) in ranges.iter().enumerate() {
            let point = |step: usize| {
                let x = low + (high - low) * step as f64 / POINTS as f64;
                let mut inputs = held.clone();
                inputs[i] = x;
                for (value, input) in inputs.iter_mut().zip(&law.inputs) {
                    *value = input.unit.to_si(*value);
                }
                let y = law.evaluate(&inputs).ok()?[o] / output.unit.factor().to_f64();
                y.is_finite().then_some((x, y))
            };
            let others = ranges.iter().zip(&held).enumerate().filter(|(other, _)| *other != i);
            let others =
                others.map(|(_, ((name, unit, _), value))| format!("{name} = {value} {unit}"));
            curves.push(Curve {
                x: (name.clone(), unit.clone()),
                y: (output.name.clone(), output.unit.to_string()),
                held: others.collect::<Vec<_>>().join(", "),
                points: (0..=POINTS).filter_map(point).collect(),
            });
        }
    }
    curves
}

/// Every output of a law along every input, a panel each.
pub(crate) fn law(law: &LawSpec) -> Figure {
    let panel = |curve: Curve| Panel {
        title: curve.held.clone(),
        x: format!("{} ({})", curve.x.0, curve.x.1),
        y: format!("{} ({})", curve.y.0, curve.y.1),
        lines: vec![Line { points: curve.points, style: Style::First, name: law.name.clone() }],
        ..Panel::default()
    };
    let panels: Vec<Panel> = curves(law).into_iter().map(panel).collect();
    Figure { title: law.title.clone(), columns: panels.len().min(2), panels }
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

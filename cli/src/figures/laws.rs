//! Q–h of laws.

use std::sync::Arc;

use whirl_codegen::kinds::law::{LawSpec, short};
use whirl_text::rounded;

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
pub struct Curve {
    /// The input and its unit.
    pub x: (String, String),
    /// The output or derivative and its unit.
    pub y: (String, String),
    /// Values of the other inputs, such as `h_dot = 0 mm/s`, zeros of many together; empty where there is none.
    pub held: String,
    /// Finite values from left to right.
    pub points: Vec<(f64, f64)>,
}

/// Every output of a law along every input on which it depends, over the range of the law's report. The other
/// inputs are zero, or in the middle of their range where zero lies outside; where the output would not
/// change, such as friction without contact, one or two of them are at a quarter of their range.
pub fn curves(law: &LawSpec) -> Vec<Curve> {
    let mut curves = Vec::new();
    for output in 0..law.outputs.len() {
        let all = (0..law.inputs.len()).map(|input| held(law, output, input));
        let all: Vec<Option<Vec<f64>>> = all.collect();
        let depends = all.iter().any(Option::is_some);
        for (input, held) in all.into_iter().enumerate() {
            // An output that depends on nothing is shown once.
            let held = held.or_else(|| (!depends && input == 0).then(|| at_rest(law)));
            curves.extend(held.map(|held| curve_of(law, output, input, &held)));
        }
    }
    curves
}

/// The first output of a law along the first input on which it depends, all others being zero; none where it does not change then, as
/// the force of a film without speed.
pub(crate) fn at_zero(law: &LawSpec) -> Option<Curve> {
    let zeros = vec![0.0; law.inputs.len()];
    let inputs = (0..law.inputs.len()).filter(|input| law.depends(0, *input));
    let mut all = inputs.map(|input| curve_of(law, 0, input, &zeros));
    all.find(|own| own.points.iter().any(|point| point.1 != own.points[0].1))
}

/// Zero, or the middle of the range where zero lies outside; in the units of the file.
fn at_rest(law: &LawSpec) -> Vec<f64> {
    let rest =
        |low: f64, high: f64| if low <= 0.0 && 0.0 <= high { 0.0 } else { (low + high) / 2.0 };
    law.report.ranges.iter().map(|(_, _, [low, high])| rest(*low, *high)).collect()
}

/// Values of all inputs at which an output changes along `input`, with as few of them off their rest as can
/// be; of those the values with the largest change. None where it never changes.
fn held(law: &LawSpec, output: usize, input: usize) -> Option<Vec<f64>> {
    /// Shares of a range at which inputs are held.
    const SHARES: [f64; 4] = [0.25, 0.75, 0.05, 0.95];
    /// Points at which a curve is compared with a constant.
    const PROBES: usize = 24;
    if !law.depends(output, input) {
        return None;
    }
    let [least, most] = law.report.outputs[output].extent;
    // Rounding is no change.
    let level = 1e-6 * (most - least);
    let change = |held: &[f64]| {
        let values = (0..=PROBES).filter_map(|i| {
            let x = share(law, input, i as f64 / PROBES as f64);
            value(law, output, held, (input, x))
        });
        let [low, high] = values
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)]);
        high - low
    };
    let rest = at_rest(law);
    let moved = |held: &[f64], place: usize| -> Vec<Vec<f64>> {
        let at = SHARES.map(|part| {
            let mut held = held.to_vec();
            // As people choose numbers.
            held[place] = rounded(share(law, place, part), 2);
            held
        });
        at.to_vec()
    };
    let others: Vec<usize> = (0..rest.len()).filter(|place| *place != input).collect();
    let one: Vec<Vec<f64>> = others.iter().flat_map(|place| moved(&rest, *place)).collect();
    let two = || {
        let pairs = others.iter().enumerate().flat_map(|(i, a)| {
            others[i + 1..].iter().flat_map(|b| {
                moved(&rest, *a).into_iter().flat_map(|held| moved(&held, *b)).collect::<Vec<_>>()
            })
        });
        pairs.collect::<Vec<_>>()
    };
    for candidates in [vec![rest.clone()], one.clone(), two()] {
        let best = candidates
            .into_iter()
            .map(|held| (change(&held), held))
            .filter(|(change, _)| *change > level)
            .reduce(|best, other| if other.0 > best.0 { other } else { best });
        if let Some((_, held)) = best {
            return Some(held);
        }
    }
    None
}

/// A part of the range of an input, in the unit of the file.
fn share(law: &LawSpec, input: usize, part: f64) -> f64 {
    let (_, _, [low, high]) = law.report.ranges[input];
    low + (high - low) * part
}

/// An output at the values `held` of all inputs but one, in the units of the file; none where it is not finite.
fn value(law: &LawSpec, output: usize, held: &[f64], (input, x): (usize, f64)) -> Option<f64> {
    let mut inputs = held.to_vec();
    inputs[input] = x;
    for (value, input) in inputs.iter_mut().zip(&law.inputs) {
        *value = input.unit.to_si(*value);
    }
    let y = law.evaluate(&inputs).ok()?[output] / law.outputs[output].unit.factor().to_f64();
    y.is_finite().then_some(y)
}

fn curve_of(law: &LawSpec, output: usize, input: usize, held: &[f64]) -> Curve {
    let ranges = &law.report.ranges;
    let point = |step: usize| {
        let x = share(law, input, step as f64 / POINTS as f64);
        Some((x, value(law, output, held, (input, x))?))
    };
    let others = ranges.iter().zip(held).enumerate().filter(|(other, _)| *other != input);
    let (zero, rest): (Vec<_>, Vec<_>) = others.partition(|(_, (_, value))| **value == 0.0);
    let say = |(_, ((name, unit, _), value)): (usize, (&(String, String, _), &f64))| match unit
        .as_str()
    {
        "1" => format!("{name} = {}", short(*value)),
        unit => format!("{name} = {} {unit}", short(*value)),
    };
    // Three and more would be too long for a heading; most are zero.
    let together = zero.len() > 1 && zero.len() + rest.len() > 2;
    let mut held: Vec<String> = rest.into_iter().map(say).collect();
    match together {
        true => held.push("the others 0".to_string()),
        false => held.extend(zero.into_iter().map(say)),
    }
    let (name, unit, _) = &ranges[input];
    let of = &law.outputs[output];
    Curve {
        x: (name.clone(), unit.clone()),
        y: (of.name.clone(), of.unit.to_string()),
        held: held.join(", "),
        points: (0..=POINTS).filter_map(point).collect(),
    }
}

/// Every output of a law along every input on which it depends, a panel each.
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

//! The points at which a law is evaluated.

use std::cell::OnceCell;

use num_traits::ToPrimitive;

use super::poles::WithSigns;
use super::{Condition, LawSpec, Named, Piece};
use crate::diagnostic::Located;
use crate::expression::Node;
use crate::operation::{Number, Rounded};
use crate::rational::nearest;

/// Most points along a line, and values of each other input, where an input varies alone.
const POINTS: usize = 1001;
const LEVELS: usize = 3;
/// Most lines an input.
const LINES: usize = 9;
/// The inverse of the plastic number: multiples of its powers, modulo 1, spread evenly.
const PLASTIC: f64 = 0.754_877_666_246_692_8;
/// Fewest points along a line, and most terms to evaluate along all lines: bounds the time that a long law
/// takes.
const FEWEST_POINTS: usize = 11;
const MOST_TERMS: usize = 20_000;

/// Points that differ in one input only.
pub(super) struct Line {
    /// The input that varies.
    pub(super) input: usize,
    /// Its values, ascending, SI.
    pub(super) points: Vec<f64>,
    /// The values of all inputs, of which the varying one is replaced.
    rest: Vec<f64>,
}

impl Line {
    /// A point of the only input.
    pub(super) fn alone(x: f64) -> Self {
        Line { input: 0, points: Vec::new(), rest: vec![x] }
    }

    /// All inputs where the varying one is `x`.
    pub(super) fn at(&self, x: f64) -> Vec<f64> {
        let mut inputs = self.rest.clone();
        inputs[self.input] = x;
        inputs
    }
}

/// A line with what all outputs need at its points.
pub(super) struct Lined<'l> {
    pub(super) line: &'l Line,
    pub(super) points: Vec<Point>,
}

impl<'l> Lined<'l> {
    pub(super) fn new(law: &LawSpec, line: &'l Line) -> Self {
        let point = |x: &f64| {
            let inputs: Vec<Rounded> = line.at(*x).into_iter().map(Rounded::new).collect();
            let names = law.names(&inputs);
            Point { x: *x, inputs, names, signed: OnceCell::new() }
        };
        Lined { line, points: line.points.iter().map(point).collect() }
    }
}

/// A point of a line.
pub(super) struct Point {
    pub(super) x: f64,
    pub(super) inputs: Vec<Rounded>,
    pub(super) names: Named<Rounded>,
    signed: OnceCell<Named<WithSigns>>,
}

impl Point {
    /// The names with the signs of divisors.
    pub(super) fn signed(&self, law: &LawSpec, line: &Line) -> &Named<WithSigns> {
        self.signed.get_or_init(|| names_at(law, line, self.x, WithSigns::new))
    }
}

/// The values of all names at a point.
pub(super) fn names_at<N: Number>(
    law: &LawSpec,
    line: &Line,
    x: f64,
    new: fn(f64) -> N,
) -> Named<N> {
    let inputs: Vec<N> = line.at(x).into_iter().map(new).collect();
    law.names(&inputs)
}

/// The range of every input, SI: what the file says, or what shows the thresholds with as much on their
/// other side.
pub(super) fn ranges(law: &LawSpec) -> Vec<[f64; 2]> {
    let mut ranges = Vec::with_capacity(law.inputs.len());
    for (place, input) in law.inputs.iter().enumerate() {
        let thresholds: Vec<f64> = thresholds(law, place);
        let low = thresholds.iter().fold(0.0_f64, |low, at| low.min(2.0 * at));
        let high = thresholds.iter().fold(0.0_f64, |high, at| high.max(2.0 * at));
        let unit = input.unit.factor().to_f64();
        ranges.push(match input.range {
            Some(range) => range,
            None if low < high => [low, high],
            None => [-unit, unit],
        });
    }
    ranges
}

/// Every constant with which the input is compared, SI.
fn thresholds(law: &LawSpec, input: usize) -> Vec<f64> {
    let pieces = law.outputs.iter().flat_map(|output| &output.pieces);
    let mut found: Vec<f64> = pieces
        .filter_map(|piece| match &piece.when {
            Some(Condition::Threshold { input: other, at, .. }) if *other == input => {
                Some(nearest(at))
            }
            _ => None,
        })
        .collect();
    // Comparisons inside conditions and functions, such as max(h, c0).
    let symbol = law.inputs[input].symbol;
    let values: Vec<_> = law.outputs.iter().map(|output| output.value).collect();
    for id in law.graph.reachable(&values) {
        let Node::Compare(_, a, b) = law.graph.node(id) else { continue };
        for (variable, constant) in [(*a, *b), (*b, *a)] {
            let Some(constant) = law.graph.as_number(constant) else { continue };
            match law.graph.terms(variable).as_slice() {
                [(term, factor)] if *term == symbol => {
                    found.extend((constant / factor).to_f64());
                }
                _ => {}
            }
        }
    }
    found
}

/// Lines through the ranges: every input in turn, the others at their ends and middles, or, if these are too
/// many, spread evenly. `terms`: how many terms an evaluation costs.
pub(super) fn lines(ranges: &[[f64; 2]], terms: usize) -> Vec<Line> {
    let mut lines = Vec::new();
    let all = (1..ranges.len()).fold(1_usize, |n, _| n.saturating_mul(LEVELS));
    let combinations = all.min(LINES);
    let affordable = MOST_TERMS / (terms.max(1) * combinations * ranges.len().max(1));
    let count = affordable.clamp(FEWEST_POINTS, POINTS);
    for input in 0..ranges.len() {
        let [low, high] = ranges[input];
        let step = |i: usize| i as f64 / (count - 1) as f64;
        let points: Vec<f64> = (0..count).map(|i| low + (high - low) * step(i)).collect();
        for line in 0..combinations {
            let mut digits = line;
            let mut fraction = 1.0;
            let rest = (ranges.iter().enumerate())
                .map(|(other, [low, high])| {
                    if other == input {
                        return *low;
                    }
                    let level = digits % LEVELS;
                    digits /= LEVELS;
                    fraction *= PLASTIC;
                    let place = match all > LINES {
                        // A Kronecker sequence.
                        true => (0.5 + line as f64 * fraction).fract(),
                        false => level as f64 / (LEVELS - 1) as f64,
                    };
                    low + (high - low) * place
                })
                .collect();
            lines.push(Line { input, points: points.clone(), rest });
        }
    }
    lines
}

/// How many terms an evaluation of a law costs.
pub(super) fn terms(law: &LawSpec) -> usize {
    let outputs = law.outputs.iter().flat_map(|output| &output.pieces);
    let conditions = outputs.clone().filter_map(|piece| match &piece.when {
        Some(Condition::Formula(formula)) => Some(formula),
        _ => None,
    });
    let values = outputs.clone().map(|piece| &piece.value);
    let definitions = law.definitions.iter().map(|definition| &definition.formula);
    let mut terms = law.inputs.len() + law.parameters.len() + outputs.count();
    for formula in conditions.chain(values).chain(definitions) {
        formula.root.visit(&mut |_| terms += 1);
    }
    terms
}

/// Neighbouring numbers between `low` and `high` of which `holds` is true and false; it is true of `low`
/// and false of `high`.
pub(super) fn bisect(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> (f64, f64) {
    /// Enough to halve any interval down to neighbours, unless they are next to zero.
    const STEPS: usize = 200;
    for _ in 0..STEPS {
        let middle = low + (high - low) / 2.0;
        if middle <= low || middle >= high {
            break;
        }
        if holds(middle) { low = middle } else { high = middle }
    }
    (low, high)
}

/// Where a message about a piece points: its condition as far as it is known as text, or its value.
pub(super) fn place_of(piece: &Piece) -> &Located {
    match &piece.when {
        Some(Condition::Formula(formula)) => &formula.text,
        Some(Condition::Threshold { text, .. }) => text,
        None => &piece.value.text,
    }
}

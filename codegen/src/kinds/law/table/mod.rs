//! Tables of a law: a monotone cubic through the rows of a file, as a number that formulas can use.

mod columns;
mod cubic;
mod draft;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use crate::rational::{Rational, nearest};
use num_traits::{One, Zero};

pub use columns::{Column, Columns, Wanted, Which};
pub(super) use draft::{TableDraft, read};

use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use crate::expression::{Function, Graph, Id, Relation};
use crate::formula::{Formula, pi};
use crate::operation::Number;
use crate::units::Unit;
use cubic::Cubic;

/// A table of a law. Its numbers are in the system of units of the law's inputs and outputs.
#[derive(Debug, Clone)]
pub struct LawTable {
    /// Symbol.
    pub name: String,
    /// The file of its rows.
    pub file: Arc<Source>,
    /// Name of the file as the law gives it.
    pub path: String,
    /// What it is looked up by, in the units of the law.
    pub input: Formula,
    /// Unit of the column of what it is looked up by.
    pub(crate) input_unit: Unit,
    /// Unit of the column of its values.
    pub unit: Unit,
    /// What becomes of inputs outside its rows.
    pub(crate) extend: Extend,
    /// Whether the extension below and above the rows may be believed.
    pub(crate) valid_beyond: [bool; 2],
    /// The inputs of its rows, ascending: between them it is a cubic, at them its slope is continuous.
    pub knots: Vec<Rational>,
    /// One piece more than there are splits.
    pieces: Vec<Cubic>,
    splits: Vec<Rational>,
    /// First and last input in the unit of their column.
    pub(super) ends: [f64; 2],
    /// The ends between which there are values, if there are none elsewhere.
    bounds: [Rational; 2],
    /// The comparisons of the input with the rows between the first and the last.
    inner: Vec<Id>,
    /// How many definitions come before it.
    pub(super) after: usize,
}

/// What becomes of inputs outside the rows of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extend {
    /// The nearest row's value.
    Constant,
    /// A straight line with the slope at the nearest row.
    Linear,
    /// The rows repeat; the last is the first again.
    Periodic,
    /// There is no value.
    Refuse,
}

/// Inputs beyond the end by less than this fraction of the whole are at the end, so that rounding of a unit
/// does not refuse the end itself.
fn margin(width: &Rational) -> Rational {
    width / Rational::from(1_i64 << 30)
}

impl LawTable {
    /// `x` and `y`: the rows; `x` rises.
    fn fill(&mut self, x: Vec<Rational>, y: &[Rational]) {
        let slopes = whirl_slopes::slopes(&x, y, self.extend == Extend::Periodic);
        self.pieces = cubic::cubics(&x, y, &slopes);
        let last = x.len() - 1;
        self.splits = x[1..last].to_vec();
        let outside = |at: usize| {
            let slope = match self.extend {
                Extend::Linear => slopes[at].clone(),
                _ => Rational::zero(),
            };
            let coefficients = [y[at].clone(), slope, Rational::zero(), Rational::zero()];
            Cubic::new(x[at].clone(), coefficients)
        };
        if matches!(self.extend, Extend::Linear | Extend::Constant) {
            self.pieces.insert(0, outside(0));
            self.pieces.push(outside(last));
            self.splits.insert(0, x[0].clone());
            self.splits.push(x[last].clone());
        }
        let margin = margin(&(&x[last] - &x[0]));
        self.bounds = [&x[0] - &margin, &x[last] + &margin];
        self.knots = x;
    }

    /// First and last input of the rows.
    pub fn span(&self) -> [&Rational; 2] {
        [&self.knots[0], &self.knots[self.knots.len() - 1]]
    }

    /// The ends of the rows beyond which the table may not be believed; none where it may be anywhere. A little
    /// further out, as rounding of a unit goes.
    pub(super) fn trusted(&self) -> Option<[Option<Rational>; 2]> {
        let [below, above] = self.valid_beyond;
        let [first, last] = self.bounds.clone();
        let ends = [(!below).then_some(first), (!above).then_some(last)];
        (self.extend != Extend::Periodic && !(below && above)).then_some(ends)
    }

    /// Comparisons on the graph across which neither value nor slope jumps.
    pub(super) fn inner(&self) -> &[Id] {
        &self.inner
    }

    fn period(&self) -> Rational {
        let [first, last] = self.span();
        last - first
    }

    /// How often a periodic input has passed its period.
    fn turns(&self, input: f64) -> Option<i64> {
        let period = nearest(&self.period());
        let turns = ((input - nearest(&self.knots[0])) / period).floor();
        (self.extend == Extend::Periodic).then_some(turns as i64)
    }

    /// Whether the input is outside the rows of a table that is not extended.
    pub(crate) fn is_outside(&self, input: f64) -> bool {
        let [low, high] = self.bounds.each_ref().map(nearest);
        self.extend == Extend::Refuse && !(low..=high).contains(&input)
    }

    /// The value by direct evaluation.
    pub fn value<N: Number>(&self, input: &N) -> N {
        let mut input = input.clone();
        if let Some(turns) = self.turns(input.value()) {
            let shift = self.period() * Rational::from(turns);
            input = input.sub(&N::exact(&shift));
        }
        if self.is_outside(input.value()) {
            return N::exact(&-Rational::one()).function(Function::Ln);
        }
        let place = self.splits.partition_point(|at| nearest(at) <= input.value());
        self.pieces[place].value(&input)
    }

    /// The value on the graph.
    pub(super) fn lower(&mut self, graph: &mut Graph, input: Id) -> Id {
        let wrapped = if self.extend == Extend::Periodic { self.wrap(graph, input) } else { input };
        let masks: Vec<Id> = (self.splits.iter())
            .map(|at| {
                let at = graph.number(at.clone());
                graph.compare(Relation::Less, wrapped, at)
            })
            .collect();
        let rows = (self.splits.iter().zip(&masks))
            .filter(|(at, _)| !self.span().contains(at) || self.extend == Extend::Linear);
        self.inner = rows.map(|(_, mask)| *mask).collect();
        let start = self.choose(graph, &masks, |piece| &piece.start);
        let t = graph.sub(wrapped, start);
        let mut value = self.choose(graph, &masks, |piece| &piece.coefficients[3]);
        for power in (0..3).rev() {
            let coefficient = self.choose(graph, &masks, |piece| &piece.coefficients[power]);
            let product = graph.mul(t, value);
            value = graph.add(coefficient, product);
        }
        if self.extend != Extend::Refuse {
            return value;
        }
        let [low, high] = self.bounds.clone().map(|end| graph.number(end));
        let above = graph.compare(Relation::LessOrEqual, low, wrapped);
        let below = graph.compare(Relation::LessOrEqual, wrapped, high);
        let inside = graph.and(above, below);
        let minus_one = graph.integer(-1);
        let nothing = graph.function(Function::Ln, minus_one);
        graph.select(inside, value, nothing)
    }

    /// A number of the piece that applies, by halves.
    fn choose(&self, graph: &mut Graph, masks: &[Id], number: impl Fn(&Cubic) -> &Rational) -> Id {
        fn half(graph: &mut Graph, masks: &[Id], numbers: &[Id]) -> Id {
            let [first, .., _] = numbers else { return numbers[0] };
            // All alike: no choice.
            if numbers.iter().all(|number| number == first) {
                return *first;
            }
            let middle = numbers.len() / 2;
            let below = half(graph, &masks[..middle - 1], &numbers[..middle]);
            let above = half(graph, &masks[middle..], &numbers[middle..]);
            graph.select(masks[middle - 1], below, above)
        }
        let numbers: Vec<Id> =
            self.pieces.iter().map(|piece| graph.number(number(piece).clone())).collect();
        half(graph, masks, &numbers)
    }

    /// The input brought into the first period. Its derivative is 1: that of the arctangent cancels that of
    /// the tangent.
    fn wrap(&self, graph: &mut Graph, input: Id) -> Id {
        let [first, last] = self.span();
        let two = Rational::from(2);
        let middle = graph.number((first + last) / two);
        let scale = pi() / self.period();
        let distance = graph.sub(input, middle);
        let angle = graph.times(scale.clone(), distance);
        let tangent = graph.function(Function::Tan, angle);
        let wrapped = graph.function(Function::Atan, tangent);
        let wrapped = graph.times(scale.recip(), wrapped);
        graph.add(middle, wrapped)
    }
}

/// What is wrong with the rows: inputs that do not rise, or ends of a period that differ.
fn check_rows(
    table: &LawTable,
    x: &columns::Column,
    y: &columns::Column,
) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::new();
    let written = |place: &std::ops::Range<usize>| &table.file.text[place.clone()];
    let falling = x.values.windows(2).all(|pair| pair[1].0 < pair[0].0);
    for pair in x.values.windows(2) {
        let [(before, first), (after, second)] = pair else { continue };
        if before < after {
            continue;
        }
        let (a, b) = (written(first), written(second));
        let message = format!("the inputs of a table rise, but {b} follows {a}");
        let error = Diagnostic::new(&table.file, Code::TABLE, second.clone(), message);
        let help = if falling { "turn the rows around" } else { "sort the rows, each input once" };
        errors.push(error.help(help));
        break;
    }
    match (table.extend, y.values.as_slice()) {
        (Extend::Periodic, [(first, at), .., (last, end)]) if first != last => {
            let (a, b) = (written(at), written(end));
            let message =
                format!("a periodic table ends with the value it starts with: {a}, not {b}");
            errors.push(Diagnostic::new(&table.file, Code::TABLE, end.clone(), message));
        }
        _ => {}
    }
    errors.into_result(())
}

//! Formulas over numbers as instructions: what [`super::evaluate()`] computes, in the same order, with names
//! by their places, for many evaluations.

use super::evaluate::{angle, chosen, function};
use super::series::{Budget, whole_f64};
use super::{Builtin, Comparison, Formula, Kind, Number, PI, Side, Term};
use crate::diagnostic::{Code, Diagnostic};
use crate::rational::nearest;

/// A formula without vectors and matrices; its last step gives its value. Truth is 1 and 0.
#[derive(Debug, Clone)]
pub(crate) struct Steps(Vec<Step>);

/// What a name is.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Known {
    /// A constant, which the ends of a sum can name.
    Constant(f64),
    /// It stands there among the values that [`Steps::value`] is given.
    Place(usize),
}

/// Operands are places of steps before.
#[derive(Debug, Clone)]
enum Step {
    Number(f64),
    Name(usize),
    Add(usize, usize),
    Sub(usize, usize),
    Mul(usize, usize),
    Div(usize, usize),
    Power(usize, usize),
    Function(Builtin, usize),
    Angle(usize, usize),
    Least(Vec<usize>),
    Greatest(Vec<usize>),
    Compare(Comparison, usize, usize),
    And(usize, usize),
    Or(usize, usize),
    Not(usize),
}

impl Steps {
    /// `known`: what names are.
    ///
    /// # Errors
    /// A name that is unknown, or something that is no number or condition.
    pub(crate) fn of(
        formula: &Formula,
        known: &dyn Fn(&str) -> Option<Known>,
    ) -> Result<Self, Diagnostic> {
        let (counters, budget) = (Vec::new(), Budget::new());
        let mut writer = Writer { formula, known, counters, budget: &budget, steps: Vec::new() };
        writer.term(&formula.root).map_err(|error| *error)?;
        Ok(Steps(writer.steps))
    }

    /// The value where names have the given ones.
    pub(crate) fn value<N: Number>(&self, names: &[N]) -> N {
        let mut values: Vec<N> = Vec::with_capacity(self.0.len());
        for step in &self.0 {
            values.push(step.value(names, &values));
        }
        values.pop().expect("a formula has a term")
    }

    /// Whether the condition holds.
    pub(crate) fn holds<N: Number>(&self, names: &[N]) -> bool {
        self.value(names).value() == 1.0
    }
}

impl Step {
    fn value<N: Number>(&self, names: &[N], of: &[N]) -> N {
        let truth = |value: bool| N::near(f64::from(u8::from(value)));
        let holds = |place: usize| of[place].value() == 1.0;
        let all = |places: &[usize]| places.iter().map(|place| of[*place].clone()).collect();
        match *self {
            Step::Number(value) => N::near(value),
            Step::Name(place) => names[place].clone(),
            Step::Add(a, b) => of[a].add(&of[b]),
            Step::Sub(a, b) => of[a].sub(&of[b]),
            Step::Mul(a, b) => of[a].mul(&of[b]),
            Step::Div(a, b) => of[a].div(&of[b]),
            Step::Power(a, b) => of[a].power(&of[b]),
            Step::Function(builtin, a) => function(builtin, &of[a]),
            Step::Angle(y, x) => angle(&of[y], &of[x]),
            Step::Least(ref places) => {
                let all: Vec<N> = all(places);
                chosen(&all, |a, b| a < b).unwrap_or_else(|| N::near(f64::NAN))
            }
            Step::Greatest(ref places) => {
                let all: Vec<N> = all(places);
                chosen(&all, |a, b| a > b).unwrap_or_else(|| N::near(f64::NAN))
            }
            Step::Compare(comparison, a, b) => {
                truth(comparison.holds(of[a].value(), of[b].value()))
            }
            Step::And(a, b) => truth(holds(a) && holds(b)),
            Step::Or(a, b) => truth(holds(a) || holds(b)),
            Step::Not(a) => truth(!holds(a)),
        }
    }
}

struct Writer<'f> {
    formula: &'f Formula,
    known: &'f dyn Fn(&str) -> Option<Known>,
    /// Counters of the sums around the term, with their values.
    counters: Vec<(&'f str, i64)>,
    budget: &'f Budget,
    steps: Vec<Step>,
}

/// The place of a step.
type Written = Result<usize, Box<Diagnostic>>;

impl<'f> Writer<'f> {
    fn error(&self, term: &Term, code: Code, message: &str) -> Box<Diagnostic> {
        Box::new(self.formula.text.error(code, term.span.clone(), message))
    }

    fn push(&mut self, step: Step) -> usize {
        self.steps.push(step);
        self.steps.len() - 1
    }

    fn terms(&mut self, terms: &'f [Term]) -> Result<Vec<usize>, Box<Diagnostic>> {
        terms.iter().map(|term| self.term(term)).collect()
    }

    fn term(&mut self, term: &'f Term) -> Written {
        let step = match &term.kind {
            Kind::Number(value) => Step::Number(nearest(value)),
            Kind::Name(name) => self.name(term, name)?,
            Kind::Negate(inner) => {
                let zero = self.push(Step::Number(0.0));
                Step::Sub(zero, self.term(inner)?)
            }
            Kind::Sum(parts) => {
                let mut sum = self.term(&parts[0].1)?;
                for (side, part) in &parts[1..] {
                    let part = self.term(part)?;
                    sum = self.push(match side {
                        Side::With => Step::Add(sum, part),
                        Side::Against => Step::Sub(sum, part),
                    });
                }
                return Ok(sum);
            }
            Kind::Product(parts) => return self.product(term, parts),
            Kind::Power(base, exponent) => Step::Power(self.term(base)?, self.term(exponent)?),
            Kind::Call { function, arguments, .. } => self.call(term, function, arguments)?,
            Kind::Series { counter, ends, body, .. } => {
                return self.series(term, counter, ends, body);
            }
            Kind::Compare(first, rest) => {
                let mut left = self.term(first)?;
                let mut all = None;
                for (comparison, part) in rest {
                    let right = self.term(part)?;
                    let holds = self.push(Step::Compare(*comparison, left, right));
                    all = Some(match all {
                        Some(all) => self.push(Step::And(all, holds)),
                        None => holds,
                    });
                    left = right;
                }
                return Ok(all.unwrap_or(left));
            }
            Kind::And(parts) => return self.chain(parts, Step::And),
            Kind::Or(parts) => return self.chain(parts, Step::Or),
            Kind::Not(inner) => Step::Not(self.term(inner)?),
        };
        Ok(self.push(step))
    }

    fn name(&self, term: &Term, name: &str) -> Result<Step, Box<Diagnostic>> {
        let counter = self.counters.iter().find(|(counter, _)| *counter == name);
        match ((self.known)(name), counter) {
            (Some(Known::Constant(value)), _) => Ok(Step::Number(value)),
            (Some(Known::Place(place)), _) => Ok(Step::Name(place)),
            (None, Some((_, count))) => Ok(Step::Number(*count as f64)),
            (None, None) if name == PI => Ok(Step::Number(std::f64::consts::PI)),
            _ => Err(self.error(term, Code::UNKNOWN_NAME, &format!("`{name}` has no value"))),
        }
    }

    fn chain(&mut self, parts: &'f [Term], join: fn(usize, usize) -> Step) -> Written {
        let mut all = self.term(&parts[0])?;
        for part in &parts[1..] {
            let part = self.term(part)?;
            all = self.push(join(all, part));
        }
        Ok(all)
    }

    fn product(&mut self, term: &Term, parts: &'f [(Side, Term)]) -> Written {
        let mut product = None;
        for (side, part) in parts {
            let factor = self.term(part)?;
            product = Some(match (product, side) {
                (None, Side::With) => factor,
                (Some(product), Side::With) => self.push(Step::Mul(product, factor)),
                (Some(product), Side::Against) => self.push(Step::Div(product, factor)),
                (None, Side::Against) => {
                    let one = self.push(Step::Number(1.0));
                    self.push(Step::Div(one, factor))
                }
            });
        }
        product.ok_or_else(|| self.error(term, Code::SHAPE, "this product has no factors"))
    }

    fn call(
        &mut self,
        term: &'f Term,
        name: &str,
        arguments: &'f [Term],
    ) -> Result<Step, Box<Diagnostic>> {
        let places = self.terms(arguments)?;
        let refused = |message| Err(self.error(term, Code::SHAPE, message));
        let Some(builtin) = Builtin::named(name) else {
            return refused("this is no function of numbers");
        };
        let step = match (builtin, &places[..]) {
            (Builtin::Min, [_, ..]) => Some(Step::Least(places)),
            (Builtin::Max, [_, ..]) => Some(Step::Greatest(places)),
            (Builtin::Atan2, [y, x]) => Some(Step::Angle(*y, *x)),
            (Builtin::Min | Builtin::Max | Builtin::Atan2, _) => None,
            (Builtin::Dot | Builtin::Outer | Builtin::Transpose, _) => {
                return refused("this is no function of numbers");
            }
            (
                Builtin::Sqrt
                | Builtin::Exp
                | Builtin::Log
                | Builtin::Sin
                | Builtin::Cos
                | Builtin::Tan
                | Builtin::Atan
                | Builtin::Sinh
                | Builtin::Cosh
                | Builtin::Tanh
                | Builtin::Abs,
                arguments,
            ) => match arguments {
                [x] => Some(Step::Function(builtin, *x)),
                _ => None,
            },
        };
        step.map_or_else(|| refused("this function has another number of arguments"), Ok)
    }

    /// The sum written out.
    fn series(
        &mut self,
        term: &'f Term,
        counter: &'f str,
        ends: &'f [Term; 2],
        body: &'f Term,
    ) -> Written {
        let [first, last] = [&ends[0], &ends[1]].map(|end| self.whole(end));
        let counts = self.budget.counter([first?, last?]);
        let counts = counts.map_err(|message| self.error(term, Code::LIMIT, &message))?;
        let mut sum = None;
        for count in counts {
            self.counters.push((counter, count));
            let part = self.term(body);
            self.counters.pop();
            let part = part?;
            sum = Some(match sum {
                Some(sum) => self.push(Step::Add(sum, part)),
                None => part,
            });
        }
        sum.ok_or_else(|| self.error(term, Code::SHAPE, "this sum has no terms"))
    }

    /// The whole number that an end of a sum is; it names only constants and counters.
    fn whole(&self, end: &'f Term) -> Result<Option<i64>, Box<Diagnostic>> {
        let counters = self.counters.clone();
        let constant = |name: &str| (self.known)(name).filter(|k| matches!(k, Known::Constant(_)));
        let mut writer = Writer {
            formula: self.formula,
            known: &constant,
            counters,
            budget: self.budget,
            steps: Vec::new(),
        };
        writer.term(end)?;
        Ok(whole_f64(Steps(writer.steps).value::<f64>(&[])))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::diagnostic::Located;
    use crate::formula::{Dual, Rounded, Value, evaluate, parse};

    #[test]
    fn steps_give_what_the_terms_give() {
        for text in [
            "-x^2 + 3*-x - 1/y/2 - 0.1*x*y",
            "sqrt(x) + abs(-y) + min(x, y, 5) - max(x, 7, y)",
            "exp(x)*log(y)/sin(x) + cos(y) - tan(x)*atan(y)^tanh(x)",
            "sinh(x) - cosh(y)*pi + atan2(y, x) - atan2(-x, y)",
            "sum(i, 0, Z, sum(j, 0, i + 1, i*j*x^j/Z))",
            "x < y <= 3 and not x > 2 or y >= 7",
            "x < 1 or y < 2 and x > y",
        ] {
            let formula = parse(&Located::alone("f", text)).expect("a formula");
            let steps = Steps::of(&formula, &|name| match name {
                "x" => Some(Known::Place(0)),
                "y" => Some(Known::Place(1)),
                _ => (name == "Z").then_some(Known::Constant(3.0)),
            });
            let steps = steps.expect("numbers only");
            for (x, y) in [(0.3, 2.5), (1.7, 0.1), (4.0, 3.0)] {
                fn both<N: Number>(formula: &Formula, steps: &Steps, [x, y]: [N; 2]) -> [f64; 2] {
                    let names = BTreeMap::from(
                        [("x", &x), ("y", &y), ("Z", &N::near(3.0))]
                            .map(|(name, value)| (name.to_owned(), Value::Scalar(value.clone()))),
                    );
                    let term = match evaluate(formula, &names).expect("a value") {
                        Value::Scalar(value) => value.value(),
                        Value::Truth(truth) => f64::from(u8::from(truth)),
                        _ => f64::NAN,
                    };
                    [term, steps.value(&[x, y]).value()]
                }
                let slope = [Dual::variable(x), Dual::constant(y)];
                for [term, step] in [
                    both(&formula, &steps, [x, y]),
                    both(&formula, &steps, slope),
                    both(&formula, &steps, [x, y].map(Rounded::new)),
                ] {
                    assert_eq!(term.to_bits(), step.to_bits(), "{text} at {x}, {y}");
                }
            }
        }
    }

    #[test]
    fn only_numbers_have_steps() {
        for text in ["dot(v, v)", "unknown + 1", "sum(j, 0, x, j)"] {
            let formula = parse(&Located::alone("f", text)).expect("a formula");
            assert!(
                Steps::of(&formula, &|name| (name != "unknown").then_some(Known::Place(0)))
                    .is_err(),
                "{text}"
            );
        }
    }
}

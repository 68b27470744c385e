//! Direct evaluation of terms over any [`Number`]: no graph, no bytecode, no rewriting. Tests compare with this
//! whatever the generator makes of a formula.

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};

use super::function::Builtin;
use super::series::{Budget, whole_f64};
use super::{Formula, Side, Term, TermKind};
use crate::operation::{Function, Number};

/// The value of a term.
#[derive(Debug, Clone, PartialEq)]
pub enum Value<N> {
    /// A number.
    Scalar(N),
    /// The entries of a vector.
    Vector(Vec<N>),
    /// The rows of a matrix.
    Matrix(Vec<Vec<N>>),
    /// A condition.
    Truth(bool),
}

impl<N> Value<N> {
    /// The number, if it is one.
    pub fn scalar(self) -> Option<N> {
        match self {
            Value::Scalar(value) => Some(value),
            _ => None,
        }
    }
}

/// The value of a formula where names have the given values. `None` where a name has none, or where shapes do
/// not fit or a sum has too many terms, which [`super::lower`] explains.
pub fn evaluate<N: Number>(
    formula: &Formula,
    names: &BTreeMap<String, Value<N>>,
) -> Option<Value<N>> {
    let mut evaluation = Evaluation { names, counters: Vec::new(), budget: Budget::new() };
    evaluation.term(&formula.root)
}

struct Evaluation<'f, N> {
    names: &'f BTreeMap<String, Value<N>>,
    /// Counters of the sums around the term, with their values.
    counters: Vec<(&'f str, i64)>,
    budget: Budget,
}

impl<'f, N: Number> Evaluation<'f, N> {
    fn scalar(&mut self, term: &'f Term) -> Option<N> {
        self.term(term)?.scalar()
    }

    fn truths(&mut self, parts: &'f [Term]) -> Option<Vec<bool>> {
        let truth = |part| match self.term(part)? {
            Value::Truth(truth) => Some(truth),
            _ => None,
        };
        parts.iter().map(truth).collect()
    }

    fn term(&mut self, term: &'f Term) -> Option<Value<N>> {
        Some(match &term.kind {
            TermKind::Number(value) => Value::Scalar(N::exact(value)),
            TermKind::Name(name) => match self.names.get(name) {
                Some(value) => value.clone(),
                None => Value::Scalar(self.counter_or_pi(name)?),
            },
            TermKind::Negate(inner) => map(self.term(inner)?, &|x| N::near(0.0).sub(x))?,
            TermKind::Sum(parts) => {
                let mut sum = self.term(&parts[0].1)?;
                for (side, part) in &parts[1..] {
                    let operation = match side {
                        Side::With => N::add,
                        Side::Against => N::sub,
                    };
                    sum = zip(sum, self.term(part)?, operation)?;
                }
                sum
            }
            TermKind::Product(parts) => self.product(parts)?,
            TermKind::Power(base, exponent) => {
                Value::Scalar(self.scalar(base)?.power(&self.scalar(exponent)?))
            }
            TermKind::Call { function, arguments, .. } => {
                let arguments: Option<Vec<_>> = arguments.iter().map(|a| self.term(a)).collect();
                call(Builtin::named(function)?.0, &arguments?)?
            }
            TermKind::Series { counter, ends, body, .. } => {
                let [first, last] = [self.scalar(&ends[0])?, self.scalar(&ends[1])?];
                let counts = self.budget.counter([first, last].map(|end| whole_f64(end.value())));
                let mut sum: Option<N> = None;
                for count in counts.ok()? {
                    self.counters.push((counter, count));
                    let part = self.scalar(body)?;
                    self.counters.pop();
                    sum = Some(sum.map_or_else(|| part.clone(), |sum| sum.add(&part)));
                }
                Value::Scalar(sum?)
            }
            TermKind::Compare(first, rest) => {
                let mut left = self.scalar(first)?.value();
                let mut holds = true;
                for (comparison, part) in rest {
                    let right = self.scalar(part)?.value();
                    let (relation, low, high) = comparison.of(left, right);
                    holds &= relation.holds(low, high);
                    left = right;
                }
                Value::Truth(holds)
            }
            TermKind::And(parts) => Value::Truth(!self.truths(parts)?.contains(&false)),
            TermKind::Or(parts) => Value::Truth(self.truths(parts)?.contains(&true)),
            TermKind::Not(inner) => Value::Truth(!self.truths(std::slice::from_ref(inner))?[0]),
        })
    }

    fn counter_or_pi(&self, name: &str) -> Option<N> {
        match self.counters.iter().find(|(counter, _)| *counter == name) {
            Some((_, count)) => Some(N::near(*count as f64)),
            None => (name == super::PI).then(|| N::near(PI)),
        }
    }

    /// Numbers from the left; vectors and matrices from the right, so that A*B*x is A(Bx).
    fn product(&mut self, parts: &'f [(Side, Term)]) -> Option<Value<N>> {
        let mut scale: Option<N> = None;
        let mut tensors = Vec::new();
        for (side, part) in parts {
            match (self.term(part)?, side) {
                (Value::Scalar(factor), Side::With) => {
                    scale = Some(scale.map_or_else(|| factor.clone(), |scale| scale.mul(&factor)));
                }
                (Value::Scalar(divisor), Side::Against) => {
                    scale = Some(scale.unwrap_or_else(|| N::near(1.0)).div(&divisor));
                }
                (tensor, Side::With) => tensors.push(tensor),
                _ => return None,
            }
        }
        let Some(mut value) = tensors.pop() else { return scale.map(Value::Scalar) };
        while let Some(left) = tensors.pop() {
            let (Value::Matrix(rows), Value::Vector(x)) = (left, value) else { return None };
            value = Value::Vector(rows.iter().map(|row| dot(row, &x)).collect::<Option<_>>()?);
        }
        match scale {
            Some(scale) => map(value, &|x| scale.mul(x)),
            None => Some(value),
        }
    }
}

fn call<N: Number>(builtin: Builtin, arguments: &[Value<N>]) -> Option<Value<N>> {
    Some(Value::Scalar(match (builtin, arguments) {
        (Builtin::Function(function), [Value::Scalar(x)]) => x.function(function),
        (Builtin::Sqrt, [Value::Scalar(x)]) => x.sqrt(),
        (Builtin::Sinh, [Value::Scalar(x)]) => hyperbolic(x, N::sub),
        (Builtin::Cosh, [Value::Scalar(x)]) => hyperbolic(x, N::add),
        (Builtin::Min, all) => best(all, |a, b| a < b)?,
        (Builtin::Max, all) => best(all, |a, b| a > b)?,
        (Builtin::Atan2, [Value::Scalar(y), Value::Scalar(x)]) => angle(y, x),
        (Builtin::Dot, [Value::Vector(a), Value::Vector(b)]) => dot(a, b)?,
        (Builtin::Outer, [Value::Vector(a), Value::Vector(b)]) => {
            let row = |x: &N| b.iter().map(|y| x.mul(y)).collect();
            return Some(Value::Matrix(a.iter().map(row).collect()));
        }
        (Builtin::Transpose, [Value::Matrix(rows)]) => {
            let column = |j: usize| rows.iter().map(|row| row[j].clone()).collect();
            return Some(Value::Matrix((0..rows.first()?.len()).map(column).collect()));
        }
        _ => return None,
    }))
}

/// ½(eˣ ∓ e⁻ˣ)
fn hyperbolic<N: Number>(x: &N, join: fn(&N, &N) -> N) -> N {
    let grows = x.function(Function::Exp);
    join(&grows, &N::near(1.0).div(&grows)).mul(&N::near(0.5))
}

/// The first that is better than all before it.
fn best<N: Number>(all: &[Value<N>], better: fn(f64, f64) -> bool) -> Option<N> {
    let mut all = all.iter().map(|value| value.clone().scalar());
    let first = all.next()??;
    all.try_fold(first, |best, other| {
        let other = other?;
        Some(N::chosen(better(other.value(), best.value()), other, best))
    })
}

/// The angle of (x, y) from the axis x, by the arctangent of the smaller over the larger of the two.
fn angle<N: Number>(y: &N, x: &N) -> N {
    let turn = |quarters: f64| N::near(quarters * FRAC_PI_2);
    if y.value().abs() <= x.value().abs() {
        let angle = y.div(x).function(Function::Atan);
        match (x.value() > 0.0, y.value() >= 0.0) {
            (true, _) => angle,
            (false, true) => angle.add(&turn(2.0)),
            (false, false) => angle.sub(&turn(2.0)),
        }
    } else {
        let angle = x.div(y).function(Function::Atan);
        turn(if y.value() > 0.0 { 1.0 } else { -1.0 }).sub(&angle)
    }
}

fn map<N>(value: Value<N>, f: &impl Fn(&N) -> N) -> Option<Value<N>> {
    Some(match value {
        Value::Scalar(x) => Value::Scalar(f(&x)),
        Value::Vector(x) => Value::Vector(x.iter().map(f).collect()),
        Value::Matrix(rows) => {
            Value::Matrix(rows.iter().map(|row| row.iter().map(f).collect()).collect())
        }
        Value::Truth(_) => return None,
    })
}

fn zip<N>(a: Value<N>, b: Value<N>, f: fn(&N, &N) -> N) -> Option<Value<N>> {
    let entries = |a: &[N], b: &[N]| -> Option<Vec<N>> {
        (a.len() == b.len()).then(|| a.iter().zip(b).map(|(x, y)| f(x, y)).collect())
    };
    Some(match (a, b) {
        (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(f(&a, &b)),
        (Value::Vector(a), Value::Vector(b)) => Value::Vector(entries(&a, &b)?),
        (Value::Matrix(a), Value::Matrix(b)) if a.len() == b.len() => {
            let rows: Option<_> = a.iter().zip(&b).map(|(a, b)| entries(a, b)).collect();
            Value::Matrix(rows?)
        }
        _ => return None,
    })
}

fn dot<N: Number>(a: &[N], b: &[N]) -> Option<N> {
    let zero = N::near(0.0);
    (a.len() == b.len()).then(|| a.iter().zip(b).fold(zero, |sum, (x, y)| sum.add(&x.mul(y))))
}

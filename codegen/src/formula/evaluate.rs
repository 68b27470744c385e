//! Direct evaluation of terms over any [`Number`]: no graph, no rewriting. Everything that the generator
//! makes of a formula is compared with this.

#[cfg(test)]
mod tests;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::LazyLock;

use crate::rational::Rational;
use num_traits::Zero;

use super::series::{self, Budget};
use super::{Builtin, Formula, Kind, Number, PI, Side, Term};
use crate::diagnostic::{Code, Diagnostic};

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

/// The value of a formula where names have the given values.
///
/// # Errors
/// A name without a value, or values whose shapes do not fit (see [`super::check`] for better words).
pub fn evaluate<N: Number>(
    formula: &Formula,
    names: &BTreeMap<String, Value<N>>,
) -> Result<Value<N>, Diagnostic> {
    let (counters, budget) = (RefCell::default(), Budget::new());
    let evaluation = Evaluation { formula, names, counters, budget };
    evaluation.term(&formula.root).map_err(|error| *error)
}

struct Evaluation<'f, N> {
    formula: &'f Formula,
    names: &'f BTreeMap<String, Value<N>>,
    /// Counters of the sums around the term, with their values.
    counters: RefCell<Vec<(&'f str, i64)>>,
    budget: Budget,
}

type Evaluated<N> = Result<Value<N>, Box<Diagnostic>>;

impl<'f, N: Number> Evaluation<'f, N> {
    fn misfit(&self, term: &Term) -> Box<Diagnostic> {
        let message = "the shapes of these values do not fit";
        Box::new(self.formula.text.error(Code::SHAPE, term.span.clone(), message))
    }

    fn scalar(&self, term: &'f Term) -> Result<N, Box<Diagnostic>> {
        self.term(term)?.scalar().ok_or_else(|| self.misfit(term))
    }

    /// The value of a counter.
    fn count(&self, name: &str) -> Option<i64> {
        let counters = self.counters.borrow();
        counters.iter().find(|(counter, _)| *counter == name).map(|(_, count)| *count)
    }

    fn truth(&self, term: &'f Term) -> Result<bool, Box<Diagnostic>> {
        match self.term(term)? {
            Value::Truth(truth) => Ok(truth),
            _ => Err(self.misfit(term)),
        }
    }

    fn vector(&self, term: &'f Term) -> Result<Vec<N>, Box<Diagnostic>> {
        match self.term(term)? {
            Value::Vector(entries) => Ok(entries),
            _ => Err(self.misfit(term)),
        }
    }

    fn term(&self, term: &'f Term) -> Evaluated<N> {
        Ok(match &term.kind {
            Kind::Number(value) => Value::Scalar(N::exact(value)),
            Kind::Name(name) => match self.names.get(name) {
                Some(value) => value.clone(),
                None => self.counter_or_pi(term, name)?,
            },
            Kind::Negate(inner) => {
                let zero = N::exact(&Rational::zero());
                map(self.term(inner)?, &|x| zero.sub(x)).ok_or_else(|| self.misfit(inner))?
            }
            Kind::Sum(parts) => {
                let mut sum = self.term(&parts[0].1)?;
                for (side, part) in &parts[1..] {
                    let operation = match side {
                        Side::With => N::add,
                        Side::Against => N::sub,
                    };
                    sum = zip(sum, self.term(part)?, operation).ok_or_else(|| self.misfit(part))?;
                }
                sum
            }
            Kind::Product(parts) => self.product(term, parts)?,
            Kind::Power(base, exponent) => {
                Value::Scalar(self.scalar(base)?.power(&self.scalar(exponent)?))
            }
            Kind::Call { function, arguments, .. } => self.call(term, function, arguments)?,
            Kind::Series { counter, ends, body, .. } => {
                let [first, last] = [self.scalar(&ends[0])?, self.scalar(&ends[1])?];
                let ends = [first, last].map(|end| series::whole_f64(end.value()));
                let counts = self.budget.counter(ends).map_err(|message| {
                    Box::new(self.formula.text.error(Code::LIMIT, term.span.clone(), message))
                })?;
                let mut sum: Option<N> = None;
                for count in counts {
                    self.counters.borrow_mut().push((counter, count));
                    let part = self.scalar(body);
                    self.counters.borrow_mut().pop();
                    sum = Some(match sum {
                        Some(sum) => sum.add(&part?),
                        None => part?,
                    });
                }
                Value::Scalar(sum.ok_or_else(|| self.misfit(term))?)
            }
            Kind::Compare(first, rest) => {
                let mut left = self.scalar(first)?.value();
                let mut holds = true;
                for (comparison, part) in rest {
                    let right = self.scalar(part)?.value();
                    holds &= comparison.holds(left, right);
                    left = right;
                }
                Value::Truth(holds)
            }
            Kind::And(parts) => {
                let parts: Result<Vec<bool>, _> = parts.iter().map(|p| self.truth(p)).collect();
                Value::Truth(parts?.into_iter().all(|truth| truth))
            }
            Kind::Or(parts) => {
                let parts: Result<Vec<bool>, _> = parts.iter().map(|p| self.truth(p)).collect();
                Value::Truth(parts?.into_iter().any(|truth| truth))
            }
            Kind::Not(inner) => Value::Truth(!self.truth(inner)?),
        })
    }

    fn counter_or_pi(&self, term: &'f Term, name: &str) -> Evaluated<N> {
        if let Some(count) = self.count(name) {
            return Ok(Value::Scalar(N::exact(&series::exact(count))));
        }
        if name == PI {
            return Ok(Value::Scalar(N::near(std::f64::consts::PI)));
        }
        let message = format!("`{name}` has no value");
        Err(Box::new(self.formula.text.error(Code::UNKNOWN_NAME, term.span.clone(), message)))
    }

    /// Numbers from the left; vectors and matrices from the right, so that A*B*x is A(Bx).
    fn product(&self, term: &'f Term, parts: &'f [(Side, Term)]) -> Evaluated<N> {
        let mut scale: Option<N> = None;
        let mut tensors = Vec::new();
        for (side, part) in parts {
            match (self.term(part)?, side) {
                (Value::Scalar(factor), side) => {
                    scale = Some(match (scale, side) {
                        (None, Side::With) => factor,
                        (Some(so_far), Side::With) => so_far.mul(&factor),
                        (so_far, Side::Against) => {
                            so_far.unwrap_or_else(|| N::exact(&one())).div(&factor)
                        }
                    });
                }
                (tensor, Side::With) => tensors.push(tensor),
                _ => return Err(self.misfit(part)),
            }
        }
        let Some(mut value) = tensors.pop() else {
            return scale.map(Value::Scalar).ok_or_else(|| self.misfit(term));
        };
        while let Some(left) = tensors.pop() {
            value = match (left, value) {
                (Value::Matrix(rows), Value::Vector(x)) => {
                    let entries: Option<Vec<N>> = rows.iter().map(|row| dot(row, &x)).collect();
                    Value::Vector(entries.ok_or_else(|| self.misfit(term))?)
                }
                _ => return Err(self.misfit(term)),
            };
        }
        match scale {
            Some(scale) => map(value, &|x| scale.mul(x)).ok_or_else(|| self.misfit(term)),
            None => Ok(value),
        }
    }

    fn call(&self, term: &'f Term, name: &str, arguments: &'f [Term]) -> Evaluated<N> {
        let builtin = Builtin::named(name).ok_or_else(|| self.misfit(term))?;
        let argument = |i: usize| arguments.get(i).ok_or_else(|| self.misfit(term));
        let choose = |better: fn(f64, f64) -> bool| {
            let all: Vec<N> = arguments.iter().map(|a| self.scalar(a)).collect::<Result<_, _>>()?;
            chosen(&all, better).map(Value::Scalar).ok_or_else(|| self.misfit(term))
        };
        match builtin {
            Builtin::Min => return choose(|a, b| a < b),
            Builtin::Max => return choose(|a, b| a > b),
            Builtin::Atan2 => {
                let (y, x) = (self.scalar(argument(0)?)?, self.scalar(argument(1)?)?);
                return Ok(Value::Scalar(angle(&y, &x)));
            }
            Builtin::Dot => {
                let (a, b) = (self.vector(argument(0)?)?, self.vector(argument(1)?)?);
                return dot(&a, &b).map(Value::Scalar).ok_or_else(|| self.misfit(term));
            }
            Builtin::Outer => {
                let (a, b) = (self.vector(argument(0)?)?, self.vector(argument(1)?)?);
                let row = |x: &N| b.iter().map(|y| x.mul(y)).collect();
                return Ok(Value::Matrix(a.iter().map(row).collect()));
            }
            Builtin::Transpose => {
                let Value::Matrix(rows) = self.term(argument(0)?)? else {
                    return Err(self.misfit(term));
                };
                let column = |j: usize| rows.iter().map(|row| row[j].clone()).collect();
                let columns = rows.first().map_or(0, Vec::len);
                return Ok(Value::Matrix((0..columns).map(column).collect()));
            }
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
            | Builtin::Abs => {}
        }
        let x = self.scalar(argument(0)?)?;
        Ok(Value::Scalar(function(builtin, &x)))
    }
}

/// A function of one number; no number of any other.
pub(super) fn function<N: Number>(builtin: Builtin, x: &N) -> N {
    let half = || N::exact(&Rational::half());
    let inverse = || N::exact(&one()).div(&x.exp());
    match builtin {
        Builtin::Sqrt => x.sqrt(),
        Builtin::Exp => x.exp(),
        Builtin::Log => x.ln(),
        Builtin::Sin => x.sin(),
        Builtin::Cos => x.cos(),
        Builtin::Tan => x.tan(),
        Builtin::Atan => x.atan(),
        Builtin::Tanh => x.tanh(),
        Builtin::Sinh => x.exp().sub(&inverse()).mul(&half()),
        Builtin::Cosh => x.exp().add(&inverse()).mul(&half()),
        Builtin::Abs => x.abs(),
        Builtin::Atan2
        | Builtin::Min
        | Builtin::Max
        | Builtin::Dot
        | Builtin::Outer
        | Builtin::Transpose => N::near(f64::NAN),
    }
}

/// The first that is better than all before it; none of none.
pub(super) fn chosen<N: Number>(all: &[N], better: fn(f64, f64) -> bool) -> Option<N> {
    let mut best = all.first()?;
    for other in &all[1..] {
        if better(other.value(), best.value()) {
            best = other;
        }
    }
    Some(best.chosen(all))
}

/// The angle of (x, y) from the axis x, by the arctangent of the smaller over the larger of the two.
pub(super) fn angle<N: Number>(y: &N, x: &N) -> N {
    let turn = |quarters: i64| N::exact(&(pi() * Rational::new(quarters, 2)));
    if y.value().abs() <= x.value().abs() {
        let angle = y.div(x).atan();
        match (x.value() > 0.0, y.value() >= 0.0) {
            (true, _) => angle,
            (false, true) => angle.add(&turn(2)),
            (false, false) => angle.sub(&turn(2)),
        }
    } else {
        let angle = x.div(y).atan();
        turn(if y.value() > 0.0 { 1 } else { -1 }).sub(&angle)
    }
}

fn one() -> Rational {
    Rational::from(1)
}

/// The f64 nearest to π, as an exact number.
pub(crate) fn pi() -> Rational {
    static PI: LazyLock<Rational> =
        LazyLock::new(|| Rational::from_float(std::f64::consts::PI).unwrap_or_else(one));
    PI.clone()
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
    let zero = N::exact(&Rational::zero());
    (a.len() == b.len()).then(|| a.iter().zip(b).fold(zero, |sum, (x, y)| sum.add(&x.mul(y))))
}

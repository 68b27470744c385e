//! The walk over a formula's terms that writes them into a graph or into code: the same functions are made of the same
//! operations in both.

use std::ops::Range;

use super::function::Builtin;
use super::series::Budget;
use super::{Formula, PI, Side, Term, TermKind, pi};
use crate::diagnostic::{Code, Diagnostics};
use crate::operation::{Function, Operation, Relation};
use crate::rational::Rational;

/// What a formula is written into.
pub(super) trait Target {
    /// What operations work on.
    type Value: Copy;

    /// An exact number.
    fn number(&mut self, value: &Rational) -> Self::Value;

    /// What a name stands for.
    fn named(&self, name: &str) -> Option<Self::Value>;

    /// The value of an operation.
    fn take(&mut self, operation: Operation<Self::Value>) -> Self::Value;

    /// a + b − c …
    fn sum(&mut self, parts: &[(Side, Self::Value)]) -> Self::Value;

    /// a·b / c …; a part that nothing can be divided by is noted. `fine`: nothing was noted of the parts.
    fn product(
        &mut self,
        parts: &[(Side, Part<'_, Self::Value>)],
        fine: bool,
        notes: &mut Notes<'_>,
    ) -> Self::Value;

    /// aᵇ, which stands at `span`; what has no value is noted.
    fn power(
        &mut self,
        parts: [Part<'_, Self::Value>; 2],
        span: &Range<usize>,
        notes: &mut Notes<'_>,
    ) -> Self::Value;

    /// A function of vectors or matrices.
    fn tensor(&mut self, _: Builtin, _: &[Self::Value]) -> Option<Self::Value> {
        None
    }

    /// Why a function has no value at an argument, as far as that is known.
    fn undefined(&self, _: Builtin, _: Self::Value) -> Option<&'static str> {
        None
    }

    /// The whole number that a value is, if it is a constant.
    fn whole(&self, value: Self::Value) -> Option<i64>;

    /// Whether nothing more can be written.
    fn is_full(&self) -> bool {
        false
    }
}

/// A part of a term that was written, and where it stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part<'t, V> {
    pub(super) value: V,
    pub(super) span: &'t Range<usize>,
}

/// What is wrong with a formula.
pub(super) struct Notes<'f> {
    formula: &'f Formula,
    errors: Diagnostics,
}

impl Notes<'_> {
    pub(super) fn error(&mut self, code: Code, span: &Range<usize>, message: impl Into<String>) {
        self.errors.push(self.formula.text.error(code, span.clone(), message));
    }

    pub(super) fn count(&self) -> usize {
        self.errors.len()
    }
}

/// Writes a formula: its value, and what is wrong with it.
pub(super) fn walk<T: Target>(formula: &Formula, target: &mut T) -> (T::Value, Diagnostics) {
    let notes = Notes { formula, errors: Diagnostics::new() };
    let mut walk = Walk { target, notes, counters: Vec::new(), budget: Budget::new() };
    let value = walk.term(&formula.root);
    (value, walk.notes.errors)
}

struct Walk<'f, 't, T> {
    target: &'t mut T,
    notes: Notes<'f>,
    /// Counters of the sums around the term, with their values.
    counters: Vec<(&'f str, i64)>,
    budget: Budget,
}

impl<'f, T: Target> Walk<'f, '_, T> {
    fn term(&mut self, term: &'f Term) -> T::Value {
        match &term.kind {
            TermKind::Number(value) => self.target.number(value),
            TermKind::Name(name) => self.name(term, name),
            TermKind::Negate(inner) => {
                let inner = self.term(inner);
                self.target.sum(&[(Side::Against, inner)])
            }
            TermKind::Sum(parts) => {
                let parts: Vec<_> = parts.iter().map(|(side, p)| (*side, self.term(p))).collect();
                self.target.sum(&parts)
            }
            TermKind::Product(parts) => {
                let before = self.notes.count();
                let parts: Vec<_> = parts.iter().map(|(side, p)| (*side, self.part(p))).collect();
                let fine = self.notes.count() == before;
                self.target.product(&parts, fine, &mut self.notes)
            }
            TermKind::Power(base, exponent) => {
                let parts = [self.part(base), self.part(exponent)];
                self.target.power(parts, &term.span, &mut self.notes)
            }
            TermKind::Call { function, arguments, .. } => self.call(term, function, arguments),
            TermKind::Series { counter, ends, body, .. } => self.series(term, counter, ends, body),
            TermKind::Compare(first, rest) => {
                let mut left = self.term(first);
                let mut all = None;
                for (comparison, part) in rest {
                    let right = self.term(part);
                    let (relation, low, high) = comparison.of(left, right);
                    let holds = self.target.take(Operation::Compare(relation, low, high));
                    all = Some(match all {
                        Some(before) => self.target.take(Operation::And(before, holds)),
                        None => holds,
                    });
                    left = right;
                }
                all.unwrap_or(left)
            }
            TermKind::And(parts) => self.chain(parts, Operation::And),
            TermKind::Or(parts) => self.chain(parts, Operation::Or),
            TermKind::Not(inner) => {
                let inner = self.term(inner);
                self.target.take(Operation::Not(inner))
            }
        }
    }

    fn terms(&mut self, parts: &'f [Term]) -> Vec<T::Value> {
        parts.iter().map(|part| self.term(part)).collect()
    }

    fn part(&mut self, term: &'f Term) -> Part<'f, T::Value> {
        Part { value: self.term(term), span: &term.span }
    }

    fn chain(
        &mut self,
        parts: &'f [Term],
        join: fn(T::Value, T::Value) -> Operation<T::Value>,
    ) -> T::Value {
        let parts = self.terms(parts);
        parts[1..].iter().fold(parts[0], |all, part| self.target.take(join(all, *part)))
    }

    fn name(&mut self, term: &Term, name: &str) -> T::Value {
        let counter = self.counters.iter().find(|(counter, _)| *counter == name);
        match (self.target.named(name), counter) {
            (Some(known), _) => known,
            (None, Some((_, count))) => self.target.number(&Rational::from(*count)),
            (None, None) if name == PI => self.target.number(&pi()),
            (None, None) => {
                self.wrong(Code::UNKNOWN_NAME, &term.span, format!("`{name}` has no value"))
            }
        }
    }

    /// Notes what is wrong; the number 0 stands for what has no value.
    fn wrong(&mut self, code: Code, span: &Range<usize>, message: impl Into<String>) -> T::Value {
        self.notes.error(code, span, message);
        self.target.number(&Rational::from(0))
    }

    /// The sum written out.
    fn series(
        &mut self,
        term: &Term,
        counter: &'f str,
        ends: &'f [Term; 2],
        body: &'f Term,
    ) -> T::Value {
        let values = [self.term(&ends[0]), self.term(&ends[1])];
        let counts = match self.budget.counter(values.map(|end| self.target.whole(end))) {
            Ok(counts) => counts,
            Err(message) => return self.wrong(Code::LIMIT, &term.span, message),
        };
        let mut parts = Vec::new();
        for count in counts {
            self.counters.push((counter, count));
            let errors = self.notes.count();
            parts.push((Side::With, self.term(body)));
            self.counters.pop();
            // What is wrong for one value of the counter mostly is for the next.
            if self.notes.count() > errors || self.target.is_full() {
                break;
            }
        }
        self.target.sum(&parts)
    }

    fn call(&mut self, term: &Term, name: &str, arguments: &'f [Term]) -> T::Value {
        let values = self.terms(arguments);
        let Some((builtin, [least, most])) = Builtin::named(name) else {
            let message = format!("unknown function `{name}`");
            return self.wrong(Code::BAD_CALL, &term.span, message);
        };
        if !(least..=most).contains(&values.len()) {
            let message = "this function has another number of arguments";
            return self.wrong(Code::SHAPE, &term.span, message);
        }
        if let Some(why) = self.target.undefined(builtin, values[0]) {
            self.notes.error(Code::UNDEFINED, &term.span, why);
        }
        let (x, all) = (values[0], values.as_slice());
        match builtin {
            Builtin::Function(function) => self.target.take(Operation::Function(function, x)),
            Builtin::Sqrt => self.target.take(Operation::Sqrt(x)),
            Builtin::Sinh => self.hyperbolic(x, Operation::Sub),
            Builtin::Cosh => self.hyperbolic(x, Operation::Add),
            Builtin::Min => self.best(all, |best, other| [other, best]),
            Builtin::Max => self.best(all, |best, other| [best, other]),
            Builtin::Atan2 => self.angle(x, all[1]),
            Builtin::Dot | Builtin::Outer | Builtin::Transpose => {
                self.target.tensor(builtin, all).unwrap_or_else(|| {
                    self.wrong(Code::SHAPE, &term.span, "this is no function of numbers")
                })
            }
        }
    }

    /// ½(eˣ ∓ e⁻ˣ)
    fn hyperbolic(
        &mut self,
        x: T::Value,
        join: fn(T::Value, T::Value) -> Operation<T::Value>,
    ) -> T::Value {
        let [one, half] = [Rational::from(1), Rational::half()].map(|n| self.target.number(&n));
        let grows = self.target.take(Operation::Function(Function::Exp, x));
        let falls = self.target.take(Operation::Div(one, grows));
        let twice = self.target.take(join(grows, falls));
        self.target.take(Operation::Mul(twice, half))
    }

    /// The first of all; another where the first of its pair with the best so far is less than the second.
    fn best(
        &mut self,
        all: &[T::Value],
        pair: fn(T::Value, T::Value) -> [T::Value; 2],
    ) -> T::Value {
        all[1..].iter().fold(all[0], |best, &other| {
            let [low, high] = pair(best, other);
            let better = self.target.take(Operation::Compare(Relation::Less, low, high));
            self.target.take(Operation::Select(better, other, best))
        })
    }

    /// The angle of (x, y) from the axis x: one arctangent of the smaller over the larger of the two, so that
    /// it divides by zero at the origin only.
    fn angle(&mut self, y: T::Value, x: T::Value) -> T::Value {
        use Operation::{Compare, Select};
        use Relation::{Less, LessOrEqual};
        let [zero, back, up, down, behind] = [0, -2, 1, -1, 2]
            .map(|quarters| self.target.number(&(pi() * Rational::new(quarters, 2))));
        let target = &mut *self.target;
        let [tall, wide] = [y, x].map(|side| target.take(Operation::Function(Function::Abs, side)));
        let flat = target.take(Compare(LessOrEqual, tall, wide));
        let minus = target.take(Operation::Sub(zero, x));
        let above = target.take(Select(flat, y, minus));
        let below = target.take(Select(flat, x, y));
        let ratio = target.take(Operation::Div(above, below));
        let angle = target.take(Operation::Function(Function::Atan, ratio));
        let right = target.take(Compare(Less, zero, x));
        let upper = target.take(Compare(Less, zero, y));
        let not_lower = target.take(Compare(LessOrEqual, zero, y));
        let left = target.take(Select(not_lower, behind, back));
        let beside = target.take(Select(right, zero, left));
        let over = target.take(Select(upper, up, down));
        let offset = target.take(Select(flat, beside, over));
        target.take(Operation::Add(offset, angle))
    }
}

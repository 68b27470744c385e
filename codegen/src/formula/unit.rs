//! Dimensions of terms: what has a declared unit may only be added to, and compared with, its like.
//! A number written in a formula takes whatever unit its place wants, as coefficients of a polynomial do.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::rational::Rational;
use num_traits::{One, ToPrimitive, Zero};

use super::function::Builtin;
use super::{Formula, PI, Side, Term, TermKind};
use crate::diagnostic::{Code, Diagnostics};
use crate::operation::Function;
use crate::units::{Dimension, Exponent};

/// What is known of a name: its dimension, and its value if it is a constant (for exponents).
#[derive(Debug, Clone, PartialEq)]
pub struct Meaning {
    /// What it measures.
    pub dimension: Dimension,
    /// The value of a constant.
    pub value: Option<Rational>,
}

/// The dimension of a formula; `None` if the numbers in it leave it open, or for a condition. Names that
/// are not in `names` are left open too.
///
/// # Errors
/// Every place where dimensions do not fit.
pub fn dimension(
    formula: &Formula,
    names: &BTreeMap<String, Meaning>,
) -> Result<Option<Dimension>, Diagnostics> {
    found(formula, names, false)
}

/// The dimension of a formula in which numbers have no unit.
///
/// # Errors
/// As [`dimension`].
pub(crate) fn dimension_of_pure(
    formula: &Formula,
    names: &BTreeMap<String, Meaning>,
) -> Result<Option<Dimension>, Diagnostics> {
    found(formula, names, true)
}

fn found(
    formula: &Formula,
    names: &BTreeMap<String, Meaning>,
    pure: bool,
) -> Result<Option<Dimension>, Diagnostics> {
    let (counters, errors) = (Vec::new(), Diagnostics::new());
    let mut checker = Checker { formula, names, pure, counters, errors };
    let dimension = checker.term(&formula.root);
    checker.errors.into_result(dimension)
}

/// How to fix terms that measure different things.
const ALIKE: &str = "both must be alike: look for a missing factor or a wrong name";

struct Checker<'f> {
    formula: &'f Formula,
    names: &'f BTreeMap<String, Meaning>,
    /// Whether numbers have no unit.
    pure: bool,
    /// Counters of the sums around the term.
    counters: Vec<String>,
    errors: Diagnostics,
}

impl Checker<'_> {
    fn error(&mut self, span: &Range<usize>, message: String) {
        self.errors.push(self.formula.text.error(Code::DIMENSION, span.clone(), message));
    }

    fn written(&self, term: &Term) -> &str {
        &self.formula.text.text()[term.span.clone()]
    }

    /// The dimension of a term; `None` if it is open, or if something inside it is wrong.
    fn term(&mut self, term: &Term) -> Option<Dimension> {
        match &term.kind {
            TermKind::Number(_) => self.pure.then_some(Dimension::NUMBER),
            TermKind::Name(name) if self.pure && name == PI => Some(Dimension::NUMBER),
            TermKind::Name(name) if self.counters.contains(name) => Some(Dimension::NUMBER),
            TermKind::Name(name) => self.names.get(name).map(|m| m.dimension.without_angle()),
            TermKind::Negate(inner) => self.term(inner),
            TermKind::Sum(_) => self.alike(term.parts().into_iter(), "added to"),
            TermKind::Product(parts) => {
                let dimensions: Vec<_> = parts.iter().map(|(_, part)| self.term(part)).collect();
                let mut product = Dimension::NUMBER;
                for ((side, _), dimension) in parts.iter().zip(dimensions) {
                    let next = match side {
                        Side::With => product.checked_times(&dimension?),
                        Side::Against => product.checked_over(&dimension?),
                    };
                    product = self.sane(term, next)?;
                }
                Some(product)
            }
            TermKind::Power(base, exponent) => self.power(term, base, exponent),
            TermKind::Call { function, arguments, .. } => self.call(term, function, arguments),
            TermKind::Series { counter, ends, body, .. } => {
                ends.iter().for_each(|end| self.pure(end, "a bound of a sum"));
                self.counters.push(counter.clone());
                let body = self.term(body);
                self.counters.pop();
                body
            }
            TermKind::Compare(..) => {
                self.alike(term.parts().into_iter(), "compared with");
                None
            }
            TermKind::And(_) | TermKind::Or(_) | TermKind::Not(_) => {
                term.parts().into_iter().for_each(|part| {
                    self.term(part);
                });
                None
            }
        }
    }

    fn sane(&mut self, term: &Term, dimension: Option<Dimension>) -> Option<Dimension> {
        if dimension.is_none() {
            let message = "the powers of the unit are too high, or of too many different fractions";
            let error = self.formula.text.error(Code::DIMENSION, term.span.clone(), message);
            self.errors.push(error.help("divide what is raised to a power by its unit first"));
        }
        dimension
    }

    /// The common dimension of parts that must be alike.
    fn alike<'t>(
        &mut self,
        parts: impl Iterator<Item = &'t Term>,
        verb: &str,
    ) -> Option<Dimension> {
        let mut first: Option<(&Term, Dimension)> = None;
        for part in parts {
            match (self.term(part), first) {
                (Some(found), Some((other, wanted))) if found != wanted => {
                    let (a, b) = (self.written(part), self.written(other));
                    let message =
                        format!("`{a}` is {found} and cannot be {verb} `{b}`, which is {wanted}");
                    let error =
                        self.formula.text.error(Code::DIMENSION, part.span.clone(), message);
                    self.errors.push(error.help(ALIKE));
                }
                (Some(found), None) => first = Some((part, found)),
                _ => {}
            }
        }
        first.map(|(_, dimension)| dimension)
    }

    /// A term that must be a pure number.
    fn pure(&mut self, term: &Term, place: &str) {
        if let Some(found) = self.term(term).filter(|found| *found != Dimension::NUMBER) {
            let message = format!("{place} must be a pure number, not {found}");
            let error = self.formula.text.error(Code::DIMENSION, term.span.clone(), message);
            self.errors.push(error.help(format!("divide it by {found}")));
        }
    }

    fn power(&mut self, term: &Term, base: &Term, exponent: &Term) -> Option<Dimension> {
        self.pure(exponent, "an exponent");
        let dimension = self.term(base)?;
        if dimension == Dimension::NUMBER {
            return Some(dimension);
        }
        match self.constant(exponent).as_ref().map(small) {
            Some(Some(exponent)) => self.sane(term, dimension.checked_power(exponent)),
            Some(None) => {
                let message = format!("{dimension} cannot be raised to such a power");
                self.error(&term.span, message);
                None
            }
            None => {
                let message = format!("{dimension} cannot be raised to a power that varies");
                let error = self.formula.text.error(Code::DIMENSION, term.span.clone(), message);
                self.errors.push(error.help(format!("divide it by {dimension} first")));
                None
            }
        }
    }

    /// The exact value of a term made of small numbers and constants.
    fn constant(&self, term: &Term) -> Option<Rational> {
        match &term.kind {
            TermKind::Number(value) => Some(value.clone()),
            TermKind::Name(name) => self.names.get(name)?.value.clone(),
            TermKind::Negate(inner) => Some(-self.constant(inner)?),
            TermKind::Sum(parts) => {
                let mut sum = Rational::zero();
                for (side, part) in parts {
                    match side {
                        Side::With => sum += self.constant(part)?,
                        Side::Against => sum -= self.constant(part)?,
                    }
                }
                Some(sum)
            }
            TermKind::Product(parts) => {
                let mut product = Rational::one();
                for (side, part) in parts {
                    let factor = self.constant(part)?;
                    match side {
                        Side::With => product *= factor,
                        Side::Against if factor.is_zero() => return None,
                        Side::Against => product /= factor,
                    }
                }
                Some(product)
            }
            _ => None,
        }
    }

    fn call(&mut self, term: &Term, function: &str, arguments: &[Term]) -> Option<Dimension> {
        let (builtin, [least, most]) = Builtin::named(function)?;
        if !(least..=most).contains(&arguments.len()) {
            // The check of shapes says so.
            return None;
        }
        match builtin {
            Builtin::Sqrt => {
                let dimension = self.term(&arguments[0])?;
                self.sane(term, dimension.checked_power(Exponent::new(1, 2)))
            }
            Builtin::Function(Function::Abs) | Builtin::Transpose => self.term(&arguments[0]),
            Builtin::Min | Builtin::Max => self.alike(arguments.iter(), "compared with"),
            Builtin::Atan2 => {
                self.alike(arguments.iter(), "compared with");
                Some(Dimension::NUMBER)
            }
            Builtin::Dot | Builtin::Outer => {
                let (a, b) = (self.term(&arguments[0]), self.term(&arguments[1]));
                self.sane(term, a?.checked_times(&b?))
            }
            Builtin::Function(_) | Builtin::Sinh | Builtin::Cosh => {
                self.pure(&arguments[0], &format!("the argument of `{function}`"));
                Some(Dimension::NUMBER)
            }
        }
    }
}

/// A rational as the exponent of a unit, if it is small enough.
fn small(value: &Rational) -> Option<Exponent> {
    let (n, d) = (value.numer().to_i32()?, value.denom().to_i32()?);
    (n.abs() <= 1000 && d <= 1000).then(|| Exponent::new(n, d))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Located;
    use crate::formula::parse;

    fn found(text: &str) -> Result<Option<Dimension>, Vec<String>> {
        let meaning = |dimension, value: Option<(i32, i32)>| Meaning {
            dimension,
            value: value.map(|(n, d)| Rational::new(n, d)),
        };
        let hertz = Dimension::FORCE.over(&Dimension::LENGTH.power(Exponent::new(3, 2)));
        let names = BTreeMap::from([
            ("h".to_owned(), meaning(Dimension::LENGTH, None)),
            ("c".to_owned(), meaning(Dimension::LENGTH, None)),
            ("v".to_owned(), meaning(Dimension::SPEED, None)),
            ("K".to_owned(), meaning(hertz, None)),
            ("n".to_owned(), meaning(Dimension::NUMBER, Some((3, 2)))),
            ("theta".to_owned(), meaning(Dimension::ANGLE, None)),
        ]);
        dimension(&parse(&Located::alone("f", text)).unwrap(), &names)
            .map_err(|errors| errors.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn numbers_take_the_unit_of_their_place() {
        assert_eq!(found("388 - 18632*h + 217550*h^2"), Ok(None));
        assert_eq!(found("h - 3"), Ok(Some(Dimension::LENGTH)));
        assert_eq!(found("K*(c - h)^n"), Ok(Some(Dimension::FORCE)));
        assert_eq!(found("1 - h/c"), Ok(Some(Dimension::NUMBER)));
        assert_eq!(found("sqrt(h*c)*sin(theta)"), Ok(Some(Dimension::LENGTH)));
        assert_eq!(found("sum(j, 0, 8, h*cos(theta + 2*pi*j/9))"), Ok(Some(Dimension::LENGTH)));
        assert_eq!(found("max(h, 0) < 1 and exp(h/c) > 2"), Ok(None));
    }

    #[test]
    fn unlike_quantities_are_not_added() {
        for (text, expected) in [
            (
                "h + v",
                "f:1:5: `v` is a speed and cannot be added to `h`, which is a length (both must be alike: look for a missing factor or a wrong name)",
            ),
            (
                "v < c - h",
                "f:1:5: `c - h` is a length and cannot be compared with `v`, which is a speed (both must be alike: look for a missing factor or a wrong name)",
            ),
            (
                "sum(j, 0, 8, h + j)",
                "f:1:18: `j` is a number without unit and cannot be added to `h`, which is a length (both must be alike: look for a missing factor or a wrong name)",
            ),
            (
                "sum(j, 0, h, j)",
                "f:1:11: a bound of a sum must be a pure number, not a length (divide it by a length)",
            ),
            (
                "exp(h)",
                "f:1:5: the argument of `exp` must be a pure number, not a length (divide it by a length)",
            ),
            (
                "2^h",
                "f:1:3: an exponent must be a pure number, not a length (divide it by a length)",
            ),
            (
                "h^(h/c)",
                "f:1:1: a length cannot be raised to a power that varies (divide it by a length first)",
            ),
            ("h^1001", "f:1:1: a length cannot be raised to such a power"),
            (
                "h^(1/997)*h^(1/991)*h^(1/983)*h^(1/977)",
                "f:1:1: the powers of the unit are too high, or of too many different fractions (divide what is raised to a power by its unit first)",
            ),
            (
                "(h^(1/7))^(1/991)",
                "f:1:1: the powers of the unit are too high, or of too many different fractions (divide what is raised to a power by its unit first)",
            ),
            (
                "max(h, v)",
                "f:1:8: `v` is a speed and cannot be compared with `h`, which is a length (both must be alike: look for a missing factor or a wrong name)",
            ),
        ] {
            assert_eq!(found(text), Err(vec![expected.to_owned()]), "{text}");
        }
        assert_eq!(found("(h + v)*(c + v)").unwrap_err().len(), 2);
    }
}

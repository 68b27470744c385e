//! Formulas over numbers as bytecode: what [`super::evaluate()`] computes, in the same order, with names by their
//! places, for many evaluations.

use std::ops::Range;

use super::series::whole_f64;
use super::walk::{Notes, Part, Target, walk};
use super::{Formula, Side};
use crate::diagnostic::Diagnostics;
use crate::operation::{Bytecode, Operand, Operation};
use crate::rational::{Rational, nearest};

/// The bytecode of a formula without vectors and matrices, whose only output is its value; truth is 1 and 0.
/// `known`: what names are, inputs or constants; the ends of a sum can name constants only.
///
/// # Errors
/// A name that is unknown, or something that is no number or condition.
pub(crate) fn bytecode(
    formula: &Formula,
    known: &dyn Fn(&str) -> Option<Operand>,
) -> Result<Bytecode, Diagnostics> {
    let mut writer = Writer { known, operations: Vec::new(), constants: Vec::new() };
    let (output, errors) = walk(formula, &mut writer);
    errors.into_result(Bytecode { operations: writer.operations, outputs: vec![output] })
}

struct Writer<'f> {
    known: &'f dyn Fn(&str) -> Option<Operand>,
    operations: Vec<Operation<Operand>>,
    /// The values of those that depend on no input: the ends of sums are such.
    constants: Vec<Option<f64>>,
}

impl Writer<'_> {
    /// The value of an operand that depends on no input.
    fn constant(&self, operand: Operand) -> Option<f64> {
        match operand {
            Operand::Constant(value) => Some(value),
            Operand::Input(_) => None,
            Operand::Value(place) => self.constants[place],
        }
    }

    /// Parts joined from the left; one that is first and against the others comes behind `neutral`.
    fn chain(
        &mut self,
        parts: impl Iterator<Item = (Side, Operand)>,
        neutral: f64,
        [with, against]: [fn(Operand, Operand) -> Operation<Operand>; 2],
    ) -> Operand {
        let all = parts.fold(None, |all, (side, part)| match (all, side) {
            (None, Side::With) => Some(part),
            (Some(all), Side::With) => Some(self.take(with(all, part))),
            (all, Side::Against) => {
                Some(self.take(against(all.unwrap_or(Operand::Constant(neutral)), part)))
            }
        });
        all.unwrap_or(Operand::Constant(neutral))
    }
}

impl Target for Writer<'_> {
    type Value = Operand;

    fn number(&mut self, value: &Rational) -> Operand {
        Operand::Constant(nearest(value))
    }

    fn named(&self, name: &str) -> Option<Operand> {
        (self.known)(name)
    }

    fn take(&mut self, operation: Operation<Operand>) -> Operand {
        let known = operation.map(|operand| self.constant(operand));
        let is_known = known.operands().all(|value| value.is_some());
        self.constants.push(is_known.then(|| known.map(Option::unwrap_or_default).value()));
        self.operations.push(operation);
        Operand::Value(self.operations.len() - 1)
    }

    fn sum(&mut self, parts: &[(Side, Operand)]) -> Operand {
        self.chain(parts.iter().copied(), 0.0, [Operation::Add, Operation::Sub])
    }

    fn product(
        &mut self,
        parts: &[(Side, Part<'_, Operand>)],
        _: bool,
        _: &mut Notes<'_>,
    ) -> Operand {
        let parts = parts.iter().map(|(side, part)| (*side, part.value));
        self.chain(parts, 1.0, [Operation::Mul, Operation::Div])
    }

    fn power(
        &mut self,
        [base, exponent]: [Part<'_, Operand>; 2],
        _: &Range<usize>,
        _: &mut Notes<'_>,
    ) -> Operand {
        self.take(Operation::Power(base.value, exponent.value))
    }

    fn whole(&self, value: Operand) -> Option<i64> {
        self.constant(value).and_then(whole_f64)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::diagnostic::Located;
    use crate::formula::{Value, evaluate, parse};
    use crate::operation::{Dual, Number, Rounded};

    #[test]
    fn bytecode_gives_what_the_terms_give() {
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
            let code = bytecode(&formula, &|name| match name {
                "x" => Some(Operand::Input(0)),
                "y" => Some(Operand::Input(1)),
                _ => (name == "Z").then_some(Operand::Constant(3.0)),
            });
            let code = code.expect("numbers only");
            for (x, y) in [(0.3, 2.5), (1.7, 0.1), (4.0, 3.0)] {
                fn both<N: Number>(formula: &Formula, code: &Bytecode, [x, y]: [N; 2]) -> [f64; 2] {
                    let names = BTreeMap::from(
                        [("x", &x), ("y", &y), ("Z", &N::near(3.0))]
                            .map(|(name, value)| (name.to_owned(), Value::Scalar(value.clone()))),
                    );
                    let term = match evaluate(formula, &names).expect("a value") {
                        Value::Scalar(value) => value.value(),
                        Value::Truth(truth) => f64::from(u8::from(truth)),
                        _ => f64::NAN,
                    };
                    [term, code.value(&[x, y]).value()]
                }
                let slope = [Dual::variable(x), Dual::constant(y)];
                for [term, found] in [
                    both(&formula, &code, [x, y]),
                    both(&formula, &code, slope),
                    both(&formula, &code, [x, y].map(Rounded::new)),
                ] {
                    assert_eq!(term.to_bits(), found.to_bits(), "{text} at {x}, {y}");
                }
            }
        }
    }

    #[test]
    fn only_numbers_have_bytecode() {
        for text in ["dot(v, v)", "unknown + 1", "sum(j, 0, x, j)"] {
            let formula = parse(&Located::alone("f", text)).expect("a formula");
            assert!(
                bytecode(&formula, &|name| (name != "unknown").then_some(Operand::Input(0)))
                    .is_err(),
                "{text}"
            );
        }
    }
}

//! Formulas over numbers as bytecode: what [`super::evaluate()`] computes, in the same order, with names by their
//! places, for many evaluations.

use std::f64::consts::FRAC_PI_2;

use super::built::Takes;
use super::function::Builtin;
use super::series::{Budget, whole_f64};
use super::{Formula, PI, Side, Term, TermKind};
use crate::diagnostic::{Code, Diagnostic};
use crate::operation::{Bytecode, Function, Operand, Operation};
use crate::rational::nearest;

/// The bytecode of a formula without vectors and matrices, whose only output is its value; truth is 1 and 0.
/// `known`: what names are, inputs or constants; the ends of a sum can name constants only.
///
/// # Errors
/// A name that is unknown, or something that is no number or condition.
pub(crate) fn bytecode(
    formula: &Formula,
    known: &dyn Fn(&str) -> Option<Operand>,
) -> Result<Bytecode, Diagnostic> {
    let (counters, budget) = (Vec::new(), Budget::new());
    let mut writer = Writer { formula, known, counters, budget: &budget, operations: Vec::new() };
    writer.code(&formula.root).map_err(|error| *error)
}

struct Writer<'f> {
    formula: &'f Formula,
    known: &'f dyn Fn(&str) -> Option<Operand>,
    /// Counters of the sums around the term, with their values.
    counters: Vec<(&'f str, i64)>,
    budget: &'f Budget,
    operations: Vec<Operation<Operand>>,
}

impl Takes for Writer<'_> {
    type Value = Operand;

    fn take(&mut self, operation: Operation<Operand>) -> Operand {
        self.operations.push(operation);
        Operand::Value(self.operations.len() - 1)
    }

    fn turn(&mut self, quarters: i64) -> Operand {
        Operand::Constant(quarters as f64 * FRAC_PI_2)
    }
}

type Written = Result<Operand, Box<Diagnostic>>;

impl<'f> Writer<'f> {
    fn code(&mut self, term: &'f Term) -> Result<Bytecode, Box<Diagnostic>> {
        let output = self.term(term)?;
        Ok(Bytecode { operations: std::mem::take(&mut self.operations), outputs: vec![output] })
    }

    fn error(&self, term: &Term, code: Code, message: &str) -> Box<Diagnostic> {
        Box::new(self.formula.text.error(code, term.span.clone(), message))
    }

    fn term(&mut self, term: &'f Term) -> Written {
        let operation = match &term.kind {
            TermKind::Number(value) => return Ok(Operand::Constant(nearest(value))),
            TermKind::Name(name) => return self.name(term, name),
            TermKind::Negate(inner) => Operation::Sub(Operand::Constant(0.0), self.term(inner)?),
            TermKind::Sum(parts) => {
                let mut sum = self.term(&parts[0].1)?;
                for (side, part) in &parts[1..] {
                    let part = self.term(part)?;
                    sum = self.take(match side {
                        Side::With => Operation::Add(sum, part),
                        Side::Against => Operation::Sub(sum, part),
                    });
                }
                return Ok(sum);
            }
            TermKind::Product(parts) => return self.product(term, parts),
            TermKind::Power(base, exponent) => {
                Operation::Power(self.term(base)?, self.term(exponent)?)
            }
            TermKind::Call { function, arguments, .. } => {
                return self.call(term, function, arguments);
            }
            TermKind::Series { counter, ends, body, .. } => {
                return self.series(term, counter, ends, body);
            }
            TermKind::Compare(first, rest) => {
                let mut left = self.term(first)?;
                let mut all = None;
                for (comparison, part) in rest {
                    let right = self.term(part)?;
                    let (relation, low, high) = comparison.of(left, right);
                    let holds = self.take(Operation::Compare(relation, low, high));
                    all = Some(match all {
                        Some(all) => self.take(Operation::And(all, holds)),
                        None => holds,
                    });
                    left = right;
                }
                return Ok(all.unwrap_or(left));
            }
            TermKind::And(parts) => return self.chain(parts, Operation::And),
            TermKind::Or(parts) => return self.chain(parts, Operation::Or),
            TermKind::Not(inner) => Operation::Not(self.term(inner)?),
        };
        Ok(self.take(operation))
    }

    fn name(&self, term: &Term, name: &str) -> Written {
        let counter = self.counters.iter().find(|(counter, _)| *counter == name);
        match ((self.known)(name), counter) {
            (Some(known), _) => Ok(known),
            (None, Some((_, count))) => Ok(Operand::Constant(*count as f64)),
            (None, None) if name == PI => Ok(Operand::Constant(std::f64::consts::PI)),
            _ => Err(self.error(term, Code::UNKNOWN_NAME, &format!("`{name}` has no value"))),
        }
    }

    fn chain(
        &mut self,
        parts: &'f [Term],
        join: fn(Operand, Operand) -> Operation<Operand>,
    ) -> Written {
        let mut all = self.term(&parts[0])?;
        for part in &parts[1..] {
            let part = self.term(part)?;
            all = self.take(join(all, part));
        }
        Ok(all)
    }

    fn product(&mut self, term: &Term, parts: &'f [(Side, Term)]) -> Written {
        let mut product = None;
        for (side, part) in parts {
            let factor = self.term(part)?;
            product = Some(match (product, side) {
                (None, Side::With) => factor,
                (Some(product), Side::With) => self.take(Operation::Mul(product, factor)),
                (product, Side::Against) => {
                    let above = product.unwrap_or(Operand::Constant(1.0));
                    self.take(Operation::Div(above, factor))
                }
            });
        }
        product.ok_or_else(|| self.error(term, Code::SHAPE, "this product has no factors"))
    }

    fn call(&mut self, term: &'f Term, name: &str, arguments: &'f [Term]) -> Written {
        let operands: Result<Vec<Operand>, _> = arguments.iter().map(|a| self.term(a)).collect();
        let Some((builtin, _)) = Builtin::named(name) else {
            return Err(self.error(term, Code::SHAPE, "this is no function of numbers"));
        };
        Ok(match (builtin, operands?.as_slice()) {
            (Builtin::Function(function), [x]) => self.take(Operation::Function(function, *x)),
            (Builtin::Sqrt, [x]) => self.take(Operation::Sqrt(*x)),
            (Builtin::Sinh, [x]) => self.hyperbolic(*x, Operation::Sub),
            (Builtin::Cosh, [x]) => self.hyperbolic(*x, Operation::Add),
            (Builtin::Min, all @ [_, ..]) => self.best(all, |best, other| [other, best]),
            (Builtin::Max, all @ [_, ..]) => self.best(all, |best, other| [best, other]),
            (Builtin::Atan2, [y, x]) => self.angle(*y, *x),
            (Builtin::Dot | Builtin::Outer | Builtin::Transpose, _) => {
                return Err(self.error(term, Code::SHAPE, "this is no function of numbers"));
            }
            _ => {
                let message = "this function has another number of arguments";
                return Err(self.error(term, Code::SHAPE, message));
            }
        })
    }

    /// ½(eˣ ∓ e⁻ˣ)
    fn hyperbolic(
        &mut self,
        x: Operand,
        join: fn(Operand, Operand) -> Operation<Operand>,
    ) -> Operand {
        let grows = self.take(Operation::Function(Function::Exp, x));
        let falls = self.take(Operation::Div(Operand::Constant(1.0), grows));
        let twice = self.take(join(grows, falls));
        self.take(Operation::Mul(twice, Operand::Constant(0.5)))
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
                Some(sum) => self.take(Operation::Add(sum, part)),
                None => part,
            });
        }
        sum.ok_or_else(|| self.error(term, Code::SHAPE, "this sum has no terms"))
    }

    /// The whole number that an end of a sum is; it names only constants and counters.
    fn whole(&self, end: &'f Term) -> Result<Option<i64>, Box<Diagnostic>> {
        let constant =
            |name: &str| (self.known)(name).filter(|known| matches!(known, Operand::Constant(_)));
        let mut writer = Writer {
            formula: self.formula,
            known: &constant,
            counters: self.counters.clone(),
            budget: self.budget,
            operations: Vec::new(),
        };
        Ok(whole_f64(writer.code(end)?.value::<f64>(&[])))
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

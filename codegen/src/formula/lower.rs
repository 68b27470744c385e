//! Terms → expression graph.

use std::collections::BTreeMap;
use std::ops::Range;

use num_traits::{One, Signed};

use super::function::Builtin;
use super::walk::{Notes, Part, Target, walk};
use super::{Formula, LIMITS, Scope, Side, check, series, undefined};
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Function, Graph, Id, Node, Shape};
use crate::operation::Operation;
use crate::rational::Rational;

/// Adds a formula to the graph, where names stand for the given nodes. A name may stand for a number, as
/// a parameter with a value does.
///
/// # Errors
/// Those of [`check`]; division by zero, roots and logarithms of negative constants; constant exponents
/// and exact numbers beyond the limits.
pub fn lower(
    formula: &Formula,
    graph: &mut Graph,
    names: &BTreeMap<String, Id>,
) -> Result<Id, Diagnostics> {
    let scope: Scope = names.iter().map(|(name, id)| (name.clone(), graph.shape(*id))).collect();
    check(formula, &scope)?;
    let before = graph.exceeded();
    let (root, mut errors) = walk(formula, &mut Lowering { graph, names });
    if graph.exceeded() && !before && errors.is_empty() {
        let message = "multiplied out, this formula has too many terms or digits to be worked with";
        let error = formula.text.error_here(Code::LIMIT, message);
        errors.push(
            error.help("use lower powers, fewer products of sums, or numbers of fewer digits"),
        );
    }
    errors.into_result(root)
}

struct Lowering<'f> {
    graph: &'f mut Graph,
    names: &'f BTreeMap<String, Id>,
}

impl Lowering<'_> {
    /// Reports exponents that grew by merging, as those of powers of powers do.
    fn bound_exponents(&self, id: Id, span: &Range<usize>, notes: &mut Notes<'_>) {
        let limit = Rational::from(LIMITS.exponent);
        let terms = self.graph.terms(id);
        let [(only, _)] = terms.as_slice() else { return };
        if let Node::Product(factors) = self.graph.node(*only) {
            let fine = |e: &Rational| e.abs() <= limit && e.denom().bits() <= 64;
            if !factors.iter().all(|(_, exponent)| fine(exponent)) {
                let message = format!("the exponents grow beyond {} here", LIMITS.exponent);
                notes.error(Code::LIMIT, span, message);
            }
        }
    }
}

impl Target for Lowering<'_> {
    type Value = Id;

    fn number(&mut self, value: &Rational) -> Id {
        self.graph.number(value.clone())
    }

    fn named(&self, name: &str) -> Option<Id> {
        self.names.get(name).copied()
    }

    fn take(&mut self, operation: Operation<Id>) -> Id {
        let graph = &mut *self.graph;
        match operation {
            Operation::Add(a, b) => graph.add(a, b),
            Operation::Sub(a, b) => graph.sub(a, b),
            Operation::Mul(a, b) => graph.mul(a, b),
            Operation::Div(a, b) => graph.div(a, b),
            Operation::Neg(a) => graph.neg(a),
            Operation::Sqrt(a) => graph.sqrt(a),
            Operation::Function(function, a) => graph.function(function, a),
            Operation::Power(a, b) => {
                let logarithm = graph.function(Function::Ln, a);
                let product = graph.mul(b, logarithm);
                graph.function(Function::Exp, product)
            }
            Operation::Compare(relation, a, b) => graph.compare(relation, a, b),
            Operation::And(a, b) => graph.and(a, b),
            Operation::Or(a, b) => graph.or(a, b),
            Operation::Not(a) => graph.not(a),
            Operation::Select(mask, a, b) => graph.select(mask, a, b),
        }
    }

    fn sum(&mut self, parts: &[(Side, Id)]) -> Id {
        let parts: Vec<_> = parts.iter().map(|(side, part)| (*part, sign(*side))).collect();
        self.graph.sum(&parts)
    }

    fn product(&mut self, parts: &[(Side, Part<'_, Id>)], fine: bool, notes: &mut Notes<'_>) -> Id {
        let (mut factors, mut tensors) = (Vec::new(), Vec::new());
        let before = notes.count();
        for (side, Part { value, span }) in parts {
            match side {
                Side::Against => match undefined::division(self.graph, *value) {
                    Some(why) => notes.error(Code::UNDEFINED, span, why),
                    None => factors.push((*value, sign(*side))),
                },
                Side::With if self.graph.shape(*value) == Shape::Scalar => {
                    factors.push((*value, sign(*side)));
                }
                Side::With => tensors.push(*value),
            }
        }
        let scalar = self.graph.product(&factors);
        if let ([(_, first), .., (_, last)], true) = (parts, fine && notes.count() == before) {
            self.bound_exponents(scalar, &(first.span.start..last.span.end), notes);
        }
        let Some(mut tensor) = tensors.pop() else {
            return scalar;
        };
        while let Some(matrix) = tensors.pop() {
            tensor = self.graph.apply(matrix, tensor);
        }
        self.graph.scale(scalar, tensor)
    }

    fn power(
        &mut self,
        [base, exponent]: [Part<'_, Id>; 2],
        span: &Range<usize>,
        notes: &mut Notes<'_>,
    ) -> Id {
        let (a, b) = (base.value, exponent.value);
        let Some(constant) = self.graph.as_number(b).cloned() else {
            if self.graph.as_number(a).is_some_and(|base| !base.is_positive()) {
                let message = "a power that varies needs a base above zero";
                notes.error(Code::UNDEFINED, base.span, message);
            }
            return self.take(Operation::Power(a, b));
        };
        if constant.abs() > Rational::from(LIMITS.exponent) {
            let message = format!("an exponent is at most {}", LIMITS.exponent);
            notes.error(Code::LIMIT, exponent.span, message);
            return a;
        }
        if let Some(why) = undefined::power(self.graph, a, &constant) {
            notes.error(Code::UNDEFINED, span, why);
            return a;
        }
        let power = self.graph.power(a, constant);
        self.bound_exponents(power, span, notes);
        power
    }

    fn tensor(&mut self, builtin: Builtin, arguments: &[Id]) -> Option<Id> {
        match (builtin, arguments) {
            (Builtin::Dot, [a, b]) => Some(self.graph.dot(*a, *b)),
            (Builtin::Outer, [a, b]) => Some(self.graph.outer(*a, *b)),
            (Builtin::Transpose, [a]) => Some(self.graph.transpose(*a)),
            _ => None,
        }
    }

    fn undefined(&self, builtin: Builtin, argument: Id) -> Option<&'static str> {
        match builtin {
            Builtin::Sqrt => undefined::power(self.graph, argument, &Rational::half())
                .map(|_| "the root of a negative number"),
            Builtin::Function(Function::Ln) => {
                let value = self.graph.as_number(argument)?;
                (!value.is_positive()).then_some("the logarithm of a number that is not positive")
            }
            _ => None,
        }
    }

    fn whole(&self, value: Id) -> Option<i64> {
        self.graph.as_number(value).and_then(series::whole)
    }

    fn is_full(&self) -> bool {
        self.graph.exceeded()
    }
}

/// The factor of a part of a sum, and the exponent of one of a product.
fn sign(side: Side) -> Rational {
    match side {
        Side::With => Rational::one(),
        Side::Against => -Rational::one(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Located;
    use crate::expression::Symmetry;
    use crate::formula::parse;

    fn lowered(graph: &mut Graph, text: &str) -> Result<Id, Vec<String>> {
        let names = BTreeMap::from([
            ("x".to_owned(), graph.scalar("x")),
            ("n".to_owned(), graph.number(Rational::new(3, 2))),
            ("v".to_owned(), graph.vector("v")),
            ("A".to_owned(), graph.matrix("A", Symmetry::None)),
        ]);
        let formula = parse(&Located::alone("f", text)).unwrap();
        lower(&formula, graph, &names)
            .map_err(|errors| errors.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn equal_formulas_are_one_node() {
        let mut graph = Graph::new();
        for (a, b) in [
            ("x + x", "2*x"),
            ("1/2*x^2 - 0.5*x*x", "0"),
            ("-2^2", "-4"),
            ("2^3^2", "512"),
            ("x^n", "x^1.5"),
            ("sqrt(x)", "x^(1/2)"),
            ("min(x, 1) - min(x, 1)", "0"),
            ("2*A*x*v", "x*(A*(2*v))"),
            ("x > 1", "1 < x"),
            ("not not x < 1", "x < 1"),
            ("sinh(x) + cosh(x)", "exp(x)"),
            ("sinh(x)", "exp(x)/2 - exp(x)^-1/2"),
            ("sum(j, 0, 3, x^j/(1 + j))", "1 + x/2 + x^2/3 + x^3/4"),
            ("sum(j, 1, 2*n, j)", "6"),
            ("atan2(0, -1)", "pi"),
            ("atan2(-2, 0)", "-pi/2"),
        ] {
            assert_eq!(lowered(&mut graph, a), lowered(&mut graph, b), "{a} = {b}");
        }
    }

    #[test]
    fn operations_without_a_value_are_errors() {
        let mut graph = Graph::new();
        for (text, expected) in [
            ("x/(2 - 2)", "f:1:4: division by zero"),
            ("0^-1", "f:1:1: division by zero"),
            ("1/((1 + x)^2 - 1 - 2*x - x^2)", "f:1:4: division by zero"),
            ("(x*(x + 1) - x^2 - x)^(-1/2)", "f:1:1: division by zero"),
            ("(x*(x + 1) - x^2 - x - n)^n", "f:1:1: a fractional power of a negative number"),
            ("sqrt((x + 1)^2 - x^2 - 2*x - 2)", "f:1:1: the root of a negative number"),
            ("sqrt(-2)*x", "f:1:1: the root of a negative number"),
            ("log(0)", "f:1:1: the logarithm of a number that is not positive"),
            ("(-2)^n", "f:1:1: a fractional power of a negative number"),
            ("(-2)^x", "f:1:2: a power that varies needs a base above zero"),
            ("x^101", "f:1:3: an exponent is at most 100"),
            ("(x^50)^3", "f:1:1: the exponents grow beyond 100 here"),
            ("2*x^60/x^-60", "f:1:1: the exponents grow beyond 100 here"),
            ("sum(j, 0, 64, x)", "f:1:1: this sum has 65 terms; 64 are allowed"),
            ("sum(j, 0, x, x)", "f:1:1: the bounds of a sum must be whole constants"),
            ("sum(j, 0, n, x)", "f:1:1: the bounds of a sum must be whole constants"),
            ("sum(j, 2, 1, x)", "f:1:1: this sum ends at 1, before it starts at 2"),
            ("sum(j, 0, 3, 1/j + 1/(j - 1))", "f:1:16: division by zero"),
            (
                "sum(i, 1, 60, sum(j, 1, 60, x))",
                "f:1:15: the sums of this formula have more than 512 terms when written out",
            ),
            (
                "x*1e300^20",
                "f:1:1: multiplied out, this formula has too many terms or digits to be worked with \
                 (use lower powers, fewer products of sums, or numbers of fewer digits)",
            ),
        ] {
            assert_eq!(lowered(&mut graph.clone(), text), Err(vec![expected.to_owned()]), "{text}");
        }
        assert!(lowered(&mut graph, "1/x").is_ok());
    }
}

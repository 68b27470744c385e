//! Terms → expression graph.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::rational::Rational;
use num_traits::{One, Signed};

use super::built::Takes;
use super::function::Builtin;
use super::series::{self, Budget};
use super::{Formula, LIMITS, PI, Scope, Side, Term, TermKind, check, undefined};
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Function, Graph, Id, Node, Shape};
use crate::operation::Operation;

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
    let mut lowering = Lowering {
        formula,
        graph,
        names,
        counters: Vec::new(),
        budget: Budget::new(),
        errors: Diagnostics::new(),
    };
    let root = lowering.term(&formula.root);
    let mut errors = lowering.errors;
    if graph.exceeded() && !before && errors.is_empty() {
        let message = "multiplied out, this formula has too many terms or digits to be worked with";
        let error = formula.text.error_here(Code::LIMIT, message);
        errors.push(
            error.help("use lower powers, fewer products of sums, or numbers of fewer digits"),
        );
    }
    errors.into_result(root)
}

/// The f64 nearest to π, as an exact number.
pub(crate) fn pi() -> Rational {
    Rational::from_float(std::f64::consts::PI).expect("a finite number")
}

struct Lowering<'f> {
    formula: &'f Formula,
    graph: &'f mut Graph,
    names: &'f BTreeMap<String, Id>,
    /// Counters of the sums around the term, with their values.
    counters: Vec<(&'f str, i64)>,
    budget: Budget,
    errors: Diagnostics,
}

impl<'f> Lowering<'f> {
    fn error(&mut self, code: Code, span: &Range<usize>, message: impl Into<String>) {
        self.errors.push(self.formula.text.error(code, span.clone(), message));
    }

    fn terms(&mut self, parts: &'f [Term]) -> Vec<Id> {
        parts.iter().map(|part| self.term(part)).collect()
    }

    fn term(&mut self, term: &'f Term) -> Id {
        match &term.kind {
            TermKind::Number(value) => self.graph.number(value.clone()),
            TermKind::Name(name) => match self.names.get(name) {
                Some(id) => *id,
                None => {
                    let counter = self.counters.iter().find(|(counter, _)| counter == name);
                    if let Some((_, count)) = counter {
                        return self.graph.integer(*count);
                    }
                    debug_assert_eq!(name, PI, "names are checked before");
                    self.graph.number(pi())
                }
            },
            TermKind::Negate(inner) => {
                let inner = self.term(inner);
                self.graph.neg(inner)
            }
            TermKind::Sum(parts) => {
                let parts: Vec<_> = (parts.iter())
                    .map(|(side, part)| {
                        let sign = match side {
                            Side::With => Rational::one(),
                            Side::Against => -Rational::one(),
                        };
                        (self.term(part), sign)
                    })
                    .collect();
                self.graph.sum(&parts)
            }
            TermKind::Product(parts) => self.product(parts),
            TermKind::Power(base, exponent) => self.power(term, base, exponent),
            TermKind::Call { function, arguments, .. } => self.call(term, function, arguments),
            TermKind::Series { counter, ends, body, .. } => self.series(term, counter, ends, body),
            TermKind::Compare(first, rest) => {
                let mut left = self.term(first);
                let mut all = None;
                for (comparison, part) in rest {
                    let right = self.term(part);
                    let (relation, low, high) = comparison.of(left, right);
                    let holds = self.graph.compare(relation, low, high);
                    all = Some(match all {
                        Some(before) => self.graph.and(before, holds),
                        None => holds,
                    });
                    left = right;
                }
                all.unwrap_or(left)
            }
            TermKind::And(parts) => self.fold(parts, Graph::and),
            TermKind::Or(parts) => self.fold(parts, Graph::or),
            TermKind::Not(inner) => {
                let inner = self.term(inner);
                self.graph.not(inner)
            }
        }
    }

    fn series(&mut self, term: &Term, counter: &'f str, ends: &'f [Term; 2], body: &'f Term) -> Id {
        let values = [self.term(&ends[0]), self.term(&ends[1])];
        let values = values.map(|end| self.graph.as_number(end).and_then(series::whole));
        let counts = match self.budget.counter(values) {
            Ok(counts) => counts,
            Err(message) => {
                self.error(Code::LIMIT, &term.span, message);
                return self.graph.integer(0);
            }
        };
        let mut parts = Vec::new();
        for count in counts {
            self.counters.push((counter, count));
            let errors = self.errors.len();
            parts.push((self.term(body), Rational::one()));
            self.counters.pop();
            // What is wrong for one value of the counter mostly is for the next.
            if self.errors.len() > errors || self.graph.exceeded() {
                break;
            }
        }
        self.graph.sum(&parts)
    }

    fn fold(&mut self, parts: &'f [Term], combine: fn(&mut Graph, Id, Id) -> Id) -> Id {
        let parts = self.terms(parts);
        parts[1..].iter().fold(parts[0], |all, part| combine(self.graph, all, *part))
    }

    fn product(&mut self, parts: &'f [(Side, Term)]) -> Id {
        let mut factors = Vec::new();
        let mut tensors = Vec::new();
        let before = self.errors.len();
        for (side, part) in parts {
            let id = self.term(part);
            match side {
                Side::Against => match undefined::division(self.graph, id) {
                    Some(why) => self.error(Code::UNDEFINED, &part.span, why),
                    None => factors.push((id, -Rational::one())),
                },
                Side::With if self.graph.shape(id) == Shape::Scalar => {
                    factors.push((id, Rational::one()));
                }
                Side::With => tensors.push(id),
            }
        }
        let scalar = self.graph.product(&factors);
        let fine = self.errors.len() == before;
        if let ([(_, first), .., (_, last)], true) = (parts, fine) {
            self.bound_exponents(scalar, &(first.span.start..last.span.end));
        }
        let Some(mut tensor) = tensors.pop() else {
            return scalar;
        };
        while let Some(matrix) = tensors.pop() {
            tensor = self.graph.apply(matrix, tensor);
        }
        self.graph.scale(scalar, tensor)
    }

    fn power(&mut self, term: &'f Term, base: &'f Term, exponent: &'f Term) -> Id {
        let (a, b) = (self.term(base), self.term(exponent));
        let Some(constant) = self.graph.as_number(b).cloned() else {
            if self.graph.as_number(a).is_some_and(|base| !base.is_positive()) {
                let message = "a power that varies needs a base above zero";
                self.error(Code::UNDEFINED, &base.span, message);
            }
            return self.graph.take(Operation::Power(a, b));
        };
        if constant.abs() > Rational::from(LIMITS.exponent) {
            let message = format!("an exponent is at most {}", LIMITS.exponent);
            self.error(Code::LIMIT, &exponent.span, message);
            return a;
        }
        if let Some(why) = undefined::power(self.graph, a, &constant) {
            self.error(Code::UNDEFINED, &term.span, why);
            return a;
        }
        let power = self.graph.power(a, constant);
        self.bound_exponents(power, &term.span);
        power
    }

    /// Reports exponents that grew by merging, as those of powers of powers do.
    fn bound_exponents(&mut self, id: Id, span: &Range<usize>) {
        let limit = Rational::from(LIMITS.exponent);
        let terms = self.graph.terms(id);
        let [(only, _)] = terms.as_slice() else { return };
        if let Node::Product(factors) = self.graph.node(*only) {
            let fine = |e: &Rational| e.abs() <= limit && e.denom().bits() <= 64;
            if !factors.iter().all(|(_, exponent)| fine(exponent)) {
                let message = format!("the exponents grow beyond {} here", LIMITS.exponent);
                self.error(Code::LIMIT, span, message);
            }
        }
    }

    fn call(&mut self, term: &'f Term, function: &str, arguments: &'f [Term]) -> Id {
        let Some((builtin, _)) = Builtin::named(function) else {
            // Only what passed the check comes here.
            self.error(Code::BAD_CALL, &term.span, format!("unknown function `{function}`"));
            return self.graph.integer(0);
        };
        let ids = self.terms(arguments);
        let a = ids[0];
        let constant = self.graph.as_number(a).cloned();
        match builtin {
            Builtin::Sqrt => {
                if undefined::power(self.graph, a, &Rational::half()).is_some() {
                    self.error(Code::UNDEFINED, &term.span, "the root of a negative number");
                }
                self.graph.sqrt(a)
            }
            Builtin::Function(function) => {
                let positive = constant.is_none_or(|value| value.is_positive());
                if function == Function::Ln && !positive {
                    let message = "the logarithm of a number that is not positive";
                    self.error(Code::UNDEFINED, &term.span, message);
                }
                self.graph.function(function, a)
            }
            Builtin::Sinh => self.hyperbolic(a, -Rational::one()),
            Builtin::Cosh => self.hyperbolic(a, Rational::one()),
            Builtin::Min => self.graph.best(&ids, |best, other| [other, best]),
            Builtin::Max => self.graph.best(&ids, |best, other| [best, other]),
            Builtin::Atan2 => self.graph.angle(a, ids[1]),
            Builtin::Dot => self.graph.dot(a, ids[1]),
            Builtin::Outer => self.graph.outer(a, ids[1]),
            Builtin::Transpose => self.graph.transpose(a),
        }
    }

    /// ½eᵃ + sign·½e⁻ᵃ
    fn hyperbolic(&mut self, a: Id, sign: Rational) -> Id {
        let half = Rational::new(1, 2);
        let grows = self.graph.function(Function::Exp, a);
        let falls = self.graph.power(grows, -Rational::one());
        self.graph.sum(&[(grows, half.clone()), (falls, sign * half)])
    }
}

impl Takes for Graph {
    type Value = Id;

    fn take(&mut self, operation: Operation<Id>) -> Id {
        match operation {
            Operation::Add(a, b) => self.add(a, b),
            Operation::Sub(a, b) => self.sub(a, b),
            Operation::Mul(a, b) => self.mul(a, b),
            Operation::Div(a, b) => self.div(a, b),
            Operation::Neg(a) => self.neg(a),
            Operation::Sqrt(a) => self.sqrt(a),
            Operation::Function(function, a) => self.function(function, a),
            Operation::Power(a, b) => {
                let logarithm = self.function(Function::Ln, a);
                let product = self.mul(b, logarithm);
                self.function(Function::Exp, product)
            }
            Operation::Compare(relation, a, b) => self.compare(relation, a, b),
            Operation::And(a, b) => self.and(a, b),
            Operation::Or(a, b) => self.or(a, b),
            Operation::Not(a) => self.not(a),
            Operation::Select(mask, a, b) => self.select(mask, a, b),
        }
    }

    fn turn(&mut self, quarters: i64) -> Id {
        self.number(pi() * Rational::new(quarters, 2))
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

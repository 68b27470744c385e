//! Terms → expression graph.

use std::collections::BTreeMap;
use std::ops::Range;

use num_rational::BigRational;
use num_traits::{One, Signed};

use super::evaluate::pi;
use super::{Builtin, Comparison, Formula, Kind, LIMITS, PI, Scope, Side, Term, check};
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Function, Graph, Id, Node, Relation, Shape};

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
    let mut lowering = Lowering { formula, graph, names, errors: Diagnostics::new() };
    let root = lowering.term(&formula.root);
    let mut errors = lowering.errors;
    if graph.exceeded() && !before && errors.is_empty() {
        let message = "the exact numbers in this formula grow beyond all use";
        errors.push(formula.text.error_here(Code::LIMIT, message));
    }
    errors.into_result(root)
}

struct Lowering<'f> {
    formula: &'f Formula,
    graph: &'f mut Graph,
    names: &'f BTreeMap<String, Id>,
    errors: Diagnostics,
}

impl Lowering<'_> {
    fn error(&mut self, code: Code, span: &Range<usize>, message: impl Into<String>) {
        self.errors.push(self.formula.text.error(code, span.clone(), message));
    }

    fn terms(&mut self, parts: &[Term]) -> Vec<Id> {
        parts.iter().map(|part| self.term(part)).collect()
    }

    fn term(&mut self, term: &Term) -> Id {
        match &term.kind {
            Kind::Number(value) => self.graph.number(value.clone()),
            Kind::Name(name) => match self.names.get(name) {
                Some(id) => *id,
                None => {
                    debug_assert_eq!(name, PI, "names are checked before");
                    self.graph.number(pi())
                }
            },
            Kind::Negate(inner) => {
                let inner = self.term(inner);
                self.graph.neg(inner)
            }
            Kind::Sum(parts) => {
                let parts: Vec<_> = (parts.iter())
                    .map(|(side, part)| {
                        let sign = match side {
                            Side::With => BigRational::one(),
                            Side::Against => -BigRational::one(),
                        };
                        (self.term(part), sign)
                    })
                    .collect();
                self.graph.sum(&parts)
            }
            Kind::Product(parts) => self.product(parts),
            Kind::Power(base, exponent) => self.power(term, base, exponent),
            Kind::Call { function, arguments, .. } => self.call(term, function, arguments),
            Kind::Compare(first, rest) => {
                let mut left = self.term(first);
                let mut all = None;
                for (comparison, part) in rest {
                    let right = self.term(part);
                    let holds = match comparison {
                        Comparison::Less => self.graph.compare(Relation::Less, left, right),
                        Comparison::LessOrEqual => {
                            self.graph.compare(Relation::LessOrEqual, left, right)
                        }
                        Comparison::Greater => self.graph.compare(Relation::Less, right, left),
                        Comparison::GreaterOrEqual => {
                            self.graph.compare(Relation::LessOrEqual, right, left)
                        }
                    };
                    all = Some(match all {
                        Some(before) => self.graph.and(before, holds),
                        None => holds,
                    });
                    left = right;
                }
                all.unwrap_or(left)
            }
            Kind::And(parts) => self.fold(parts, Graph::and),
            Kind::Or(parts) => self.fold(parts, Graph::or),
            Kind::Not(inner) => {
                let inner = self.term(inner);
                self.graph.not(inner)
            }
        }
    }

    fn fold(&mut self, parts: &[Term], combine: fn(&mut Graph, Id, Id) -> Id) -> Id {
        let parts = self.terms(parts);
        parts[1..].iter().fold(parts[0], |all, part| combine(self.graph, all, *part))
    }

    fn product(&mut self, parts: &[(Side, Term)]) -> Id {
        let mut factors = Vec::new();
        let mut tensors = Vec::new();
        for (side, part) in parts {
            let id = self.term(part);
            match side {
                Side::Against if self.graph.is_zero(id) => {
                    self.error(Code::UNDEFINED, &part.span, "division by zero");
                }
                Side::Against => factors.push((id, -BigRational::one())),
                Side::With if self.graph.shape(id) == Shape::Scalar => {
                    factors.push((id, BigRational::one()));
                }
                Side::With => tensors.push(id),
            }
        }
        let scalar = self.graph.product(&factors);
        if let [(_, first), .., (_, last)] = parts {
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

    fn power(&mut self, term: &Term, base: &Term, exponent: &Term) -> Id {
        let (a, b) = (self.term(base), self.term(exponent));
        let negative_base = self.graph.as_number(a).is_some_and(Signed::is_negative);
        let Some(constant) = self.graph.as_number(b).cloned() else {
            if negative_base || self.graph.is_zero(a) {
                let message = "a power that varies needs a base above zero";
                self.error(Code::UNDEFINED, &base.span, message);
            }
            let logarithm = self.graph.function(Function::Ln, a);
            let product = self.graph.mul(b, logarithm);
            return self.graph.function(Function::Exp, product);
        };
        if constant.abs() > BigRational::from_integer(LIMITS.exponent.into()) {
            let message = format!("an exponent is at most {}", LIMITS.exponent);
            self.error(Code::LIMIT, &exponent.span, message);
            return a;
        }
        if negative_base && !constant.is_integer() {
            self.error(Code::UNDEFINED, &term.span, "a broken power of a negative number");
        }
        if self.graph.is_zero(a) && constant.is_negative() {
            self.error(Code::UNDEFINED, &term.span, "division by zero");
        }
        let power = self.graph.power(a, constant);
        self.bound_exponents(power, &term.span);
        power
    }

    /// Reports exponents that grew by merging, as those of powers of powers do.
    fn bound_exponents(&mut self, id: Id, span: &Range<usize>) {
        let limit = BigRational::from_integer(LIMITS.exponent.into());
        let terms = self.graph.terms(id);
        let [(only, _)] = terms.as_slice() else { return };
        if let Node::Product(factors) = self.graph.node(*only) {
            let fine = |e: &BigRational| e.abs() <= limit && e.denom().bits() <= 64;
            if !factors.iter().all(|(_, exponent)| fine(exponent)) {
                let message = format!("the exponents grow beyond {} here", LIMITS.exponent);
                self.error(Code::LIMIT, span, message);
            }
        }
    }

    fn call(&mut self, term: &Term, function: &str, arguments: &[Term]) -> Id {
        let Some(builtin) = Builtin::named(function) else {
            // Only what passed the check comes here.
            self.error(Code::BAD_CALL, &term.span, format!("unknown function `{function}`"));
            return self.graph.integer(0);
        };
        let ids = self.terms(arguments);
        let a = ids[0];
        let constant = self.graph.as_number(a).cloned();
        let simple = match builtin {
            Builtin::Sqrt => {
                if constant.is_some_and(|value| value.is_negative()) {
                    self.error(Code::UNDEFINED, &term.span, "the root of a negative number");
                }
                return self.graph.sqrt(a);
            }
            Builtin::Log => {
                if constant.is_some_and(|value| !value.is_positive()) {
                    let message = "the logarithm of a number that is not positive";
                    self.error(Code::UNDEFINED, &term.span, message);
                }
                Function::Ln
            }
            Builtin::Exp => Function::Exp,
            Builtin::Sin => Function::Sin,
            Builtin::Cos => Function::Cos,
            Builtin::Tan => Function::Tan,
            Builtin::Atan => Function::Atan,
            Builtin::Tanh => Function::Tanh,
            Builtin::Abs => Function::Abs,
            Builtin::Sinh => return self.hyperbolic(a, -BigRational::one()),
            Builtin::Cosh => return self.hyperbolic(a, BigRational::one()),
            Builtin::Min | Builtin::Max => {
                return ids[1..].iter().fold(a, |best, &other| {
                    let (low, high) = match builtin {
                        Builtin::Min => (other, best),
                        _ => (best, other),
                    };
                    let better = self.graph.compare(Relation::Less, low, high);
                    self.graph.select(better, other, best)
                });
            }
            Builtin::Dot => return self.graph.dot(a, ids[1]),
            Builtin::Outer => return self.graph.outer(a, ids[1]),
            Builtin::Transpose => return self.graph.transpose(a),
        };
        self.graph.function(simple, a)
    }

    /// ½eᵃ + sign·½e⁻ᵃ
    fn hyperbolic(&mut self, a: Id, sign: BigRational) -> Id {
        let half = BigRational::new(1.into(), 2.into());
        let grows = self.graph.function(Function::Exp, a);
        let falls = self.graph.power(grows, -BigRational::one());
        self.graph.sum(&[(grows, half.clone()), (falls, sign * half)])
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
            ("n".to_owned(), graph.number(BigRational::new(3.into(), 2.into()))),
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
            ("sqrt(-2)*x", "f:1:1: the root of a negative number"),
            ("log(0)", "f:1:1: the logarithm of a number that is not positive"),
            ("(-2)^n", "f:1:2: a broken power of a negative number"),
            ("(-2)^x", "f:1:2: a power that varies needs a base above zero"),
            ("x^101", "f:1:3: an exponent is at most 100"),
            ("(x^50)^3", "f:1:2: the exponents grow beyond 100 here"),
            ("2*x^60/x^-60", "f:1:1: the exponents grow beyond 100 here"),
            ("x*1e300^20", "f:1:1: the exact numbers in this formula grow beyond all use"),
        ] {
            assert_eq!(lowered(&mut graph.clone(), text), Err(vec![expected.to_owned()]), "{text}");
        }
        assert!(lowered(&mut graph, "1/x").is_ok());
    }
}

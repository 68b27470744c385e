//! Shapes of terms: numbers, vectors and matrices of one run-time length, and conditions.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::function::{Builtin, ELSEWHERE, names};
use super::{Formula, PI, Side, Term, TermKind};
use crate::diagnostic::{Code, Diagnostics, suggest};
use crate::expression::Shape;

/// The names that a formula may use, with their shapes.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Scope {
    names: BTreeMap<String, Shape>,
}

impl<S: Into<String>> FromIterator<(S, Shape)> for Scope {
    fn from_iter<I: IntoIterator<Item = (S, Shape)>>(names: I) -> Self {
        Scope { names: names.into_iter().map(|(name, shape)| (name.into(), shape)).collect() }
    }
}

/// The shape of a formula.
///
/// # Errors
/// Every name that is not declared, every function that does not exist, every place where shapes do not
/// fit; an error inside a term is not followed by errors about the term.
pub fn check(formula: &Formula, scope: &Scope) -> Result<Shape, Diagnostics> {
    let mut checker = Checker {
        formula,
        scope,
        counters: Vec::new(),
        unknown: BTreeSet::new(),
        errors: Diagnostics::new(),
    };
    let shape = checker.shape(&formula.root);
    checker.errors.into_result(shape.unwrap_or(Shape::Scalar))
}

struct Checker<'f> {
    formula: &'f Formula,
    scope: &'f Scope,
    /// Counters of the sums around the term.
    counters: Vec<&'f str>,
    /// Unknown names reported so far.
    unknown: BTreeSet<String>,
    errors: Diagnostics,
}

pub(super) fn called(shape: Shape) -> &'static str {
    match shape {
        Shape::Scalar => "a number",
        Shape::Vector => "a vector",
        Shape::Matrix => "a matrix",
        Shape::Truth => "a condition",
    }
}

impl<'f> Checker<'f> {
    fn error(&mut self, code: Code, span: &Range<usize>, message: String, help: Option<String>) {
        let error = self.formula.text.error(code, span.clone(), message);
        self.errors.push(error.maybe_help(help));
    }

    /// The shape of a term; `None` if something inside it is wrong and was reported.
    fn shape(&mut self, term: &'f Term) -> Option<Shape> {
        match &term.kind {
            TermKind::Number(_) => Some(Shape::Scalar),
            TermKind::Name(name) => self.name(name, &term.span),
            TermKind::Negate(inner) => {
                let shape = self.shape(inner)?;
                if shape == Shape::Truth {
                    self.wanted(inner, "a number", shape);
                    return None;
                }
                Some(shape)
            }
            TermKind::Sum(parts) => self.sum(parts),
            TermKind::Product(parts) => self.product(parts),
            TermKind::Power(base, exponent) => {
                let (base, exponent) = (self.number(base), self.number(exponent));
                base.and(exponent)
            }
            TermKind::Call { function, name, arguments } => {
                self.call(term, function, name, arguments)
            }
            TermKind::Series { counter, name, ends, body } => {
                let ends: Vec<_> = ends.iter().map(|end| self.number(end)).collect();
                let fine = self.counter(counter, name);
                self.counters.push(counter);
                let body = self.number(body);
                self.counters.pop();
                body.filter(|_| fine && ends.iter().all(Option::is_some))
            }
            TermKind::Compare(first, rest) => {
                let first = self.number(first);
                let rest: Vec<_> = rest.iter().map(|(_, part)| self.number(part)).collect();
                (first.is_some() && rest.iter().all(Option::is_some)).then_some(Shape::Truth)
            }
            TermKind::And(parts) | TermKind::Or(parts) => {
                let parts: Vec<_> = parts.iter().map(|part| self.truth(part)).collect();
                parts.into_iter().all(|part| part.is_some()).then_some(Shape::Truth)
            }
            TermKind::Not(inner) => self.truth(inner),
        }
    }

    /// A term as it was written, cut if it is long.
    fn written(&self, term: &Term) -> String {
        const LONGEST: usize = 40;
        let text = &self.formula.text.text()[term.span.clone()];
        match text.char_indices().nth(LONGEST) {
            Some((end, _)) => format!("{}…", &text[..end]),
            None => text.to_owned(),
        }
    }

    fn wanted(&mut self, term: &'f Term, wanted: &str, found: Shape) {
        let message = format!("expected {wanted}, found {}", called(found));
        let label = format!("`{}` is {}", self.written(term), called(found));
        let error = self.formula.text.error(Code::SHAPE, term.span.clone(), message);
        self.errors.push(error.label(label));
    }

    fn number(&mut self, term: &'f Term) -> Option<Shape> {
        self.exactly(term, Shape::Scalar)
    }

    fn truth(&mut self, term: &'f Term) -> Option<Shape> {
        self.exactly(term, Shape::Truth)
    }

    fn exactly(&mut self, term: &'f Term, wanted: Shape) -> Option<Shape> {
        let found = self.shape(term)?;
        if found != wanted {
            self.wanted(term, called(wanted), found);
            return None;
        }
        Some(found)
    }

    fn name(&mut self, name: &str, span: &Range<usize>) -> Option<Shape> {
        if let Some(shape) = self.scope.names.get(name) {
            return Some(*shape);
        }
        if name == PI || self.counters.contains(&name) {
            return Some(Shape::Scalar);
        }
        // Once a formula: the other places are fixed with the first.
        if !self.unknown.insert(name.to_owned()) {
            return None;
        }
        let known: Vec<&str> = self.scope.names.keys().map(String::as_str).collect();
        let help = if Builtin::named(name).is_some() {
            Some(format!("`{name}` is a function: write `{name}(…)`"))
        } else {
            suggest(name, &known)
        };
        self.error(Code::UNKNOWN_NAME, span, format!("unknown name `{name}`"), help);
        None
    }

    /// Whether a counter has a name of its own.
    fn counter(&mut self, counter: &'f str, place: &Range<usize>) -> bool {
        let taken = self.scope.names.contains_key(counter)
            || counter == PI
            || self.counters.contains(&counter);
        if taken {
            let message = format!("the counter `{counter}` has the name of something else");
            self.error(Code::BAD_NAME, place, message, Some("give it another name".to_owned()));
        }
        !taken
    }

    fn sum(&mut self, parts: &'f [(Side, Term)]) -> Option<Shape> {
        let shapes: Vec<_> = parts.iter().map(|(_, part)| self.shape(part)).collect();
        let first = shapes[0];
        let mut fine = first.is_some();
        for ((_, part), shape) in parts.iter().zip(&shapes) {
            match (first, shape) {
                (_, Some(Shape::Truth)) => {
                    self.wanted(part, "a number", Shape::Truth);
                    fine = false;
                }
                (Some(first), Some(shape)) if first != *shape && first != Shape::Truth => {
                    let (a, b) = (called(*shape), called(first));
                    let message = format!("{a} cannot be added to {b}");
                    let (part_text, first_text) = (self.written(part), self.written(&parts[0].1));
                    let label = format!("`{part_text}` is {a}, `{first_text}` is {b}");
                    let error = self.formula.text.error(Code::SHAPE, part.span.clone(), message);
                    self.errors.push(error.label(label));
                    fine = false;
                }
                (_, None) => fine = false,
                _ => {}
            }
        }
        if fine { first } else { None }
    }

    /// A product is read with its numbers apart; what is left must be a matrix, a vector, or matrices
    /// applied to a vector.
    fn product(&mut self, parts: &'f [(Side, Term)]) -> Option<Shape> {
        let mut fine = true;
        let mut tensors: Vec<(Shape, &Term)> = Vec::new();
        for (side, part) in parts {
            match (side, self.shape(part)) {
                (_, None) => fine = false,
                (_, Some(Shape::Scalar)) => {}
                (_, Some(Shape::Truth)) => {
                    self.wanted(part, "a number", Shape::Truth);
                    fine = false;
                }
                (Side::With, Some(shape)) => tensors.push((shape, part)),
                (Side::Against, Some(shape)) => {
                    let message = format!("cannot divide by {}", called(shape));
                    self.error(Code::SHAPE, &part.span, message, None);
                    fine = false;
                }
            }
        }
        for pair in tensors.windows(2) {
            let (message, help) = match (pair[0].0, pair[1].0) {
                (Shape::Vector, Shape::Vector) => {
                    ("two vectors cannot be multiplied", "write `dot(a, b)` or `outer(a, b)`")
                }
                (Shape::Vector, _) => (
                    "a matrix cannot stand to the right of a vector",
                    "write `transpose(A)*x`, or `dot(x, A*y)`",
                ),
                _ => continue,
            };
            fine = false;
            self.error(Code::SHAPE, &pair[1].1.span, message.to_owned(), Some(help.to_owned()));
        }
        let last = tensors.last().map_or(Shape::Scalar, |(shape, _)| *shape);
        if fine && tensors.len() > 1 && last == Shape::Matrix {
            let message = "two matrices cannot be multiplied".to_owned();
            let help = "apply them to a vector, as in `A*B*x`".to_owned();
            self.error(Code::SHAPE, &tensors[1].1.span, message, Some(help));
            fine = false;
        }
        fine.then_some(last)
    }

    fn call(
        &mut self,
        term: &'f Term,
        function: &str,
        name: &Range<usize>,
        arguments: &'f [Term],
    ) -> Option<Shape> {
        let Some((builtin, [least, most])) = Builtin::named(function) else {
            let help = if self.scope.names.contains_key(function) {
                Some(format!("`{function}` is a quantity: write `{function}*(…)` for a product"))
            } else if let Some((_, help)) = ELSEWHERE.iter().find(|(f, _)| *f == function) {
                Some((*help).to_owned())
            } else {
                suggest(function, &names().collect::<Vec<&str>>())
            };
            self.error(Code::BAD_CALL, name, format!("unknown function `{function}`"), help);
            arguments.iter().for_each(|argument| {
                self.shape(argument);
            });
            return None;
        };
        if arguments.len() < least || arguments.len() > most {
            let count = match (least, most) {
                (1, 1) => "one argument".to_owned(),
                (least, most) if least == most => format!("{least} arguments"),
                (least, most) => format!("{least} to {most} arguments"),
            };
            let message = format!("`{function}` takes {count}, not {}", arguments.len());
            self.error(Code::BAD_CALL, &term.span, message, None);
            return None;
        }
        let (wanted, result) = builtin.shapes();
        let fine: Vec<_> = arguments.iter().map(|a| self.exactly(a, wanted)).collect();
        fine.iter().all(Option::is_some).then_some(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Located;
    use crate::formula::parse;

    fn shape(text: &str) -> Result<Shape, Vec<String>> {
        let scope = Scope::from_iter([
            ("h", Shape::Scalar),
            ("theta_dot", Shape::Scalar),
            ("eta", Shape::Vector),
            ("Y", Shape::Matrix),
        ]);
        let formula = parse(&Located::alone("f", text)).unwrap();
        check(&formula, &scope).map_err(|errors| errors.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn shapes_are_found() {
        assert_eq!(shape("2*h^2/θ̇ + pi"), Ok(Shape::Scalar));
        assert_eq!(shape("h*Y*eta/2 - 3*eta"), Ok(Shape::Vector));
        assert_eq!(shape("Y*Y*eta"), Ok(Shape::Vector));
        assert_eq!(shape("dot(eta, Y*eta)"), Ok(Shape::Scalar));
        assert_eq!(shape("outer(eta, eta) + transpose(Y)*h"), Ok(Shape::Matrix));
        assert_eq!(shape("0 < h <= 1 and not (h > 3 or h < 2)"), Ok(Shape::Truth));
        assert_eq!(shape("min(h, 1, 2)"), Ok(Shape::Scalar));
        assert_eq!(shape("sum(i, 1, 3, sum(j, 0, i, h^j))"), Ok(Shape::Scalar));
    }

    #[test]
    fn all_errors_are_found_without_cascades() {
        let expected: &[(&str, &[&str])] = &[
            (
                "hh + thetadot",
                &[
                    "f:1:1: unknown name `hh` (did you mean `h`?)",
                    "f:1:6: unknown name `thetadot` (did you mean `theta_dot`?)",
                ],
            ),
            (
                "sine(h) + sqrt(x)",
                &[
                    "f:1:1: unknown function `sine` (did you mean `sin`?)",
                    "f:1:16: unknown name `x` (known: `Y`, `eta`, `h`, `theta_dot`)",
                ],
            ),
            ("ln(h)", &["f:1:1: unknown function `ln` (write `log(…)` for the natural logarithm)"]),
            (
                "h(1 + h)",
                &["f:1:1: unknown function `h` (`h` is a quantity: write `h*(…)` for a product)"],
            ),
            ("2*sqrt", &["f:1:3: unknown name `sqrt` (`sqrt` is a function: write `sqrt(…)`)"]),
            ("sin(h, h)", &["f:1:1: `sin` takes one argument, not 2"]),
            ("max(h)", &["f:1:1: `max` takes 2 to 32 arguments, not 1"]),
            ("dot(eta)", &["f:1:1: `dot` takes 2 arguments, not 1"]),
            ("h + eta", &["f:1:5: a vector cannot be added to a number"]),
            (
                "eta*eta",
                &["f:1:5: two vectors cannot be multiplied (write `dot(a, b)` or `outer(a, b)`)"],
            ),
            (
                "eta*Y",
                &[
                    "f:1:5: a matrix cannot stand to the right of a vector (write `transpose(A)*x`, or `dot(x, A*y)`)",
                ],
            ),
            (
                "Y*Y",
                &[
                    "f:1:3: two matrices cannot be multiplied (apply them to a vector, as in `A*B*x`)",
                ],
            ),
            ("h/eta", &["f:1:3: cannot divide by a vector"]),
            ("eta^2", &["f:1:1: expected a number, found a vector"]),
            ("sin(eta) + 1", &["f:1:5: expected a number, found a vector"]),
            ("(h < 1) + 2", &["f:1:2: expected a number, found a condition"]),
            ("h and h < 1", &["f:1:1: expected a condition, found a number"]),
            (
                "sum(h, 0, 2, h)",
                &["f:1:5: the counter `h` has the name of something else (give it another name)"],
            ),
            (
                "sum(j, 0, 2, j*k) + j",
                &[
                    "f:1:16: unknown name `k` (known: `Y`, `eta`, `h`, `theta_dot`)",
                    "f:1:21: unknown name `j` (known: `Y`, `eta`, `h`, `theta_dot`)",
                ],
            ),
            ("sum(j, 0, 2, eta)", &["f:1:14: expected a number, found a vector"]),
            ("(h < 1) < 2", &["f:1:2: expected a number, found a condition"]),
        ];
        for (text, expected) in expected {
            assert_eq!(shape(text).unwrap_err(), *expected, "{text}");
        }
    }
}

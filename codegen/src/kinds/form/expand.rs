//! Form → components: with v = N_a e_i and u = N_b e_j a form becomes, for every (i, j), a sum of products
//! of one of (N_a, ∂N_a/∂x, ∂N_a/∂y, ∂N_a/∂z), one of the same of N_b, and a coefficient of the material.

use std::array::from_fn;
use std::collections::BTreeMap;
use std::ops::Range;

use num_traits::{One, ToPrimitive};

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::expression::{Graph, Id, Node, Rational, normal};
use crate::formula::{Formula, Side, Term, TermKind, undefined};

/// Component i of the test function, j of the trial function; which of (N, ∂x, ∂y, ∂z) of either.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Component of v.
    pub(crate) i: usize,
    /// Component of u.
    pub(crate) j: usize,
    /// 0 for N_a, 1 + k for ∂N_a/∂x_k.
    pub(crate) test: usize,
    /// 0 for N_b, 1 + k for ∂N_b/∂x_k.
    pub(crate) trial: usize,
}

/// A form by its coefficients; those that are zero are left out.
pub type Bilinear = BTreeMap<Place, Id>;

/// What the names of a form stand for.
#[derive(Debug, Clone, Default)]
pub(crate) struct Names {
    /// Properties and coefficients of the material, as symbols.
    pub scalars: BTreeMap<String, Id>,
    /// What the symbols of coefficients stand for, over the material.
    pub coefficients: BTreeMap<Id, Id>,
    /// Constant matrices.
    pub(crate) matrices: BTreeMap<String, [[Rational; 3]; 3]>,
    /// Stresses, as symbols of their components.
    pub(crate) stresses: BTreeMap<String, [[Id; 3]; 3]>,
}

/// Functions of the form language, with the number of their arguments.
const FUNCTIONS: [(&str, usize); 7] =
    [("div", 1), ("grad", 1), ("eps", 1), ("trace", 1), ("transpose", 1), ("inner", 2), ("dot", 2)];

/// A part of a form with its degrees in u and in v.
#[derive(Debug, Clone)]
struct Subterm {
    value: Value,
    degrees: [u32; 2],
}

#[derive(Debug, Clone)]
enum Value {
    Scalar(Id),
    /// A vector field linear in u or v, with its gradient [component][direction].
    Field([Id; 3], [[Id; 3]; 3]),
    Matrix([[Id; 3]; 3]),
}

impl Value {
    fn called(&self) -> &'static str {
        match self {
            Value::Scalar(_) => "a number",
            Value::Field(..) => "a vector",
            Value::Matrix(_) => "a matrix",
        }
    }

    fn map(&self, mut f: impl FnMut(Id) -> Id) -> Value {
        match self {
            Value::Scalar(a) => Value::Scalar(f(*a)),
            Value::Field(a, g) => Value::Field(a.map(&mut f), g.map(|row| row.map(&mut f))),
            Value::Matrix(m) => Value::Matrix(m.map(|row| row.map(&mut f))),
        }
    }
}

/// Expands a form into its coefficients.
///
/// # Errors
/// The first part that the form language does not have, whose shapes do not fit, or that is not linear in
/// u and in v.
pub(super) fn expand(
    formula: &Formula,
    graph: &mut Graph,
    names: &Names,
) -> Result<Bilinear, Box<Diagnostic>> {
    let symbols = |graph: &mut Graph, side: &str| {
        ["", "_x", "_y", "_z"].map(|part| graph.scalar(&format!("{side}{part}")))
    };
    let (test, trial) = (symbols(graph, "N_a"), symbols(graph, "N_b"));
    let mut bilinear = Bilinear::new();
    for i in 0..3 {
        for j in 0..3 {
            let v = Subterm { value: field(graph, &test, i), degrees: [0, 1] };
            let u = Subterm { value: field(graph, &trial, j), degrees: [1, 0] };
            let mut expansion = Expansion { formula, graph, names, u, v, test, trial };
            let Subterm { value, degrees } = expansion.term(&formula.root)?;
            let Value::Scalar(value) = value else {
                let message = format!("a form is a number, this is {}", value.called());
                return Err(Box::new(formula.text.error_here(Code::SHAPE, message)));
            };
            if degrees != [1, 1] {
                return expansion.not_bilinear(&formula.root, degrees);
            }
            expansion.collect(value, i, j, &mut bilinear);
        }
    }
    Ok(bilinear)
}

/// N e_i with its gradient.
fn field(graph: &mut Graph, basis: &[Id; 4], i: usize) -> Value {
    let zero = graph.integer(0);
    let at = |k: usize, id: Id| if k == i { id } else { zero };
    Value::Field(from_fn(|k| at(k, basis[0])), from_fn(|k| from_fn(|l| at(k, basis[1 + l]))))
}

struct Expansion<'f> {
    formula: &'f Formula,
    graph: &'f mut Graph,
    names: &'f Names,
    u: Subterm,
    v: Subterm,
    test: [Id; 4],
    trial: [Id; 4],
}

/// How to fix a form that is not linear in both.
const LINEAR: &str = "every term holds u once and v once";

type Expanded = Result<Subterm, Box<Diagnostic>>;

impl Expansion<'_> {
    fn error<T>(
        &self,
        code: Code,
        span: &Range<usize>,
        message: impl Into<String>,
    ) -> Result<T, Box<Diagnostic>> {
        let error = self.formula.text.error(code, span.clone(), message);
        // Terms that are not linear all are fixed alike.
        let help = (code == Code::FORM).then(|| LINEAR.to_owned());
        Err(Box::new(error.maybe_help(help)))
    }

    fn not_bilinear<T>(&self, term: &Term, [u, v]: [u32; 2]) -> Result<T, Box<Diagnostic>> {
        let message = "the form is not linear in u and in v";
        let label = format!("of degree {u} in u and {v} in v");
        let error = self.formula.text.error(Code::FORM, term.span.clone(), message);
        Err(Box::new(error.label(label).help(LINEAR)))
    }

    fn term(&mut self, term: &Term) -> Expanded {
        let constant = |value| Ok(Subterm { value, degrees: [0, 0] });
        match &term.kind {
            TermKind::Number(value) => constant(Value::Scalar(self.graph.number(value.clone()))),
            TermKind::Name(name) => match name.as_str() {
                "u" => Ok(self.u.clone()),
                "v" => Ok(self.v.clone()),
                _ => constant(self.name(name, &term.span)?),
            },
            TermKind::Negate(inner) => {
                let Subterm { value, degrees } = self.term(inner)?;
                Ok(Subterm { value: value.map(|id| self.graph.neg(id)), degrees })
            }
            TermKind::Sum(parts) => self.sum(parts),
            TermKind::Product(parts) => self.product(parts),
            TermKind::Power(base, exponent) => constant(self.power(term, base, exponent)?),
            TermKind::Call { function, name, arguments } => {
                self.call(term, function, name, arguments)
            }
            TermKind::Series { .. } => self.error(Code::SYNTAX, &term.span, "a form has no `sum`"),
            TermKind::Compare(..) | TermKind::And(_) | TermKind::Or(_) | TermKind::Not(_) => {
                self.error(Code::SYNTAX, &term.span, "a form has no conditions")
            }
        }
    }

    fn name(&mut self, name: &str, span: &Range<usize>) -> Result<Value, Box<Diagnostic>> {
        if let Some(symbol) = self.names.scalars.get(name) {
            return Ok(Value::Scalar(*symbol));
        }
        if let Some(matrix) = self.names.matrices.get(name) {
            return Ok(Value::Matrix(
                matrix.each_ref().map(|row| row.each_ref().map(|x| self.graph.number(x.clone()))),
            ));
        }
        if let Some(stress) = self.names.stresses.get(name) {
            return Ok(Value::Matrix(*stress));
        }
        let known: Vec<&str> = ["u", "v"]
            .into_iter()
            .chain(self.names.scalars.keys().map(String::as_str))
            .chain(self.names.matrices.keys().map(String::as_str))
            .chain(self.names.stresses.keys().map(String::as_str))
            .collect();
        let text = &self.formula.text;
        let error = text.error(Code::UNKNOWN_NAME, span.clone(), format!("unknown name `{name}`"));
        Err(Box::new(error.maybe_help(suggest(name, &known))))
    }

    fn sum(&mut self, parts: &[(Side, Term)]) -> Expanded {
        let mut total: Option<Subterm> = None;
        for (side, term) in parts {
            let Subterm { value, degrees } = self.term(term)?;
            let value = match side {
                Side::With => value,
                Side::Against => value.map(|id| self.graph.neg(id)),
            };
            let Some(before) = total else {
                total = Some(Subterm { value, degrees });
                continue;
            };
            if before.degrees != degrees {
                return self.not_bilinear(term, degrees);
            }
            let value = match (before.value, value) {
                (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(self.graph.add(a, b)),
                (Value::Field(a, g), Value::Field(b, h)) => Value::Field(
                    from_fn(|k| self.graph.add(a[k], b[k])),
                    from_fn(|k| from_fn(|l| self.graph.add(g[k][l], h[k][l]))),
                ),
                (Value::Matrix(a), Value::Matrix(b)) => {
                    Value::Matrix(from_fn(|k| from_fn(|l| self.graph.add(a[k][l], b[k][l]))))
                }
                (a, b) => {
                    let message = format!("{} cannot be added to {}", b.called(), a.called());
                    return self.error(Code::SHAPE, &term.span, message);
                }
            };
            total = Some(Subterm { value, degrees });
        }
        Ok(total.expect("a sum has parts"))
    }

    fn product(&mut self, parts: &[(Side, Term)]) -> Expanded {
        let mut total = Subterm { value: Value::Scalar(self.graph.integer(1)), degrees: [0, 0] };
        // From the right, so that A*B*u is A*(B*u).
        for (side, term) in parts.iter().rev() {
            let part = self.term(term)?;
            let degrees = from_fn(|side| part.degrees[side] + total.degrees[side]);
            if degrees.iter().any(|degree| *degree > 1) {
                return self.not_bilinear(term, degrees);
            }
            let scale = match (&part.value, &total.value) {
                (Value::Scalar(_), Value::Field(..)) => part.degrees,
                (Value::Field(..), Value::Scalar(_)) => total.degrees,
                _ => [0, 0],
            };
            if scale != [0, 0] {
                let message = "a vector can only be scaled by what does not depend on u or v";
                return self.error(Code::FORM, &term.span, message);
            }
            let stressed = self.stressed(&part.value) || self.stressed(&total.value);
            let value = match (part.value, total.value, side) {
                (Value::Scalar(a), other, Side::Against) if part.degrees == [0, 0] => {
                    let divisor = self.seen(a);
                    if let Some(why) = undefined::division(self.graph, divisor) {
                        return self.error(Code::UNDEFINED, &term.span, why);
                    }
                    let inverse = self.graph.power(a, -Rational::one());
                    other.map(|id| self.graph.mul(inverse, id))
                }
                (other, _, Side::Against) => {
                    let what = match part.degrees {
                        [0, 0] => other.called(),
                        _ => "what depends on u or v",
                    };
                    return self.error(Code::FORM, &term.span, format!("no division by {what}"));
                }
                (Value::Scalar(a), other, _) | (other, Value::Scalar(a), _) => {
                    other.map(|id| self.graph.mul(a, id))
                }
                (Value::Matrix(m), Value::Field(a, g), _) if part.degrees == [0, 0] => {
                    let columns: [[Id; 3]; 3] = from_fn(|l| self.applied(&m, from_fn(|k| g[k][l])));
                    let value = self.applied(&m, a);
                    Value::Field(value, from_fn(|k| from_fn(|l| columns[l][k])))
                }
                (Value::Matrix(a), Value::Matrix(b), _) => {
                    let columns: [[Id; 3]; 3] = from_fn(|l| self.applied(&a, from_fn(|k| b[k][l])));
                    Value::Matrix(from_fn(|k| from_fn(|l| columns[l][k])))
                }
                (a, b, _) => {
                    let message = format!("{} times {} is not defined", a.called(), b.called());
                    let help = "write `dot(a, b)` of vectors, `inner(A, B)` of matrices, and only \
                                constant matrices before a vector";
                    let error = self.formula.text.error(Code::SHAPE, term.span.clone(), message);
                    return Err(Box::new(error.help(help)));
                }
            };
            if stressed && matches!(value, Value::Field(..)) {
                let message = "a vector can only be scaled by what is constant over a cell, which a \
                               stress is not";
                return self.error(Code::FORM, &term.span, message);
            }
            total = Subterm { value, degrees };
        }
        Ok(total)
    }

    /// Whether a stress occurs, which differs from point to point.
    fn stressed(&self, value: &Value) -> bool {
        let symbols = || self.names.stresses.values().flatten().flatten();
        let depends = |id: &Id| symbols().any(|symbol| self.graph.depends(*id, *symbol));
        match value {
            Value::Scalar(id) => depends(id),
            Value::Field(value, _) => value.iter().any(depends),
            Value::Matrix(matrix) => matrix.iter().flatten().any(depends),
        }
    }

    fn applied(&mut self, matrix: &[[Id; 3]; 3], x: [Id; 3]) -> [Id; 3] {
        matrix.map(|row| self.products(row.into_iter().zip(x)))
    }

    fn products(&mut self, pairs: impl IntoIterator<Item = (Id, Id)>) -> Id {
        let terms: Vec<_> =
            pairs.into_iter().map(|(a, b)| (self.graph.mul(a, b), Rational::one())).collect();
        self.graph.sum(&terms)
    }

    /// What is known of a scalar: coefficients stand for their values.
    fn seen(&mut self, id: Id) -> Id {
        self.graph.substitute(id, &self.names.coefficients)
    }

    fn power(
        &mut self,
        term: &Term,
        base: &Term,
        exponent: &Term,
    ) -> Result<Value, Box<Diagnostic>> {
        let (a, b) = (self.term(base)?, self.term(exponent)?);
        if let Some(term) = [(&a, base), (&b, exponent)].iter().find(|(p, _)| p.degrees != [0, 0]) {
            let message = "no powers of what depends on u or v";
            return self.error(Code::FORM, &term.1.span, message);
        }
        match (a.value, b.value) {
            (Value::Scalar(a), Value::Scalar(b)) => match self.graph.as_number(b) {
                Some(b) if b.to_f64().is_some_and(|b| b.abs() <= 8.0) => {
                    let (b, base) = (b.clone(), self.seen(a));
                    match undefined::power(self.graph, base, &b) {
                        Some(why) => self.error(Code::UNDEFINED, &term.span, why),
                        None => Ok(Value::Scalar(self.graph.power(a, b))),
                    }
                }
                _ => {
                    let message = "an exponent is a number up to 8";
                    let place = exponent.span.clone();
                    Err(Box::new(self.formula.text.error(Code::FORM, place, message)))
                }
            },
            _ => self.error(Code::SHAPE, &base.span, "only a number has powers"),
        }
    }

    fn call(
        &mut self,
        term: &Term,
        function: &str,
        name: &Range<usize>,
        arguments: &[Term],
    ) -> Expanded {
        let Some((_, count)) = FUNCTIONS.iter().find(|(known, _)| *known == function) else {
            let known = FUNCTIONS.map(|(name, _)| name);
            let message = format!("`{function}` is not a function of forms");
            let error = self.formula.text.error(Code::BAD_CALL, name.clone(), message);
            return Err(Box::new(error.maybe_help(suggest(function, &known))));
        };
        if arguments.len() != *count {
            let message = format!("`{function}` takes {count} arguments, not {}", arguments.len());
            return self.error(Code::BAD_CALL, &term.span, message);
        }
        let (mut values, mut degrees) = (Vec::with_capacity(2), [0, 0]);
        for argument in arguments {
            let part = self.term(argument)?;
            degrees = from_fn(|side| degrees[side] + part.degrees[side]);
            values.push(part.value);
        }
        if degrees.iter().any(|degree| *degree > 1) {
            return self.not_bilinear(term, degrees);
        }
        let value = match (function, values.as_slice()) {
            ("grad", [Value::Field(_, g)]) => Value::Matrix(*g),
            ("eps", [Value::Field(_, g)]) => {
                let half = Rational::half();
                Value::Matrix(from_fn(|k| {
                    from_fn(|l| self.graph.sum(&[(g[k][l], half.clone()), (g[l][k], half.clone())]))
                }))
            }
            ("div", [Value::Field(_, m)]) | ("trace", [Value::Matrix(m)]) => {
                let terms = [0, 1, 2].map(|k| (m[k][k], Rational::one()));
                Value::Scalar(self.graph.sum(&terms))
            }
            ("transpose", [Value::Matrix(m)]) => Value::Matrix(from_fn(|k| from_fn(|l| m[l][k]))),
            ("inner", [Value::Matrix(a), Value::Matrix(b)]) => {
                let (a, b) = (a.as_flattened().to_vec(), b.as_flattened().to_vec());
                Value::Scalar(self.products(a.into_iter().zip(b)))
            }
            ("dot", [Value::Field(a, _), Value::Field(b, _)]) => {
                Value::Scalar(self.products(a.iter().copied().zip(*b)))
            }
            _ => {
                let found: Vec<&str> = values.iter().map(Value::called).collect();
                let message = format!("`{function}` does not take {}", found.join(" and "));
                return self.error(Code::SHAPE, &term.span, message);
            }
        };
        Ok(Subterm { value, degrees })
    }

    /// Sorts the terms of a component by the basis functions' parts in them: one of each, as the degrees
    /// of the form say.
    fn collect(&mut self, value: Id, i: usize, j: usize, bilinear: &mut Bilinear) {
        let expanded = normal::expand(self.graph, value);
        let mut coefficients: BTreeMap<Place, Vec<(Id, Rational)>> = BTreeMap::new();
        for (term, coefficient) in self.graph.terms(expanded) {
            let factors = match self.graph.node(term).clone() {
                Node::Product(factors) => factors,
                _ => vec![(term, Rational::one())],
            };
            let (mut test, mut trial, mut rest) = (None, None, Vec::new());
            for (base, exponent) in factors {
                let part = |symbols: &[Id; 4]| symbols.iter().position(|symbol| *symbol == base);
                match (part(&self.test), part(&self.trial)) {
                    (Some(part), _) => test = Some(part),
                    (_, Some(part)) => trial = Some(part),
                    _ => rest.push((base, exponent)),
                }
            }
            // Only the number zero has neither.
            let (Some(test), Some(trial)) = (test, trial) else { continue };
            let rest = self.graph.product(&rest);
            let place = Place { i, j, test, trial };
            coefficients.entry(place).or_default().push((rest, coefficient));
        }
        for (place, terms) in coefficients {
            bilinear.insert(place, self.graph.sum(&terms));
        }
    }
}

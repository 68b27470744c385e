//! What each rule does. A rule considers one node only, and what is right below it.

use num_traits::{One, Signed, Zero};

use crate::expression::{Function, Graph, Id, Node, Rational, Shape};

/// outer(inner(a)) = a.
pub(super) fn inverse(graph: &mut Graph, id: Id, outer: Function, inner: Function) -> Option<Id> {
    let argument = argument(graph, id, outer)?;
    self::argument(graph, argument, inner)
}

/// The argument of a function.
fn argument(graph: &Graph, id: Id, wanted: Function) -> Option<Id> {
    match *graph.node(id) {
        Node::Function(function, argument) if function == wanted => Some(argument),
        _ => None,
    }
}

fn factors(graph: &Graph, id: Id) -> Vec<(Id, Rational)> {
    match graph.node(id) {
        Node::Product(factors) => factors.clone(),
        _ => vec![(id, Rational::one())],
    }
}

pub(super) fn product_of_exponentials(graph: &mut Graph, id: Id) -> Option<Id> {
    let (mut exponents, mut rest) = (Vec::new(), Vec::new());
    for (base, exponent) in factors(graph, id) {
        match argument(graph, base, Function::Exp) {
            Some(a) => exponents.push((a, exponent)),
            None => rest.push((base, exponent)),
        }
    }
    if exponents.is_empty() {
        return None;
    }
    let exponent = graph.sum(&exponents);
    rest.push((graph.function(Function::Exp, exponent), Rational::one()));
    Some(graph.product(&rest))
}

/// Only for powers and exponentials, of which it is known that they are above zero; a logarithm of
/// anything else could be that of a product of two negative numbers.
pub(super) fn sum_of_logarithms(graph: &mut Graph, id: Id) -> Option<Id> {
    let (mut powers, mut rest) = (Vec::new(), Vec::new());
    for (term, coefficient) in graph.terms(id) {
        match argument(graph, term, Function::Ln) {
            Some(a) if coefficient.is_integer() && is_positive(graph, a) => {
                powers.push((a, coefficient));
            }
            _ => rest.push((term, coefficient)),
        }
    }
    if powers.len() < 2 {
        return None;
    }
    let product = graph.product(&powers);
    rest.push((graph.function(Function::Ln, product), Rational::one()));
    Some(graph.sum(&rest))
}

/// Whether a scalar is known to be above zero wherever it is defined.
fn is_positive(graph: &Graph, id: Id) -> bool {
    match graph.node(id) {
        Node::Number(value) => value.is_positive(),
        Node::Function(Function::Exp, _) => true,
        Node::Sum(terms) => {
            let fine = |(term, c): &(Id, Rational)| c.is_positive() && is_positive(graph, *term);
            terms.iter().all(fine)
        }
        Node::Product(factors) => factors.iter().all(|(base, _)| is_positive(graph, *base)),
        _ => false,
    }
}

pub(super) fn sum_of_squares(graph: &mut Graph, id: Id) -> Option<Id> {
    let terms = graph.terms(id);
    // What multiplies the square of `function(a)`, and a.
    let part = |graph: &mut Graph, term: Id, function| {
        let factors = factors(graph, term);
        let two = Rational::from(2);
        let place = factors.iter().position(|(base, exponent)| {
            *exponent == two && argument(graph, *base, function).is_some()
        })?;
        let a = argument(graph, factors[place].0, function)?;
        let mut rest = factors;
        rest.remove(place);
        Some((a, graph.product(&rest)))
    };
    for (i, (sine, first)) in terms.iter().enumerate() {
        let Some((a, rest)) = part(graph, *sine, Function::Sin) else { continue };
        for (j, (cosine, second)) in terms.iter().enumerate() {
            if part(graph, *cosine, Function::Cos) != Some((a, rest)) {
                continue;
            }
            // x sin² + y cos² = y + (x − y) sin², or the same with the other left over.
            let mut sum: Vec<_> = terms.clone();
            let (keep, coefficient) =
                if first.abs() < second.abs() { (j, first) } else { (i, second) };
            let drop = i + j - keep;
            sum[keep].1 = &sum[keep].1 - coefficient;
            sum[drop] = (rest, coefficient.clone());
            return Some(graph.sum(&sum));
        }
    }
    None
}

pub(super) fn sine_over_cosine(graph: &mut Graph, id: Id) -> Option<Id> {
    let mut factors = factors(graph, id);
    for (i, (sine, n)) in factors.iter().enumerate() {
        let Some(a) = argument(graph, *sine, Function::Sin) else { continue };
        let cosine = factors.iter().position(|(base, m)| {
            argument(graph, *base, Function::Cos) == Some(a) && (n + m).is_zero() && n.is_integer()
        });
        if let Some(j) = cosine {
            let exponent = n.clone();
            factors[i] = (graph.function(Function::Tan, a), exponent);
            factors.remove(j);
            return Some(graph.product(&factors));
        }
    }
    None
}

pub(super) fn hyperbolic_tangent(graph: &mut Graph, id: Id) -> Option<Id> {
    let mut factors = factors(graph, id);
    for (i, (above, n)) in factors.iter().enumerate() {
        for (j, (below, m)) in factors.iter().enumerate() {
            let opposite = (n + m).is_zero() && n.is_positive() && n.is_integer();
            let Some((factor, a)) = (opposite).then(|| quotient(graph, *above, *below)).flatten()
            else {
                continue;
            };
            let exponent = n.clone();
            let tangent = graph.function(Function::Tanh, a);
            factors[i] = (graph.times(factor, tangent), exponent);
            factors.remove(j);
            return Some(graph.product(&factors));
        }
    }
    None
}

/// (factor, a) where above/below = factor·(eᵃ − e⁻ᵃ)/(eᵃ + e⁻ᵃ).
fn quotient(graph: &mut Graph, above: Id, below: Id) -> Option<(Rational, Id)> {
    let ([(x, p), (y, q)], [(u, r), (v, s)]) =
        (graph.terms(above).try_into().ok()?, graph.terms(below).try_into().ok()?);
    if (x, y) != (u, v) || r != s || p != -q.clone() {
        return None;
    }
    let (a, b) = (exponent(graph, x)?, exponent(graph, y)?);
    let opposite = graph.neg(b);
    (a == opposite).then(|| (p / r, a))
}

/// a of eᵃ or 1/e⁻ᵃ.
fn exponent(graph: &mut Graph, id: Id) -> Option<Id> {
    let [(base, exponent)] = factors(graph, id).try_into().ok()?;
    let a = argument(graph, base, Function::Exp)?;
    Some(graph.times(exponent, a))
}

fn is_even(exponent: &Rational) -> bool {
    (exponent / Rational::from(2)).is_integer()
}

pub(super) fn even_power_of_absolute(graph: &mut Graph, id: Id) -> Option<Id> {
    let factors = factors(graph, id);
    let plain = |(base, exponent): &(Id, Rational)| {
        let a = argument(graph, *base, Function::Abs).filter(|_| is_even(exponent));
        (a.unwrap_or(*base), exponent.clone())
    };
    let changed: Vec<_> = factors.iter().map(plain).collect();
    Some(graph.product(&changed))
}

pub(super) fn root_of_even_power(graph: &mut Graph, id: Id) -> Option<Id> {
    let mut changed = Vec::new();
    for (base, outer) in factors(graph, id) {
        let inner = match graph.node(base) {
            Node::Product(inner) if !outer.is_integer() => inner.clone(),
            _ => Vec::new(),
        };
        match inner.as_slice() {
            [(a, n)] if is_even(n) => {
                changed.push((graph.function(Function::Abs, *a), n * outer));
            }
            _ => changed.push((base, outer)),
        }
    }
    Some(graph.product(&changed))
}

fn choice(graph: &Graph, id: Id) -> Option<(Id, Id, Id)> {
    match *graph.node(id) {
        Node::Select(mask, a, b) => Some((mask, a, b)),
        _ => None,
    }
}

pub(super) fn nested_choice(graph: &mut Graph, id: Id) -> Option<Id> {
    let (mask, a, b) = choice(graph, id)?;
    let inside = |graph: &Graph, id, first: bool| match choice(graph, id) {
        Some((other, a, b)) if other == mask => Some(if first { a } else { b }),
        _ => None,
    };
    let (x, y) = (inside(graph, a, true), inside(graph, b, false));
    x.or(y)?;
    Some(graph.select(mask, x.unwrap_or(a), y.unwrap_or(b)))
}

pub(super) fn sum_of_choices(graph: &mut Graph, id: Id) -> Option<Id> {
    let terms = graph.terms(id);
    let (mask, mut first, mut second, mut rest) = (
        common_mask(graph, terms.iter().map(|(term, _)| *term))?,
        Vec::new(),
        Vec::new(),
        Vec::new(),
    );
    for (term, coefficient) in terms {
        match choice(graph, term).filter(|(other, ..)| *other == mask) {
            Some((_, a, b)) => {
                first.push((a, coefficient.clone()));
                second.push((b, coefficient));
            }
            None => rest.push((term, coefficient)),
        }
    }
    let (first, second) = (graph.sum(&first), graph.sum(&second));
    rest.push((graph.select(mask, first, second), Rational::one()));
    Some(graph.sum(&rest))
}

pub(super) fn product_of_choices(graph: &mut Graph, id: Id) -> Option<Id> {
    let factors = factors(graph, id);
    let mask = common_mask(graph, factors.iter().map(|(base, _)| *base))?;
    let (mut first, mut second, mut rest) = (Vec::new(), Vec::new(), Vec::new());
    for (base, exponent) in factors {
        match choice(graph, base).filter(|(other, ..)| *other == mask) {
            Some((_, a, b)) => {
                // A power of the piece that is not chosen must not be one of zero.
                if exponent.is_negative() && (graph.is_zero(a) || graph.is_zero(b)) {
                    return None;
                }
                first.push((a, exponent.clone()));
                second.push((b, exponent));
            }
            None => rest.push((base, exponent)),
        }
    }
    let (first, second) = (graph.product(&first), graph.product(&second));
    rest.push((graph.select(mask, first, second), Rational::one()));
    Some(graph.product(&rest))
}

/// The condition of two or more of the choices.
fn common_mask(graph: &Graph, ids: impl Iterator<Item = Id>) -> Option<Id> {
    let mut masks = Vec::new();
    for id in ids {
        if let Some((mask, ..)) = choice(graph, id) {
            if masks.contains(&mask) {
                return Some(mask);
            }
            masks.push(mask);
        }
    }
    None
}

pub(super) fn factor_of_choice(graph: &mut Graph, id: Id) -> Option<Id> {
    let (mask, a, b) = choice(graph, id)?;
    if graph.shape(a) != Shape::Scalar {
        return None;
    }
    let (left, right) = (factors_and_coefficient(graph, a), factors_and_coefficient(graph, b));
    let common: Vec<(Id, Rational)> =
        left.1.iter().filter(|factor| right.1.contains(factor)).cloned().collect();
    if common.is_empty() {
        return None;
    }
    let rest = |graph: &mut Graph, (coefficient, factors): (Rational, Vec<(Id, Rational)>)| {
        let rest: Vec<_> = factors.into_iter().filter(|f| !common.contains(f)).collect();
        let product = graph.product(&rest);
        graph.times(coefficient, product)
    };
    let (a, b) = (rest(graph, left), rest(graph, right));
    let mut product = common.clone();
    product.push((graph.select(mask, a, b), Rational::one()));
    Some(graph.product(&product))
}

fn factors_and_coefficient(graph: &Graph, id: Id) -> (Rational, Vec<(Id, Rational)>) {
    match graph.terms(id).as_slice() {
        [(term, coefficient)] => (coefficient.clone(), factors(graph, *term)),
        _ => (Rational::one(), factors(graph, id)),
    }
}

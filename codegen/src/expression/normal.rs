//! Normal form: everything multiplied out, so that two polynomials in scalars, dot products and
//! matrix–vector products are equal exactly if their normal forms are the same node.

use std::collections::BTreeMap;

use num_traits::{One, Signed, ToPrimitive};

use super::graph::Graph;
use super::node::{Id, Node, Rational, Shape};

/// Most terms of an expanded sum; past it the graph counts as exceeded.
const TERMS: usize = 5_000;

/// Whether `a` and `b` are equal as polynomials (functions and choices count as unknowns).
pub(crate) fn equal(graph: &mut Graph, a: Id, b: Id) -> bool {
    let difference = graph.sub(a, b);
    let expanded = expand(graph, difference);
    !graph.exceeded() && graph.is_zero(expanded)
}

/// The normal form of a node.
pub fn expand(graph: &mut Graph, id: Id) -> Id {
    let mut expanded: BTreeMap<Id, Id> = BTreeMap::new();
    for next in graph.reachable(&[id]) {
        if graph.exceeded() {
            let shape = graph.shape(id);
            return graph.zero(shape);
        }
        let form = step(graph, next, &expanded);
        graph.keep(next, form);
        expanded.insert(next, form);
    }
    expanded[&id]
}

fn step(graph: &mut Graph, id: Id, of: &BTreeMap<Id, Id>) -> Id {
    match graph.node(id).clone() {
        Node::Product(factors) => {
            let mut product = graph.integer(1);
            for (base, exponent) in factors {
                product = multiply_power(graph, product, of[&base], &exponent);
            }
            product
        }
        Node::Scale(scalar, x) => pairs(graph, of[&scalar], of[&x], Graph::scale),
        Node::Dot(a, b) => pairs(graph, of[&a], of[&b], dot_of_words),
        Node::Apply(matrix, x) => pairs(graph, of[&matrix], of[&x], Graph::apply),
        Node::Outer(a, b) => pairs(graph, of[&a], of[&b], Graph::outer),
        _ => graph.rebuild(id, &|operand| of[&operand]),
    }
}

/// Σ over the terms of `a` and `b` of `combine`.
fn pairs(graph: &mut Graph, a: Id, b: Id, combine: fn(&mut Graph, Id, Id) -> Id) -> Id {
    let (left, right) = (graph.terms(a), graph.terms(b));
    if left.len() * right.len() > TERMS {
        graph.overflow();
    }
    if graph.exceeded() {
        // A zero of the right shape.
        return combine(graph, a, b);
    }
    let mut parts = Vec::with_capacity(left.len() * right.len());
    for (x, cx) in &left {
        if graph.exceeded() {
            return combine(graph, a, b);
        }
        for (y, cy) in &right {
            parts.push((combine(graph, *x, *y), cx * cy));
        }
    }
    graph.sum(&parts)
}

fn multiply_power(graph: &mut Graph, product: Id, base: Id, exponent: &Rational) -> Id {
    let whole = exponent.is_integer().then(|| exponent.to_u32()).flatten();
    match whole {
        Some(count) if !exponent.is_negative() && matches!(graph.node(base), Node::Sum(_)) => {
            // A number above every bound on exponents stops at the bound on work.
            let mut power = product;
            for _ in 0..count {
                power = pairs(graph, power, base, Graph::mul);
                if graph.exceeded() {
                    break;
                }
            }
            power
        }
        _ => {
            let power = graph.power(base, exponent.clone());
            pairs(graph, product, power, Graph::mul)
        }
    }
}

/// a·b of two words (matrices applied to a symbol, with scalar factors): all matrices move to one side,
/// and of the two ways to write it the one with the smaller symbol in front is taken.
fn dot_of_words(graph: &mut Graph, a: Id, b: Id) -> Id {
    if graph.is_zero(a) || graph.is_zero(b) {
        return graph.zero(Shape::Scalar);
    }
    let ((sa, a), (sb, b)) = (graph.split_scale(a), graph.split_scale(b));
    let factor = graph.mul(sa, sb);
    let forward = gathered(graph, a, b);
    let backward = gathered(graph, b, a);
    let chosen = choose(graph, forward, backward);
    pairs(graph, factor, chosen, Graph::mul)
}

/// x · (W y) with x a symbol: (coefficient, x, W y).
fn gathered(graph: &mut Graph, a: Id, b: Id) -> (Rational, Id, Id) {
    let (mut front, mut back) = (a, b);
    let mut coefficient = Rational::one();
    while let Node::Apply(matrix, inner) = *graph.node(front) {
        let transposed = graph.transpose(matrix);
        let moved = graph.apply(transposed, back);
        let (factor, rest) = graph.split_coefficient(moved);
        coefficient *= factor;
        (front, back) = (inner, rest);
    }
    (coefficient, front, back)
}

fn choose(graph: &mut Graph, a: (Rational, Id, Id), b: (Rational, Id, Id)) -> Id {
    if (a.1, a.2) == (b.1, b.2) && a.0 != b.0 {
        // x·Hx = −x·Hx.
        return graph.zero(Shape::Scalar);
    }
    let (coefficient, front, back) = if (a.1, a.2) <= (b.1, b.2) { a } else { b };
    let dot = graph.intern(Node::Dot(front.min(back), front.max(back)));
    graph.times(coefficient, dot)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::Symmetry;

    #[test]
    fn equality_knows_symmetry_and_skewness() {
        let mut g = Graph::new();
        let (x, y) = (g.vector("x"), g.vector("y"));
        let (s, h) = (g.matrix("S", Symmetry::Symmetric), g.matrix("H", Symmetry::Skew));
        let (sx, sy, hx, hy) = (g.apply(s, x), g.apply(s, y), g.apply(h, x), g.apply(h, y));
        let (a, b) = (g.dot(x, sy), g.dot(y, sx));
        assert!(equal(&mut g, a, b));
        let (a, b) = (g.dot(x, hy), g.dot(y, hx));
        assert!(!equal(&mut g, a, b));
        let minus = g.neg(b);
        assert!(equal(&mut g, a, minus));
        let nothing = g.dot(x, hx);
        assert!(!g.is_zero(nothing));
        let zero = g.integer(0);
        assert!(equal(&mut g, nothing, zero));
        let (a, shx) = (g.dot(sx, hx), g.apply(s, hx));
        let b = g.dot(x, shx);
        assert!(equal(&mut g, a, b));
    }

    #[test]
    fn products_multiply_out() {
        let mut g = Graph::new();
        let (a, b) = (g.scalar("a"), g.scalar("b"));
        let (plus, minus) = (g.add(a, b), g.sub(a, b));
        let product = g.mul(plus, minus);
        let two = Rational::from(2);
        let (aa, bb) = (g.power(a, two.clone()), g.power(b, two));
        let difference = g.sub(aa, bb);
        assert_ne!(product, difference);
        assert!(equal(&mut g, product, difference));
        assert!(g.same_signature(product, difference));
        assert!(!equal(&mut g, product, aa));
    }

    #[test]
    fn derivatives_of_quadratic_forms() {
        let mut g = Graph::new();
        let x = g.vector("x");
        let s = g.matrix("S", Symmetry::Symmetric);
        let sx = g.apply(s, x);
        let form = g.dot(x, sx);
        let gradient = g.differentiate(form, x).expect("a gradient");
        let twice = g.times(Rational::from(2), sx);
        assert_eq!(gradient, twice);
        let hessian = g.differentiate(gradient, x).expect("a Hessian");
        let two_s = g.times(Rational::from(2), s);
        assert_eq!(hessian, two_s);
    }
}

//! Exact numbers and rational functions on the graph: values at points, limits, nearest f64.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::{One, Pow, Signed, ToPrimitive, Zero};

use crate::expression::{Graph, Id, Node, Rational, normal};
use crate::units::nearest;

/// Bits behind the point of an approximated root: far more than 53, so that rounding to f64 is nearest and
/// two exact numbers of a spec that differ are told apart.
const ROOT_BITS: usize = 320;

/// An exact number with roots, approximated to about `ROOT_BITS` bits; `None` if the node is no number.
pub fn approximate(graph: &Graph, id: Id) -> Option<Rational> {
    match graph.node(id) {
        Node::Number(value) => Some(value.clone()),
        Node::Sum(terms) => terms.iter().try_fold(Rational::zero(), |sum, (term, coefficient)| {
            Some(sum + coefficient * approximate(graph, *term)?)
        }),
        Node::Product(factors) => {
            factors.iter().try_fold(Rational::one(), |product, (base, exponent)| {
                let base = approximate(graph, *base)?;
                let twice = exponent * Rational::from_integer(2.into());
                if base.is_zero() || !twice.is_integer() {
                    return None;
                }
                let whole = exponent.is_integer();
                let base = if whole { base } else { root(&base)? };
                let exponent = if whole { exponent } else { &twice };
                Some(product * base.pow(exponent.to_integer().to_i32()?))
            })
        }
        _ => None,
    }
}

fn root(value: &Rational) -> Option<Rational> {
    if value.is_negative() {
        return None;
    }
    let scaled: BigInt = (value.numer() << (2 * ROOT_BITS)) / value.denom();
    Some(Rational::new(scaled.sqrt(), BigInt::one() << ROOT_BITS))
}

/// The f64 nearest to an exact number; `None` if the node is no number.
pub fn to_f64(graph: &Graph, id: Id) -> Option<f64> {
    approximate(graph, id).map(|value| nearest(&value))
}

/// A number as people write it: `3/8`, else six digits.
pub fn display(graph: &Graph, id: Id) -> String {
    match (graph.as_number(id), to_f64(graph, id)) {
        (Some(value), _) if value.denom().bits() + value.numer().bits() < 40 => value.to_string(),
        (_, Some(value)) => format!("{value:.6}"),
        _ => "not a number".to_owned(),
    }
}

/// Numerator and denominator of a rational function, both without negative powers.
fn fraction(graph: &mut Graph, id: Id) -> (Id, Id) {
    let mut parts: BTreeMap<Id, (Id, Id)> = BTreeMap::new();
    let one = graph.integer(1);
    for next in graph.reachable(&[id]) {
        let split = match graph.node(next).clone() {
            Node::Sum(terms) => {
                let mut sum = (graph.integer(0), one);
                for (term, coefficient) in terms {
                    let (above, below) = parts[&term];
                    let above = graph.times(coefficient, above);
                    sum = if below == sum.1 {
                        (graph.add(sum.0, above), below)
                    } else {
                        let (left, right) = (graph.mul(sum.0, below), graph.mul(above, sum.1));
                        (graph.add(left, right), graph.mul(sum.1, below))
                    };
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = (one, one);
                for (base, exponent) in factors {
                    let (mut above, mut below) = parts[&base];
                    if exponent.is_negative() {
                        (above, below) = (below, above);
                    }
                    let exponent = exponent.abs();
                    let (above, below) =
                        (graph.power(above, exponent.clone()), graph.power(below, exponent));
                    product = (graph.mul(product.0, above), graph.mul(product.1, below));
                }
                product
            }
            _ => (next, one),
        };
        parts.insert(next, split);
    }
    parts[&id]
}

/// Whether a rational function vanishes identically.
pub fn is_zero(graph: &mut Graph, id: Id) -> bool {
    let (above, _) = fraction(graph, id);
    let above = normal::expand(graph, above);
    !graph.exceeded() && graph.is_zero(above)
}

/// The value of a rational function at a point, where numerator and denominator may both vanish: the limit
/// from `inside`. `None` if there is none, or if the function is of another kind.
pub fn value_at(
    graph: &mut Graph,
    id: Id,
    coordinates: &[Id; 3],
    point: &[Id; 3],
    inside: &[Rational; 3],
) -> Option<Id> {
    let by: BTreeMap<Id, Id> = coordinates.iter().copied().zip(point.iter().copied()).collect();
    let direct = graph.substitute(id, &by);
    let direct = normal::expand(graph, direct);
    if approximate(graph, direct).is_some() {
        return Some(direct);
    }
    let t = graph.scalar("t");
    let mut by = BTreeMap::new();
    for axis in 0..3 {
        let inside = graph.number(inside[axis].clone());
        let step = graph.sub(inside, point[axis]);
        let along = graph.mul(t, step);
        by.insert(coordinates[axis], graph.add(point[axis], along));
    }
    let along = graph.substitute(id, &by);
    let (above, below) = fraction(graph, along);
    let (above, below) = (lowest(graph, above, t)?, lowest(graph, below, t)?);
    match (above, below) {
        (_, None) => None,
        (None, _) => Some(graph.integer(0)),
        (Some((p, a)), Some((q, b))) => match p.cmp(&q) {
            std::cmp::Ordering::Less => None,
            std::cmp::Ordering::Equal => Some(graph.div(a, b)),
            std::cmp::Ordering::Greater => Some(graph.integer(0)),
        },
    }
}

/// Lowest power of `t` in a polynomial and its coefficient; `Some(None)` of zero, `None` of anything that
/// is no polynomial.
fn lowest(graph: &mut Graph, id: Id, t: Id) -> Option<Option<(u32, Id)>> {
    let expanded = normal::expand(graph, id);
    let mut coefficients: BTreeMap<u32, Vec<(Id, Rational)>> = BTreeMap::new();
    for (term, coefficient) in graph.terms(expanded) {
        let factors = match graph.node(term).clone() {
            Node::Product(factors) => factors,
            _ => vec![(term, Rational::one())],
        };
        let (of_t, rest): (Vec<_>, Vec<_>) = factors.into_iter().partition(|(base, _)| *base == t);
        let power = match of_t.first() {
            Some((_, power)) if power.is_integer() => power.to_integer().to_u32()?,
            Some(_) => return None,
            None => 0,
        };
        let rest = graph.product(&rest);
        if graph.depends(rest, t) {
            return None;
        }
        coefficients.entry(power).or_default().push((rest, coefficient));
    }
    for (power, terms) in coefficients {
        let sum = graph.sum(&terms);
        if approximate(graph, sum)?.abs() > Rational::new(BigInt::one(), BigInt::one() << 200) {
            return Some(Some((power, sum)));
        }
    }
    Some(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_rounded_once() {
        let mut g = Graph::new();
        let three = g.integer(3);
        let root = g.sqrt(three);
        let one = g.integer(1);
        let inverse = g.div(one, root);
        assert_eq!(to_f64(&g, inverse), Some(0.577_350_269_189_625_7));
        let cube = g.power(inverse, Rational::from_integer(3.into()));
        let third = g.times(Rational::new(1.into(), 3.into()), inverse);
        assert_eq!(cube, third);
    }

    #[test]
    fn a_removable_singularity_has_its_limit() {
        let mut g = Graph::new();
        let names = ["xi", "eta", "zeta"].map(|name| g.scalar(name));
        let one = g.integer(1);
        // (1 − ζ + ξ)(1 − ζ)⁻¹·(1 − ζ) at the apex of a pyramid.
        let height = g.sub(one, names[2]);
        let sum = g.add(height, names[0]);
        let square = g.mul(sum, sum);
        let ratio = g.div(square, height);
        let apex = [g.integer(0), g.integer(0), one];
        let centre = crate::element::Cell::Pyramid.centre();
        let value = value_at(&mut g, ratio, &names, &apex, &centre).expect("a limit");
        assert!(g.is_zero(value));
        let pole = g.div(one, height);
        assert_eq!(value_at(&mut g, pole, &names, &apex, &centre), None);
        let same = g.div(square, sum);
        let difference = g.sub(same, sum);
        assert!(is_zero(&mut g, difference));
    }
}

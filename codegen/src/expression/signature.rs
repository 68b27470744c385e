//! The value of every node at fixed points: a check on every pass that must keep the meaning. Values carry a
//! bound of their rounding error, so that the check sees what matters at any scale, and no rounding.

use std::collections::BTreeMap;

use num_traits::{Signed, ToPrimitive};

use super::node::{Id, Node, Rational, Shape, Symmetry};
use crate::operation::{Number, Rounded};
use crate::rational::nearest;

/// Number of points where none are given.
const POINTS: usize = 2;
/// Length of vectors at the points.
const N: usize = 3;
/// Bounds are of first order; two values differ if they are further apart than so many times their bounds.
const BOUNDS: f64 = 8.0;
/// Where even that says nothing: a change of the argument by more than this fraction of it.
const FRACTION: f64 = 1e-3;
/// Below it numbers lose digits.
const TINY: f64 = 1e-290;

/// Where expressions are evaluated: values of scalar symbols by their names. All others have numbers in
/// [0.5, 1.5) that are fixed by their names.
#[derive(Debug, Clone, PartialEq)]
pub struct Points {
    count: usize,
    given: BTreeMap<String, Vec<f64>>,
}

impl Default for Points {
    fn default() -> Self {
        Points { count: POINTS, given: BTreeMap::new() }
    }
}

impl Points {
    /// Points at which these symbols have the given values, as many for each; [`Points::default`] of none.
    pub fn of(given: BTreeMap<String, Vec<f64>>) -> Self {
        match given.values().map(Vec::len).min() {
            Some(count) if count > 0 => Points { count, given },
            _ => Points::default(),
        }
    }

    fn scalar(&self, name: &str, point: usize) -> f64 {
        let given = self.given.get(name).and_then(|values| values.get(point));
        given.copied().unwrap_or_else(|| uniform(name, point, 0))
    }
}

/// The values of all nodes, with n = 3. Truth is 1 and 0, and nothing where rounding decides.
#[derive(Debug, Clone, Default)]
pub(super) struct Signatures {
    points: Points,
    /// Where the numbers of a node begin.
    starts: Vec<usize>,
    /// Of every node, point by point and entry by entry, rows first: values and bounds.
    numbers: Vec<Rounded>,
}

impl Signatures {
    /// Adds a node of this shape whose operands are there.
    pub(super) fn push(&mut self, node: &Node, shape: Shape, shape_of: impl Fn(Id) -> Shape) {
        self.starts.push(self.numbers.len());
        for point in 0..self.points.count {
            for entry in 0..size(shape) {
                let of = |id: Id, entry: usize| {
                    let first = self.starts[id.index()] + size(shape_of(id)) * point;
                    self.numbers[first + entry]
                };
                self.numbers.push(at(node, entry, point, &self.points, &of));
            }
        }
    }

    /// The same nodes at other points.
    pub(super) fn move_to(&mut self, points: Points, nodes: &[Node], shapes: &[Shape]) {
        *self = Signatures { points, ..Signatures::default() };
        for (node, shape) in nodes.iter().zip(shapes) {
            self.push(node, *shape, |id| shapes[id.index()]);
        }
    }

    /// Number of points.
    pub(super) fn points(&self) -> usize {
        self.points.count
    }

    fn of(&self, id: Id) -> &[Rounded] {
        let end = self.starts.get(id.index() + 1).copied().unwrap_or(self.numbers.len());
        &self.numbers[self.starts[id.index()]..end]
    }

    /// All values of a node, point by point.
    #[cfg(test)]
    pub(super) fn values(&self, id: Id) -> impl Iterator<Item = f64> {
        self.of(id).iter().map(|number| number.value)
    }

    /// Whether two nodes agree at all points, to rounding. What is not finite, or decided by rounding, says
    /// nothing and agrees.
    pub(super) fn agree(&self, a: Id, b: Id) -> bool {
        let (a, b) = (self.of(a), self.of(b));
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| agree(a, b))
    }

    /// Whether a node agrees at all points with Σ factor·scalar·rest, whose rests have its shape.
    pub(super) fn is_sum(&self, id: Id, shape: Shape, parts: &[(Rational, Id, Id)]) -> bool {
        let size = size(shape);
        self.of(id).iter().enumerate().all(|(place, expected)| {
            let terms = parts.iter().map(|(factor, scalar, rest)| {
                number(factor).mul(&self.of(*scalar)[place / size]).mul(&self.of(*rest)[place])
            });
            agree(expected, &terms.fold(exactly(0.0), |sum, term| sum.add(&term)))
        })
    }

    /// Whether a scalar agrees at all points with factor·(a·b) of two vectors.
    pub(super) fn is_dot(&self, id: Id, factor: &Rational, [a, b]: [Id; 2]) -> bool {
        let vectors = self.of(a).chunks(N).zip(self.of(b).chunks(N));
        self.of(id).iter().zip(vectors).all(|(expected, (a, b))| {
            let products = a.iter().zip(b).map(|(a, b)| a.mul(b));
            let dot = products.fold(exactly(0.0), |sum, product| sum.add(&product));
            agree(expected, &number(factor).mul(&dot))
        })
    }

    /// Whether a scalar agrees with itself from point to point.
    pub(super) fn is_steady(&self, id: Id) -> bool {
        self.of(id).windows(2).all(|pair| agree(&pair[0], &pair[1]))
    }
}

const NOTHING: Rounded = Rounded { value: f64::NAN, error: f64::NAN };

fn exactly(value: f64) -> Rounded {
    Rounded { value, error: 0.0 }
}

fn agree(a: &Rounded, b: &Rounded) -> bool {
    let bound = BOUNDS * (a.error + b.error) + TINY;
    let far = (a.value - b.value).abs() > bound;
    // False of anything that is not a number.
    !(far && bound.is_finite())
}

/// What has this value and slope at a number.
fn through(at: Rounded, value: f64, slope: f64) -> Rounded {
    // A few units in the last place of the library's functions.
    let rounding = 4.0 * f64::EPSILON * value.abs();
    let inherited = match at.error {
        0.0 => 0.0,
        error => (slope * error).abs(),
    };
    Rounded { value, error: inherited + rounding }
}

fn power(base: Rounded, exponent: &Rational) -> Rounded {
    let e = nearest(exponent);
    let whole = exponent.is_integer().then(|| exponent.abs().to_i32()).flatten().is_some();
    let value = if whole { base.value.powi(e as i32) } else { libm::pow(base.value, e) };
    // Near a pole, or a root, no first order holds.
    if base.error > FRACTION * base.value.abs() && !(whole && e > 0.0) {
        return NOTHING;
    }
    // ε(1 + |e|·|ln b|) of a power whose exponent is rounded.
    let rounding = match whole {
        true => e.abs() * f64::EPSILON * value.abs(),
        false => f64::EPSILON * (value * e * libm::log(base.value)).abs(),
    };
    let found = through(base, value, e * value / base.value);
    let inherited = if base.value == 0.0 { base.error } else { found.error };
    Rounded { value, error: inherited + rounding }
}

fn size(shape: Shape) -> usize {
    match shape {
        Shape::Scalar | Shape::Truth => 1,
        Shape::Vector => N,
        Shape::Matrix => N * N,
    }
}

/// An entry of a node from those of its operands.
fn at(
    node: &Node,
    entry: usize,
    point: usize,
    points: &Points,
    of: &dyn Fn(Id, usize) -> Rounded,
) -> Rounded {
    let scalar = |id: Id| of(id, 0);
    let truth = |id: Id| Some(of(id, 0).value).filter(|v| !v.is_nan()).map(|v| v == 1.0);
    let decided = |truth: Option<bool>| match truth {
        Some(truth) => exactly(f64::from(u8::from(truth))),
        None => NOTHING,
    };
    let sum = |term: &dyn Fn(usize) -> Rounded| {
        (0..N).map(term).reduce(|a, b| a.add(&b)).expect("entries")
    };
    let (i, j) = (entry / N, entry % N);
    match node {
        Node::Number(value) => number(value),
        Node::Zero(_) => exactly(0.0),
        Node::Identity => exactly(f64::from(u8::from(i == j))),
        Node::Symbol(symbol) => exactly(match (symbol.shape, symbol.symmetry) {
            (Shape::Scalar | Shape::Truth, _) => points.scalar(&symbol.name, point),
            (Shape::Matrix, Symmetry::Symmetric) => {
                uniform(&symbol.name, point, N * i.min(j) + i.max(j))
            }
            (Shape::Matrix, Symmetry::Skew) if i == j => 0.0,
            (Shape::Matrix, Symmetry::Skew) if i > j => -uniform(&symbol.name, point, N * j + i),
            (Shape::Matrix | Shape::Vector, _) => uniform(&symbol.name, point, entry),
        }),
        Node::Sum(terms) => {
            let terms = terms.iter().map(|(id, c)| number(c).mul(&of(*id, entry)));
            terms.reduce(|a, b| a.add(&b)).expect("a term")
        }
        Node::Product(factors) => {
            let powers = factors.iter().map(|(id, exponent)| power(scalar(*id), exponent));
            powers.reduce(|a, b| a.mul(&b)).expect("a factor")
        }
        Node::Function(function, a) => {
            let a = scalar(*a);
            let value = function.value(a.value);
            through(a, value, function.slope(&a.value, &value))
        }
        Node::Compare(relation, a, b) => {
            let (a, b) = (scalar(*a), scalar(*b));
            let close = (a.value - b.value).abs() <= BOUNDS * (a.error + b.error);
            let exact = a.error == 0.0 && b.error == 0.0;
            let known = a.value.is_finite() && b.value.is_finite() && (exact || !close);
            decided(known.then_some(relation.holds(a.value, b.value)))
        }
        Node::Truth(value) => decided(Some(*value)),
        Node::And(a, b) => decided(match (truth(*a), truth(*b)) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (a, b) => a.and(b),
        }),
        Node::Or(a, b) => decided(match (truth(*a), truth(*b)) {
            (Some(true), _) | (_, Some(true)) => Some(true),
            (a, b) => a.and(b),
        }),
        Node::Not(a) => decided(truth(*a).map(|truth| !truth)),
        Node::Select(mask, a, b) => match truth(*mask) {
            Some(mask) => of(if mask { *a } else { *b }, entry),
            None => NOTHING,
        },
        Node::Scale(s, x) => scalar(*s).mul(&of(*x, entry)),
        Node::Dot(a, b) => sum(&|k| of(*a, k).mul(&of(*b, k))),
        Node::Apply(m, v) => sum(&|k| of(*m, N * entry + k).mul(&of(*v, k))),
        Node::Transpose(m) => of(*m, N * j + i),
        Node::Outer(a, b) => of(*a, i).mul(&of(*b, j)),
    }
}

fn number(value: &Rational) -> Rounded {
    Rounded::new(nearest(value))
}

/// A number in [0.5, 1.5), fixed by name, point and entry (FNV-1a, then a splitmix finish): positive, so
/// that roots and logarithms of symbols exist.
fn uniform(name: &str, point: usize, entry: usize) -> f64 {
    let bytes = name.bytes().chain([point as u8 + 1, entry as u8 + 1]);
    let mut hash = bytes
        .fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
    hash = (hash ^ (hash >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    hash = (hash ^ (hash >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    hash ^= hash >> 31;
    0.5 + (hash >> 11) as f64 / (1_u64 << 53) as f64
}

//! The value of every node at fixed points: a check on every pass that must keep the meaning. Values carry a
//! bound of their rounding error, so that the check sees what matters at any scale, and no rounding.

use std::collections::BTreeMap;

use num_traits::{Signed, ToPrimitive};

use super::node::{Id, Node, Rational, Relation, Shape, Symmetry};
use crate::rational::nearest;

/// Number of points where none are given.
const POINTS: usize = 2;
/// Length of vectors at the points.
const N: usize = 3;
/// Bounds are of first order; two values differ if they are further apart than so many times their bounds.
const BOUNDS: f64 = 8.0;
/// Where even that says nothing: a change of the argument by more than this share of it.
const SHARE: f64 = 1e-3;
/// Below it numbers lose digits.
const TINY: f64 = 1e-290;

/// Where expressions are looked at: values of scalar symbols by their names. All others have numbers in
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

/// Value of a node at one point, with n = 3, and bounds of the error of each of its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Value {
    Scalar(Near),
    Vector([Near; N]),
    Matrix([[Near; N]; N]),
    /// Nothing where rounding decides.
    Truth(Option<bool>),
}

/// A number that is wrong by at most `error`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Near {
    value: f64,
    error: f64,
}

/// The values of all nodes.
#[derive(Debug, Clone, Default)]
pub(super) struct Signatures {
    points: Points,
    /// Where the numbers of a node begin.
    starts: Vec<usize>,
    /// Of every node, point by point: values and bounds.
    numbers: Vec<Near>,
}

impl Signatures {
    /// Adds a node whose operands are there.
    pub(super) fn push(&mut self, node: &Node, shape_of: impl Fn(Id) -> Shape) {
        self.starts.push(self.numbers.len());
        for point in 0..self.points.count {
            let of = |id: Id| self.value(id, shape_of(id), point);
            match at(node, point, &self.points, &of) {
                Value::Scalar(value) => self.numbers.push(value),
                Value::Vector(values) => self.numbers.extend(values),
                Value::Matrix(rows) => self.numbers.extend(rows.as_flattened()),
                Value::Truth(truth) => {
                    let value = truth.map_or(f64::NAN, |truth| f64::from(u8::from(truth)));
                    self.numbers.push(Near { value, error: 0.0 });
                }
            }
        }
    }

    /// The same nodes at other points.
    pub(super) fn move_to(&mut self, points: Points, nodes: &[Node], shapes: &[Shape]) {
        *self = Signatures { points, ..Signatures::default() };
        nodes.iter().for_each(|node| self.push(node, |id| shapes[id.index()]));
    }

    /// Number of points.
    pub(super) fn points(&self) -> usize {
        self.points.count
    }

    fn value(&self, id: Id, shape: Shape, point: usize) -> Value {
        let size = match shape {
            Shape::Scalar | Shape::Truth => 1,
            Shape::Vector => N,
            Shape::Matrix => N * N,
        };
        let numbers = &self.numbers[self.starts[id.index()] + size * point..][..size];
        match shape {
            Shape::Scalar => Value::Scalar(numbers[0]),
            Shape::Truth if numbers[0].value.is_nan() => Value::Truth(None),
            Shape::Truth => Value::Truth(Some(numbers[0].value == 1.0)),
            Shape::Vector => Value::Vector(std::array::from_fn(|i| numbers[i])),
            Shape::Matrix => {
                Value::Matrix(std::array::from_fn(|i| std::array::from_fn(|j| numbers[N * i + j])))
            }
        }
    }

    fn of(&self, id: Id) -> &[Near] {
        let end = self.starts.get(id.index() + 1).copied().unwrap_or(self.numbers.len());
        &self.numbers[self.starts[id.index()]..end]
    }

    /// All values of a node, point by point.
    pub(super) fn values(&self, id: Id) -> impl Iterator<Item = f64> {
        self.of(id).iter().map(|number| number.value)
    }

    /// Whether two nodes agree at all points, to rounding. What is not finite, or decided by rounding, says
    /// nothing and agrees.
    pub(super) fn agree(&self, a: Id, b: Id) -> bool {
        let (a, b) = (self.of(a), self.of(b));
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.agrees(b))
    }
}

impl Near {
    const NOTHING: Near = Near { value: f64::NAN, error: f64::NAN };

    fn exactly(value: f64) -> Self {
        Near { value, error: 0.0 }
    }

    fn rounded(value: f64) -> Self {
        Near { value, error: f64::EPSILON * value.abs() }
    }

    fn agrees(&self, other: &Near) -> bool {
        let bound = BOUNDS * (self.error + other.error) + TINY;
        let far = (self.value - other.value).abs() > bound;
        // False of anything that is not a number.
        !(far && bound.is_finite())
    }

    fn plus(self, other: Near) -> Self {
        let value = self.value + other.value;
        Near { value, error: self.error + other.error + f64::EPSILON * value.abs() }
    }

    fn times(self, other: Near) -> Self {
        let value = self.value * other.value;
        let inherited = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        Near { value, error: inherited + f64::EPSILON * value.abs() }
    }

    /// A function with this value and slope here.
    fn through(self, value: f64, slope: f64) -> Self {
        // A few units in the last place of the library's functions.
        let rounding = 4.0 * f64::EPSILON * value.abs();
        let inherited = match self.error {
            0.0 => 0.0,
            error => (slope * error).abs(),
        };
        Near { value, error: inherited + rounding }
    }

    fn power(self, exponent: &Rational) -> Self {
        let e = nearest(exponent);
        let whole = exponent.is_integer().then(|| exponent.abs().to_i32()).flatten().is_some();
        let value = if whole { self.value.powi(e as i32) } else { libm::pow(self.value, e) };
        // Near a pole, or a root, no first order holds.
        if self.error > SHARE * self.value.abs() && !(whole && e > 0.0) {
            return Near::NOTHING;
        }
        // ε(1 + |e|·|ln b|) of a power whose exponent is rounded.
        let rounding = match whole {
            true => e.abs() * f64::EPSILON * value.abs(),
            false => f64::EPSILON * (value * e * libm::log(self.value)).abs(),
        };
        let found = self.through(value, e * value / self.value);
        let inherited = if self.value == 0.0 { self.error } else { found.error };
        Near { value, error: inherited + rounding }
    }
}

/// Value of a node from the values of its operands.
fn at(node: &Node, point: usize, points: &Points, of: &dyn Fn(Id) -> Value) -> Value {
    let scalar = |id: Id| match of(id) {
        Value::Scalar(v) => v,
        Value::Vector(_) | Value::Matrix(_) | Value::Truth(_) => Near::NOTHING,
    };
    let vector = |id: Id| match of(id) {
        Value::Vector(v) => v,
        Value::Scalar(_) | Value::Matrix(_) | Value::Truth(_) => [Near::NOTHING; N],
    };
    let matrix = |id: Id| match of(id) {
        Value::Matrix(m) => m,
        Value::Scalar(_) | Value::Vector(_) | Value::Truth(_) => [[Near::NOTHING; N]; N],
    };
    let truth = |id: Id| match of(id) {
        Value::Truth(truth) => truth,
        Value::Scalar(_) | Value::Vector(_) | Value::Matrix(_) => None,
    };
    let zero = Near::exactly(0.0);
    match node {
        Node::Number(value) => Value::Scalar(number(value)),
        Node::Zero(Shape::Matrix) => Value::Matrix([[zero; N]; N]),
        Node::Zero(_) => Value::Vector([zero; N]),
        Node::Identity => Value::Matrix(std::array::from_fn(|i| {
            std::array::from_fn(|j| Near::exactly(f64::from(u8::from(i == j))))
        })),
        Node::Symbol(symbol) => {
            let random = |entry: usize| Near::exactly(uniform(&symbol.name, point, entry));
            match symbol.shape {
                Shape::Scalar | Shape::Truth => {
                    Value::Scalar(Near::exactly(points.scalar(&symbol.name, point)))
                }
                Shape::Vector => Value::Vector(std::array::from_fn(random)),
                Shape::Matrix => Value::Matrix(std::array::from_fn(|i| {
                    std::array::from_fn(|j| match symbol.symmetry {
                        Symmetry::None => random(N * i + j),
                        Symmetry::Symmetric => random(N * i.min(j) + i.max(j)),
                        Symmetry::Skew if i == j => zero,
                        Symmetry::Skew if i < j => random(N * i + j),
                        Symmetry::Skew => Near::exactly(-uniform(&symbol.name, point, N * j + i)),
                    })
                })),
            }
        }
        Node::Sum(terms) => {
            terms.iter().map(|(id, c)| scaled(number(c), of(*id))).reduce(added).expect("a term")
        }
        Node::Product(factors) => {
            let powers = factors.iter().map(|(id, exponent)| scalar(*id).power(exponent));
            Value::Scalar(powers.reduce(Near::times).expect("a factor"))
        }
        Node::Function(function, a) => {
            let a = scalar(*a);
            let value = function.value(a.value);
            Value::Scalar(a.through(value, function.slope(&a.value, &value)))
        }
        Node::Compare(relation, a, b) => {
            let (a, b) = (scalar(*a), scalar(*b));
            let close = (a.value - b.value).abs() <= BOUNDS * (a.error + b.error);
            let exact = a.error == 0.0 && b.error == 0.0;
            let known = a.value.is_finite() && b.value.is_finite() && (exact || !close);
            Value::Truth(known.then_some(match relation {
                Relation::Less => a.value < b.value,
                Relation::LessOrEqual => a.value <= b.value,
            }))
        }
        Node::Truth(value) => Value::Truth(Some(*value)),
        Node::And(a, b) => Value::Truth(match (truth(*a), truth(*b)) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            (None, _) | (_, None) => None,
        }),
        Node::Or(a, b) => Value::Truth(match (truth(*a), truth(*b)) {
            (Some(true), _) | (_, Some(true)) => Some(true),
            (Some(false), Some(false)) => Some(false),
            (None, _) | (_, None) => None,
        }),
        Node::Not(a) => Value::Truth(truth(*a).map(|truth| !truth)),
        Node::Select(mask, a, b) => match truth(*mask) {
            Some(true) => of(*a),
            Some(false) => of(*b),
            None => scaled(Near::NOTHING, of(*a)),
        },
        Node::Scale(s, x) => scaled(scalar(*s), of(*x)),
        Node::Dot(a, b) => Value::Scalar(dot(&vector(*a), &vector(*b))),
        Node::Apply(m, v) => {
            let v = vector(*v);
            Value::Vector(matrix(*m).map(|row| dot(&row, &v)))
        }
        Node::Transpose(m) => {
            let m = matrix(*m);
            Value::Matrix(std::array::from_fn(|i| std::array::from_fn(|j| m[j][i])))
        }
        Node::Outer(a, b) => {
            let (a, b) = (vector(*a), vector(*b));
            Value::Matrix(a.map(|x| b.map(|y| x.times(y))))
        }
    }
}

fn number(value: &Rational) -> Near {
    Near::rounded(nearest(value))
}

fn dot(a: &[Near; N], b: &[Near; N]) -> Near {
    a.iter().zip(b).map(|(x, y)| x.times(*y)).reduce(Near::plus).expect("entries")
}

fn scaled(factor: Near, value: Value) -> Value {
    match value {
        Value::Scalar(v) => Value::Scalar(factor.times(v)),
        Value::Vector(v) => Value::Vector(v.map(|x| factor.times(x))),
        Value::Matrix(m) => Value::Matrix(m.map(|row| row.map(|x| factor.times(x)))),
        Value::Truth(truth) => Value::Truth(truth.filter(|_| factor.value.is_finite())),
    }
}

fn added(a: Value, b: Value) -> Value {
    match (a, b) {
        (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(a.plus(b)),
        (Value::Vector(a), Value::Vector(b)) => {
            Value::Vector(std::array::from_fn(|i| a[i].plus(b[i])))
        }
        (Value::Matrix(a), Value::Matrix(b)) => {
            Value::Matrix(std::array::from_fn(|i| std::array::from_fn(|j| a[i][j].plus(b[i][j]))))
        }
        (a, _) => scaled(Near::NOTHING, a),
    }
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

//! The value of every node at fixed random points: a check on every pass that must keep the meaning.

use num_traits::{Signed, ToPrimitive};

use super::node::{Id, Node, Rational, Relation, Shape, Symmetry};

/// Number of random points.
pub(super) const POINTS: usize = 2;
/// Length of vectors at the random points.
const N: usize = 3;

/// Value of a node at one random point, with n = 3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// A scalar.
    Scalar(f64),
    /// A vector.
    Vector([f64; N]),
    /// A matrix, rows first.
    Matrix([[f64; N]; N]),
    /// A truth value.
    Truth(bool),
}

/// Nearest f64 of an exact number.
pub(super) fn to_f64(value: &Rational) -> f64 {
    value.to_f64().unwrap_or(f64::NAN)
}

/// Whether two signatures agree to rounding. Values that are not finite say nothing and agree.
pub(super) fn agree(a: &[Value; POINTS], b: &[Value; POINTS]) -> bool {
    a.iter().zip(b).all(|(a, b)| {
        let (a, b) = (flat(a), flat(b));
        let scale = a.iter().chain(&b).fold(0.0_f64, |m, v| m.max(v.abs()));
        a.len() == b.len()
            && a.iter().zip(&b).all(|(x, y)| {
                !(x.is_finite() && y.is_finite()) || (x - y).abs() <= 1e-7 * scale.max(1.0)
            })
    })
}

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Scalar(v) => vec![*v],
        Value::Vector(v) => v.to_vec(),
        Value::Matrix(m) => m.as_flattened().to_vec(),
        Value::Truth(t) => vec![f64::from(*t)],
    }
}

/// Value of a node from the values of its operands.
pub(super) fn evaluate<'a>(node: &Node, of: impl Fn(Id) -> &'a [Value; POINTS]) -> [Value; POINTS] {
    std::array::from_fn(|point| at(node, point, &|id| of(id)[point]))
}

fn at(node: &Node, point: usize, of: &dyn Fn(Id) -> Value) -> Value {
    let scalar = |id: Id| match of(id) {
        Value::Scalar(v) => v,
        _ => f64::NAN,
    };
    let vector = |id: Id| match of(id) {
        Value::Vector(v) => v,
        _ => [f64::NAN; N],
    };
    let matrix = |id: Id| match of(id) {
        Value::Matrix(m) => m,
        _ => [[f64::NAN; N]; N],
    };
    let truth = |id: Id| matches!(of(id), Value::Truth(true));
    match node {
        Node::Number(value) => Value::Scalar(to_f64(value)),
        Node::Zero(Shape::Matrix) => Value::Matrix([[0.0; N]; N]),
        Node::Zero(_) => Value::Vector([0.0; N]),
        Node::Identity => {
            Value::Matrix(std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j))))
        }
        Node::Symbol(symbol) => {
            let random = |entry: usize| uniform(&symbol.name, point, entry);
            match symbol.shape {
                Shape::Scalar | Shape::Truth => Value::Scalar(random(0)),
                Shape::Vector => Value::Vector(std::array::from_fn(random)),
                Shape::Matrix => Value::Matrix(std::array::from_fn(|i| {
                    std::array::from_fn(|j| match symbol.symmetry {
                        Symmetry::None => random(N * i + j),
                        Symmetry::Symmetric => random(N * i.min(j) + i.max(j)),
                        Symmetry::Skew if i == j => 0.0,
                        Symmetry::Skew if i < j => random(N * i + j),
                        Symmetry::Skew => -random(N * j + i),
                    })
                })),
            }
        }
        Node::Sum(terms) => {
            terms.iter().map(|(id, c)| scaled(to_f64(c), of(*id))).reduce(added).expect("a term")
        }
        Node::Product(factors) => Value::Scalar(
            factors
                .iter()
                .map(|(id, exponent)| {
                    let (base, e) = (scalar(*id), to_f64(exponent));
                    if exponent.is_integer() && exponent.abs().to_i32().is_some() {
                        base.powi(e as i32)
                    } else {
                        base.powf(e)
                    }
                })
                .product(),
        ),
        Node::Function(function, a) => Value::Scalar(function.value(scalar(*a))),
        Node::Compare(Relation::Less, a, b) => Value::Truth(scalar(*a) < scalar(*b)),
        Node::Compare(Relation::LessOrEqual, a, b) => Value::Truth(scalar(*a) <= scalar(*b)),
        Node::Truth(value) => Value::Truth(*value),
        Node::And(a, b) => Value::Truth(truth(*a) && truth(*b)),
        Node::Or(a, b) => Value::Truth(truth(*a) || truth(*b)),
        Node::Not(a) => Value::Truth(!truth(*a)),
        Node::Select(mask, a, b) => of(if truth(*mask) { *a } else { *b }),
        Node::Scale(s, x) => scaled(scalar(*s), of(*x)),
        Node::Dot(a, b) => {
            Value::Scalar(vector(*a).iter().zip(vector(*b)).map(|(x, y)| x * y).sum())
        }
        Node::Apply(m, v) => {
            let v = vector(*v);
            Value::Vector(matrix(*m).map(|row| row.iter().zip(v).map(|(x, y)| x * y).sum()))
        }
        Node::Transpose(m) => {
            let m = matrix(*m);
            Value::Matrix(std::array::from_fn(|i| std::array::from_fn(|j| m[j][i])))
        }
        Node::Outer(a, b) => {
            let (a, b) = (vector(*a), vector(*b));
            Value::Matrix(a.map(|x| b.map(|y| x * y)))
        }
    }
}

fn scaled(factor: f64, value: Value) -> Value {
    match value {
        Value::Scalar(v) => Value::Scalar(factor * v),
        Value::Vector(v) => Value::Vector(v.map(|x| factor * x)),
        Value::Matrix(m) => Value::Matrix(m.map(|row| row.map(|x| factor * x))),
        Value::Truth(_) => value,
    }
}

fn added(a: Value, b: Value) -> Value {
    match (a, b) {
        (Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(a + b),
        (Value::Vector(a), Value::Vector(b)) => Value::Vector(std::array::from_fn(|i| a[i] + b[i])),
        (Value::Matrix(a), Value::Matrix(b)) => {
            Value::Matrix(std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j])))
        }
        _ => Value::Scalar(f64::NAN),
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

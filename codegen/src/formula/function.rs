//! What can be called in formulas: the functions of one number, and what takes more or other arguments.

use super::SUM;
use crate::expression::Shape;
use crate::operation::Function;

/// Something that can be called in a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Builtin {
    /// A function of one number.
    Function(Function),
    /// √a
    Sqrt,
    /// The angle of the point (x, y) from the axis x, in (−π, π]: atan2(y, x); nothing at the origin.
    Atan2,
    /// sinh a
    Sinh,
    /// cosh a
    Cosh,
    /// The least of two to [`MOST_COMPARED`].
    Min,
    /// The greatest of two to [`MOST_COMPARED`].
    Max,
    /// a·b of vectors
    Dot,
    /// a bᵀ of vectors
    Outer,
    /// Aᵀ of a matrix
    Transpose,
}

/// Most arguments of `min` and `max`: every one of them is compared with what the others leave.
const MOST_COMPARED: usize = 32;

/// All but the functions of one number: name, and the minimum and maximum number of arguments.
const OTHERS: &[(&str, Builtin, [usize; 2])] = &[
    ("sqrt", Builtin::Sqrt, [1, 1]),
    ("atan2", Builtin::Atan2, [2, 2]),
    ("sinh", Builtin::Sinh, [1, 1]),
    ("cosh", Builtin::Cosh, [1, 1]),
    ("min", Builtin::Min, [2, MOST_COMPARED]),
    ("max", Builtin::Max, [2, MOST_COMPARED]),
    ("dot", Builtin::Dot, [2, 2]),
    ("outer", Builtin::Outer, [2, 2]),
    ("transpose", Builtin::Transpose, [1, 1]),
];

/// Names from other languages, and what to write instead.
pub(super) const ELSEWHERE: &[(&str, &str)] = &[
    ("ln", "write `log(…)` for the natural logarithm"),
    ("log10", "write `log(…)/log(10)`"),
    ("pow", "write `a^b`"),
    ("arctan", "write `atan(…)`"),
    ("arsinh", "write `asinh(…)`"),
    ("fabs", "write `abs(…)`"),
    ("if", "write pieces with `when`"),
];

/// Every name that can be called.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    let functions = Function::ALL.iter().map(|function| function.name());
    functions.chain(OTHERS.iter().map(|(name, ..)| *name)).chain([SUM])
}

impl Builtin {
    /// What is called `name`, with the minimum and maximum number of its arguments.
    pub(super) fn named(name: &str) -> Option<(Builtin, [usize; 2])> {
        let other = OTHERS.iter().find(|(known, ..)| *known == name);
        let other = other.map(|(_, builtin, count)| (*builtin, *count));
        other.or_else(|| Some((Builtin::Function(Function::named(name)?), [1, 1])))
    }

    /// The shapes of its arguments and of its value.
    pub(super) fn shapes(self) -> (Shape, Shape) {
        match self {
            Builtin::Dot => (Shape::Vector, Shape::Scalar),
            Builtin::Outer => (Shape::Vector, Shape::Matrix),
            Builtin::Transpose => (Shape::Matrix, Shape::Matrix),
            _ => (Shape::Scalar, Shape::Scalar),
        }
    }
}

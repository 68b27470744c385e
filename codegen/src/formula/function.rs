//! The functions of the formula language, as a table.

/// A function of the language.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Builtin {
    /// √a
    Sqrt,
    /// eᵃ
    Exp,
    /// ln a
    Log,
    /// sin a, a in rad
    Sin,
    /// cos a, a in rad
    Cos,
    /// tan a, a in rad
    Tan,
    /// arctan a, in rad
    Atan,
    /// The angle of the point (x, y) from the axis x, in (−π, π]: atan2(y, x); nothing at the origin.
    Atan2,
    /// sinh a
    Sinh,
    /// cosh a
    Cosh,
    /// tanh a
    Tanh,
    /// |a|
    Abs,
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
pub const MOST_COMPARED: usize = 32;

/// Name, function, and the least and largest number of arguments.
pub const FUNCTIONS: &[(&str, Builtin, usize, usize)] = &[
    ("sqrt", Builtin::Sqrt, 1, 1),
    ("exp", Builtin::Exp, 1, 1),
    ("log", Builtin::Log, 1, 1),
    ("sin", Builtin::Sin, 1, 1),
    ("cos", Builtin::Cos, 1, 1),
    ("tan", Builtin::Tan, 1, 1),
    ("atan", Builtin::Atan, 1, 1),
    ("atan2", Builtin::Atan2, 2, 2),
    ("sinh", Builtin::Sinh, 1, 1),
    ("cosh", Builtin::Cosh, 1, 1),
    ("tanh", Builtin::Tanh, 1, 1),
    ("abs", Builtin::Abs, 1, 1),
    ("min", Builtin::Min, 2, MOST_COMPARED),
    ("max", Builtin::Max, 2, MOST_COMPARED),
    ("dot", Builtin::Dot, 2, 2),
    ("outer", Builtin::Outer, 2, 2),
    ("transpose", Builtin::Transpose, 1, 1),
];

/// Names from other languages, and what to write instead.
pub(super) const ELSEWHERE: &[(&str, &str)] = &[
    ("ln", "write `log(…)` for the natural logarithm"),
    ("log10", "write `log(…)/log(10)`"),
    ("pow", "write `a^b`"),
    ("arctan", "write `atan(…)`"),
    ("fabs", "write `abs(…)`"),
    ("if", "write pieces with `when`"),
];

impl Builtin {
    /// The function called `name`.
    pub fn named(name: &str) -> Option<Builtin> {
        FUNCTIONS.iter().find(|(known, ..)| *known == name).map(|(_, builtin, ..)| *builtin)
    }
}

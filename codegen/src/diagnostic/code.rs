//! The codes of errors, each with what it means and how to fix it.

use std::fmt;

/// A stable code, such as `E010`, under which an error can be looked up in `docs/errors.md`.
///
/// Codes below `E100` belong to specs and formulas; each user of this module numbers its own from there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code(pub &'static str);

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

/// What a code means, and how errors of this code are fixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Explanation {
    /// The code.
    pub code: Code,
    /// What it means.
    pub meaning: &'static str,
    /// How to fix it.
    pub remedy: &'static str,
}

/// Declares codes as constants of a type, and the list of them all, so that none is left out of it.
#[macro_export]
macro_rules! codes {
    ($(#[$about:meta])* $all:ident; $($name:ident $code:literal $meaning:literal $remedy:literal)*) => {
        $(
            #[doc = $meaning]
            pub const $name: $crate::diagnostic::Code = $crate::diagnostic::Code($code);
        )*
        $(#[$about])*
        pub const $all: &[$crate::diagnostic::Explanation] = &[$(
            $crate::diagnostic::Explanation {
                code: $crate::diagnostic::Code($code),
                meaning: $meaning,
                remedy: $remedy,
            },
        )*];
    };
}

impl Code {
    codes! {
        /// Every code of specs and formulas, in the order of the codes.
        ALL;
        TOML "E001" "The file is not TOML."
            "Correct the place shown; strings stand between quotes, and tables begin with `[name]`."
        UNKNOWN_KEY "E002" "A key that nothing reads."
            "Correct its spelling to the name suggested, or take it out."
        MISSING_KEY "E003" "A key that must be there is not."
            "Add it, as the help shows."
        BAD_VALUE "E004" "A value of the wrong type, out of its range, or one of a few words misspelt."
            "Write a value of the kind that the message asks for."
        BAD_NAME "E005" "A name declared twice, taken by the kernels, or no name at all."
            "Choose another name: a letter, then letters, digits and `_`."
        UNUSED "E006" "A declared name that no formula uses."
            "Use it, or take its declaration out."
        SYNTAX "E010" "A formula that the grammar does not allow."
            "Write it with `+ - * / ^`, parentheses, comparisons, `and`, `or`, `not` and calls of functions."
        UNKNOWN_NAME "E011" "A name that nothing declares here."
            "Correct its spelling to a name listed, or declare it."
        BAD_CALL "E012" "A function that does not exist, or that takes another number of arguments."
            "Call one of the functions that the message suggests, with as many arguments as it takes."
        SHAPE "E013" "Numbers, vectors, matrices or conditions that do not fit their places."
            "Bring the part shown into the shape that its place wants."
        DIMENSION "E014" "Quantities whose dimensions do not fit."
            "Add and compare quantities of one dimension only; a parameter with a unit may be missing as a factor."
        LIMIT "E015" "A formula or file beyond a limit on size, depth, exponents or work."
            "Split it, use parameters and definitions, or lower the exponents."
        UNDEFINED "E016" "A division by zero or another operation without a value."
            "Change the part shown so that it has a value, or give that place a piece of its own."
        UNKNOWN_UNIT "E020" "A unit that is not known or not written as one."
            "Write units as in `N*s/mm`, `kg/m^3` or `1`."
        WRONG_UNIT "E021" "A quantity of another dimension, or in another system of units, than wanted."
            "Write the unit that the help names."
        JUMP "E030" "A law whose value jumps where two of its pieces meet."
            "Write `engage = \"root\"` to move the break to where the pieces meet, or `jump = \"accept\"` to keep the jump."
        PIECES "E031" "Pieces of a law that are missing, never apply, or leave places without a value."
            "Give every piece but the last a `when`, and the last one none."
        NO_ROOT "E032" "A law that should engage where two pieces meet, and they never do."
            "Change the pieces, their conditions, or keep the jump by `jump = \"accept\"`."
        TABLE "E033" "A table of a law or of a case whose columns or rows do not fit."
            "Correct the row or the key that the message names; the input must rise from row to row."
        DERIVATIVE "E040" "A derivative that has no form in generated code, or terms that depend on rates they may not."
            "Write the term applied to a vector, declare products of matrices as tensors, keep rates where the message says."
        PROOF "E041" "A declared term that is not the derivative of the other declared terms."
            "Compare the declared term with the derived one that the help shows."
        SHAPE_FUNCTION "E050" "Shape functions that do not sum to one, interpolate the nodes or reproduce the coordinates."
            "Correct the function or the node that the message names."
        QUADRATURE "E051" "A quadrature rule that does not fit the cell, has weights that are not positive, or not its degree."
            "Take a rule of the cell with enough points, or declare the degree that it has."
        PATCH_TEST "E052" "Enhanced modes that do work against a constant stress."
            "Write `jacobian = \"centre\"` and `scale = 'det0/det'`, and modes whose gradients integrate to zero."
        FORM "E053" "A form that is not bilinear in u and v, or out of which enhanced modes cannot be condensed."
            "Write every term with `u` once and `v` once."
    }
}

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
        TOML "E001" "The file is not valid TOML."
            "Correct the line shown; strings are quoted, and tables begin with `[name]`."
        UNKNOWN_KEY "E002" "An unknown key."
            "Use the name suggested, or remove the key."
        MISSING_KEY "E003" "A required key is missing."
            "Add it, as the help shows."
        BAD_VALUE "E004" "A value of the wrong type, out of range, or an unknown keyword."
            "Write a value of the kind that the message asks for."
        BAD_NAME "E005" "A name that is declared twice, reserved, or not valid."
            "Choose another name: a letter, then letters, digits and `_`."
        UNUSED "E006" "A declared name that no formula uses."
            "Use it, or remove its declaration."
        SYNTAX "E010" "A syntax error in a formula."
            "Use `+ - * / ^`, parentheses, comparisons, `and`, `or`, `not` and function calls."
        UNKNOWN_NAME "E011" "An undeclared name."
            "Correct its spelling to a name listed, or declare it."
        BAD_CALL "E012" "An unknown function, or the wrong number of arguments."
            "Call one of the functions that the message suggests, with the right number of arguments."
        SHAPE "E013" "Scalars, vectors, matrices or conditions of the wrong shape."
            "Give the part shown the shape that is required there."
        DIMENSION "E014" "Quantities whose dimensions do not fit."
            "Add and compare quantities of one dimension only; a parameter with a unit may be missing as a factor."
        LIMIT "E015" "A formula or file beyond a limit on size, depth, exponents or work."
            "Split it, use parameters and definitions, or lower the exponents."
        UNDEFINED "E016" "A division by zero or another undefined operation."
            "Change the part shown so that it has a value, or add a piece for that range."
        UNKNOWN_UNIT "E020" "An unknown or malformed unit."
            "Write units as in `N*s/mm`, `kg/m^3` or `1`."
        WRONG_UNIT "E021" "A quantity of the wrong dimension, or in another system of units."
            "Use the unit that the help names."
        JUMP "E030" "The value of a law jumps where two of its pieces meet."
            "Write `engage = \"root\"` to move the break to where the pieces meet, or `jump = \"accept\"` to keep the jump."
        PIECES "E031" "Pieces of a law that are missing, never apply, or leave a range without a value."
            "Give every piece except the last a `when`."
        NO_ROOT "E032" "A law with `engage` whose pieces never meet."
            "Change the pieces or their conditions, or keep the jump with `jump = \"accept\"`."
        TABLE "E033" "Wrong columns or rows in a table of a law or a case."
            "Correct the row or the key that the message names; the input must increase from row to row."
        DERIVATIVE "E040" "A derivative that cannot be generated, or terms that depend on rates where they may not."
            "Write the term applied to a vector, declare products of matrices as tensors, keep rates where the message says."
        PROOF "E041" "A declared term that is not the derivative of the other declared terms."
            "Compare the declared term with the derived one that the help shows."
        SHAPE_FUNCTION "E050" "Shape functions that do not sum to one, interpolate the nodes or reproduce the coordinates."
            "Correct the function or the node that the message names."
        QUADRATURE "E051" "A quadrature rule for another cell, with weights that are not positive, or of a lower \
             degree than declared."
            "Use a rule of this cell with enough points, or declare its actual degree."
        PATCH_TEST "E052" "Enhanced modes that do work against a constant stress."
            "Write `jacobian = \"centre\"` and `scale = 'det0/det'`, and use modes whose gradients integrate to zero."
        FORM "E053" "A form that is not bilinear in u and v, or from which enhanced modes cannot be condensed."
            "Write every term with `u` once and `v` once."
        FILM "E060" "A film that may hold less than nothing, or whose moments do not balance."
            "Correct what a node holds, or the force on the mean motion of the surfaces, as the message says."
    }
}

//! What can be said of a law before it is used: values and slopes at its breaks, sign, monotonicity,
//! poles, and where all this was evaluated. Exactly for piecewise polynomials of one input; for all others
//! on lines through the ranges of the inputs, by direct evaluation of the file's formulas.

use super::table::Extend;

/// What was found about a law.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LawReport {
    /// Name, unit and range of every input over which the law was analysed, in the file's units.
    pub ranges: Vec<(String, String, [f64; 2])>,
    /// One for every table.
    pub tables: Vec<TableReport>,
    /// One for every output, then one for the rate of every state.
    pub outputs: Vec<OutputReport>,
    /// One for every state.
    pub states: Vec<StateReport>,
}

/// How a state comes to rest by itself, all else held, at the points evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct StateReport {
    /// Symbol.
    pub name: String,
    /// Least and largest −∂ẋ/∂x (1/s): the rate at which it relaxes; it grows where that is negative.
    pub rates: [f64; 2],
}

/// What is known of a table, in the units of its columns.
#[derive(Debug, Clone, PartialEq)]
pub struct TableReport {
    /// Symbol.
    pub name: String,
    /// The file as the law names it.
    pub file: String,
    /// Number of rows.
    pub(crate) rows: usize,
    /// What it is looked up by, with its unit.
    pub input: [String; 2],
    /// First and last input.
    pub span: [f64; 2],
    /// What becomes of other inputs.
    pub(crate) extend: Extend,
}

/// What was found about an output, in the file's units.
#[derive(Debug, Clone, PartialEq)]
pub struct OutputReport {
    /// Symbol.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Number of points at which it was evaluated; 0 if all that is said of it is exact.
    pub points: usize,
    /// Least and largest value found.
    pub extent: [f64; 2],
    /// How it changes with each input.
    pub trends: Vec<(String, Trend)>,
    /// The motion that it should oppose, if it is a force against one, and whether it never drives it.
    pub(crate) opposes: Option<(String, bool)>,
    /// Where pieces meet, and where the value or the slope jumps inside them.
    pub breaks: Vec<Break>,
    /// Where a divisor passes through zero: input and value.
    pub(crate) poles: Vec<(String, f64)>,
    /// Inputs at the first point without a finite value, if there is one.
    pub(crate) undefined: Option<Vec<f64>>,
}

/// How an output changes with an input, at the points evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trend {
    /// Not at all.
    Constant,
    /// It never falls.
    Rising,
    /// It never rises.
    Falling,
    /// It does both.
    Mixed,
}

/// A place where two formulas meet, in the file's units.
#[derive(Debug, Clone, PartialEq)]
pub struct Break {
    /// The input that crosses it.
    pub input: String,
    /// Its unit.
    pub unit: String,
    /// Value of the input.
    pub at: f64,
    /// The other inputs there: name, value and unit.
    pub(crate) beside: Vec<(String, f64, String)>,
    /// Value in the file, if `engage` moved the break.
    pub moved_from: Option<f64>,
    /// Length over which `smooth` blends the pieces.
    pub(crate) blended: Option<f64>,
    /// Value of the output below and above; a difference below rounding is not a jump.
    pub values: [f64; 2],
    /// Bound of the rounding error of their difference.
    pub(crate) rounding: f64,
    /// Slope of the output along the input below and above.
    pub slopes: [f64; 2],
}

impl Trend {
    pub(super) fn of(rises: bool, falls: bool) -> Self {
        match (rises, falls) {
            (false, false) => Trend::Constant,
            (true, false) => Trend::Rising,
            (false, true) => Trend::Falling,
            (true, true) => Trend::Mixed,
        }
    }
}

impl Break {
    /// Whether the value jumps, beyond rounding.
    pub fn jumps(&self) -> bool {
        let jump = self.values[1] - self.values[0];
        // Infinite or undefined on one side is a jump too.
        jump.is_nan() || jump.abs() > self.rounding
    }
}

//! What can be said of a law before it is used: values and slopes at its breaks, sign, monotonicity,
//! poles, and where all this was evaluated. Exactly for piecewise polynomials of one input; for all others
//! on lines through the ranges of the inputs, by direct evaluation of the file's formulas.

use std::cell::OnceCell;

use super::analysis::{Analysis, in_file};
use super::describe::{per, short};
use super::exact;
use super::lint;
use super::scan::{self, Lined};
use super::table::Extend;
use super::{LawSpec, LawTable};
use crate::diagnostic::Diagnostics;

/// What was found about a law.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LawReport {
    /// Name, unit and range of every input over which the law was analysed, in the file's units.
    pub ranges: Vec<(String, String, [f64; 2])>,
    /// One for every table.
    pub tables: Vec<TableReport>,
    /// One for every output.
    pub outputs: Vec<OutputReport>,
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
    /// The jump of an output in words.
    pub(super) fn words(&self, name: &str, unit: &str) -> String {
        let size = short((self.values[1] - self.values[0]).abs());
        let per = per(unit, &self.unit);
        let [below, above] = [0, 1].map(|side| {
            format!(
                "{} {unit} with slope {} {per}",
                short(self.values[side]),
                short(self.slopes[side])
            )
        });
        let places = std::iter::once((&self.input, self.at, &self.unit))
            .chain(self.beside.iter().map(|(input, at, unit)| (input, *at, unit)))
            .map(|(input, at, unit)| format!("{input} = {} {unit}", short(at)));
        let place = places.collect::<Vec<_>>().join(", ");
        format!("`{name}` jumps by {size} {unit} at {place}: {below} below, {above} above")
    }

    /// Whether the value jumps, beyond rounding.
    pub fn jumps(&self) -> bool {
        let jump = self.values[1] - self.values[0];
        // Infinite or undefined on one side is a jump too.
        jump.is_nan() || jump.abs() > self.rounding
    }
}

/// Analyses a law. A jump that is not accepted, and a point in a declared range without a finite value,
/// are errors.
pub(super) fn report(law: &LawSpec) -> Result<LawReport, Diagnostics> {
    let ranges = scan::ranges(law);
    let lines = scan::lines(&ranges, scan::terms(law));
    let mut errors = Diagnostics::new();
    lint::tables(law, &lines, &mut errors);
    if !errors.is_empty() {
        return Err(errors);
    }
    let mut outputs = Vec::new();
    // Names have the same values for all outputs.
    let lined: OnceCell<Vec<Lined<'_>>> = OnceCell::new();
    for output in &law.outputs {
        let analysis = Analysis::new(law, output);
        let analysed = match exact::facts(law, output, ranges[0]) {
            Some(facts) => Ok(analysis.exactly(facts)),
            None => analysis.over(
                lined.get_or_init(|| lines.iter().map(|line| Lined::new(law, line)).collect()),
            ),
        };
        match analysed {
            Ok(found) => {
                lint::output(law, output, &found, &mut errors);
                outputs.push(found.report);
            }
            Err(error) => errors.push(error),
        }
    }
    let named = law.inputs.iter().zip(&ranges).map(|(input, range)| {
        let range = range.map(|end| in_file(end, &input.unit));
        (input.name.clone(), input.unit.to_string(), range)
    });
    let tables = law.tables.iter().map(table_report).collect();
    errors.into_result(LawReport { ranges: named.collect(), tables, outputs })
}

fn table_report(table: &LawTable) -> TableReport {
    TableReport {
        name: table.name.clone(),
        file: table.path.clone(),
        rows: table.knots.len(),
        input: [table.input.text.text().to_owned(), table.input_unit.to_string()],
        span: table.ends,
        extend: table.extend,
    }
}

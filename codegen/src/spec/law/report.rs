//! What can be said of a law before it is used: values and slopes at its breaks, sign, monotonicity,
//! poles, and where all this was looked at. Works on the file's formulas by direct evaluation.

use super::describe::short;
use super::poles::Signed;
use super::scan::{self, Line};
use super::{Condition, Extend, LawOutput, LawSpec, scalar};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::formula::{Dual, Rounded};
use crate::units::{Unit, nearest};

/// Poles that are listed, and breaks along one line, beyond which a law is refused.
const MOST_POLES: usize = 16;
const MOST_BREAKS: usize = 256;

/// What was found about a law.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LawReport {
    /// Name, unit and range of every input over which the law was looked at, in the file's units.
    pub ranges: Vec<(String, String, [f64; 2])>,
    /// One for every output.
    pub outputs: Vec<OutputReport>,
}

/// What was found about an output, in the file's units.
#[derive(Debug, Clone, PartialEq)]
pub struct OutputReport {
    /// Symbol.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Number of points at which it was evaluated.
    pub points: usize,
    /// Least and largest value found.
    pub extent: [f64; 2],
    /// How it changes with each input.
    pub trends: Vec<(String, Trend)>,
    /// Where pieces meet.
    pub breaks: Vec<Break>,
    /// Where a divisor passes through zero: input and value.
    pub poles: Vec<(String, f64)>,
    /// Inputs at the first point without a finite value, if there is one.
    pub undefined: Option<Vec<f64>>,
}

/// How an output changes with an input, at the points looked at.
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

/// A place where two pieces meet, in the file's units.
#[derive(Debug, Clone, PartialEq)]
pub struct Break {
    /// The input that crosses it.
    pub input: String,
    /// Its unit.
    pub unit: String,
    /// Value of the input.
    pub at: f64,
    /// Value in the file, if `engage` moved the break.
    pub moved_from: Option<f64>,
    /// Value of the output below and above; a difference below rounding is not a jump.
    pub values: [f64; 2],
    /// Bound of the rounding error of their difference.
    pub rounding: f64,
    /// Slope of the output along the input below and above.
    pub slopes: [f64; 2],
}

impl Break {
    /// Whether the value jumps, beyond rounding.
    pub fn jumps(&self) -> bool {
        let jump = self.values[1] - self.values[0];
        // Infinite or undefined on one side is a jump too.
        jump.is_nan() || jump.abs() > self.rounding
    }
}

/// Looks at a law; a jump that is not accepted, and a point in a declared range without a finite value,
/// are errors.
pub(super) fn report(law: &LawSpec) -> Result<LawReport, Diagnostics> {
    let ranges = scan::ranges(law);
    let lines = scan::lines(&ranges, scan::terms(law));
    let mut errors = Diagnostics::new();
    check_tables(law, &lines, &mut errors);
    if !errors.is_empty() {
        return Err(errors);
    }
    let mut outputs = Vec::new();
    for output in &law.outputs {
        match Look::new(law, output).over(&lines) {
            Ok(found) => {
                check(law, output, &found, &mut errors);
                outputs.push(found.report);
            }
            Err(error) => errors.push(error),
        }
    }
    let named = law.inputs.iter().zip(&ranges).map(|(input, range)| {
        let range = range.map(|end| in_file(end, &input.unit));
        (input.name.clone(), input.unit.to_string(), range)
    });
    errors.into_result(LawReport { ranges: named.collect(), outputs })
}

/// A table without an extension must reach over the declared ranges.
fn check_tables(law: &LawSpec, lines: &[Line], errors: &mut Diagnostics) {
    if law.inputs.iter().any(|input| input.range.is_none()) {
        return;
    }
    for table in law.tables.iter().filter(|table| table.extend == Extend::Refuse) {
        let points = lines.iter().flat_map(|line| line.points.iter().map(|x| line.at(*x)));
        let inputs = points.filter_map(|inputs| {
            scalar(&table.input, &law.names(&inputs).ok()?).ok().filter(|input| input.is_finite())
        });
        let [first, last] = table.span().map(nearest);
        let [low, high] = inputs
            .fold([first, last], |[low, high]: [f64; 2], input| [low.min(input), high.max(input)]);
        for (reached, end) in [(low, first), (high, last)] {
            if !table.is_outside(reached) {
                continue;
            }
            let message = format!(
                "`{}` reaches {}, but the rows of `{}` end at {}",
                table.input.text.text(),
                short(reached),
                table.path,
                short(end)
            );
            let error = table.input.text.error_here(Code::TABLE, message);
            errors.push(error.help(
                "extend the table by `extend = \"constant\"` or `\"linear\"`, or make the `range` of the \
                 inputs smaller",
            ));
        }
    }
}

/// What was seen of an output, and between which pieces each of its breaks lies.
struct Seen {
    report: OutputReport,
    between: Vec<[usize; 2]>,
}

/// One output being looked at.
struct Look<'l> {
    law: &'l LawSpec,
    output: &'l LawOutput,
    seen: Seen,
    /// Signs of the divisors at the point looked at last, if the piece was the same.
    signs_at_last: Option<u64>,
}

fn in_file(si: f64, unit: &Unit) -> f64 {
    si / unit.factor().to_f64()
}

impl<'l> Look<'l> {
    fn new(law: &'l LawSpec, output: &'l LawOutput) -> Self {
        let report = OutputReport {
            name: output.name.clone(),
            unit: output.unit.to_string(),
            points: 0,
            extent: [f64::INFINITY, f64::NEG_INFINITY],
            trends: Vec::new(),
            breaks: Vec::new(),
            poles: Vec::new(),
            undefined: None,
        };
        let seen = Seen { report, between: Vec::new() };
        Look { law, output, seen, signs_at_last: None }
    }

    fn over(mut self, lines: &[Line]) -> Result<Seen, Diagnostic> {
        for input in 0..self.law.inputs.len() {
            let (mut rises, mut falls) = (false, false);
            for line in lines.iter().filter(|line| line.input == input) {
                self.along(line, &mut rises, &mut falls)?;
            }
            let trend = match (rises, falls) {
                (false, false) => Trend::Constant,
                (true, false) => Trend::Rising,
                (false, true) => Trend::Falling,
                (true, true) => Trend::Mixed,
            };
            self.seen.report.trends.push((self.law.inputs[input].name.clone(), trend));
        }
        Ok(self.seen)
    }

    fn along(&mut self, line: &Line, rises: &mut bool, falls: &mut bool) -> Result<(), Diagnostic> {
        let mut before: Option<(f64, usize, Rounded)> = None;
        let mut breaks = 0;
        self.signs_at_last = None;
        for &x in &line.points {
            let inputs: Vec<Rounded> = line.at(x).into_iter().map(Rounded::new).collect();
            let names = self.law.names(&inputs)?;
            let piece = self.output.active(&inputs, &names)?;
            let value = self.output.value_at(&inputs, &names)?;
            self.record(line, x, value.value);
            if let Some((low, other, last)) = before {
                let rounding = value.error + last.error;
                *rises |= value.value - last.value > rounding;
                *falls |= last.value - value.value > rounding;
                if other == piece {
                    self.poles(line, piece, low, x)?;
                } else {
                    self.signs_at_last = None;
                    self.breaks(line, low, x, &mut breaks)?;
                }
            }
            before = Some((x, piece, value));
        }
        Ok(())
    }

    fn record(&mut self, line: &Line, x: f64, si: f64) {
        let report = &mut self.seen.report;
        report.points += 1;
        let value = in_file(si, &self.output.unit);
        if value.is_finite() {
            report.extent = [report.extent[0].min(value), report.extent[1].max(value)];
        } else if report.undefined.is_none() {
            let inputs = line.at(x).into_iter().zip(&self.law.inputs);
            report.undefined = Some(inputs.map(|(x, input)| in_file(x, &input.unit)).collect());
        }
    }

    fn active(&self, line: &Line, x: f64) -> Result<usize, Diagnostic> {
        let inputs = line.at(x);
        self.output.active(&inputs, &self.law.names(&inputs)?)
    }

    /// Finds every break between two points by bisection.
    fn breaks(
        &mut self,
        line: &Line,
        mut low: f64,
        high: f64,
        count: &mut usize,
    ) -> Result<(), Diagnostic> {
        let last = self.active(line, high)?;
        loop {
            let first = self.active(line, low)?;
            if first == last {
                return Ok(());
            }
            *count += 1;
            if *count > MOST_BREAKS {
                let message = format!("`{}` has more than {MOST_BREAKS} breaks", self.output.name);
                let place = scan::place_of(&self.output.pieces[first]);
                return Err(place.error_here(Code::LIMIT, message));
            }
            let (a, b) = match self.known_end(line, first, low, high)? {
                Some(neighbours) => neighbours,
                None => scan::bisect(low, high, |x| Ok(self.active(line, x)? == first))?,
            };
            let second = self.active(line, b)?;
            self.meet(line, a, b, [first, second])?;
            low = b;
        }
    }

    /// Neighbours of the threshold at which a piece ends, if it ends at one between two points.
    fn known_end(
        &self,
        line: &Line,
        piece: usize,
        low: f64,
        high: f64,
    ) -> Result<Option<(f64, f64)>, Diagnostic> {
        let Some(Condition::Threshold { input, at, .. }) = &self.output.pieces[piece].when else {
            return Ok(None);
        };
        let at = nearest(at);
        let (below, above) = (at.next_down(), at.next_up());
        if *input != line.input || below < low || above > high {
            return Ok(None);
        }
        let ends = self.active(line, below)? == piece && self.active(line, above)? != piece;
        Ok(ends.then_some((below, above)))
    }

    /// Records the break between neighbours `a` and `b` where `pieces` meet.
    fn meet(&mut self, line: &Line, a: f64, b: f64, pieces: [usize; 2]) -> Result<(), Diagnostic> {
        let threshold = pieces.iter().find_map(|piece| match &self.output.pieces[*piece].when {
            Some(Condition::Threshold { input, at, moved_from, .. })
                if *input == line.input && (a..=b).contains(&nearest(at)) =>
            {
                Some((nearest(at), moved_from.as_ref().map(nearest)))
            }
            _ => None,
        });
        let (at, moved_from) = threshold.unwrap_or((b, None));
        let input = &self.law.inputs[line.input];
        let unit = &self.output.unit;
        let mut values = [0.0; 2];
        let mut slopes = [0.0; 2];
        let mut rounding = 0.0;
        // Beside a blended break both sides are the same function.
        let blended = pieces.iter().any(|piece| {
            matches!(
                self.output.pieces[*piece].when,
                Some(Condition::Threshold { blend: Some(_), .. })
            )
        });
        for (side, piece) in pieces.into_iter().enumerate() {
            let rounded: Vec<Rounded> = line.at(at).into_iter().map(Rounded::new).collect();
            let names = self.law.names(&rounded)?;
            let value = match blended {
                true => self.output.value_at(&rounded, &names)?,
                false => self.output.value_of(piece, &names)?,
            };
            values[side] = in_file(value.value, unit);
            rounding += in_file(value.error, unit);
            let duals: Vec<Dual> = (line.at(at).into_iter().enumerate())
                .map(|(i, x)| Dual { value: x, slope: f64::from(i == line.input) })
                .collect();
            let names = self.law.names(&duals)?;
            let value = match blended {
                true => self.output.value_at(&duals, &names)?,
                false => self.output.value_of(piece, &names)?,
            };
            slopes[side] = in_file(value.slope, unit) * input.unit.factor().to_f64();
        }
        let found = Break {
            input: input.name.clone(),
            unit: input.unit.to_string(),
            at: in_file(at, &input.unit),
            moved_from: moved_from.map(|at| in_file(at, &input.unit)),
            values,
            rounding,
            slopes,
        };
        let size = |b: &Break| if b.jumps() { (b.values[1] - b.values[0]).abs() } else { 0.0 };
        let (breaks, between) = (&mut self.seen.report.breaks, &mut self.seen.between);
        let same =
            (0..breaks.len()).find(|&i| breaks[i].input == found.input && between[i] == pieces);
        match same {
            Some(i) if size(&breaks[i]) >= size(&found) => {}
            Some(i) => breaks[i] = found,
            None => {
                breaks.push(found);
                between.push(pieces);
            }
        }
        Ok(())
    }

    /// Records where a divisor of a piece changes its sign between two points.
    fn poles(&mut self, line: &Line, piece: usize, low: f64, high: f64) -> Result<(), Diagnostic> {
        let signs = |x: f64| -> Result<u64, Diagnostic> {
            let inputs: Vec<Signed> = line.at(x).into_iter().map(Signed::new).collect();
            Ok(self.output.value_of(piece, &self.law.names(&inputs)?)?.signs)
        };
        if self.seen.report.poles.len() == MOST_POLES {
            return Ok(());
        }
        let first = self.signs_at_last.take().map_or_else(|| signs(low), Ok)?;
        let last = signs(high)?;
        self.signs_at_last = Some(last);
        if first == last {
            return Ok(());
        }
        let (_, at) = scan::bisect(low, high, |x| Ok(signs(x)? == first))?;
        let input = &self.law.inputs[line.input];
        let pole = (input.name.clone(), in_file(at, &input.unit));
        if !self.seen.report.poles.contains(&pole) {
            self.seen.report.poles.push(pole);
        }
        Ok(())
    }
}

fn check(law: &LawSpec, output: &LawOutput, seen: &Seen, errors: &mut Diagnostics) {
    for (found, pieces) in seen.report.breaks.iter().zip(&seen.between) {
        if output.accepts_jumps || !found.jumps() {
            continue;
        }
        let piece = pieces[0].min(pieces[1]);
        let (unit, at) = (&output.unit, short(found.at));
        let [below, above] = found.values.map(short);
        let size = short((found.values[1] - found.values[0]).abs());
        let message = format!(
            "`{}` jumps by {size} {unit} at {} = {at} {}: {below} {unit} below, {above} {unit} above",
            output.name, found.input, found.unit
        );
        let root = root_beside(law, output, piece, found);
        let help = match root {
            Some(root) => format!(
                "`engage = \"root\"` moves the break to {} = {} {}, where the pieces meet; \
                 `jump = \"accept\"` keeps the jump",
                found.input,
                short(root),
                found.unit
            ),
            None => "change the pieces so that they meet, or keep the jump by `jump = \"accept\"`"
                .to_owned(),
        };
        let place = scan::place_of(&output.pieces[piece]);
        errors.push(place.error_here(Code::JUMP, message).help(help));
    }
    let declared = law.inputs.iter().all(|input| input.range.is_some());
    if let (Some(point), true) = (&seen.report.undefined, declared) {
        let point: Vec<String> = (law.inputs.iter().zip(point))
            .map(|(input, x)| format!("{} = {} {}", input.name, short(*x), input.unit))
            .collect();
        let message = format!("`{}` has no finite value at {}", output.name, point.join(", "));
        let place = scan::place_of(&output.pieces[0]);
        let help = "give this place a piece of its own, or make the `range` of the inputs smaller";
        errors.push(place.error_here(Code::UNDEFINED, message).help(help));
    }
}

/// Where `engage` would move a break to, in the file's unit.
fn root_beside(law: &LawSpec, output: &LawOutput, piece: usize, found: &Break) -> Option<f64> {
    let root = super::build::engaged(law, &output.pieces, piece)?;
    let input = law.inputs.iter().find(|input| input.name == found.input)?;
    Some(in_file(nearest(&root), &input.unit))
}

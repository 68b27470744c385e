//! What can be said of a law before it is used: values and slopes at its breaks, sign, monotonicity,
//! poles, and where all this was looked at. Exactly for piecewise polynomials of one input; for all others
//! on lines through the ranges of the inputs, by direct evaluation of the file's formulas.

use super::branch::Branches;
use std::collections::BTreeMap;

use super::describe::{per, short};
use super::exact;
use super::poles::Signed;
use super::scan::{self, Line};
use super::{Condition, Extend, LawOutput, LawSpec, LawTable, scalar};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::formula::{Dual, Rounded};
use crate::units::{Unit, nearest};

/// Poles that are listed, and breaks along one line, beyond which a law is refused.
const MOST_POLES: usize = 16;
const MOST_BREAKS: usize = 256;
/// Share of the distance between two points that counts as the same place.
const NEAR: f64 = 1e-9;
/// How often a comparison inside a formula of several inputs is looked at along one of them: where its break
/// lies changes from line to line.
const MOST_LOOKS: usize = 4;

/// What was found about a law.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LawReport {
    /// Name, unit and range of every input over which the law was looked at, in the file's units.
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
    pub rows: usize,
    /// What it is looked up by, with its unit.
    pub input: [String; 2],
    /// First and last input.
    pub span: [f64; 2],
    /// What becomes of other inputs.
    pub extend: Extend,
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
    pub opposes: Option<(String, bool)>,
    /// Where pieces meet, and where the value or the slope jumps inside them.
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

/// A place where two formulas meet, in the file's units.
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
    /// Length over which `smooth` blends the pieces.
    pub blended: Option<f64>,
    /// Value of the output below and above; a difference below rounding is not a jump.
    pub values: [f64; 2],
    /// Bound of the rounding error of their difference.
    pub rounding: f64,
    /// Slope of the output along the input below and above.
    pub slopes: [f64; 2],
}

impl Trend {
    fn of(rises: bool, falls: bool) -> Self {
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
    fn words(&self, name: &str, unit: &str) -> String {
        let size = short((self.values[1] - self.values[0]).abs());
        let per = per(unit, &self.unit);
        let [below, above] = [0, 1].map(|side| {
            format!(
                "{} {unit} with slope {} {per}",
                short(self.values[side]),
                short(self.slopes[side])
            )
        });
        format!(
            "`{name}` jumps by {size} {unit} at {} = {} {}: {below} below, {above} above",
            self.input,
            short(self.at),
            self.unit
        )
    }

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
        let look = Look::new(law, output);
        let looked = match exact::facts(law, output, ranges[0]) {
            Some(facts) => look.exactly(facts),
            None => look.over(&lines),
        };
        match looked {
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
    between: Vec<Between>,
}

/// What a break lies between: two pieces, or two sides of a comparison inside one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Between {
    pieces: [usize; 2],
    comparison: Option<usize>,
}

/// Slopes that differ by less than this share of them are the same: at neighbouring numbers, those of a power
/// such as 3/2 differ by the root of rounding, which differences of large terms enlarge.
const SAME_SLOPE: f64 = 1e-4;

/// Forces of friction, with the motions that they should oppose.
const OPPOSED: [(&str, &str); 2] = [("T", "v_t"), ("M_z", "omega")];

/// One output being looked at.
struct Look<'l> {
    law: &'l LawSpec,
    output: &'l LawOutput,
    seen: Seen,
    branches: Branches,
    /// How often comparisons were looked at, by input and comparison.
    looks: BTreeMap<(usize, Option<usize>), usize>,
    /// Place of the input that the output should oppose.
    motion: Option<usize>,
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
            opposes: None,
            breaks: Vec::new(),
            poles: Vec::new(),
            undefined: None,
        };
        let seen = Seen { report, between: Vec::new() };
        let motion = OPPOSED.iter().find(|(force, _)| *force == output.name);
        let motion = motion
            .and_then(|(_, motion)| law.inputs.iter().position(|input| input.name == *motion));
        let branches = Branches::of(law, output);
        Look { law, output, seen, branches, looks: BTreeMap::new(), motion, signs_at_last: None }
    }

    fn over(mut self, lines: &[Line]) -> Result<Seen, Diagnostic> {
        for input in 0..self.law.inputs.len() {
            let (mut rises, mut falls) = (false, false);
            for line in lines.iter().filter(|line| line.input == input) {
                self.along(line, &mut rises, &mut falls)?;
            }
            let trend = Trend::of(rises, falls);
            self.seen.report.trends.push((self.law.inputs[input].name.clone(), trend));
        }
        Ok(self.seen)
    }

    /// The report of a piecewise polynomial of one input.
    fn exactly(mut self, facts: exact::Facts) -> Result<Seen, Diagnostic> {
        let (input, unit) = (&self.law.inputs[0], &self.output.unit);
        let report = &mut self.seen.report;
        report.extent = facts.extent.map(|value| in_file(value, unit));
        report.trends = vec![(input.name.clone(), Trend::of(facts.rises, facts.falls))];
        report.opposes = None;
        for meeting in facts.meetings {
            if meeting.piece.is_none() && !meeting.jumps && !meeting.kinks {
                continue;
            }
            let at = nearest(&meeting.at);
            let piece = match meeting.piece {
                Some(piece) => piece,
                None => self.output.active(&[at], &self.law.names(&[at])?)?,
            };
            let moved_from = match &self.output.pieces[piece].when {
                Some(Condition::Threshold { moved_from: Some(from), .. }) => Some(nearest(from)),
                _ => None,
            };
            let moved_from = moved_from.filter(|_| meeting.piece.is_some());
            let per = input.unit.factor().to_f64();
            self.seen.report.breaks.push(Break {
                input: input.name.clone(),
                unit: input.unit.to_string(),
                at: in_file(at, &input.unit),
                moved_from: moved_from.map(|from| in_file(from, &input.unit)),
                blended: None,
                values: meeting.values.map(|value| in_file(value, unit)),
                rounding: in_file(meeting.rounding, unit),
                slopes: meeting.slopes.map(|slope| in_file(slope, unit) * per),
            });
            let pieces = [piece, piece + usize::from(meeting.piece.is_some())];
            self.seen.between.push(Between { pieces, comparison: None });
        }
        // Nothing jumps at a blended break, but it is one.
        let range = scan::ranges(self.law)[0];
        for place in 0..self.output.pieces.len() {
            let Some(Condition::Threshold { at, blend: Some(_), .. }) =
                &self.output.pieces[place].when
            else {
                continue;
            };
            let at = nearest(at);
            if (range[0]..=range[1]).contains(&at) {
                self.meet(&Line::alone(at), at, at, [place, place + 1])?;
            }
        }
        Ok(self.seen)
    }

    fn along(&mut self, line: &Line, rises: &mut bool, falls: &mut bool) -> Result<(), Diagnostic> {
        let mut before: Option<(f64, usize, Rounded, Vec<bool>)> = None;
        let mut breaks = 0;
        self.signs_at_last = None;
        for &x in &line.points {
            let inputs: Vec<Rounded> = line.at(x).into_iter().map(Rounded::new).collect();
            let names = self.law.names(&inputs)?;
            let piece = self.output.active(&inputs, &names)?;
            let value = self.output.value_at(&inputs, &names)?;
            self.record(line, x, value.value);
            let sides = self.branches.sides(&line.at(x));
            if let Some((low, other, last, before)) = before {
                let rounding = value.error + last.error;
                *rises |= value.value - last.value > rounding;
                *falls |= last.value - value.value > rounding;
                if other == piece {
                    // With several inputs, only where no formula changes: there is no time for all others.
                    if before == sides || self.law.inputs.len() == 1 {
                        self.poles(line, piece, low, x)?;
                    } else {
                        self.signs_at_last = None;
                    }
                    self.kinks(line, piece, (low, x), (before, &sides), &mut breaks)?;
                } else {
                    self.signs_at_last = None;
                    self.breaks(line, low, x, &mut breaks)?;
                }
            }
            before = Some((x, piece, value, sides));
        }
        Ok(())
    }

    fn record(&mut self, line: &Line, x: f64, si: f64) {
        let report = &mut self.seen.report;
        report.points += 1;
        let value = in_file(si, &self.output.unit);
        if let Some(motion) = self.motion {
            let against = !(value * line.at(x)[motion] > 0.0);
            let name = &self.law.inputs[motion].name;
            let opposes = report.opposes.get_or_insert_with(|| (name.clone(), true));
            opposes.1 &= against;
        }
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

    /// Finds where the value or the slope jumps inside a piece, between two points on different sides of a
    /// comparison.
    fn kinks(
        &mut self,
        line: &Line,
        piece: usize,
        (mut low, high): (f64, f64),
        (mut sides, last): (Vec<bool>, &[bool]),
        count: &mut usize,
    ) -> Result<(), Diagnostic> {
        while sides != last && *count < MOST_BREAKS {
            *count += 1;
            let first = sides.iter().zip(last).position(|(a, b)| a != b);
            let looks = self.looks.entry((line.input, first)).or_insert(0);
            *looks += 1;
            if self.law.inputs.len() > 1 && *looks > MOST_LOOKS {
                return Ok(());
            }
            let (a, b) =
                scan::bisect(low, high, |x| Ok(self.branches.sides(&line.at(x)) == sides))?;
            let next = self.branches.sides(&line.at(b));
            // Bisection ends at the smallest numbers beside zero.
            let place = if b.abs() <= NEAR * NEAR * (high - low) { 0.0 } else { b };
            let comparison = sides.iter().zip(&next).position(|(a, b)| a != b);
            let (unit, input) = (&self.output.unit, &self.law.inputs[line.input]);
            let (mut values, mut slopes, mut rounding) = ([0.0; 2], [0.0; 2], 0.0);
            for (side, x) in [a, b].into_iter().enumerate() {
                let inputs: Vec<Rounded> = line.at(x).into_iter().map(Rounded::new).collect();
                let value = self.output.value_at(&inputs, &self.law.names(&inputs)?)?;
                let duals: Vec<Dual> = (line.at(x).into_iter().enumerate())
                    .map(|(i, x)| Dual { value: x, slope: f64::from(i == line.input) })
                    .collect();
                let dual = self.output.value_at(&duals, &self.law.names(&duals)?)?;
                values[side] = in_file(value.value, unit);
                slopes[side] = in_file(dual.slope, unit) * input.unit.factor().to_f64();
                rounding += in_file(value.error + (dual.slope * (b - a)).abs(), unit);
            }
            let found = Break {
                input: input.name.clone(),
                unit: input.unit.to_string(),
                at: in_file(place, &input.unit),
                moved_from: None,
                blended: None,
                values,
                rounding,
                slopes,
            };
            let steepest = slopes[0].abs().max(slopes[1].abs());
            let kink = (slopes[1] - slopes[0]).abs() > SAME_SLOPE * steepest;
            let finite = values.iter().all(|value| value.is_finite());
            if finite && (found.jumps() || kink) {
                self.keep(found, Between { pieces: [piece, piece], comparison });
            }
            (low, sides) = (b, next);
        }
        Ok(())
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
        let blend = pieces.iter().find_map(|piece| match &self.output.pieces[*piece].when {
            Some(Condition::Threshold { blend: Some(half), .. }) => Some(2.0 * nearest(half)),
            _ => None,
        });
        let blended = blend.is_some();
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
            blended: blend.map(|length| in_file(length, &input.unit)),
            values,
            rounding,
            slopes,
        };
        self.keep(found, Between { pieces, comparison: None });
        Ok(())
    }

    /// Lists a break; of those between the same formulas along different lines, the one that jumps most.
    fn keep(&mut self, found: Break, between: Between) {
        let size = |b: &Break| if b.jumps() { (b.values[1] - b.values[0]).abs() } else { 0.0 };
        let (breaks, seen) = (&mut self.seen.report.breaks, &mut self.seen.between);
        let several = self.law.inputs.len() > 1;
        let same = (0..breaks.len()).find(|&i| {
            breaks[i].input == found.input
                && seen[i] == between
                && (several || breaks[i].at == found.at)
        });
        match same {
            Some(i) if size(&breaks[i]) >= size(&found) => {}
            Some(i) => breaks[i] = found,
            None => {
                breaks.push(found);
                seen.push(between);
            }
        }
    }

    /// Records where a divisor of a piece changes its sign between two points.
    fn poles(&mut self, line: &Line, piece: usize, low: f64, high: f64) -> Result<(), Diagnostic> {
        let signs = |x: f64| -> Result<u64, Diagnostic> {
            let inputs: Vec<Signed> = line.at(x).into_iter().map(Signed::new).collect();
            Ok(self.output.value_of(piece, &self.law.names(&inputs)?)?.signs)
        };
        // Of several inputs, where the pole of one lies depends on the others: one is an example.
        let name = &self.law.inputs[line.input].name;
        let known = self.seen.report.poles.iter().any(|(input, _)| input == name);
        if self.seen.report.poles.len() == MOST_POLES || known && self.law.inputs.len() > 1 {
            return Ok(());
        }
        let first = self.signs_at_last.take().map_or_else(|| signs(low), Ok)?;
        let last = signs(high)?;
        self.signs_at_last = Some(last);
        if first == last {
            return Ok(());
        }
        let (below, at) = scan::bisect(low, high, |x| Ok(signs(x)? == first))?;
        // A choice between formulas changes what is divided by; that is no pole. Formulas and graph round
        // differently, so that the choice is looked for a little around.
        let around = NEAR * (high - low);
        let sides = [below - around, at + around].map(|x| self.branches.sides(&line.at(x)));
        if sides[0] != sides[1] {
            return Ok(());
        }
        let input = &self.law.inputs[line.input];
        let pole = (input.name.clone(), in_file(at, &input.unit));
        if !self.seen.report.poles.contains(&pole) {
            self.seen.report.poles.push(pole);
        }
        Ok(())
    }
}

fn check(law: &LawSpec, output: &LawOutput, seen: &Seen, errors: &mut Diagnostics) {
    for (found, between) in seen.report.breaks.iter().zip(&seen.between) {
        if output.accepts_jumps || !found.jumps() {
            continue;
        }
        let piece = between.pieces[0].min(between.pieces[1]);
        let place = scan::place_of(&output.pieces[piece]);
        let error =
            place.error_here(Code::JUMP, found.words(&output.name, &output.unit.to_string()));
        errors.push(error.help(remedies(law, output, piece, found)));
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

/// What can be done about a jump.
fn remedies(law: &LawSpec, output: &LawOutput, piece: usize, found: &Break) -> String {
    let (input, unit) = (&found.input, &found.unit);
    let mut ways = Vec::new();
    if let Some(root) = root_beside(law, output, piece, found) {
        let root = short(root);
        ways.push(format!(
            "`engage = \"root\"` moves the break to {input} = {root} {unit}, where the pieces meet"
        ));
    }
    let threshold = matches!(output.pieces[piece].when, Some(Condition::Threshold { .. }));
    if threshold {
        // A twentieth of the distance from zero, to one digit, as an example of a length.
        let length = if found.at == 0.0 { 0.1 } else { found.at.abs() / 20.0 };
        let length: f64 = format!("{length:.0e}").parse().unwrap_or(length);
        ways.push(format!(
            "`smooth = \"{} {unit}\"` blends the pieces over that length of {input}",
            short(length)
        ));
    }
    ways.push("`jump = \"accept\"` keeps the jump".to_owned());
    ways.join("; ")
}

/// Where `engage` would move a break to, in the file's unit.
fn root_beside(law: &LawSpec, output: &LawOutput, piece: usize, found: &Break) -> Option<f64> {
    let root = super::build::engaged(law, &output.pieces, piece)?;
    let input = law.inputs.iter().find(|input| input.name == found.input)?;
    Some(in_file(nearest(&root), &input.unit))
}

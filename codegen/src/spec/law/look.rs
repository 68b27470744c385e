//! One output being looked at, and what is seen of it.

use std::collections::BTreeMap;

use super::branch::Branches;
use super::exact;
use super::poles::Signed;
use super::report::{Break, OutputReport, Trend};
use super::scan::{self, Line, Lined, Point, names_at};
use super::{Condition, LawOutput, LawSpec, Named};
use crate::diagnostic::{Code, Diagnostic};
use crate::formula::{Dual, Rounded};
use crate::rational::nearest;
use crate::units::Unit;

/// Poles that are listed, and breaks along one line, beyond which a law is refused.
const MOST_POLES: usize = 16;
const MOST_BREAKS: usize = 256;
/// Share of the distance between two points that counts as the same place.
const NEAR: f64 = 1e-9;
/// How often a comparison inside a formula of several inputs is looked at along one of them: where its break
/// lies changes from line to line.
const MOST_LOOKS: usize = 4;

/// What was seen of an output, and between which pieces each of its breaks lies.
pub(super) struct Seen {
    pub(super) report: OutputReport,
    pub(super) between: Vec<Between>,
}

/// What a break lies between: two pieces, or two sides of a comparison inside one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Between {
    pub(super) pieces: [usize; 2],
    comparison: Option<usize>,
}

/// Slopes that differ by less than this share of them are the same: at neighbouring numbers, those of a power
/// such as 3/2 differ by the root of rounding, which differences of large terms enlarge.
const SAME_SLOPE: f64 = 1e-4;

/// Forces of friction, with the motions that they should oppose.
const OPPOSED: [(&str, &str); 2] = [("T", "v_t"), ("M_z", "omega")];

/// One output being looked at.
pub(super) struct Look<'l> {
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

pub(super) fn in_file(si: f64, unit: &Unit) -> f64 {
    si / unit.factor().to_f64()
}

impl<'l> Look<'l> {
    pub(super) fn new(law: &'l LawSpec, output: &'l LawOutput) -> Self {
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

    pub(super) fn over(mut self, lines: &[Lined<'l>]) -> Result<Seen, Diagnostic> {
        for input in 0..self.law.inputs.len() {
            let (mut rises, mut falls) = (false, false);
            for Lined { line, points } in lines.iter().filter(|lined| lined.line.input == input) {
                self.along(line, points, &mut rises, &mut falls)?;
            }
            let trend = Trend::of(rises, falls);
            self.seen.report.trends.push((self.law.inputs[input].name.clone(), trend));
        }
        Ok(self.seen)
    }

    /// The report of a piecewise polynomial of one input.
    pub(super) fn exactly(mut self, facts: exact::Facts) -> Result<Seen, Diagnostic> {
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

    fn along(
        &mut self,
        line: &Line,
        points: &[Point<'l>],
        rises: &mut bool,
        falls: &mut bool,
    ) -> Result<(), Diagnostic> {
        let mut before: Option<(&Point<'l>, usize, Rounded, Vec<bool>)> = None;
        let mut breaks = 0;
        self.signs_at_last = None;
        for point in points {
            let Point { x, inputs, names, .. } = point;
            let x = *x;
            let piece = self.output.active(inputs, names)?;
            let value = self.output.value_at(inputs, names)?;
            self.record(line, x, value.value);
            let sides = self.branches.sides(&line.at(x));
            if let Some((low_point, other, last, before)) = before {
                let low = low_point.x;
                let rounding = value.error + last.error;
                *rises |= value.value - last.value > rounding;
                *falls |= last.value - value.value > rounding;
                if other == piece {
                    // With several inputs, only where no formula changes: there is no time for all others.
                    if before == sides || self.law.inputs.len() == 1 {
                        self.poles(line, piece, low_point, point)?;
                    } else {
                        self.signs_at_last = None;
                    }
                    self.kinks(line, piece, (low, x), (before, &sides), &mut breaks)?;
                } else {
                    self.signs_at_last = None;
                    self.breaks(line, low, x, &mut breaks)?;
                }
            }
            before = Some((point, piece, value, sides));
        }
        Ok(())
    }

    fn record(&mut self, line: &Line, x: f64, si: f64) {
        let report = &mut self.seen.report;
        report.points += 1;
        let value = in_file(si, &self.output.unit);
        if let Some(motion) = self.motion {
            let against = (value * line.at(x)[motion]).max(0.0) == 0.0;
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
    fn poles(
        &mut self,
        line: &Line,
        piece: usize,
        low: &Point<'l>,
        high: &Point<'l>,
    ) -> Result<(), Diagnostic> {
        let signs = |names: &Named<'l, Signed>| -> Result<u64, Diagnostic> {
            Ok(self.output.value_of(piece, names)?.signs)
        };
        // Of several inputs, where the pole of one lies depends on the others: one is an example.
        let name = &self.law.inputs[line.input].name;
        let known = self.seen.report.poles.iter().any(|(input, _)| input == name);
        if self.seen.report.poles.len() == MOST_POLES || known && self.law.inputs.len() > 1 {
            return Ok(());
        }
        let first = match self.signs_at_last {
            Some(signs) => signs,
            None => signs(low.signed(self.law, line)?)?,
        };
        let last = signs(high.signed(self.law, line)?)?;
        self.signs_at_last = Some(last);
        if first == last {
            return Ok(());
        }
        let (low, high) = (low.x, high.x);
        let (below, at) = scan::bisect(low, high, |x| {
            Ok(signs(&names_at(self.law, line, x, Signed::new)?)? == first)
        })?;
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

//! Analysis of one output of a law along lines through the ranges of its inputs.

mod breaks;
mod poles;

use std::collections::BTreeMap;

use super::branch::Branches;
use super::exact;
use super::poles::Signs;
use super::report::{Break, OutputReport, Trend};
use super::scan::{self, Line, Lined, Point};
use super::{Condition, LawOutput, LawSpec};
use crate::diagnostic::Diagnostic;
use crate::operation::Rounded;
use crate::rational::nearest;
use crate::units::Unit;

/// Fraction of the distance between two points that counts as the same place.
const NEAR: f64 = 1e-9;

/// What was found about an output, and between which pieces each of its breaks lies.
pub(super) struct Findings {
    pub(super) report: OutputReport,
    pub(super) between: Vec<Between>,
}

/// What a break lies between: two pieces, or two sides of a comparison inside one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Between {
    pub(super) pieces: [usize; 2],
    comparison: Option<usize>,
}

/// Forces of friction, with the motions that they should oppose.
const OPPOSED: [(&str, &str); 2] = [("T", "v_t"), ("M_z", "omega")];

/// The analysis of one output.
pub(super) struct Analysis<'l> {
    law: &'l LawSpec,
    output: &'l LawOutput,
    findings: Findings,
    branches: Branches,
    /// How often comparisons were met, by input and comparison.
    visits: BTreeMap<(usize, Option<usize>), usize>,
    /// Place of the input that the output should oppose.
    motion: Option<usize>,
    /// Signs of the divisors at the last point, if the piece was the same.
    signs_at_last: Option<Signs>,
}

pub(super) fn in_file(si: f64, unit: &Unit) -> f64 {
    si / unit.factor().to_f64()
}

impl<'l> Analysis<'l> {
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
        let findings = Findings { report, between: Vec::new() };
        let motion = OPPOSED.iter().find(|(force, _)| *force == output.name);
        let motion = motion
            .and_then(|(_, motion)| law.inputs.iter().position(|input| input.name == *motion));
        let branches = Branches::of(law, output);
        Analysis {
            law,
            output,
            findings,
            branches,
            visits: BTreeMap::new(),
            motion,
            signs_at_last: None,
        }
    }

    pub(super) fn over(mut self, lines: &[Lined<'_>]) -> Result<Findings, Diagnostic> {
        for input in 0..self.law.inputs.len() {
            let (mut rises, mut falls) = (false, false);
            for Lined { line, points } in lines.iter().filter(|lined| lined.line.input == input) {
                self.along(line, points, &mut rises, &mut falls)?;
            }
            let trend = Trend::of(rises, falls);
            self.findings.report.trends.push((self.law.inputs[input].name.clone(), trend));
        }
        Ok(self.findings)
    }

    /// The report of a piecewise polynomial of one input.
    pub(super) fn exactly(mut self, facts: exact::Facts) -> Findings {
        let (input, unit) = (&self.law.inputs[0], &self.output.unit);
        let report = &mut self.findings.report;
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
                None => self.output.active(&[at], &self.law.names(&[at])),
            };
            let moved_from = match &self.output.pieces[piece].when {
                Some(Condition::Threshold { moved_from: Some(from), .. }) => Some(nearest(from)),
                _ => None,
            };
            let moved_from = moved_from.filter(|_| meeting.piece.is_some());
            let per = input.unit.factor().to_f64();
            self.findings.report.breaks.push(Break {
                input: input.name.clone(),
                unit: input.unit.to_string(),
                at: in_file(at, &input.unit),
                beside: Vec::new(),
                moved_from: moved_from.map(|from| in_file(from, &input.unit)),
                blended: None,
                values: meeting.values.map(|value| in_file(value, unit)),
                rounding: in_file(meeting.rounding, unit),
                slopes: meeting.slopes.map(|slope| in_file(slope, unit) * per),
            });
            let pieces = [piece, piece + usize::from(meeting.piece.is_some())];
            self.findings.between.push(Between { pieces, comparison: None });
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
                self.meet(&Line::alone(at), at, at, [place, place + 1]);
            }
        }
        self.findings
    }

    fn along(
        &mut self,
        line: &Line,
        points: &[Point],
        rises: &mut bool,
        falls: &mut bool,
    ) -> Result<(), Diagnostic> {
        let mut before: Option<(&Point, usize, Rounded, Vec<bool>)> = None;
        let mut breaks = 0;
        self.signs_at_last = None;
        for point in points {
            let Point { x, inputs, names, .. } = point;
            let x = *x;
            let piece = self.output.active(inputs, names);
            let value = self.output.value_at(inputs, names);
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
                        self.poles(line, piece, low_point, point);
                    } else {
                        self.signs_at_last = None;
                    }
                    self.kinks(line, piece, (low, x), (before, &sides), &mut breaks);
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
        let report = &mut self.findings.report;
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

    fn active(&self, line: &Line, x: f64) -> usize {
        let inputs = line.at(x);
        self.output.active(&inputs, &self.law.names(&inputs))
    }

    /// Lists a break; of those between the same formulas along different lines, the one that jumps most.
    fn keep(&mut self, found: Break, between: Between) {
        let size = |b: &Break| if b.jumps() { (b.values[1] - b.values[0]).abs() } else { 0.0 };
        let (breaks, known) = (&mut self.findings.report.breaks, &mut self.findings.between);
        let several = self.law.inputs.len() > 1;
        let same = (0..breaks.len()).find(|&i| {
            breaks[i].input == found.input
                && known[i] == between
                && (several || breaks[i].at == found.at)
        });
        match same {
            Some(i) if size(&breaks[i]) >= size(&found) => {}
            Some(i) => breaks[i] = found,
            None => {
                breaks.push(found);
                known.push(between);
            }
        }
    }
}

//! Poles along a line: where a factor of something that a formula divides by changes its sign.

use super::super::Named;
use super::super::poles::WithSigns;
use super::super::scan::{self, Line, Point, names_at};
use super::{Analysis, NEAR, in_file};

/// Poles that are listed.
const MOST_POLES: usize = 16;

impl Analysis<'_> {
    /// Records where a divisor of a piece changes its sign between two points.
    pub(super) fn poles(&mut self, line: &Line, piece: usize, low: &Point, high: &Point) {
        let signs = |names: &Named<WithSigns>| self.output.value_of(piece, names).signs;
        // Of several inputs, where the pole of one lies depends on the others: one is an example.
        let name = &self.law.inputs[line.input].name;
        let known = self.findings.report.poles.iter().any(|(input, _)| input == name);
        if self.findings.report.poles.len() == MOST_POLES || known && self.law.inputs.len() > 1 {
            return;
        }
        let first = match self.signs_at_last {
            Some(signs) => signs,
            None => signs(low.signed(self.law, line)),
        };
        let last = signs(high.signed(self.law, line));
        self.signs_at_last = Some(last);
        if first == last {
            return;
        }
        let (low, high) = (low.x, high.x);
        let (below, at) = scan::bisect(low, high, |x| {
            signs(&names_at(self.law, line, x, WithSigns::new)) == first
        });
        // A choice between formulas changes what is divided by; that is no pole. Formulas and graph round
        // differently, so that the choice is also evaluated a little below and above.
        let around = NEAR * (high - low);
        let sides = [below - around, at + around].map(|x| self.branches.sides(&line.at(x)));
        if sides[0] != sides[1] {
            return;
        }
        let input = &self.law.inputs[line.input];
        let pole = (input.name.clone(), in_file(at, &input.unit));
        if !self.findings.report.poles.contains(&pole) {
            self.findings.report.poles.push(pole);
        }
    }
}

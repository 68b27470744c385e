//! Breaks along a line: where pieces meet, and where a formula changes inside one.

use super::super::Condition;
use super::super::report::Break;
use super::super::scan::{self, Line};
use super::{Analysis, Between, NEAR, in_file};
use crate::diagnostic::{Code, Diagnostic};
use crate::operation::{Dual, Rounded};
use crate::rational::nearest;

/// Breaks along one line beyond which a law is refused.
const MOST_BREAKS: usize = 256;
/// How often a comparison inside a formula of several inputs is followed along one of them: where its break
/// lies changes from line to line.
const MOST_VISITS: usize = 4;
/// Slopes that differ by less than this fraction of them are the same: at neighbouring numbers, those of a power
/// such as 3/2 differ by the root of rounding, which differences of large terms enlarge.
const SAME_SLOPE: f64 = 1e-4;

/// The output on one side of a break, in the units of the file.
struct OnSide {
    value: f64,
    error: f64,
    /// By the input of the line.
    slope: f64,
}

impl Analysis<'_> {
    /// Finds every break between two points by bisection.
    pub(super) fn breaks(
        &mut self,
        line: &Line,
        mut low: f64,
        high: f64,
        count: &mut usize,
    ) -> Result<(), Diagnostic> {
        let last = self.active(line, high);
        loop {
            let first = self.active(line, low);
            if first == last {
                return Ok(());
            }
            *count += 1;
            if *count > MOST_BREAKS {
                let message = format!("`{}` has more than {MOST_BREAKS} breaks", self.output.name);
                let place = scan::place_of(&self.output.pieces[first]);
                return Err(place.error_here(Code::LIMIT, message));
            }
            let (a, b) = match self.known_end(line, first, low, high) {
                Some(neighbours) => neighbours,
                None => scan::bisect(low, high, |x| self.active(line, x) == first),
            };
            let second = self.active(line, b);
            self.meet(line, a, b, [first, second]);
            low = b;
        }
    }

    /// Finds where the value or the slope jumps inside a piece, between two points on different sides of a
    /// comparison.
    pub(super) fn kinks(
        &mut self,
        line: &Line,
        piece: usize,
        (mut low, high): (f64, f64),
        (mut sides, last): (Vec<bool>, &[bool]),
        count: &mut usize,
    ) {
        while sides != last && *count < MOST_BREAKS {
            *count += 1;
            let first = sides.iter().zip(last).position(|(a, b)| a != b);
            let visits = self.visits.entry((line.input, first)).or_insert(0);
            *visits += 1;
            if self.law.inputs.len() > 1 && *visits > MOST_VISITS {
                return;
            }
            let (a, b) = scan::bisect(low, high, |x| self.branches.sides(&line.at(x)) == sides);
            let next = self.branches.sides(&line.at(b));
            // Bisection ends at the smallest numbers beside zero.
            let place = if b.abs() <= NEAR * NEAR * (high - low) { 0.0 } else { b };
            let comparison = sides.iter().zip(&next).position(|(a, b)| a != b);
            let input = &self.law.inputs[line.input];
            let (mut values, mut slopes, mut rounding) = ([0.0; 2], [0.0; 2], 0.0);
            for (side, x) in [a, b].into_iter().enumerate() {
                let found = self.side(line, x, None);
                let apart = (b - a) / input.unit.factor().to_f64();
                (values[side], slopes[side]) = (found.value, found.slope);
                rounding += found.error + (found.slope * apart).abs();
            }
            let found = Break {
                input: input.name.clone(),
                unit: input.unit.to_string(),
                at: in_file(place, &input.unit),
                beside: self.beside(line),
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
    }

    /// Neighbours of the threshold at which a piece ends, if it ends at one between two points.
    fn known_end(&self, line: &Line, piece: usize, low: f64, high: f64) -> Option<(f64, f64)> {
        let Some(Condition::Threshold { input, at, .. }) = &self.output.pieces[piece].when else {
            return None;
        };
        let at = nearest(at);
        let (below, above) = (at.next_down(), at.next_up());
        if *input != line.input || below < low || above > high {
            return None;
        }
        let ends = self.active(line, below) == piece && self.active(line, above) != piece;
        ends.then_some((below, above))
    }

    /// Records the break between neighbours `a` and `b` where `pieces` meet.
    pub(super) fn meet(&mut self, line: &Line, a: f64, b: f64, pieces: [usize; 2]) {
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
        let (mut values, mut slopes, mut rounding) = ([0.0; 2], [0.0; 2], 0.0);
        let blend = pieces.iter().find_map(|piece| match &self.output.pieces[*piece].when {
            Some(Condition::Threshold { blend: Some(half), .. }) => Some(2.0 * nearest(half)),
            _ => None,
        });
        for (side, piece) in pieces.into_iter().enumerate() {
            // Beside a blended break both sides are the same function.
            let found = self.side(line, at, blend.is_none().then_some(piece));
            (values[side], slopes[side]) = (found.value, found.slope);
            rounding += found.error;
        }
        let found = Break {
            input: input.name.clone(),
            unit: input.unit.to_string(),
            at: in_file(at, &input.unit),
            beside: self.beside(line),
            moved_from: moved_from.map(|at| in_file(at, &input.unit)),
            blended: blend.map(|length| in_file(length, &input.unit)),
            values,
            rounding,
            slopes,
        };
        self.keep(found, Between { pieces, comparison: None });
    }

    /// The inputs that a line keeps.
    fn beside(&self, line: &Line) -> Vec<(String, f64, String)> {
        let values = line.at(0.0);
        let inputs = self.law.inputs.iter().zip(values).enumerate();
        inputs
            .filter(|(place, _)| *place != line.input)
            .map(|(_, (input, value))| {
                (input.name.clone(), in_file(value, &input.unit), input.unit.to_string())
            })
            .collect()
    }

    /// The output at a point of a line, or one of its pieces there.
    fn side(&self, line: &Line, x: f64, piece: Option<usize>) -> OnSide {
        let rounded: Vec<Rounded> = line.at(x).into_iter().map(Rounded::new).collect();
        let duals: Vec<Dual> = (line.at(x).into_iter().enumerate())
            .map(|(i, x)| Dual { value: x, slope: f64::from(i == line.input) })
            .collect();
        let (names, dual_names) = (self.law.names(&rounded), self.law.names(&duals));
        let (value, dual) = match piece {
            Some(piece) => {
                (self.output.value_of(piece, &names), self.output.value_of(piece, &dual_names))
            }
            None => {
                let value = self.output.value_at(&rounded, &names);
                (value, self.output.value_at(&duals, &dual_names))
            }
        };
        let (unit, per) = (&self.output.unit, self.law.inputs[line.input].unit.factor().to_f64());
        OnSide {
            value: in_file(value.value, unit),
            error: in_file(value.error, unit),
            slope: in_file(dual.slope, unit) * per,
        }
    }
}

//! Breaks blended over a length by `smooth`: from −½ to ½ of the length beside the break, the pieces on both
//! sides are weighted with the smoothstep w = s²(3 − 2s), whose slope is zero at both ends, so that value and
//! slope are continuous whatever the pieces do.

use crate::rational::{Rational, nearest};

use super::draft::Output;
use super::{Condition, LawInput, LawOutput, Named, Piece};
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Graph, Id, Relation};
use crate::operation::Number;
use crate::units::Unit;

/// Gives every break of an output the length of its `smooth`, if there is one.
pub(super) fn set(
    output: &Output,
    inputs: &[LawInput],
    pieces: &mut [Piece],
) -> Result<(), Diagnostics> {
    let Some((length, place)) = &output.smooth else { return Ok(()) };
    let mut errors = Diagnostics::new();
    let last = pieces.len() - 1;
    if last == 0 {
        let error =
            place.error_here(Code::PIECES, "`smooth` needs pieces with a break between them");
        errors.push(error.help("leave it out"));
    }
    for piece in &mut pieces[..last] {
        let Some(Condition::Threshold { input, blend, text, .. }) = &mut piece.when else {
            let message = "`smooth` needs conditions such as `h < c0`: one input and a constant";
            errors.push(place.error_here(Code::PIECES, message));
            break;
        };
        let unit: &Unit = &inputs[*input].unit;
        match length.expect(unit.dimension()) {
            Ok(si) => {
                let half = si / 2.0;
                *blend = Rational::from_float(half);
            }
            Err(error) => {
                let at =
                    format!("the break `{}` is blended over {}", text.text(), unit.dimension());
                let error = place.error(error.code, error.span, error.message);
                errors
                    .push(error.help(format!("{at}: write for example `smooth = \"0.1 {unit}\"`")));
                break;
            }
        }
    }
    errors.into_result(())
}

/// A piece with what follows it on the graph, blended beside the threshold `at` of `x`.
pub(super) fn lower(
    graph: &mut Graph,
    x: Id,
    (at, below, half): (&Rational, bool, &Rational),
    piece: Id,
    rest: Id,
) -> Id {
    let [start, end] = [at - half, at + half].map(|edge| graph.number(edge));
    let (before, behind) = if below { (piece, rest) } else { (rest, piece) };
    let distance = graph.sub(x, start);
    let s = graph.times((half + half).recip(), distance);
    let (three, two) = (graph.integer(3), Rational::from(2));
    let twice = graph.times(two.clone(), s);
    let falling = graph.sub(three, twice);
    let square = graph.power(s, two);
    let weight = graph.mul(square, falling);
    let difference = graph.sub(behind, before);
    let part = graph.mul(weight, difference);
    let blended = graph.add(before, part);
    let (not_yet, still) =
        (graph.compare(Relation::Less, x, start), graph.compare(Relation::Less, x, end));
    let later = graph.select(still, blended, behind);
    graph.select(not_yet, before, later)
}

impl LawOutput {
    /// The value, SI, by direct evaluation.
    pub(super) fn value_at<N: Number>(&self, inputs: &[N], names: &Named<N>) -> N {
        self.value_from(0, inputs, names)
    }

    /// The value of the pieces from `first` on.
    fn value_from<N: Number>(&self, first: usize, inputs: &[N], names: &Named<N>) -> N {
        for place in first..self.pieces.len() {
            let Some(Condition::Threshold { input, at, below, blend: Some(half), .. }) =
                &self.pieces[place].when
            else {
                if self.holds(place, inputs, names) {
                    return self.value_of(place, names);
                }
                continue;
            };
            let x = &inputs[*input];
            let (start, end) = (at - half, at + half);
            let side = match x.value() {
                x if x < nearest(&start) => Some(true),
                x if x < nearest(&end) => None,
                _ => Some(false),
            };
            match side {
                Some(side) if side == *below => return self.value_of(place, names),
                Some(_) => continue,
                None => {}
            }
            let (piece, rest) =
                (self.value_of(place, names), self.value_from(place + 1, inputs, names));
            let (before, behind) = if *below { (piece, rest) } else { (rest, piece) };
            let number = |value: i64| N::exact(&Rational::from(value));
            let s = x.sub(&N::exact(&start)).div(&N::exact(&(half + half)));
            let weight = s.mul(&s).mul(&number(3).sub(&number(2).mul(&s)));
            return before.add(&behind.sub(&before).mul(&weight));
        }
        // The last piece has no condition.
        self.value_of(self.pieces.len() - 1, names)
    }
}

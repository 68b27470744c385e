//! Breaks moved to where the pieces beside them meet.

use super::super::root::Polynomial;
use super::super::{Condition, LawInput, LawSpec, Piece, scan};
use crate::diagnostic::{Code, Diagnostics, Located};
use crate::expression::{Graph, Id};
use crate::rational::Rational;

/// The root of the difference of a piece and the next that lies nearest to the break between them.
fn nearest_root(
    graph: &mut Graph,
    x: Id,
    difference: Id,
    at: &Rational,
) -> Result<Rational, String> {
    let polynomial = Polynomial::of(graph, difference, x)
        .ok_or("`engage = \"root\"` needs pieces that are polynomials in the input of the break")?;
    polynomial
        .root_nearest(at)
        .ok_or_else(|| "the pieces beside the break never have the same value".to_owned())
}

/// Where `engage` would move the break after a piece to, SI; `None` if nowhere.
pub(in crate::kinds::law) fn engaged(
    law: &LawSpec,
    pieces: &[Piece],
    place: usize,
) -> Option<Rational> {
    let [Piece { when: Some(Condition::Threshold { input, at, .. }), node, .. }, next] =
        pieces.get(place..place + 2)?
    else {
        return None;
    };
    let mut graph = law.graph.clone();
    let difference = graph.sub(*node, next.node);
    nearest_root(&mut graph, law.inputs[*input].symbol, difference, at).ok()
}

/// Moves every break to the nearest place where the pieces beside it meet.
pub(super) fn engage(
    graph: &mut Graph,
    inputs: &[LawInput],
    pieces: &mut [Piece],
) -> Result<(), Diagnostics> {
    let places: Vec<Located> = pieces.iter().map(|piece| scan::place_of(piece).clone()).collect();
    let mut errors = Diagnostics::new();
    let thresholds: Vec<Option<(usize, Rational)>> = (pieces.iter())
        .map(|piece| match &piece.when {
            Some(Condition::Threshold { input, at, .. }) => Some((*input, at.clone())),
            _ => None,
        })
        .collect();
    let last = pieces.len() - 1;
    for place in 0..last {
        let difference = graph.sub(pieces[place].node, pieces[place + 1].node);
        let Some(Condition::Threshold { input, at, moved_from, .. }) = &mut pieces[place].when
        else {
            let message = "`engage = \"root\"` needs conditions such as `h < c0`: one input and a \
                           constant";
            errors.push(places[place].error_here(Code::NO_ROOT, message.to_owned()));
            continue;
        };
        if graph.is_zero(difference) {
            continue;
        }
        match nearest_root(graph, inputs[*input].symbol, difference, at) {
            Ok(root) => {
                let (low, high) = ((&root).min(at).clone(), (&root).max(at).clone());
                let mut others = thresholds.iter().enumerate().filter(|(other, _)| *other != place);
                let crossed = others.any(|(_, other)| {
                    matches!(other, Some((i, x)) if i == input && low <= *x && *x <= high)
                });
                if crossed {
                    errors.push(places[place].error_here(
                        Code::NO_ROOT,
                        "the root nearest to a break lies past another".to_owned(),
                    ));
                } else if root != *at {
                    *moved_from = Some(std::mem::replace(at, root));
                }
            }
            Err(message) => {
                let error = places[place].error_here(Code::NO_ROOT, message);
                errors.push(error.help(
                    "change the pieces or the break, or keep the jump by `jump = \"accept\"`",
                ));
            }
        }
    }
    errors.into_result(())
}

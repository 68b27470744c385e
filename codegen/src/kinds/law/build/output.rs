//! An output: its pieces and conditions lowered, and the choice between them.

use num_traits::Signed;

use super::super::blend;
use super::super::draft::{Jumps, Output};
use super::super::root::Polynomial;
use super::super::{Condition, LawInput, LawOutput, Piece, in_si};
use super::engage::engage;
use super::names::Names;
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Graph, Id, Node, Relation, Shape};
use crate::formula::Formula;

/// Lowers an output: conditions, pieces, and the choice between them.
pub(super) fn lower(
    output: Output,
    graph: &mut Graph,
    names: &Names,
    inputs: &[LawInput],
) -> Result<LawOutput, Diagnostics> {
    let mut errors = Diagnostics::new();
    let variable = &output.variable;
    let wanted = variable.unit.dimension().without_angle();
    let (mut conditions, mut pieces) = (Vec::new(), Vec::new());
    for (when, value) in &output.pieces {
        let lowered = names.lower(graph, value, Shape::Scalar).and_then(|(id, found)| match found
            .filter(|found| *found != wanted)
        {
            Some(found) => {
                let message = format!("`{}` is {wanted}, but this is {found}", variable.name);
                let help = "a parameter with a unit is missing as a factor; a number as a factor \
                                takes any unit";
                Err(value.text.error_here(Code::DIMENSION, message).help(help).into())
            }
            None => Ok(graph.times(in_si(&variable.unit), id)),
        });
        let node = lowered.unwrap_or_else(|found| {
            errors.append(found);
            graph.integer(0)
        });
        let condition = match when {
            None => None,
            Some(when) => match names.lower(graph, when, Shape::Truth) {
                Ok((id, _)) => {
                    conditions.push(id);
                    let threshold = threshold(graph, id, inputs, when);
                    Some(threshold.unwrap_or_else(|| Condition::Formula(when.clone())))
                }
                Err(found) => {
                    errors.append(found);
                    Some(Condition::Formula(when.clone()))
                }
            },
        };
        pieces.push(Piece { when: condition, value: value.clone(), node });
    }
    errors.into_result(())?;
    if output.jumps == Jumps::Engaged {
        engage(graph, inputs, &mut pieces)?;
    }
    blend::set(&output, inputs, &mut pieces)?;
    let mut value = pieces[pieces.len() - 1].node;
    for (place, piece) in pieces.iter().enumerate().rev().skip(1) {
        let mask = match &piece.when {
            Some(Condition::Threshold { input, at, below, blend: Some(half), .. }) => {
                let x = inputs[*input].symbol;
                value = blend::lower(graph, x, (at, *below, half), piece.node, value);
                continue;
            }
            Some(Condition::Threshold { input, at, below, inclusive, .. }) => {
                let relation = if *inclusive { Relation::LessOrEqual } else { Relation::Less };
                let (x, at) = (inputs[*input].symbol, graph.number(at.clone()));
                let (low, high) = if *below { (x, at) } else { (at, x) };
                graph.compare(relation, low, high)
            }
            _ => conditions[place],
        };
        value = graph.select(mask, piece.node, value);
    }
    Ok(LawOutput {
        name: output.variable.name,
        title: output.variable.title,
        unit: output.variable.unit,
        accepts_jumps: output.jumps == Jumps::Accepted,
        pieces,
        value,
        derivatives: Vec::new(),
        code: Vec::new(),
    })
}

/// The condition as a threshold of one input, if it compares something linear in one.
fn threshold(
    graph: &mut Graph,
    condition: Id,
    inputs: &[LawInput],
    when: &Formula,
) -> Option<Condition> {
    let Node::Compare(relation, a, b) = *graph.node(condition) else {
        return None;
    };
    let difference = graph.sub(a, b);
    for (input, variable) in inputs.iter().enumerate() {
        let polynomial = Polynomial::of(graph, difference, variable.symbol);
        // slope·(x − at) < 0
        if let Some((slope, at)) = polynomial.and_then(|p| p.linear()) {
            let (below, inclusive) = (slope.is_positive(), relation == Relation::LessOrEqual);
            let text = when.text.clone();
            return Some(Condition::Threshold {
                input,
                at,
                below,
                inclusive,
                moved_from: None,
                blend: None,
                text,
            });
        }
    }
    None
}

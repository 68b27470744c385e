//! Errors that the analysis of a law shows: jumps that are not accepted, places without a value, tables
//! that end too early.

use super::analysis::{Findings, in_file};
use super::describe::short;
use super::report::Break;
use super::scan::{self, Line};
use super::{Condition, Extend, LawOutput, LawSpec, LawTable};
use crate::diagnostic::{Code, Diagnostics};
use crate::rational::nearest;

/// A table without an extension must reach over the declared ranges.
pub(super) fn tables(law: &LawSpec, lines: &[Line], errors: &mut Diagnostics) {
    if law.inputs.iter().any(|input| input.range.is_none()) {
        return;
    }
    let refusing = |(_, table): &(usize, &LawTable)| table.extend == Extend::Refuse;
    for (place, table) in law.tables.iter().enumerate().filter(refusing) {
        let points = lines.iter().flat_map(|line| line.points.iter().map(|x| line.at(*x)));
        let inputs = points.filter_map(|inputs| {
            law.input_of(place, &law.names(&inputs)).filter(|input| input.is_finite())
        });
        let [first, last] = table.span().map(nearest);
        let [low, high] = inputs
            .fold([first, last], |[low, high]: [f64; 2], input| [low.min(input), high.max(input)]);
        // In the unit of the column, as a reader of the file knows them.
        let unit = match table.input_unit.text() {
            "1" => String::new(),
            text => format!(" {text}"),
        };
        let scale = (table.ends[1] - table.ends[0]) / (last - first);
        for (reached, end, written) in [(low, first, table.ends[0]), (high, last, table.ends[1])] {
            if !table.is_outside(reached) {
                continue;
            }
            let message = format!(
                "`{}` reaches {}{unit} over the `range` of the inputs, but the rows of `{}` end at {}{unit}",
                table.input.text.text(),
                short(written + (reached - end) * scale),
                table.path,
                short(written)
            );
            let error = table.input.text.error_here(Code::TABLE, message);
            errors.push(error.help(
                "extend the table by `extend = \"constant\"` or `\"linear\"`, or make the `range` of the \
                 inputs smaller",
            ));
        }
    }
}

/// Adds the errors of an output.
pub(super) fn output(
    law: &LawSpec,
    (number, output): (usize, &LawOutput),
    findings: &Findings,
    errors: &mut Diagnostics,
) {
    for (found, between) in findings.report.breaks.iter().zip(&findings.between) {
        if output.accepts_jumps || !found.jumps() {
            continue;
        }
        let piece = between.pieces[0].min(between.pieces[1]);
        let place = scan::place_of(&output.pieces[piece]);
        let error =
            place.error_here(Code::JUMP, found.words(&output.name, &output.unit.to_string()));
        let help = match law.is_rate(number) {
            true => {
                "the rate of a state must be continuous: let it rise over a small range, by min and max"
                    .to_owned()
            }
            false => remedies(law, output, piece, found),
        };
        errors.push(error.help(help));
    }
    let declared = law.inputs.iter().all(|input| input.range.is_some());
    if let (Some(point), true) = (&findings.report.undefined, declared) {
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
        ways.push(format!(
            "`smooth = \"{} {unit}\"` blends the pieces over that length of {input}",
            short(whirl_text::rounded(length, 1))
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

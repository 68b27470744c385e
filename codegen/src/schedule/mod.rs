//! From scalar expressions to straight-line code: sums factored where that saves operations, common
//! subexpressions shared, every value computed in the first stage that has what it needs.

mod build;
mod factor;
mod lower;
mod name;
mod program;
mod request;
mod sum;
#[cfg(test)]
mod tests;

use crate::expression::{Graph, Id, Shape};

use lower::Lowered;
pub use program::{
    Counts, Instruction, Operand, Operation, Program, ProgramInput, ProgramOutput, Stage,
};
pub use request::{Input, Output, Request, ScheduleError};
pub use sum::take_out;

/// The program that computes the outputs of a request: of the sums as written and the factored sums,
/// whichever runs cheaper.
pub fn schedule(graph: &mut Graph, request: &Request) -> Result<Program, ScheduleError> {
    let written: Vec<Id> = request.outputs.iter().map(|output| output.expression).collect();
    only_scalars(graph, request)?;
    let plain = assemble(request, lower::lower(graph, request, &written, &request.names)?);

    let mut roots = written.clone();
    roots.extend(request.names.iter().map(|(id, _)| *id));
    let rewritten = factor::factor(graph, request, &roots);
    let factored: Vec<Id> = written.iter().map(|id| rewritten[id]).collect();
    let names: Vec<_> =
        request.names.iter().map(|(id, name)| (rewritten[id], name.clone())).collect();
    same_meaning(graph, request, &factored)?;
    let factored = assemble(request, lower::lower(graph, request, &factored, &names)?);

    if graph.exceeded() {
        return Err(ScheduleError::Exceeded);
    }
    Ok(if factored.cost() < plain.cost() { factored } else { plain })
}

fn only_scalars(graph: &Graph, request: &Request) -> Result<(), ScheduleError> {
    match request.outputs.iter().find(|o| graph.shape(o.expression) != Shape::Scalar) {
        Some(output) => Err(ScheduleError::NotScalar { output: output.name.clone() }),
        None => Ok(()),
    }
}

fn same_meaning(graph: &Graph, request: &Request, new: &[Id]) -> Result<(), ScheduleError> {
    for (output, new) in request.outputs.iter().zip(new) {
        if !graph.same_signature(output.expression, *new) {
            return Err(ScheduleError::MeaningChanged { output: output.name.clone() });
        }
    }
    Ok(())
}

/// Drops what no output needs, sorts by stage, and names the values.
fn assemble(request: &Request, lowered: Lowered) -> Program {
    let order = needed_by_stage(&lowered);
    let mut places = vec![usize::MAX; lowered.operations.len()];
    order.iter().enumerate().for_each(|(new, old)| places[*old] = new);
    let moved = |operand: Operand| match operand {
        Operand::Value(place) => Operand::Value(places[place]),
        other => other,
    };
    let operations: Vec<Operation> =
        order.iter().map(|old| lowered.operations[*old].map(moved)).collect();

    let outputs: Vec<ProgramOutput> = request
        .outputs
        .iter()
        .zip(&lowered.outputs)
        .map(|(output, operand)| ProgramOutput {
            name: output.name.clone(),
            operand: moved(*operand),
        })
        .collect();
    let kept = |operand: &Operand| !matches!(operand, Operand::Value(place) if places[*place] == usize::MAX);
    let mut given: Vec<(Operand, String)> =
        outputs.iter().map(|output| (output.operand, output.name.clone())).collect();
    given.extend(
        lowered
            .names
            .iter()
            .filter(|(operand, _)| kept(operand))
            .map(|(operand, name)| (moved(*operand), name.clone())),
    );
    let inputs: Vec<&str> = request.inputs.iter().map(|input| input.name.as_str()).collect();
    let names = name::names(&operations, &inputs, &given);

    let mut is_given = vec![false; order.len()];
    for (operand, _) in &given {
        if let Operand::Value(place) = operand {
            is_given[*place] = true;
        }
    }
    let instructions = order
        .iter()
        .zip(operations)
        .zip(names)
        .enumerate()
        .map(|(place, ((old, operation), name))| Instruction {
            name,
            given: is_given[place],
            stage: lowered.stages[*old],
            operation,
        })
        .collect();
    let inputs = request
        .inputs
        .iter()
        .map(|input| ProgramInput { name: input.name.clone(), stage: input.stage })
        .collect();
    Program { stages: request.stages.clone(), inputs, instructions, outputs }
}

/// Operations that outputs need, by stage; within one in the order in which the outputs, one after the
/// other, first need them, operands first.
fn needed_by_stage(lowered: &Lowered) -> Vec<usize> {
    let mut visited = vec![false; lowered.operations.len()];
    let mut order = Vec::new();
    // A place is pushed twice: to open its operands, and to be listed after them.
    let mut open: Vec<(Operand, bool)> = Vec::new();
    for output in &lowered.outputs {
        open.push((*output, false));
        while let Some((operand, listed)) = open.pop() {
            let Operand::Value(place) = operand else { continue };
            if listed {
                order.push(place);
            } else if !std::mem::replace(&mut visited[place], true) {
                open.push((operand, true));
                let operands = lowered.operations[place].operands();
                open.extend(operands.into_iter().rev().map(|operand| (operand, false)));
            }
        }
    }
    order.sort_by_key(|place| lowered.stages[*place]);
    order
}

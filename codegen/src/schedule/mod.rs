//! From scalar expressions to straight-line code: sums factored where that saves operations, common
//! subexpressions shared, every value computed in the first stage that has what it needs.

mod build;
mod factor;
mod lower;
mod name;
mod program;
mod request;
mod skeleton;
mod sum;
#[cfg(test)]
mod tests;

use crate::expression::{Graph, Id, Shape, normal};
use crate::operation::{Operand, Operation};
use crate::simplify::simplify;

use lower::Lowered;
pub use program::{Counts, Instruction, Program, ProgramInput, ProgramOutput, Stage};
pub use request::{Input, Output, Request, ScheduleError};
pub use skeleton::Skeleton;
pub use sum::take_out;

/// The program that computes the outputs of a request: of several ways to write each output, all equal,
/// those that together run cheapest.
pub fn schedule(graph: &mut Graph, request: &Request) -> Result<Program, ScheduleError> {
    only_scalars(graph, request)?;
    let ways = ways(graph, request)?;
    let program = cheapest(graph, request, &ways)?;
    if graph.exceeded() {
        return Err(ScheduleError::Exceeded);
    }
    Ok(program)
}

/// The program that computes the outputs as they are written: for what runs seldom, and has too many products to try
/// other ways.
pub(crate) fn schedule_as_written(
    graph: &mut Graph,
    request: &Request,
) -> Result<Program, ScheduleError> {
    only_scalars(graph, request)?;
    let program = cheapest(graph, request, &[Way::written(request)])?;
    if graph.exceeded() {
        return Err(ScheduleError::Exceeded);
    }
    Ok(program)
}

/// One way to write all outputs, with the names that then belong to values inside.
struct Way {
    outputs: Vec<Id>,
    names: Vec<(Id, String)>,
}

impl Way {
    fn written(request: &Request) -> Self {
        Way {
            outputs: request.outputs.iter().map(|output| output.expression).collect(),
            names: request.names.clone(),
        }
    }
}

/// As written; factored; where rules apply, simplified, and that factored; and, where there are stages to
/// hoist to, multiplied out and factored anew.
fn ways(graph: &mut Graph, request: &Request) -> Result<Vec<Way>, ScheduleError> {
    let written = Way::written(request);
    let mut ways = vec![factored(graph, request, &written)?];
    let simple = simplify(graph, &written.outputs);
    same_meaning(graph, request, &simple)?;
    if simple != written.outputs {
        let simple = Way { outputs: simple, names: request.names.clone() };
        ways.push(factored(graph, request, &simple)?);
        ways.push(simple);
    }
    if request.stages.len() > 1
        && let Some(expanded) = expanded(graph, &written)
    {
        ways.push(factored(graph, request, &expanded)?);
    }
    ways.insert(0, written);
    Ok(ways)
}

fn factored(graph: &mut Graph, request: &Request, way: &Way) -> Result<Way, ScheduleError> {
    let mut roots = way.outputs.clone();
    roots.extend(way.names.iter().map(|(id, _)| *id));
    let new = factor::factor(graph, request, &roots);
    let outputs: Vec<Id> = way.outputs.iter().map(|id| new[id]).collect();
    same_meaning(graph, request, &outputs)?;
    let names = way.names.iter().map(|(id, name)| (new[id], name.clone())).collect();
    Ok(Way { outputs, names })
}

/// Multiplied out, unless that grows beyond all use.
fn expanded(graph: &mut Graph, way: &Way) -> Option<Way> {
    let mut trial = graph.clone();
    let mut outputs = Vec::with_capacity(way.outputs.len());
    for output in &way.outputs {
        outputs.push(normal::expand(&mut trial, *output));
        if trial.exceeded() || trial.size() > graph.size() + EXPANSION {
            return None;
        }
    }
    *graph = trial;
    Some(Way { outputs, names: way.names.clone() })
}

/// Most nodes that multiplying out may add.
const EXPANSION: usize = 100_000;
/// Most instructions × outputs for which each output's way is chosen by itself.
const CHOICES: usize = 200_000;

/// What one choice of ways comes to: its operations, those that are needed in their order, and their cost.
struct Candidate<'w> {
    lowered: Lowered<'w>,
    order: Vec<usize>,
    cost: f64,
}

impl<'w> Candidate<'w> {
    fn new(request: &Request, lowered: Lowered<'w>) -> Self {
        let order = needed_by_stage(&lowered);
        let of_stage = |stage: usize| -> u64 {
            let places = order.iter().filter(|place| lowered.stages[**place] == stage);
            places.map(|place| lowered.operations[*place].weight()).sum()
        };
        let stages = request.stages.iter().enumerate();
        let cost = stages.map(|(place, stage)| stage.runs * of_stage(place) as f64).sum();
        Candidate { lowered, order, cost }
    }
}

/// Begins with the cheapest way for all outputs, then changes single outputs while that is cheaper.
fn cheapest(graph: &Graph, request: &Request, ways: &[Way]) -> Result<Program, ScheduleError> {
    let names: Vec<&(Id, String)> = ways.iter().flat_map(|way| &way.names).collect();
    let candidate = |outputs: &[Id]| {
        lower::lower(graph, request, outputs, &names)
            .map(|lowered| Candidate::new(request, lowered))
    };
    let (mut outputs, mut best) = (ways[0].outputs.clone(), candidate(&ways[0].outputs)?);
    for way in &ways[1..] {
        let other = candidate(&way.outputs)?;
        if other.cost < best.cost {
            (outputs, best) = (way.outputs.clone(), other);
        }
    }
    if outputs.len() == 1 || best.order.len() * outputs.len() > CHOICES {
        return Ok(assemble(request, best));
    }
    for place in 0..outputs.len() {
        // Several ways may write an output alike.
        let mut tried = vec![outputs[place]];
        for way in ways {
            let new = way.outputs[place];
            if tried.contains(&new) {
                continue;
            }
            tried.push(new);
            let before = std::mem::replace(&mut outputs[place], new);
            let other = candidate(&outputs)?;
            if other.cost < best.cost {
                best = other;
            } else {
                outputs[place] = before;
            }
        }
    }
    Ok(assemble(request, best))
}

fn only_scalars(graph: &Graph, request: &Request) -> Result<(), ScheduleError> {
    match request.outputs.iter().find(|o| graph.shape(o.expression) != Shape::Scalar) {
        Some(output) => Err(ScheduleError::NotScalar { output: output.name.clone() }),
        None => Ok(()),
    }
}

fn same_meaning(graph: &Graph, request: &Request, new: &[Id]) -> Result<(), ScheduleError> {
    let changed = graph.changed();
    for (output, new) in request.outputs.iter().zip(new) {
        let inside = changed.is_some_and(|node| graph.depends(output.expression, node));
        if inside || !graph.same_signature(output.expression, *new) {
            return Err(ScheduleError::MeaningChanged { output: output.name.clone() });
        }
    }
    // In what a pass made of an output, which no output of the request holds.
    match (changed, request.outputs.first()) {
        (Some(_), Some(output)) => {
            Err(ScheduleError::MeaningChanged { output: output.name.clone() })
        }
        _ => Ok(()),
    }
}

/// The operations that are needed, in their order and with names.
fn assemble(request: &Request, Candidate { lowered, order, .. }: Candidate) -> Program {
    let mut places = vec![usize::MAX; lowered.operations.len()];
    order.iter().enumerate().for_each(|(new, old)| places[*old] = new);
    let moved = |operand: Operand| match operand {
        Operand::Value(place) => Operand::Value(places[place]),
        other => other,
    };
    let operations: Vec<Operation<Operand>> =
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
            .map(|(operand, name)| (moved(*operand), (*name).to_owned())),
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
                open.extend(operands.rev().map(|operand| (operand, false)));
            }
        }
    }
    order.sort_by_key(|place| lowered.stages[*place]);
    order
}

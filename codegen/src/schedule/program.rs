//! What a schedule is: straight-line three-address code over scalars, in stages.

use std::fmt;

use crate::operation::{Function, Operand, Operation};

/// A group of instructions that run equally often, such as once a ring or once a spring.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Name, such as `ring`.
    pub name: String,
    /// Earlier stages whose values this one can use.
    pub(crate) sees: Vec<usize>,
    /// How often it runs relative to the other stages; guides what is worth hoisting.
    pub(crate) runs: f64,
}

impl Stage {
    /// A stage that sees all of `sees`.
    pub(crate) fn new(name: &str, sees: &[usize], runs: f64) -> Self {
        Stage { name: name.to_string(), sees: sees.to_vec(), runs }
    }
}

/// A named value that a program takes.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramInput {
    /// The spec's own name.
    pub name: String,
    /// Stage at which it is known.
    pub(crate) stage: usize,
}

/// A named value that a program gives.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramOutput {
    /// Its name.
    pub name: String,
    /// Where it is found.
    pub operand: Operand,
}

/// One instruction: `name` = operation.
#[derive(Debug, Clone, PartialEq)]
pub struct Instruction {
    /// Readable name, from the symbols of the spec; unique in the program, its inputs included.
    pub name: String,
    /// Whether the name is that of an output or of a definition of the spec, not a made one.
    pub(crate) given: bool,
    /// Stage in which it runs.
    pub(crate) stage: usize,
    /// What it does with constants, inputs of the program and values of its instructions.
    pub operation: Operation<Operand>,
}

/// Straight-line code. Instructions ascend in stage; an instruction uses only values before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// Stages in the order in which they run.
    pub(crate) stages: Vec<Stage>,
    /// Inputs, in the order of the request.
    pub inputs: Vec<ProgramInput>,
    /// Instructions.
    pub instructions: Vec<Instruction>,
    /// Outputs, in the order of the request.
    pub outputs: Vec<ProgramOutput>,
}

impl Program {
    /// Places of the instructions of a stage.
    pub(crate) fn stage(&self, stage: usize) -> std::ops::Range<usize> {
        let start = self.instructions.partition_point(|instruction| instruction.stage < stage);
        let end = self.instructions.partition_point(|instruction| instruction.stage <= stage);
        start..end
    }

    /// Whether lanes compute all of it side by side.
    pub(crate) fn is_side_by_side(&self) -> bool {
        self.instructions.iter().all(|own| match own.operation {
            Operation::Function(function, _) => function.is_side_by_side(),
            Operation::Power(..) => false,
            _ => true,
        })
    }

    /// Stage at which an operand is known; constants belong to the first.
    pub(crate) fn stage_of(&self, operand: Operand) -> usize {
        match operand {
            Operand::Constant(_) => 0,
            Operand::Input(place) => self.inputs[place].stage,
            Operand::Value(place) => self.instructions[place].stage,
        }
    }

    /// Name of an input or value; `None` of a constant.
    pub(crate) fn name_of(&self, operand: Operand) -> Option<&str> {
        match operand {
            Operand::Constant(_) => None,
            Operand::Input(place) => Some(&self.inputs[place].name),
            Operand::Value(place) => Some(&self.instructions[place].name),
        }
    }

    /// Inputs and values of `stage` that `later` stages (or the outputs, if `outputs`) use, inputs first:
    /// what has to be kept between them.
    pub(crate) fn carried(&self, stage: usize, later: &[usize], outputs: bool) -> Vec<Operand> {
        let mut inputs = vec![false; self.inputs.len()];
        let mut values = vec![false; self.instructions.len()];
        let mut mark = |operand: Operand| match operand {
            Operand::Input(place) => inputs[place] |= self.inputs[place].stage == stage,
            Operand::Value(place) => values[place] |= self.instructions[place].stage == stage,
            Operand::Constant(_) => {}
        };
        for instruction in self.instructions.iter().filter(|i| later.contains(&i.stage)) {
            instruction.operation.operands().for_each(&mut mark);
        }
        if outputs {
            self.outputs.iter().for_each(|output| mark(output.operand));
        }
        let inputs = inputs.iter().enumerate().filter(|(_, used)| **used);
        let values = values.iter().enumerate().filter(|(_, used)| **used);
        let inputs = inputs.map(|(place, _)| Operand::Input(place));
        inputs.chain(values.map(|(place, _)| Operand::Value(place))).collect()
    }

    /// Names of the inputs that are used.
    pub fn used_inputs(&self) -> Vec<String> {
        let stages: Vec<usize> = (0..self.stages.len()).collect();
        let used = stages.iter().flat_map(|stage| self.carried(*stage, &stages, true));
        used.filter(|operand| matches!(operand, Operand::Input(_)))
            .filter_map(|operand| self.name_of(operand).map(str::to_string))
            .collect()
    }

    /// The part of the program that gives some of its outputs; inputs stay as they are.
    pub(crate) fn restricted(&self, outputs: impl Fn(&str) -> bool) -> Program {
        let outputs: Vec<ProgramOutput> =
            self.outputs.iter().filter(|output| outputs(&output.name)).cloned().collect();
        let mut needed = vec![false; self.instructions.len()];
        let mut mark = |operand: Operand| {
            if let Operand::Value(place) = operand {
                needed[place] = true;
            }
        };
        outputs.iter().for_each(|output| mark(output.operand));
        for place in (0..needed.len()).rev() {
            if needed[place] {
                for operand in self.instructions[place].operation.operands() {
                    if let Operand::Value(operand) = operand {
                        needed[operand] = true;
                    }
                }
            }
        }
        let mut places = Vec::with_capacity(needed.len());
        let mut instructions = Vec::new();
        let moved = |places: &[usize], operand: Operand| match operand {
            Operand::Value(place) => Operand::Value(places[place]),
            other => other,
        };
        for (instruction, needed) in self.instructions.iter().zip(needed) {
            places.push(instructions.len());
            if needed {
                let operation = instruction.operation.map(|operand| moved(&places, operand));
                instructions.push(Instruction { operation, ..instruction.clone() });
            }
        }
        let outputs = outputs
            .into_iter()
            .map(|output| ProgramOutput { operand: moved(&places, output.operand), ..output });
        Program {
            stages: self.stages.clone(),
            inputs: self.inputs.clone(),
            outputs: outputs.collect(),
            instructions,
        }
    }

    /// The operand of an output.
    pub(crate) fn output(&self, name: &str) -> Option<Operand> {
        self.outputs.iter().find(|output| output.name == name).map(|output| output.operand)
    }

    /// Operation counts of a stage.
    pub(crate) fn counts(&self, stage: usize) -> Counts {
        Counts::of(self.instructions[self.stage(stage)].iter().map(|i| i.operation))
    }

    /// Operation counts of all stages together.
    pub(crate) fn total_counts(&self) -> Counts {
        Counts::of(self.instructions.iter().map(|i| i.operation))
    }
}

/// How many operations of each kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Additions, subtractions and changes of sign.
    pub(crate) add: usize,
    /// Multiplications.
    pub(crate) mul: usize,
    /// Divisions.
    pub(crate) div: usize,
    /// Square roots.
    pub(crate) sqrt: usize,
    /// Other functions and real powers.
    pub(crate) function: usize,
    /// Comparisons and operations on truth values.
    pub(crate) compare: usize,
    /// Selections.
    pub(crate) select: usize,
}

impl Counts {
    pub(super) fn of(operations: impl Iterator<Item = Operation<Operand>>) -> Self {
        let mut counts = Counts::default();
        for operation in operations {
            match operation {
                Operation::Add(..) | Operation::Sub(..) | Operation::Neg(_) => counts.add += 1,
                Operation::Mul(..) => counts.mul += 1,
                Operation::Div(..) => counts.div += 1,
                Operation::Sqrt(_) => counts.sqrt += 1,
                Operation::Function(Function::Abs, _) => counts.select += 1,
                Operation::Function(..) | Operation::Power(..) => counts.function += 1,
                Operation::Select(..) => counts.select += 1,
                operation if operation.is_truth() => counts.compare += 1,
                _ => {}
            }
        }
        counts
    }

    /// Operations on numbers: additions, multiplications, divisions, roots and functions.
    pub(crate) fn arithmetic(&self) -> usize {
        self.add + self.mul + self.div + self.sqrt + self.function
    }
}

impl fmt::Display for Counts {
    /// `4 add, 3 mul, 1 select`; `no operations` where there is none.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts: Vec<String> = [
            (self.add, "add"),
            (self.mul, "mul"),
            (self.div, "div"),
            (self.sqrt, "sqrt"),
            (self.function, "function"),
            (self.compare, "compare"),
            (self.select, "select"),
        ]
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, name)| format!("{count} {name}"))
        .collect();
        f.write_str(&if parts.is_empty() { "no operations".to_string() } else { parts.join(", ") })
    }
}

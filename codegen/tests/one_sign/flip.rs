//! Programs run one instruction after the other, with a sign flipped.

use std::collections::BTreeSet;

use whirl_codegen::operation::{Operand, Operation};
use whirl_codegen::schedule::Program;

/// One operand of one instruction, whose sign is flipped where it is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Flip {
    pub(crate) place: usize,
    pub(crate) operand: usize,
}

/// The values of a program's outputs, one instruction after the other, with a sign flipped.
pub(crate) fn run(program: &Program, inputs: &[f64], flip: Option<Flip>) -> Vec<f64> {
    let mut values: Vec<f64> = Vec::with_capacity(program.instructions.len());
    let read = |values: &[f64], operand: Operand| match operand {
        Operand::Constant(value) => value,
        Operand::Input(place) => inputs[place],
        Operand::Value(place) => values[place],
    };
    for (place, instruction) in program.instructions.iter().enumerate() {
        let mut operand = 0..;
        let operation = instruction.operation.map(|from| {
            let (value, operand) = (read(&values, from), operand.next());
            let flipped = flip.filter(|f| f.place == place && Some(f.operand) == operand);
            if flipped.is_some() { -value } else { value }
        });
        values.push(operation.value());
    }
    program.outputs.iter().map(|output| read(&values, output.operand)).collect()
}

/// Every sign of the instructions that an output needs. Of the two operands of a product or quotient one
/// stands for both; zero has no sign.
pub(crate) fn flips(program: &Program, output: usize) -> Vec<Flip> {
    flips_of(program, &[output])
}

/// As [`flips`], of what several outputs need.
pub(crate) fn flips_of(program: &Program, outputs: &[usize]) -> Vec<Flip> {
    let mut needed = BTreeSet::new();
    let mut open: Vec<Operand> = outputs.iter().map(|o| program.outputs[*o].operand).collect();
    while let Some(operand) = open.pop() {
        if let Operand::Value(place) = operand
            && needed.insert(place)
        {
            open.extend(program.instructions[place].operation.operands());
        }
    }
    let mut flips = Vec::new();
    for place in needed {
        let operation = program.instructions[place].operation;
        let operands: Vec<Operand> = operation.operands().collect();
        let signs = match operation {
            Operation::Mul(..) | Operation::Div(..) | Operation::Power(..) => 0..1,
            Operation::And(..) | Operation::Or(..) | Operation::Not(_) => 0..0,
            Operation::Select(..) => 1..3,
            _ => 0..operands.len(),
        };
        let zero = |operand: &usize| operands[*operand] == Operand::Constant(0.0);
        let signs = signs.filter(|operand| !zero(operand));
        flips.extend(signs.map(|operand| Flip { place, operand }));
    }
    flips
}

/// A derivative by differences, and how far it may be off.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Difference {
    pub(crate) value: f64,
    pub(crate) bound: f64,
}

impl Difference {
    pub(crate) fn agrees(&self, derivative: f64) -> bool {
        !self.value.is_finite() || (derivative - self.value).abs() <= self.bound
    }
}

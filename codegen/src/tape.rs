//! A schedule evaluated at run time, without a compiler: one instruction at a time over up to 64 springs.
//! It gives the same bits as the emitted code, because both follow the same schedule, no operation is
//! fused, and functions come from the same implementation.

use std::collections::BTreeMap;

use crate::operation::{Function, Operand, Operation, Relation};
use crate::schedule::Program;

/// Most springs that one instruction covers.
pub(crate) const WIDTH: usize = 64;

/// One value of every spring of a block. Truth values are 1 and 0.
type Register<const W: usize> = [f64; W];

/// A program ready to be evaluated over rows of springs.
#[derive(Debug, Clone)]
pub struct Tape {
    constants: Vec<f64>,
    inputs: usize,
    /// Between places of registers: constants, then inputs, then the results of the operations before.
    operations: Vec<Operation<usize>>,
    outputs: Vec<usize>,
}

impl Tape {
    /// The tape of a program; its stages are run as one.
    pub fn new(program: &Program) -> Self {
        let mut constants: Vec<f64> = Vec::new();
        let mut places: BTreeMap<u64, usize> = BTreeMap::new();
        let operands = program.instructions.iter().flat_map(|i| i.operation.operands());
        for operand in operands.chain(program.outputs.iter().map(|output| output.operand)) {
            if let Operand::Constant(value) = operand {
                places.entry(value.to_bits()).or_insert_with(|| {
                    constants.push(value);
                    constants.len() - 1
                });
            }
        }
        let register = |operand: Operand| match operand {
            Operand::Constant(value) => places[&value.to_bits()],
            Operand::Input(place) => constants.len() + place,
            Operand::Value(place) => constants.len() + program.inputs.len() + place,
        };
        let operations = program.instructions.iter().map(|i| i.operation.map(register)).collect();
        let outputs = program.outputs.iter().map(|output| register(output.operand)).collect();
        Tape { inputs: program.inputs.len(), operations, outputs, constants }
    }

    /// Number of input rows.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// Number of output rows.
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// Length of the workspace that [`Tape::evaluate`] needs, whatever the number of springs.
    pub fn workspace(&self) -> usize {
        WIDTH * (self.constants.len() + self.inputs + self.operations.len())
    }

    /// Evaluates all springs. `inputs`: one row of `springs` values an input; `outputs`: one row an output;
    /// `workspace`: at least [`Tape::workspace`] values, whose contents do not matter. Allocates nothing.
    ///
    /// # Panics
    /// If a slice is shorter than that.
    pub fn evaluate(
        &self,
        springs: usize,
        inputs: &[f64],
        outputs: &mut [f64],
        workspace: &mut [f64],
    ) {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has the instructions.
            unsafe { self.evaluate_avx2(springs, inputs, outputs, workspace) };
            return;
        }
        self.evaluate_blocks(springs, inputs, outputs, workspace);
    }

    /// The same on wider registers; without fused operations, the bits are the same.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn evaluate_avx2(
        &self,
        springs: usize,
        inputs: &[f64],
        outputs: &mut [f64],
        workspace: &mut [f64],
    ) {
        self.evaluate_blocks(springs, inputs, outputs, workspace);
    }

    /// In blocks that are no wider than the springs need: a law of a ring has one.
    #[inline(always)]
    fn evaluate_blocks(
        &self,
        springs: usize,
        inputs: &[f64],
        outputs: &mut [f64],
        workspace: &mut [f64],
    ) {
        let rows = (&inputs[..springs * self.inputs], &mut outputs[..springs * self.outputs.len()]);
        let workspace = &mut workspace[..self.workspace()];
        match springs {
            ..=1 => self.blocks_of::<1>(springs, rows, workspace),
            2..=4 => self.blocks_of::<4>(springs, rows, workspace),
            5..=8 => self.blocks_of::<8>(springs, rows, workspace),
            9..=16 => self.blocks_of::<16>(springs, rows, workspace),
            17..=32 => self.blocks_of::<32>(springs, rows, workspace),
            _ => self.blocks_of::<WIDTH>(springs, rows, workspace),
        }
    }

    #[inline(always)]
    fn blocks_of<const W: usize>(
        &self,
        springs: usize,
        (inputs, outputs): (&[f64], &mut [f64]),
        workspace: &mut [f64],
    ) {
        let (registers, _) = workspace.as_chunks_mut::<W>();
        for (register, constant) in registers.iter_mut().zip(&self.constants) {
            register.fill(*constant);
        }
        let first_result = self.constants.len() + self.inputs;
        for start in (0..springs).step_by(W) {
            let count = W.min(springs - start);
            let given = &mut registers[self.constants.len()..first_result];
            for (place, register) in given.iter_mut().enumerate() {
                let row = springs * place + start;
                register[..count].copy_from_slice(&inputs[row..row + count]);
                // The rest of the last block computes on copies; what it gives is not used.
                register[count..].fill(inputs[row]);
            }
            for (place, operation) in self.operations.iter().enumerate() {
                let (known, rest) = registers.split_at_mut(first_result + place);
                run(*operation, known, &mut rest[0]);
            }
            for (place, register) in self.outputs.iter().enumerate() {
                let row = springs * place + start;
                outputs[row..row + count].copy_from_slice(&registers[*register][..count]);
            }
        }
    }
}

/// [`Operation::value`] of every spring.
#[inline(always)]
fn run<const W: usize>(operation: Operation<usize>, known: &[Register<W>], out: &mut Register<W>) {
    match operation {
        Operation::Add(a, b) => binary(&known[a], &known[b], out, |a, b| a + b),
        Operation::Sub(a, b) => binary(&known[a], &known[b], out, |a, b| a - b),
        Operation::Mul(a, b) => binary(&known[a], &known[b], out, |a, b| a * b),
        Operation::Div(a, b) => binary(&known[a], &known[b], out, |a, b| a / b),
        Operation::Neg(a) => unary(&known[a], out, |a| -a),
        Operation::Sqrt(a) => unary(&known[a], out, f64::sqrt),
        Operation::Function(Function::Abs, a) => unary(&known[a], out, f64::abs),
        Operation::Function(function, a) => unary(&known[a], out, |a| function.value(a)),
        Operation::Power(a, b) => binary(&known[a], &known[b], out, libm::pow),
        Operation::Compare(Relation::Less, a, b) => {
            binary(&known[a], &known[b], out, |a, b| truth(a < b))
        }
        Operation::Compare(Relation::LessOrEqual, a, b) => {
            binary(&known[a], &known[b], out, |a, b| truth(a <= b))
        }
        Operation::And(a, b) => binary(&known[a], &known[b], out, |a, b| a * b),
        Operation::Or(a, b) => binary(&known[a], &known[b], out, |a, b| truth(a + b > 0.0)),
        Operation::Not(a) => unary(&known[a], out, |a| 1.0 - a),
        Operation::Select(mask, a, b) => {
            let (mask, a, b) = (&known[mask], &known[a], &known[b]);
            for i in 0..W {
                out[i] = if mask[i] != 0.0 { a[i] } else { b[i] };
            }
        }
    }
}

#[inline(always)]
fn truth(value: bool) -> f64 {
    if value { 1.0 } else { 0.0 }
}

#[inline(always)]
fn unary<const W: usize>(a: &Register<W>, out: &mut Register<W>, f: impl Fn(f64) -> f64) {
    for i in 0..W {
        out[i] = f(a[i]);
    }
}

#[inline(always)]
fn binary<const W: usize>(
    a: &Register<W>,
    b: &Register<W>,
    out: &mut Register<W>,
    f: impl Fn(f64, f64) -> f64,
) {
    for i in 0..W {
        out[i] = f(a[i], b[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::{Graph, Rational};
    use crate::schedule::{Request, schedule};

    #[test]
    fn every_spring_of_every_block_is_evaluated() {
        let mut g = Graph::new();
        let (x, y) = (g.scalar("x"), g.scalar("y"));
        let (half, zero) = (g.number(Rational::new(1, 2)), g.integer(0));
        let mask = g.compare(Relation::Less, x, half);
        let sine = g.function(Function::Sin, y);
        let product = g.mul(x, sine);
        let chosen = g.select(mask, product, zero);
        let request = Request::flat(&[("x", x), ("y", y)], &[("a", chosen), ("b", half)]);
        let tape = Tape::new(&schedule(&mut g, &request).expect("a program"));
        for springs in [1, 2, 4, 5, 8, 9, 16, 17, 32, 33, 64, 150_u32] {
            let inputs: Vec<f64> = (0..2 * springs).map(|i| f64::from(i) * 0.01 - 0.3).collect();
            let springs = springs as usize;
            let mut outputs = vec![f64::NAN; 2 * springs];
            let mut workspace = vec![f64::NAN; tape.workspace()];
            tape.evaluate(springs, &inputs, &mut outputs, &mut workspace);
            for j in 0..springs {
                let (x, y) = (inputs[j], inputs[springs + j]);
                let expected = if x < 0.5 { x * libm::sin(y) } else { 0.0 };
                assert_eq!(outputs[j].to_bits(), expected.to_bits());
                assert_eq!(outputs[springs + j], 0.5);
            }
        }
        let mut workspace = vec![f64::NAN; tape.workspace()];
        tape.evaluate(0, &[], &mut [], &mut workspace);
    }
}

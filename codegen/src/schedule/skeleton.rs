//! A program without its numbers. A law whose file has other values in it, or whose case gives other ones, mostly does the same with
//! other numbers: what was compiled for the skeleton then serves it.

use super::program::{Program, ProgramInput};
use crate::hash::hash;
use crate::operation::{Operand, Operation};

/// A program whose numbers are inputs behind its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Skeleton {
    pub(crate) program: Program,
    /// Inputs that are not numbers of the program.
    inputs: usize,
}

impl Program {
    /// The skeleton of the program, and its numbers in the order in which they stand, one for each place where they do. None where
    /// a truth is among them.
    pub fn skeleton(&self) -> Option<(Skeleton, Vec<f64>)> {
        if self.instructions.iter().any(|own| knows_a_truth(own.operation)) {
            return None;
        }
        let (inputs, mut numbers) = (self.inputs.len(), Vec::new());
        let mut placed = |operand: Operand| match operand {
            Operand::Constant(value) => {
                numbers.push(value);
                Operand::Input(inputs + numbers.len() - 1)
            }
            other => other,
        };
        let mut program = self.clone();
        for own in &mut program.instructions {
            own.operation = own.operation.map(&mut placed);
        }
        for own in &mut program.outputs {
            own.operand = placed(own.operand);
        }
        let mut prefix = "k".to_owned();
        while self.has_names_like(&prefix) {
            prefix.push('_');
        }
        let named = (0..numbers.len()).map(|place| format!("{prefix}{place}"));
        program.inputs.extend(named.map(|name| ProgramInput { name, stage: 0 }));
        Some((Skeleton { program, inputs }, numbers))
    }

    /// Whether any value is called by these letters and a number behind them.
    fn has_names_like(&self, prefix: &str) -> bool {
        let names = self.inputs.iter().map(|own| &own.name);
        let mut names = names.chain(self.instructions.iter().map(|own| &own.name));
        names.any(|name| {
            let rest = name.strip_prefix(prefix);
            rest.is_some_and(|rest| rest.bytes().all(|own| own.is_ascii_digit()))
        })
    }
}

/// Whether an operation takes a truth that is a number.
fn knows_a_truth(operation: Operation<Operand>) -> bool {
    let truths = match operation {
        Operation::And(a, b) | Operation::Or(a, b) => [Some(a), Some(b)],
        Operation::Not(a) | Operation::Select(a, ..) => [Some(a), None],
        _ => [None; 2],
    };
    truths.into_iter().flatten().any(|own| matches!(own, Operand::Constant(_)))
}

impl Skeleton {
    /// A text that two skeletons share where they do the same, whatever their values are called.
    pub fn key(&self) -> String {
        let Program { stages: _, inputs, instructions, outputs } = &self.program;
        let mut texts = vec![format!("{} of {} inputs", self.inputs, inputs.len())];
        let instructions = instructions.iter();
        texts.extend(instructions.map(|own| format!("{} {:?}", own.stage, own.operation)));
        texts.extend(outputs.iter().map(|own| format!("{:?}", own.operand)));
        hash(texts.iter().map(String::as_str))
    }

    /// Names of the numbers.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = &str> {
        self.program.inputs[self.inputs..].iter().map(|own| own.name.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::{Graph, Rational};
    use crate::schedule::{Request, schedule};

    /// a·x + k0 of some numbers.
    fn line(slope: i64, above: i64) -> Program {
        let mut g = Graph::new();
        let (x, k0) = (g.scalar("x"), g.scalar("k0"));
        let terms = [(x, Rational::new(slope, 1)), (k0, Rational::new(above, 1))];
        let sum = g.sum(&terms);
        let request = Request::flat(&[("x", x), ("k0", k0)], &[("y", sum)]);
        schedule(&mut g, &request).expect("a program")
    }

    #[test]
    fn programs_that_differ_by_numbers_have_one_skeleton() {
        let (skeleton, numbers) = line(3, 7).skeleton().expect("no truths");
        let (other, others) = line(5, 11).skeleton().expect("no truths");
        assert_eq!(skeleton.key(), other.key());
        assert_eq!((numbers.len(), others.len()), (2, 2));
        assert_ne!(numbers, others);
        // What is multiplied by one is not multiplied.
        let (plain, _) = line(1, 11).skeleton().expect("no truths");
        assert_ne!(skeleton.key(), plain.key());
        // No input of the program has the name of a number.
        assert_eq!(skeleton.numbers().collect::<Vec<_>>(), ["k_0", "k_1"]);
    }
}

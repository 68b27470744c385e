//! Which side of every comparison inside a law's formulas a point lies on, by evaluating the graph.

use super::{LawOutput, LawSpec};
use crate::expression::{Function, Id, Node};
use crate::operation::Bytecode;

/// The comparisons of an output's formulas, but for those between the rows of a table, where neither value
/// nor slope jumps.
pub(super) struct Branches {
    code: Bytecode,
    /// Whether an output is what the absolute value is taken of, of which the sign tells the side.
    signed: Vec<bool>,
}

impl Branches {
    pub(super) fn of(law: &LawSpec, output: &LawOutput) -> Self {
        let between: Vec<Id> = law.tables.iter().flat_map(|table| table.inner()).copied().collect();
        let compared =
            (law.graph.reachable(&[output.value]).into_iter()).filter_map(|id| {
                match law.graph.node(id) {
                    Node::Compare(..) if !between.contains(&id) => Some((id, false)),
                    Node::Function(Function::Abs, argument) => Some((*argument, true)),
                    _ => None,
                }
            });
        let (compared, signed): (Vec<Id>, Vec<bool>) = compared.unzip();
        let inputs: Vec<Id> = law.inputs.iter().map(|input| input.symbol).collect();
        Branches { code: law.graph.bytecode(&inputs, &compared), signed }
    }

    /// The sides of all comparisons where the inputs (SI) have the given values.
    pub(super) fn sides(&self, inputs: &[f64]) -> Vec<bool> {
        let values = self.code.values(inputs).into_iter().zip(&self.signed);
        values.map(|(value, signed)| if *signed { value < 0.0 } else { value == 1.0 }).collect()
    }
}

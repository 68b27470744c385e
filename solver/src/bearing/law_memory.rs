//! Memory in which laws are evaluated.

use super::placed_law::PlacedLaw;
use super::springs::Springs;

/// Memory in which any of the laws is evaluated at all its springs.
pub(super) struct LawMemory {
    pub(super) inputs: Vec<f64>,
    pub(super) outputs: Vec<f64>,
    pub(super) workspace: Vec<f64>,
}

impl LawMemory {
    pub(super) fn new(springs: &Springs) -> Self {
        let outputs = springs.most(|law| law.bound.rows_out());
        let workspace = springs.laws.iter().map(|law| law.bound.law.workspace()).max();
        LawMemory {
            inputs: vec![0.0; springs.most(|law| law.bound.rows_in())],
            outputs: vec![0.0; outputs],
            workspace: vec![0.0; workspace.unwrap_or(0)],
        }
    }

    /// What a law gives of the inputs and states that stand here: a row a force, then one a rate of a state, each before
    /// those of its derivatives.
    pub(super) fn evaluate(&mut self, law: &PlacedLaw) -> &[f64] {
        let (bound, n) = (&law.bound, law.springs);
        let inputs = &self.inputs[..bound.rows_in() * n];
        let outputs = &mut self.outputs[..bound.rows_out() * n];
        bound.law.evaluate(n, inputs, outputs, &mut self.workspace);
        outputs
    }

    /// The forces alone, a row each.
    pub(super) fn forces(&mut self, law: &PlacedLaw) -> &[f64] {
        let (bound, n) = (&law.bound, law.springs);
        let inputs = &self.inputs[..bound.rows_in() * n];
        let outputs = &mut self.outputs[..bound.forces.len() * n];
        bound.law.forces(n, inputs, outputs, &mut self.workspace);
        outputs
    }
}

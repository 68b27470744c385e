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
        LawMemory::for_times(springs, |_| 1)
    }

    /// For a law with so many springs as many times as `times` says.
    pub(super) fn for_times(springs: &Springs, times: impl Fn(usize) -> usize) -> Self {
        let of_all =
            |rows: fn(&PlacedLaw) -> usize| springs.most(|law| rows(law) * times(law.springs));
        let workspace = springs.laws.iter().map(|law| law.bound.law.workspace()).max();
        LawMemory {
            inputs: vec![0.0; of_all(|law| law.bound.rows_in())],
            outputs: vec![0.0; of_all(|law| law.bound.rows_out())],
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

    /// The forces alone, a row each, at all springs so many times over.
    pub(super) fn forces(&mut self, law: &PlacedLaw, times: usize) -> &[f64] {
        let (bound, n) = (&law.bound, law.springs * times);
        let inputs = &self.inputs[..bound.rows_in() * n];
        let outputs = &mut self.outputs[..bound.forces.len() * n];
        bound.law.forces(n, inputs, outputs, &mut self.workspace);
        outputs
    }
}

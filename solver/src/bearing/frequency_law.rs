//! A law with coefficients over the frequency beside it.

use super::law::{SpringLaw, Validity};
use super::over_frequency::FrequencyTable;

/// A law of the coefficients of what stands still, with those over the frequency beside it.
pub struct FrequencyLaw {
    /// Force by displacement, rate and speed with the coefficients of the first column.
    pub still: Box<dyn SpringLaw>,
    /// All of them.
    pub table: FrequencyTable,
    /// A hash of both.
    pub hash: String,
}

impl SpringLaw for FrequencyLaw {
    fn name(&self) -> &str {
        self.still.name()
    }

    fn hash(&self) -> &str {
        &self.hash
    }

    fn inputs(&self) -> Vec<&str> {
        self.still.inputs()
    }

    fn outputs(&self) -> Vec<&str> {
        self.still.outputs()
    }

    fn workspace(&self) -> usize {
        self.still.workspace()
    }

    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        self.still.evaluate(springs, inputs, outputs, workspace);
    }

    fn forces(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        self.still.forces(springs, inputs, outputs, workspace);
    }

    fn valid(&self) -> Vec<Validity> {
        self.still.valid()
    }

    fn measure(&self, springs: usize, inputs: &[f64], measures: &mut [f64], workspace: &mut [f64]) {
        self.still.measure(springs, inputs, measures, workspace);
    }

    fn over_frequency(&self) -> Option<&FrequencyTable> {
        Some(&self.table)
    }
}

//! Bearing laws as the marcher sees them: named inputs to named outputs, over rows of springs.

use whirl_specs::Law;

use crate::error::{Error, nearest};

/// A law that can be evaluated over rows of springs. Two kinds exist: compiled ones of the registry, and
/// those of a law file, evaluated without a compiler.
pub trait SpringLaw: Send + Sync {
    /// Name, as the case says it.
    fn name(&self) -> &str;
    /// Hash of the spec that it was made from.
    fn hash(&self) -> &str;
    /// Names of the inputs, in order.
    fn inputs(&self) -> Vec<&str>;
    /// Names of the outputs, in order.
    fn outputs(&self) -> Vec<&str>;
    /// Length of the workspace that [`SpringLaw::evaluate`] needs.
    fn workspace(&self) -> usize;
    /// Evaluates all springs; rows as in [`whirl_specs::LawKernel`]. Allocates nothing.
    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]);
}

impl SpringLaw for &'static Law {
    fn name(&self) -> &str {
        self.origin.name
    }
    fn hash(&self) -> &str {
        self.origin.hash
    }
    fn inputs(&self) -> Vec<&str> {
        self.inputs.iter().map(|variable| variable.name).collect()
    }
    fn outputs(&self) -> Vec<&str> {
        self.outputs.iter().map(|variable| variable.name).collect()
    }
    fn workspace(&self) -> usize {
        0
    }
    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        (self.evaluate)(springs, inputs, outputs);
    }
}

/// What the solver can give to a law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Input {
    /// Clearance h (m).
    Clearance,
    /// Its rate ḣ (m/s).
    ClearanceRate,
}

const INPUTS: [(&str, Input); 2] = [("h", Input::Clearance), ("h_dot", Input::ClearanceRate)];

/// A law with its inputs and outputs found by name.
pub(crate) struct BoundLaw {
    pub(crate) law: Box<dyn SpringLaw>,
    pub(crate) inputs: Vec<Input>,
    /// Number of rows that the law writes.
    pub(crate) output_rows: usize,
    /// Row of Q; its derivatives follow.
    pub(crate) q_row: usize,
}

impl BoundLaw {
    /// Finds what the law takes and gives.
    ///
    /// # Errors
    /// An input that the solver does not have, or no output `Q`.
    pub(crate) fn new(law: Box<dyn SpringLaw>) -> Result<Self, Error> {
        let known = INPUTS.map(|(name, _)| name);
        let mut inputs = Vec::new();
        for name in law.inputs() {
            let Some((_, input)) = INPUTS.iter().find(|(input, _)| *input == name) else {
                let hint = match nearest(name, known) {
                    Some(near) => format!("did you mean {near}?"),
                    None => format!("springs have {}", known.join(", ")),
                };
                let what = format!("takes the input {name}, which no spring has; {hint}");
                return Err(Error::Law { law: law.name().to_owned(), what });
            };
            inputs.push(*input);
        }
        let outputs = law.outputs();
        let Some(place) = outputs.iter().position(|name| *name == "Q") else {
            let what = format!(
                "gives {}, but a spring needs the normal force Q",
                if outputs.is_empty() { "nothing".to_owned() } else { outputs.join(", ") }
            );
            return Err(Error::Law { law: law.name().to_owned(), what });
        };
        let rows = 1 + inputs.len();
        Ok(BoundLaw { output_rows: outputs.len() * rows, q_row: place * rows, inputs, law })
    }

    /// Whether the law depends on `input`.
    pub(crate) fn uses(&self, input: Input) -> bool {
        self.inputs.contains(&input)
    }
}

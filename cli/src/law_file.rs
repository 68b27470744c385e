//! A law of a spec file, evaluated without a compiler.

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics};
use whirl_codegen::spec::law::LawSpec;
use whirl_codegen::tape::Tape;
use whirl_solver::bearing::SpringLaw;
use whirl_solver::cache::Key;

/// A law whose kernel is a tape; it gives the same bits as a compiled one.
pub(crate) struct LawFile {
    name: String,
    hash: String,
    inputs: Vec<String>,
    outputs: Vec<String>,
    tape: Tape,
}

impl LawFile {
    /// The law of a spec.
    ///
    /// # Errors
    /// A law too large to be scheduled.
    pub(crate) fn new(spec: &LawSpec) -> Result<LawFile, Diagnostics> {
        let program = spec
            .program()
            .map_err(|error| Diagnostic::new(&spec.file, Code::LIMIT, None, error.to_string()))?;
        Ok(LawFile {
            name: spec.name.clone(),
            hash: Key::of(&spec.texts().collect::<Vec<_>>().join("\0")).hex(),
            inputs: spec.inputs.iter().map(|input| input.name.clone()).collect(),
            outputs: spec.outputs.iter().map(|output| output.name.clone()).collect(),
            tape: Tape::new(&program),
        })
    }
}

impl SpringLaw for LawFile {
    fn name(&self) -> &str {
        &self.name
    }

    fn hash(&self) -> &str {
        &self.hash
    }

    fn inputs(&self) -> Vec<&str> {
        self.inputs.iter().map(String::as_str).collect()
    }

    fn outputs(&self) -> Vec<&str> {
        self.outputs.iter().map(String::as_str).collect()
    }

    fn workspace(&self) -> usize {
        self.tape.workspace()
    }

    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        self.tape.evaluate(springs, inputs, outputs, workspace);
    }
}

//! A law of a spec file, evaluated without a compiler.

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics};
use whirl_codegen::kinds::law;
use whirl_codegen::kinds::law::{Given, LawSpec};
use whirl_codegen::schedule::ScheduleError;
use whirl_codegen::tape::Tape;
use whirl_solver::bearing::{Remembered, SpringLaw, Validity};
use whirl_solver::cache::Key;

/// A law whose kernel is a tape; it gives the same bits as a compiled one.
pub(crate) struct LawFile {
    name: String,
    hash: String,
    inputs: Vec<String>,
    outputs: Vec<String>,
    tape: Tape,
    /// Of the outputs alone.
    forces: Tape,
    states: Vec<Remembered>,
    /// Of the energy that is stored.
    stored: Option<Tape>,
    valid: Vec<Validity>,
    /// Of the measures of `valid`.
    measures: Option<Tape>,
}

impl LawFile {
    /// The law of a spec that was read with the values `given` in place of those in its file.
    ///
    /// # Errors
    /// A law too large to be scheduled.
    pub(crate) fn new(spec: &LawSpec, given: &[Given]) -> Result<LawFile, Diagnostics> {
        let too_large = |error: ScheduleError| {
            Diagnostic::new(&spec.file, Code::LIMIT, None, error.to_string())
        };
        let program = spec.program().map_err(too_large)?;
        let measures = spec.measures_program().map_err(too_large)?;
        let stored = spec.stored_program().map_err(too_large)?;
        let states = spec.remembered().iter().zip(&spec.states).map(|(input, state)| Remembered {
            name: input.name.clone(),
            unit: input.unit.dimension().si_unit(),
            start: state.start,
        });
        let exactly = |given: &Given| {
            let Given { name, value, unit } = given;
            format!("{name} = {}/{} {unit}", value.numer(), value.denom())
        };
        let texts: Vec<String> =
            spec.texts().map(str::to_owned).chain(given.iter().map(exactly)).collect();
        Ok(LawFile {
            name: spec.name.clone(),
            hash: Key::of(&texts.join("\0")).hex(),
            inputs: spec.taken().iter().map(|input| input.name.clone()).collect(),
            outputs: spec.given().iter().map(|output| output.name.clone()).collect(),
            tape: Tape::new(&program),
            forces: Tape::new(&spec.forces_of(&program)),
            states: states.collect(),
            stored: stored.as_ref().map(Tape::new),
            valid: spec.valid.iter().map(validity).collect(),
            measures: measures.as_ref().map(Tape::new),
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
        let others = self.measures.iter().chain(&self.stored);
        others.map(Tape::workspace).fold(self.tape.workspace(), usize::max)
    }

    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        self.tape.evaluate(springs, inputs, outputs, workspace);
    }

    fn forces(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        self.forces.evaluate(springs, inputs, outputs, workspace);
    }

    fn states(&self) -> Vec<Remembered> {
        self.states.clone()
    }

    fn stores(&self) -> bool {
        self.stored.is_some()
    }

    fn stored(&self, springs: usize, inputs: &[f64], energies: &mut [f64], workspace: &mut [f64]) {
        if let Some(tape) = &self.stored {
            tape.evaluate(springs, inputs, energies, workspace);
        }
    }

    fn valid(&self) -> Vec<Validity> {
        self.valid.clone()
    }

    fn measure(&self, springs: usize, inputs: &[f64], measures: &mut [f64], workspace: &mut [f64]) {
        if let Some(tape) = &self.measures {
            tape.evaluate(springs, inputs, measures, workspace);
        }
    }
}

fn validity(own: &law::Validity) -> Validity {
    Validity {
        name: own.name.clone(),
        title: own.title.clone(),
        help: own.help.clone(),
        unit: own.unit.text().to_string(),
        per_unit: own.unit.factor().to_f64(),
        limits: own.limits,
    }
}

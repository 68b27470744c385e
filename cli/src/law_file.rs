//! A law of a spec file, evaluated without a compiler: where a law that is built in does the same with other numbers, by its kernel.

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics};
use whirl_codegen::kinds::law;
use whirl_codegen::kinds::law::{Given, LawSpec};
use whirl_codegen::schedule::{Program, ScheduleError};
use whirl_codegen::tape::Tape;
use whirl_solver::bearing::{Remembered, SpringLaw, Validity};
use whirl_solver::cache::Key;
use whirl_specs::{LAWS, Law, LawSkeleton};

/// A law that was not compiled; it gives the same bits as a compiled one.
pub(crate) struct LawFile {
    name: String,
    hash: String,
    inputs: Vec<String>,
    outputs: Vec<String>,
    all: Runs,
    /// Of the outputs alone.
    forces: Runs,
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
            range: input.range,
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
            all: Runs::new(&program, |law| law.skeleton),
            forces: Runs::new(&spec.forces_of(&program), |law| law.forces_skeleton),
            states: states.collect(),
            stored: stored.as_ref().map(Tape::new),
            valid: spec.valid.iter().map(validity).collect(),
            measures: measures.as_ref().map(Tape::new),
        })
    }

    /// Whether a compiled kernel evaluates it.
    pub(crate) fn is_compiled(&self) -> bool {
        matches!(self.all, Runs::Kernel(..))
    }
}

/// What evaluates a program.
enum Runs {
    /// The kernel of a law that is built in, with the numbers of this one.
    Kernel(LawSkeleton, Vec<f64>),
    Tape(Tape),
}

impl Runs {
    /// The kernel if a law that is built in has the skeleton of the program, among its skeletons by `skeleton`.
    fn new(program: &Program, skeleton: impl Fn(&Law) -> Option<LawSkeleton>) -> Self {
        let compiled = program.skeleton().and_then(|(own, numbers)| {
            let key = own.key();
            let skeleton = LAWS.iter().filter_map(skeleton).find(|skeleton| skeleton.key == key)?;
            Some(Runs::Kernel(skeleton, numbers))
        });
        compiled.unwrap_or_else(|| Runs::Tape(Tape::new(program)))
    }

    fn workspace(&self) -> usize {
        match self {
            Runs::Kernel(..) => 0,
            Runs::Tape(tape) => tape.workspace(),
        }
    }

    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        match self {
            Runs::Kernel(skeleton, numbers) => {
                (skeleton.evaluate)(springs, numbers, inputs, outputs)
            }
            Runs::Tape(tape) => tape.evaluate(springs, inputs, outputs, workspace),
        }
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
        let others = others.map(Tape::workspace).max().unwrap_or(0);
        others.max(self.all.workspace()).max(self.forces.workspace())
    }

    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        self.all.evaluate(springs, inputs, outputs, workspace);
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

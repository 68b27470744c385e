//! A unit as its importer unpacks it: the case with all that it names, and its reduced bodies, in a folder.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use whirl_codegen::diagnostic::{Code, Diagnostic, Source};
use whirl_solver::cache::Cache;
use whirl_solver::dynamics::{Checkpoint, March};

use super::parameters::{self, Parameter};
use super::variables::{ToldGroup, Variable, Variables};
use crate::case::{Case, CaseText};
use crate::errors::Failure;
use crate::machine::{self, Built};
use crate::{simulate, start, version};

/// Names in the folder `resources` of a unit.
pub(super) const MANIFEST: &str = "unit.json";
pub(super) const BODIES: &str = "bodies";
pub(super) const LAST_STATE: &str = "state.bin";

/// What a unit says of itself.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Manifest {
    /// Hash of the sources of the program that made it.
    pub(super) program: String,
    /// Hash of its content, as the description has it.
    pub(super) token: String,
    /// Path of the case.
    pub(super) case: String,
    /// Keys of the case that are parameters.
    pub(super) parameters: Vec<String>,
}

/// A unit, read from its folder of resources.
#[derive(Debug)]
pub struct Unit {
    token: String,
    text: CaseText,
    parameters: Vec<Parameter>,
    cache: Cache,
    /// From which it goes on, if its case does.
    state: Option<Vec<u8>>,
}

/// The machine of a unit.
pub struct Made {
    /// The case.
    pub(crate) case: Case,
    /// Its machine.
    pub(crate) built: Built,
    /// Its variables.
    pub(crate) variables: Variables,
    /// The texts and other files that it was read from.
    pub(super) files: Vec<PathBuf>,
}

impl Unit {
    /// Reads the resources in a folder.
    ///
    /// # Errors
    /// It is none of a unit, or one of another version of the program.
    pub fn open(resources: &Path) -> Result<Unit, Failure> {
        let path = resources.join(MANIFEST);
        let manifest = fs::read(&path).map_err(|error| damaged(&path, &error.to_string()))?;
        let manifest: Manifest = serde_json::from_slice(&manifest)
            .map_err(|error| damaged(&path, &error.to_string()))?;
        if manifest.program != version::SOURCES {
            return Err(damaged(&path, "it was made by another version of the program"));
        }
        let text = CaseText::of_file(&resources.join(&manifest.case))?;
        let cache = Cache::shared(None);
        let bodies = resources.join(BODIES);
        let mut paths: Vec<_> = match fs::read_dir(&bodies) {
            Ok(entries) => entries.flatten().map(|entry| entry.path()).collect(),
            Err(_) => Vec::new(),
        };
        paths.sort();
        for path in paths {
            let bytes = fs::read(&path).map_err(|error| damaged(&path, &error.to_string()))?;
            if !cache.adopt(&bytes) {
                return Err(damaged(&path, "it is no reduced body"));
            }
        }
        let parameters = parameters::asked(&text, &manifest.parameters)?;
        let state = fs::read(resources.join(LAST_STATE)).ok();
        Ok(Unit { token: manifest.token, text, parameters, cache, state })
    }

    /// Hash of its content, as its description has it.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// The values of its parameters in the case, in their order and units.
    pub fn parameter_values(&self) -> Vec<f64> {
        self.parameters.iter().map(|own| own.start).collect()
    }

    /// Its machine with these values of its parameters. `warnings` are added to. Bodies that it was not exported with, as on
    /// another kind of processor, are reduced.
    ///
    /// # Errors
    /// Values that the case does not take.
    pub fn make(&self, values: &[f64], warnings: &mut Vec<String>) -> Result<Made, Failure> {
        let text = parameters::with_values(&self.text, &self.parameters, values);
        let mut case = machine::read_text(&text, warnings)?;
        case.marched()?;
        if let Some(state) = &self.state {
            start::time_of(state)?;
            start::go_on(&mut case, state);
        }
        let built = machine::build_planned(&case, Some(&self.cache), warnings)?;
        let variables = Variables::of(&case, &built, &self.parameters);
        let texts = text.noted().into_iter().map(|own| own.path.clone());
        let files = texts.chain(case.other_files()).collect();
        Ok(Made { case, built, variables, files })
    }
}

impl Made {
    /// The march of its machine before its first step.
    ///
    /// # Errors
    /// No equilibrium, or no state that fits.
    pub fn begin(&self) -> Result<March<'_>, Failure> {
        simulate::begin(&self.case, &self.built).map(|(march, _)| march)
    }

    /// Δt (s); where the program chooses the parts of it, from one row of the history to the next.
    pub fn time_step(&self) -> f64 {
        self.case.march().time_step
    }

    /// The march of its machine from a point of another one.
    ///
    /// # Errors
    /// A mass matrix that cannot be inverted.
    pub fn resume(&self, point: Checkpoint) -> Result<March<'_>, Failure> {
        let options = start::options(&self.case, &self.built);
        March::resume(&self.built.machine, &options, point).map_err(Failure::from)
    }

    /// Its machine.
    pub fn built(&self) -> &Built {
        &self.built
    }

    /// The speed that a body has at t = 0 where it is not told another (rad/s); 0 of one that is not told any.
    pub fn speed_at_start(&self, body: usize) -> f64 {
        let rotation = self.built.machine.bodies.get(body).and_then(|own| own.rotation());
        rotation.and_then(|own| own.told_speed()).unwrap_or(0.0)
    }

    /// Its variables, in the order of their value references.
    pub fn variables(&self) -> &[Variable] {
        &self.variables.all
    }

    /// Loads that can be told, by their places in [`Role::Load`](super::Role::Load).
    pub fn loads(&self) -> &[ToldGroup] {
        &self.variables.loads
    }

    /// Bodies of which the speed can be told, by their places in [`Role::Speed`](super::Role::Speed).
    pub fn speeds(&self) -> &[usize] {
        &self.variables.speeds
    }
}

/// A file of a unit that cannot be used.
fn damaged(path: &Path, reason: &str) -> Failure {
    let message = format!("`{}` cannot be used: {reason}", path.display());
    let error = Diagnostic::new(&Source::new(path, ""), Code::BAD_VALUE, None, message);
    Failure::Input(error.help("export the unit again, and leave its files as they are").into())
}

//! `whirl export`: a case with its reduced bodies and the solver as a unit for co-simulation, after FMI 2.0.

use std::fs;
use std::path::{Path, PathBuf};

use whirl_solver::cache::{Cache, Key};
use whirl_solver::model::LoadAction;

use super::description;
use super::layout;
use super::library::Library;
use super::parameters::{self, Parameter};
use super::unit::{BODIES, LAST_STATE, MANIFEST, Manifest, Unit};
use super::variables::{Role, Variable, Variables};
use crate::archive;
use crate::arguments::ExportArguments;
use crate::case::{Case, CaseText, Form, JoinedLoad};
use crate::errors::Failure;
use crate::machine;
use crate::output;
use crate::progress::{self, ProgressMode};
use crate::results::STATE;
use crate::{start, streams, version};

/// Files by their paths.
type Files = Vec<(String, Vec<u8>)>;

/// Writes the unit of a case; gives what there is to say of it.
///
/// # Errors
/// A case that cannot be marched, keys that are no parameters, no library, a file that cannot be written. Nothing is written
/// then.
pub(crate) fn export(arguments: &ExportArguments) -> Result<String, Failure> {
    let library = Library::find(arguments.library.as_deref())?;
    let text = CaseText::find(&arguments.case, None)?;
    let case = streams::warned(|warnings| machine::read_text(&text, warnings))?;
    case.marched()?;
    let named = [text.path().into(), arguments.case.clone().into()];
    let mut read: Vec<PathBuf> = named.into_iter().chain(arguments.library.clone()).collect();
    read.extend(case.other_files());
    read.extend(text.noted().iter().map(|own| own.path.clone()));
    may_be_written(&arguments.fmu, &read)?;
    let parameters = parameters::asked(&text, &arguments.parameters)?;
    parameters::keep_bodies(&text, &parameters)?;
    let cache = Cache::shared(arguments.cache.open());
    let show = ProgressMode::fitting(arguments.quiet);
    let build =
        || streams::warned(|warnings| machine::build_planned(&case, Some(&cache), warnings));
    let built = progress::during(show, case.reducing(), build)?;
    let variables = Variables::of(&case, &built, &parameters);
    unanswered(&case).iter().for_each(streams::warn);
    let (name, resources) = resources(arguments, (&text, &case), &cache)?;
    let state = resources.iter().find(|own| own.0 == LAST_STATE);
    let begins = state.map_or(Ok(0.0), |own| start::time_of(&own.1))?;
    let (all, keys) = (&variables.all, &parameters);
    let content = Content { case: &case, begins, variables: all, parameters: keys };
    let files = content.files(library, (name, resources));
    prove(&files, &variables.all)?;
    let bytes = archive::packed(&files).map_err(|error| Failure::Output {
        path: arguments.fmu.clone(),
        reason: error.to_string(),
    })?;
    let size = bytes.len();
    output::write_file(&arguments.fmu, bytes)?;
    Ok(said(&arguments.fmu, size, &variables.all))
}

/// Inputs of loads along which the case has none, and to which reduced bodies keep no static answer, a warning each load.
fn unanswered(case: &Case) -> Vec<String> {
    let of = |own: &JoinedLoad| {
        let body = &case.machine.bodies[own.body];
        let Form::Meshed(form) = &body.form else { return None };
        let (parts, letter) = match own.load.acting {
            LoadAction::Force(parts) => (parts, 'f'),
            LoadAction::Couple(parts) => (parts, 'm'),
        };
        let (kept, turns) = (form.body.static_correction.loads && !form.rigid, body.turns());
        if !kept || parts == [0.0; 3] {
            return None;
        }
        let across = turns && (parts[0] != 0.0 || parts[1] != 0.0);
        // Along its axis a body that turns is stiff.
        let lacks =
            |axis: &usize| parts[*axis] == 0.0 && !(across && *axis < 2 || turns && *axis == 2);
        let name = own.name.text();
        let inputs: Vec<String> = (0..3)
            .filter(lacks)
            .map(|axis| format!("`load.{name}.{letter}{}`", ["x", "y", "z"][axis]))
            .collect();
        let body = body.name.text();
        (!inputs.is_empty()).then(|| {
            format!(
                "{}: the case has nothing there, so that the reduced {body} keeps no static answer to it and gives way too little; \
                 give the load a small value along them, such as 1e-6 of the others",
                inputs.join(", ")
            )
        })
    };
    case.machine.loads.iter().filter_map(of).collect()
}

/// Whether a unit may stand at a path.
///
/// # Errors
/// The export reads what is there, or it is no file.
fn may_be_written(file: &Path, read: &[PathBuf]) -> Result<(), Failure> {
    let Ok(whole) = file.canonicalize() else { return Ok(()) };
    let why = if read.iter().any(|own| own.canonicalize().is_ok_and(|own| own == whole)) {
        "the unit is made of this file"
    } else if !whole.is_file() {
        "it is there, and is no file"
    } else {
        return Ok(());
    };
    Err(Failure::Argument {
        message: format!("`--fmu {}`: {why}", file.display()),
        help: "name a new file for the unit, such as `--fmu rotor.fmu`".to_owned(),
    })
}

/// The path of the case in the unit, and its files with the reduced bodies.
fn resources(
    arguments: &ExportArguments,
    (text, case): (&CaseText, &Case),
    cache: &Cache,
) -> Result<(String, Files), Failure> {
    let mut named: Vec<(PathBuf, Vec<u8>)> = vec![(text.path().into(), text.text().into())];
    let others: Vec<(PathBuf, Vec<u8>)> = match Path::new(&arguments.case).is_file() {
        true => {
            let noted = text.noted();
            noted.iter().map(|own| (own.path.clone(), own.text.clone().into())).collect()
        }
        false => case.files().map(|(path, own)| (path.into(), own.into())).collect(),
    };
    named.extend(others);
    let content = |path: &Path| {
        fs::read(path).map_err(|error| Failure::Argument {
            message: format!("cannot read `{}`: {error}", path.display()),
            help: "a unit takes with it all files that its case names".to_owned(),
        })
    };
    for path in case.other_files() {
        let content = content(&path)?;
        named.push((path, content));
    }
    let state = case.goes_on_from().map(|folder| content(&folder.join(STATE))).transpose()?;
    let paths: Vec<PathBuf> = named.iter().map(|own| own.0.clone()).collect();
    let paths = layout::paths(&paths)?;
    let main = paths[0].clone();
    let mut files: Files = paths.into_iter().zip(named.into_iter().map(|own| own.1)).collect();
    files.extend(state.map(|content| (LAST_STATE.to_owned(), content)));
    let mut bodies: Vec<Vec<u8>> = cache.held().iter().map(|own| own.to_vec()).collect();
    bodies.sort();
    let body = |(place, content)| (format!("{BODIES}/{}.bin", place + 1), content);
    files.extend(bodies.into_iter().enumerate().map(body));
    files.sort();
    files.dedup_by(|a, b| a.0 == b.0);
    Ok((main, files))
}

/// What a unit is of.
struct Content<'c> {
    case: &'c Case,
    /// Time of its start (s).
    begins: f64,
    variables: &'c [Variable],
    parameters: &'c [Parameter],
}

impl Content<'_> {
    /// All files of the archive, the description first. `main`: the path of the case among the resources.
    fn files(&self, library: Library, (main, resources): (String, Files)) -> Files {
        let identifier = description::identifier(&self.case.name);
        let Library { content, platform, ending } = library;
        let untold = description::text((self.case, self.begins), self.variables, &identifier, "");
        let keys: Vec<&str> = self.parameters.iter().map(|own| own.key.as_str()).collect();
        let token = Key::of(&(untold, &content, &main, &keys, &resources)).hex();
        let manifest = Manifest {
            program: version::SOURCES.to_owned(),
            token: token.clone(),
            case: main,
            parameters: keys.into_iter().map(str::to_owned).collect(),
        };
        let manifest = serde_json::to_vec_pretty(&manifest).expect("texts can be written");
        let description =
            description::text((self.case, self.begins), self.variables, &identifier, &token);
        let mut files = vec![
            ("modelDescription.xml".to_owned(), description.into_bytes()),
            (format!("binaries/{platform}/{identifier}{ending}"), content),
            (format!("{RESOURCES}/{MANIFEST}"), manifest),
        ];
        let below = |(path, content)| (format!("{RESOURCES}/{path}"), content);
        files.extend(resources.into_iter().map(below));
        files
    }
}

const RESOURCES: &str = "resources";

/// Opens a unit as its importer will, from a folder elsewhere.
///
/// # Errors
/// A file of the case that does not go with it.
fn prove(files: &Files, variables: &[Variable]) -> Result<(), Failure> {
    let elsewhere = |reason: String| Failure::Output { path: std::env::temp_dir(), reason };
    let folder = tempfile::tempdir().map_err(|error| elsewhere(error.to_string()))?;
    for (path, content) in files.iter().filter(|own| own.0.starts_with(RESOURCES)) {
        let path = folder.path().join(path);
        let above = path.parent().unwrap_or(folder.path());
        let written = fs::create_dir_all(above).and_then(|()| fs::write(&path, content));
        written.map_err(|error| elsewhere(error.to_string()))?;
    }
    let unit = Unit::open(&folder.path().join(RESOURCES))?;
    let made = unit.make(&unit.parameter_values(), &mut Vec::new())?;
    if let Some(path) = made.files.iter().find(|own| !own.starts_with(folder.path())) {
        return Err(Failure::Argument {
            message: format!(
                "`{}` is named by its whole path, which is another one where the unit is used",
                path.display()
            ),
            help: "name it by its path relative to the file that names it".to_owned(),
        });
    }
    assert_eq!(made.variables(), variables, "a unit has the variables that it describes");
    Ok(())
}

/// What there is to say of a unit that was written.
fn said(path: &Path, size: usize, variables: &[Variable]) -> String {
    let count =
        |wanted: fn(&Role) -> bool| variables.iter().filter(|own| wanted(&own.role)).count();
    let outputs = count(|own| matches!(own, Role::Output(_)));
    let parameters = count(|own| matches!(own, Role::Parameter(_)));
    let inputs = variables.len() - outputs - parameters;
    format!(
        "{}: {:.2} MB; {inputs} inputs, {outputs} outputs, {parameters} parameters\n",
        path.display(),
        1e-6 * size as f64
    )
}

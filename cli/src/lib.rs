//! The `whirl` command: case files, progress, results, figures.

mod analyse;
mod analysis;
mod archive;
pub mod arguments;
mod case;
mod check;
mod checkpoint;
mod created;
pub mod errors;
mod explain;
mod fields;
mod figures;
pub mod fmu;
mod history;
mod law_file;
mod list;
mod lock;
mod machine;
mod matlab;
mod memory;
mod mesh_file;
mod new;
mod other_files;
mod output;
mod outside;
mod page;
mod parquet;
mod picture_file;
mod progress;
mod report;
mod report_file;
mod results;
mod ring;
mod room;
mod run;
mod schema;
mod shell;
mod signals;
pub mod simulate;
mod spec_file;
mod start;
mod streams;
pub mod sweep;
mod table_files;
mod text_file;
mod told;
mod values;
mod version;
mod watch;

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::kinds::list::Spec;
use whirl_solver::cache::{Cache, Key};
use whirl_solver::machine::MachineParts;

pub use analysis::{Analysed, Asked, Described};
pub use case::{Case, CaseText};
pub use figures::{Curve, curves};
pub use history::HistoryTable;
pub use machine::Built;
pub use new::FromRotor;

use arguments::{Arguments, Command};
use case::AnalysisKind;
use errors::Failure;
use streams::{print_error, say};

/// Does what the command line asks for, and says which exit status that gives: 0 done, 1 begun and not finished or
/// not written to standard output, 2 bad input.
pub fn execute(arguments: &Arguments) -> ExitCode {
    let done = match &arguments.command {
        Command::Run(arguments) => run::run(arguments),
        Command::Sweep(arguments) => sweep::sweep(&arguments.order()),
        Command::Analyse(arguments) => analyse::analyse(arguments),
        Command::Modes(arguments) => analyse::of_kind(AnalysisKind::Modes, arguments),
        Command::Campbell(arguments) => analyse::of_kind(AnalysisKind::Campbell, arguments),
        Command::Response(arguments) => analyse::of_kind(AnalysisKind::Response, arguments),
        Command::Coefficients(arguments) => analyse::of_kind(AnalysisKind::Coefficients, arguments),
        Command::Stability(arguments) => analyse::of_kind(AnalysisKind::Stability, arguments),
        Command::Torsion(arguments) => analyse::of_kind(AnalysisKind::Torsion, arguments),
        Command::Forces(arguments) => analyse::of_kind(AnalysisKind::Forces, arguments),
        Command::Map(arguments) => analyse::map_of(arguments),
        Command::Lateral(arguments) => analyse::lateral_of(arguments),
        Command::Matrices(arguments) => analyse::matrices(arguments),
        Command::Report(arguments) => report_file::report(arguments).and_then(|text| say(&text)),
        Command::Check(arguments) => check::check(arguments).and_then(|text| say(&text)),
        Command::Explain(arguments) => explain::explain(arguments).and_then(|text| say(&text)),
        Command::New(arguments) => new::new(arguments).and_then(|text| say(&text)),
        Command::Schema(arguments) => {
            say(&schema::schema(arguments.kind.as_deref(), arguments.page))
        }
        Command::Export(arguments) => {
            fmu::export(arguments).and_then(|text| match arguments.quiet {
                true => Ok(()),
                false => say(&text),
            })
        }
        Command::Mesh(arguments) => mesh_file::mesh(arguments).and_then(|text| say(&text)),
        Command::List => say(&list::list()),
        Command::Completions(arguments) => say(&shell::completions(arguments)),
        Command::Man(arguments) => shell::man(arguments).and_then(|text| say(&text)),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            print_error(&failure.report());
            failure.status()
        }
    }
}

/// Reads a case for a program that runs it itself, with [`simulate::in_memory`] once it is built. `case`: a path or the name
/// of a built-in case. `warnings` are added to, here and below.
///
/// # Errors
/// Everything wrong with the case, each with its place.
pub fn read(case: &str, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    machine::read(case, warnings)
}

/// As [`read`], of a text.
///
/// # Errors
/// As [`read`].
pub fn read_text(text: &CaseText, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    machine::read_text(text, warnings)
}

/// As [`read`], of a case that need not be marched.
///
/// # Errors
/// As [`read`].
pub fn read_to_analyse(case: &str, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    machine::read_to_analyse(case, warnings)
}

/// As [`read_to_analyse`], of a text.
///
/// # Errors
/// As [`read`].
pub fn read_text_to_analyse(text: &CaseText, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    machine::read_text_to_analyse(text, warnings)
}

/// What `whirl check` says of a case.
///
/// # Errors
/// As [`build`].
pub fn check_case(
    case: &Case,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<String, Failure> {
    check::of_case(
        (case, None),
        (cache, check::Wanted::default()),
        progress::ProgressMode::Nothing,
        warnings,
    )
}

/// What `whirl explain` says of a spec: the name of a built-in one, or the path of a file.
///
/// # Errors
/// Nothing is called so; whatever is wrong with it.
pub fn explain_spec(name: &str) -> Result<String, Failure> {
    explain::of_name(name)
}

/// As [`explain_spec`], of a text.
///
/// # Errors
/// Whatever is wrong with it.
pub fn explain_text(source: &Arc<Source>) -> Result<String, Failure> {
    explain::of_source(source, None)
}

/// The law called `name`: a built-in one, or the path of a file.
///
/// # Errors
/// Nothing is called so; whatever is wrong with it; what it is, if that is no law.
pub fn law(name: &str) -> Result<LawSpec, Failure> {
    let (source, _) = spec_file::find(name)?;
    law_of(&source)
}

/// As [`law`], of a text.
///
/// # Errors
/// As [`law`].
pub fn law_of(source: &Arc<Source>) -> Result<LawSpec, Failure> {
    match spec_file::read(source)? {
        Spec::Law(law) => Ok(*law),
        other => {
            let message = format!("this is a spec of the kind `{}`, not a law", other.kind().name);
            Err(Diagnostics::from(Diagnostic::new(source, Code::BAD_VALUE, None, message)).into())
        }
    }
}

/// Hash of all sources of the program, and of the compiler.
pub fn sources() -> &'static str {
    version::SOURCES
}

/// Names of the built-in cases.
pub fn built_in_cases() -> impl Iterator<Item = &'static str> {
    case::embedded_cases()
}

/// A case from a rotor that ROSS saved as `file`, as `whirl new case --from` writes it; it and the files beside it will be called
/// `name`.
///
/// # Errors
/// A file that is none of a rotor, and everything in it that no rotor has.
pub fn case_of_rotor(file: &Path, name: &str) -> Result<FromRotor, Failure> {
    new::rotor(file, name)
}

/// Builds the machine of a case, which may be run many times, by several threads at once. Bodies that `cache` has are not
/// reduced again: cases that differ in nothing that their bodies depend on share them through [`Cache::shared`].
///
/// # Errors
/// Everything wrong with its meshes, sets, bodies and laws.
pub fn build(
    case: &Case,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<Built, Failure> {
    machine::build_planned(case, cache, warnings)
}

/// The keys under which the bodies of a case are kept: cases with the same keys share their bodies. Nothing is reduced.
///
/// # Errors
/// Everything wrong with its meshes and sets.
pub fn body_keys(case: &Case) -> Result<Vec<Key>, Failure> {
    machine::keys(case)
}

/// What the page of a run tells beside its numbers: the texts of about.json and, of a machine with bodies, of shapes.json.
/// `steady`: [`simulate::InMemory::steady`].
///
/// # Errors
/// Meshes that cannot be read any more.
pub fn page_facts(
    case: &Case,
    built: &Built,
    steady: String,
) -> Result<(String, Option<String>), Failure> {
    told::of_run((case, built), steady)
}

/// The text of report.html of a folder of results that is not kept: no files are named.
///
/// # Errors
/// It is no folder of results.
pub fn page_of(folder: &Path) -> Result<String, Failure> {
    report_file::page_alone(folder)
}

/// Checks for whatever can be found wrong with a case before its bodies are reduced: as `whirl check` does
/// first; gives the warnings. `case`: a path or the name of a built-in case.
///
/// # Errors
/// Everything wrong with the case, its meshes and its sets.
pub fn examine(case: &str) -> Result<Vec<String>, Failure> {
    let mut warnings = Vec::new();
    let case = machine::read(case, &mut warnings)?;
    machine::plan(&case, &mut warnings)?;
    Ok(warnings)
}

/// What the machine of a case is made from, for programs that march it themselves. `case`: a path or the name of a built-in case. What there is to warn of, [`examine`] says.
///
/// # Errors
/// Everything wrong with the case, as text.
pub fn machine_parts(case: &str) -> Result<MachineParts, String> {
    let case = case::read(case).map_err(|errors| errors.render())?;
    machine::parts(&case, &mut Vec::new()).map_err(|failure| failure.report())
}

//! `whirl analyse` and a command for each kind of analysis: a case, its machine, each analysis, and what they come to.

use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::{Code, Diagnostics, Located, suggest};
use whirl_solver::cache::write_whole;
use whirl_solver::linear::LinearMachine;

use crate::analysis::{Space, Subject};
use crate::arguments::{
    AnalyseArguments, AnalysisOutput, LateralArguments, MapArguments, MatricesArguments,
    ModesArguments,
};
use crate::case::{self, Analysis, AnalysisKind, Case, CaseText};
use crate::errors::Failure;
use crate::output::Output;
use crate::page::{self, Analyses, AnalysisFacts};
use crate::progress::{self, ProgressMode};
use crate::results::{ANALYSES, REPORT};
use crate::signals::Interruption;
use crate::streams::say;
use crate::table_files::TableFiles;
use crate::{check, machine, streams};

/// Does the analyses of a case.
///
/// # Errors
/// Bad input, a folder that cannot be written, a speed at which the machine does not stand, an interruption.
pub(crate) fn analyse(arguments: &AnalyseArguments) -> Result<(), Failure> {
    let case = read(&arguments.case)?;
    let chosen = chosen(&case, arguments.name.as_deref())?;
    let folder = arguments.results.out.clone().unwrap_or_else(|| usual(&case));
    run((&case, &arguments.case), &chosen, Some(&folder), &arguments.results)
}

/// Does one that the command line describes.
///
/// # Errors
/// As [`analyse`].
pub(crate) fn of_kind(kind: AnalysisKind, arguments: &ModesArguments) -> Result<(), Failure> {
    let case = read(&arguments.case)?;
    let ModesArguments { of, speeds, count, orders, .. } = arguments;
    let analysis = described(&case, kind, (of.as_deref(), speeds.as_deref()), (*count, orders))?;
    let folder = match (&arguments.results.out, kind) {
        (Some(folder), _) => Some(folder.clone()),
        (None, AnalysisKind::Modes | AnalysisKind::Coefficients) => None,
        (None, _) => Some(usual(&case)),
    };
    run((&case, &arguments.case), &[analysis], folder.as_deref(), &arguments.results)
}

/// Draws the map that the command line describes.
///
/// # Errors
/// As [`analyse`].
pub(crate) fn map_of(arguments: &MapArguments) -> Result<(), Failure> {
    let case = read(&arguments.case)?;
    let stiffness = match &arguments.stiffness {
        Some(text) => case::stiffness(&Located::alone("--stiffness", text)).map_err(|own| {
            let mut errors = Diagnostics::new();
            errors.push(*own);
            errors
        })?,
        None => Vec::new(),
    };
    let (of, count) = (arguments.of.as_deref(), arguments.count);
    let analysis =
        Analysis { stiffness, ..described(&case, AnalysisKind::Map, (of, None), (count, &[]))? };
    let folder = arguments.results.out.clone().unwrap_or_else(|| usual(&case));
    run((&case, &arguments.case), &[analysis], Some(&folder), &arguments.results)
}

/// Does the lateral analyses of a case.
///
/// # Errors
/// As [`analyse`]; the case has none.
pub(crate) fn lateral_of(arguments: &LateralArguments) -> Result<(), Failure> {
    let case = read(&arguments.case)?;
    let own = case.analyses.iter().filter(|own| own.kind == AnalysisKind::Lateral);
    let own: Vec<Analysis> = own.cloned().collect();
    if own.is_empty() {
        return Err(Failure::Argument {
            message: format!("`{}` has no lateral analysis", case.name),
            help: "add a table such as `[analysis.lateral]` with `kind = \"lateral\"`, `minimum_speed` and `maximum_speed`"
                .to_owned(),
        });
    }
    let folder = arguments.results.out.clone().unwrap_or_else(|| usual(&case));
    run((&case, &arguments.case), &own, Some(&folder), &arguments.results)
}

/// Writes the matrices of small motions.
///
/// # Errors
/// As [`analyse`].
pub(crate) fn matrices(arguments: &MatricesArguments) -> Result<(), Failure> {
    let case = read(&arguments.case)?;
    let (of, speeds) = asked(&case, arguments.of.as_deref(), arguments.speeds.as_deref())?;
    let analysis = Analysis {
        of,
        speeds,
        format: arguments.format,
        ..Analysis::of_kind(AnalysisKind::Matrices)
    };
    let folder = arguments.out.clone().unwrap_or_else(|| usual(&case));
    let (quiet, cache) = (arguments.quiet, arguments.cache.clone());
    let results = AnalysisOutput {
        out: None,
        parquet: false,
        mat: false,
        no_figures: true,
        no_report: true,
        quiet,
        cache,
    };
    run((&case, &arguments.case), &[analysis], Some(&folder), &results)
}

fn read(name: &str) -> Result<Case, Failure> {
    streams::warned(|warnings| machine::read_to_analyse(name, warnings))
}

fn usual(case: &Case) -> PathBuf {
    Path::new("results").join(&case.name)
}

/// The analyses of a case that are meant.
fn chosen(case: &Case, name: Option<&str>) -> Result<Vec<Analysis>, Failure> {
    let wrong = |message: String, help: String| Err(Failure::Argument { message, help });
    if case.analyses.is_empty() {
        let help = "add a table such as `[analysis.campbell]` with `kind = \"campbell\"`, or try `whirl campbell` and \
                    `whirl modes`, which need none";
        return wrong(format!("`{}` has no analysis", case.name), help.to_owned());
    }
    let Some(name) = name else { return Ok(case.analyses.clone()) };
    let own = case.analyses.iter().find(|own| own.name == name);
    own.map_or_else(
        || {
            let names: Vec<&str> = case.analyses.iter().map(|own| own.name.as_str()).collect();
            let help = suggest(name, &names)
                .unwrap_or_else(|| format!("its analyses: {}", names.join(", ")));
            wrong(format!("`{}` has no analysis `{name}`", case.name), help)
        },
        |own| Ok(vec![own.clone()]),
    )
}

/// The analysis that arguments describe.
fn described(
    case: &Case,
    kind: AnalysisKind,
    (of, speeds): (Option<&str>, Option<&str>),
    (count, orders): (usize, &[f64]),
) -> Result<Analysis, Failure> {
    let (of, speeds) = asked(case, of, speeds)?;
    if let Some(order) = orders.iter().find(|order| !(**order > 0.0)) {
        return Err(Failure::Argument {
            message: format!("`{order}` is no order of a rotation"),
            help: "write positive numbers, such as `--orders 1,2`".to_owned(),
        });
    }
    if count == 0 {
        return Err(Failure::Argument {
            message: "no modes are asked for".to_owned(),
            help: "write `--count 10`".to_owned(),
        });
    }
    Ok(Analysis {
        of,
        speeds,
        count,
        orders: if orders.is_empty() { kind.orders() } else { case::each_once(orders) },
        ..Analysis::of_kind(kind)
    })
}

/// The body and the speeds that arguments name.
fn asked(
    case: &Case,
    of: Option<&str>,
    speeds: Option<&str>,
) -> Result<(Option<usize>, Vec<f64>), Failure> {
    let mut errors = Diagnostics::new();
    let of = of.and_then(|name| {
        case::turning(&case.machine, &Located::alone("--of", name))
            .map_err(|own| errors.push(*own))
            .ok()
    });
    let speeds = speeds.and_then(|text| {
        case::speeds(&Located::alone("--speeds", text)).map_err(|own| errors.push(*own)).ok()
    });
    errors.into_result((of, speeds.unwrap_or_default())).map_err(Failure::from)
}

/// Does analyses one after the other, and writes what they come to into a folder, if there is one.
fn run(
    (case, file): (&Case, &str),
    analyses: &[Analysis],
    folder: Option<&Path>,
    arguments: &AnalysisOutput,
) -> Result<(), Failure> {
    let show = ProgressMode::fitting(arguments.quiet);
    let tables = TableFiles::of(arguments);
    if let (None, Some(option)) = (folder, tables.option()) {
        return Err(Failure::Argument {
            message: format!(
                "`{option}` writes tables beside others, and no folder is given for these"
            ),
            help: "add `--out DIR`".to_owned(),
        });
    }
    let mut output = folder.map(Output::open_alone).transpose()?;
    let interruption = Interruption::install().map_err(|error| Failure::Unfinished {
        reason: format!("signal handlers cannot be installed: {error}"),
        kept: None,
        help: None,
    })?;
    let cache = arguments.cache.open();
    let whole = analyses.iter().any(|own| !Subject::is_alone(own.kind));
    let mut words = Vec::new();
    let mut linear = None;
    if whole || folder.is_some() {
        let (built, said) = streams::warned(|warnings| {
            let plan = machine::plan(case, warnings)?;
            let words = check::words(case, &plan)?;
            let build = || machine::build(case, &plan, cache.as_ref(), warnings);
            let built = whole.then(|| progress::during(show, case.reducing(), build)).transpose();
            Ok::<_, Failure>((built?, words))
        })?;
        linear = built.map(|own| LinearMachine::new(own.machine)).transpose()?;
        words = said;
    }
    // Variants of a case are read anew.
    let text = match analyses.iter().any(Subject::needs_text) {
        true => Some(CaseText::find(file, None)?),
        false => None,
    };
    let space = (!arguments.no_report && output.is_some()).then(|| Space::of(case, cache.as_ref()));
    let subject = Subject {
        case,
        text: text.as_ref(),
        linear: linear.as_ref(),
        cache: cache.as_ref(),
        interruption: &interruption,
        figures: !arguments.no_figures && output.is_some(),
        space: space.as_ref(),
    };
    let (mut done, mut interrupted) = (Vec::new(), false);
    let (mut lost, mut alone) = (Vec::new(), None);
    let mut unfinished: Vec<Failure> = Vec::new();
    let mut refused = Diagnostics::new();
    for analysis in analyses {
        let name = &analysis.name;
        let work = || streams::warned(|warnings| subject.found(analysis, warnings));
        let found = match progress::during(show, "analysing", work) {
            Ok(found) => found,
            // What the ones before came to is kept.
            Err(Failure::Unfinished { .. }) if !done.is_empty() && interruption.asked() => {
                show.note(&format!("`{name}` was interrupted before anything was found"));
                interrupted = true;
                break;
            }
            Err(error @ Failure::Unfinished { .. }) if interruption.asked() => return Err(error),
            // One that comes to nothing keeps no other from being done, and what it came to before does not stand for it.
            Err(error) => {
                lost.push(AnalysisFacts::failed(analysis, &error.to_string()));
                match error {
                    error if analyses.len() == 1 && analysis.table.is_none() => alone = Some(error),
                    error @ Failure::Unfinished { .. } => unfinished.push(named(analysis, error)),
                    // Nor does one that cannot be done: its table is named.
                    error => refused.append(located(analysis, error)),
                }
                continue;
            }
        };
        if !arguments.quiet {
            say(&found.text)?;
        }
        let mut files = Vec::new();
        if let Some(output) = &mut output {
            for (file, content) in found.files {
                // Matrices have formats of their own.
                let others = match analysis.kind == AnalysisKind::Matrices {
                    true => Vec::new(),
                    false => tables.made(&file, &content),
                };
                for (name, own) in others.into_iter().chain([(file, content)]) {
                    output.put(&name, own);
                    files.push(name);
                }
            }
        }
        let speeds = (subject.speed_of(analysis), subject.run_speeds(analysis));
        done.push(AnalysisFacts::new(analysis, &found.text, files, found.interrupted, speeds));
        interrupted |= found.interrupted;
        if interrupted {
            show.note(&format!("`{name}` was interrupted: what was found is kept"));
            break;
        }
    }
    let before = folder.and_then(Analyses::of);
    let stood = |own: &AnalysisFacts| {
        before.as_ref().is_some_and(|before| !before.files_of(own.name()).is_empty())
    };
    let ended = !unfinished.is_empty() || matches!(alone, Some(Failure::Unfinished { .. }));
    let changes = !done.is_empty() || ended && lost.iter().any(stood);
    if let (Some(mut output), Some(folder), true) = (output, folder, changes) {
        let stale =
            before.iter().flat_map(|own| lost.iter().flat_map(|lost| own.files_of(lost.name())));
        stale.for_each(|file| output.remove(file));
        done.extend(lost);
        output.put(ANALYSES, Analyses::with(folder, case, words, done).json());
        output.commit()?;
        if !arguments.no_report {
            let path = folder.join(REPORT);
            let written = page::made(folder).and_then(|page| {
                write_whole(&path, page.as_bytes()).map_err(|error| error.to_string())
            });
            written.map_err(|reason| Failure::Output { path, reason })?;
        }
        show.note(&format!("results are in {}", folder.display()));
    }
    if interrupted {
        return Err(Failure::Unfinished {
            reason: "interrupted".to_owned(),
            // What is kept has been told of already.
            kept: None,
            help: None,
        });
    }
    if let Some(error) = alone {
        return Err(error);
    }
    // The last error is the command's own; those before it are written here.
    let last = if refused.is_empty() { unfinished.pop() } else { None };
    unfinished.iter().for_each(|own| streams::print_error(&own.report()));
    refused.into_result(())?;
    last.map_or(Ok(()), Err)
}

/// Why an analysis among others comes to nothing, with its name.
fn named(analysis: &Analysis, error: Failure) -> Failure {
    match error {
        Failure::Unfinished { reason, kept, help } => {
            let reason = format!("the analysis `{}` comes to nothing: {reason}", analysis.name);
            Failure::Unfinished { reason, kept, help }
        }
        other => other,
    }
}

/// Why an analysis among others cannot be done, with the place of its table.
fn located(analysis: &Analysis, error: Failure) -> Diagnostics {
    let error = match error {
        Failure::Input(all) => return all,
        other => other,
    };
    let alone = Located::alone("analysis", &analysis.name);
    let table = analysis.table.as_ref().unwrap_or(&alone);
    let message = format!("the analysis `{}` cannot be done: {error}", analysis.name);
    let diagnostic = table.error_here(Code::BAD_VALUE, message);
    let diagnostic = match error {
        Failure::Argument { help, .. } => diagnostic.help(help),
        _ => diagnostic,
    };
    let mut all = Diagnostics::new();
    all.push(diagnostic);
    all
}

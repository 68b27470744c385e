//! `whirl analyse`, `modes`, `campbell`, `response` and `coefficients`: small motions about the state in which a machine stands at constant speeds.
//!
//! A case → its machine → bodies made round ([`LinearMachine`]) → each analysis over its speeds → a text, tables and figures.

mod campbell;
mod coefficients;
mod found;
mod lost;
mod modes;
mod response;
mod speeds;
mod words;

use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::{Diagnostics, Located, suggest};
use whirl_solver::linear::LinearMachine;

use crate::arguments::{AnalyseArguments, AnalysisOutput, ModesArguments};
use crate::case::{self, Analysis, AnalysisKind, Case, ORDERS};
use crate::errors::Failure;
use crate::output::Output;
use crate::progress::{self, ProgressMode};
use crate::signals::Interruption;
use crate::streams::say;
use crate::{machine, streams};

/// Does the analyses of a case.
///
/// # Errors
/// Bad input, a folder that cannot be written, a speed at which the machine does not stand, an interruption.
pub(crate) fn analyse(arguments: &AnalyseArguments) -> Result<(), Failure> {
    let case = read(&arguments.case)?;
    let chosen = chosen(&case, arguments.name.as_deref())?;
    let folder = arguments.results.out.clone().unwrap_or_else(|| usual(&case));
    run(&case, &chosen, Some(&folder), &arguments.results)
}

/// Does one that the command line describes.
///
/// # Errors
/// As [`analyse`].
pub(crate) fn of_kind(kind: AnalysisKind, arguments: &ModesArguments) -> Result<(), Failure> {
    let case = read(&arguments.case)?;
    let analysis = described(&case, kind, arguments)?;
    let folder = match (&arguments.results.out, kind) {
        (Some(folder), _) => Some(folder.clone()),
        (None, AnalysisKind::Modes | AnalysisKind::Coefficients) => None,
        (None, AnalysisKind::Campbell | AnalysisKind::Response) => Some(usual(&case)),
    };
    run(&case, &[analysis], folder.as_deref(), &arguments.results)
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
    arguments: &ModesArguments,
) -> Result<Analysis, Failure> {
    let mut errors = Diagnostics::new();
    let of = arguments.of.as_ref().and_then(|name| {
        let name = Located::alone("--of", name);
        case::turning(&case.machine, &name).map_err(|own| errors.push(*own)).ok()
    });
    let speeds = arguments.speeds.as_ref().and_then(|text| {
        case::speeds(&Located::alone("--speeds", text)).map_err(|own| errors.push(*own)).ok()
    });
    errors.into_result(())?;
    if let Some(order) = arguments.orders.iter().find(|order| !(**order > 0.0)) {
        return Err(Failure::Argument {
            message: format!("`{order}` is no order of a rotation"),
            help: "write positive numbers, such as `--orders 1,2`".to_owned(),
        });
    }
    if arguments.count == 0 {
        return Err(Failure::Argument {
            message: "no modes are asked for".to_owned(),
            help: "write `--count 10`".to_owned(),
        });
    }
    let orders = arguments.orders.clone();
    Ok(Analysis {
        name: kind.word().to_owned(),
        kind,
        of,
        speeds: speeds.unwrap_or_default(),
        ratios: Vec::new(),
        count: arguments.count,
        orders: if orders.is_empty() { ORDERS.to_vec() } else { orders },
    })
}

/// Does analyses one after the other, and writes what they come to into a folder, if there is one.
fn run(
    case: &Case,
    analyses: &[Analysis],
    folder: Option<&Path>,
    arguments: &AnalysisOutput,
) -> Result<(), Failure> {
    let show = ProgressMode::fitting(arguments.quiet);
    let mut output = folder.map(Output::open).transpose()?;
    let interruption = Interruption::install().map_err(|error| Failure::Unfinished {
        reason: format!("signal handlers cannot be installed: {error}"),
        kept: None,
        help: None,
    })?;
    let cache = arguments.cache.open();
    let build =
        || streams::warned(|warnings| machine::build_planned(case, cache.as_ref(), warnings));
    let built = progress::during(show, case.reducing(), build)?;
    let linear = LinearMachine::new(built.machine)?;
    let mut interrupted = false;
    for analysis in analyses {
        let name = &analysis.name;
        let wanted = speeds::wanted(case, &linear, analysis)?;
        let (wanted, figures) = ((analysis, &wanted), !arguments.no_figures);
        let work = || match analysis.kind {
            AnalysisKind::Modes => modes::found(case, &linear, wanted),
            AnalysisKind::Campbell => {
                campbell::found(case, &linear, wanted, &interruption, figures)
            }
            AnalysisKind::Response => {
                response::found(case, &linear, wanted, &interruption, figures)
            }
            AnalysisKind::Coefficients => coefficients::found(case, &linear, wanted, &interruption),
        };
        let found = progress::during(show, "analysing", work)?;
        if !arguments.quiet {
            say(&found.text)?;
        }
        if let Some(output) = &mut output {
            for (file, content) in found.files {
                output.put(&file, content);
            }
        }
        interrupted |= found.interrupted;
        if interrupted {
            show.note(&format!("`{name}` was interrupted: what was found is kept"));
            break;
        }
    }
    if let (Some(output), Some(folder)) = (output, folder) {
        output.commit()?;
        show.note(&format!("results are in {}", folder.display()));
    }
    if interrupted {
        return Err(Failure::Unfinished {
            reason: "interrupted".to_owned(),
            kept: folder.map(Path::to_path_buf),
            help: None,
        });
    }
    Ok(())
}

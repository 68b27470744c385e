//! Analyses of the points of a sweep: which ones it names, and their numbers.

use std::num::NonZero;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, suggest};
use whirl_solver::cache::Cache;
use whirl_solver::linear::LinearMachine;

use super::facts::Facts;
use super::subject::Subject;
use crate::case::{Analysis, AnalysisKind, Case};
use crate::errors::Failure;
use crate::machine::Built;
use crate::signals::Interruption;

/// Those that need no table, as they have usual settings.
const USUAL: [AnalysisKind; 7] = [
    AnalysisKind::Modes,
    AnalysisKind::Campbell,
    AnalysisKind::Response,
    AnalysisKind::Coefficients,
    AnalysisKind::Stability,
    AnalysisKind::Torsion,
    AnalysisKind::Forces,
];

/// The analyses of a case with these names: those of its tables, or a kind with its usual settings.
///
/// # Errors
/// There is none; one that has no numbers of its own for a table.
pub(crate) fn named(case: &Case, names: &[Located]) -> Result<Vec<Analysis>, Failure> {
    let mut errors = Diagnostics::new();
    let mut all = Vec::with_capacity(names.len());
    for name in names {
        let own = case.analyses.iter().find(|own| own.name == name.text()).cloned();
        let usual = USUAL.into_iter().find(|kind| kind.word() == name.text());
        match own.or_else(|| usual.map(Analysis::of_kind)) {
            None => errors.push(unknown(case, name)),
            Some(own) => match without_numbers(&own, name) {
                Some(error) => errors.push(error),
                None => all.push(own),
            },
        }
    }
    errors.into_result(all).map_err(Failure::from)
}

fn unknown(case: &Case, name: &Located) -> Diagnostic {
    let own = case.analyses.iter().map(|own| own.name.as_str());
    let names: Vec<&str> = own.chain(USUAL.map(AnalysisKind::word)).collect();
    let message = format!("`{}` has no analysis `{}`", case.name, name.text());
    let help = suggest(name.text(), &names).unwrap_or_else(|| {
        format!(
            "write a table `[analysis.{}]` in the case, or name one of these: {}",
            name.text(),
            names.join(", ")
        )
    });
    name.error_here(Code::BAD_VALUE, message).help(help)
}

/// Why an analysis has no numbers of which each is one of its own, if so.
fn without_numbers(own: &Analysis, name: &Located) -> Option<Diagnostic> {
    let wrong =
        |message: String, help: &str| Some(name.error_here(Code::BAD_VALUE, message).help(help));
    let several = |count: usize, of: &str| {
        format!("`{}` is of {count} {of}, and a cell of a table has one number", name.text())
    };
    match own.kind {
        AnalysisKind::Matrices => {
            let message = format!("`{}` gives matrices, which no table has", name.text());
            wrong(message, "name an analysis with numbers, such as `modes` or `stability`")
        }
        AnalysisKind::Periodic if own.periodic.vary.is_some() => {
            let message = format!("`{}` follows motions over a key of its own", name.text());
            wrong(message, "leave out its `vary`, and let the key vary in the sweep")
        }
        AnalysisKind::Modes
        | AnalysisKind::Coefficients
        | AnalysisKind::Forces
        | AnalysisKind::Periodic
            if own.speeds.len() > 1 =>
        {
            let help = "give one of `speeds`: add a table of another name with `speeds = \"3000 rpm\"`, or let a speed vary";
            wrong(several(own.speeds.len(), "speeds"), help)
        }
        AnalysisKind::Map if own.stiffness.len() != 1 => {
            let message = match own.stiffness.len() {
                0 => format!("`{}` is of many stiffnesses", name.text()),
                count => several(count, "stiffnesses"),
            };
            wrong(message, "give one of `stiffness`, such as `stiffness = \"1e7 N/m\"`")
        }
        _ => None,
    }
}

/// Whether some of them are of the machine that a march has.
pub(crate) fn need_machine(analyses: &[Analysis]) -> bool {
    analyses.iter().any(|own| !Subject::is_alone(own.kind))
}

/// A case at a point of a sweep.
pub(crate) struct AtPoint<'a> {
    pub(crate) case: &'a Case,
    /// Its machine, if that is needed.
    pub(crate) built: Option<&'a Built>,
    pub(crate) cache: &'a Cache,
    pub(crate) interruption: &'a Interruption,
    /// How many speeds are looked at side by side.
    pub(crate) threads: NonZero<usize>,
}

impl AtPoint<'_> {
    /// Numbers and notes of analyses, all under their names; of a lateral one those of the case as it is. `warnings` are added
    /// to.
    ///
    /// # Errors
    /// What keeps one of them from its end, an interruption included.
    pub(crate) fn facts(
        &self,
        analyses: &[Analysis],
        warnings: &mut Vec<String>,
    ) -> Result<Facts, Failure> {
        let linear = match self.built {
            Some(built) if need_machine(analyses) => {
                let linear = LinearMachine::new(built.machine.clone())?;
                Some(linear.on_threads(self.threads))
            }
            _ => None,
        };
        let subject = Subject {
            case: self.case,
            text: None,
            linear: linear.as_ref(),
            cache: Some(self.cache),
            interruption: self.interruption,
            figures: false,
            space: None,
        };
        let mut all = Facts::default();
        for analysis in analyses {
            let found = subject.found(analysis, warnings)?;
            if found.interrupted {
                let reason = "interrupted".to_owned();
                return Err(Failure::Unfinished { reason, kept: None, help: None });
            }
            let name = &analysis.name;
            let numbers = found.facts.numbers.into_iter();
            all.numbers.extend(numbers.map(|(own, value)| (format!("{name}.{own}"), value)));
            let called = if analyses.len() > 1 { format!("{name}: ") } else { String::new() };
            found.facts.notes.iter().for_each(|own| all.note(&format!("{called}{own}")));
        }
        Ok(all)
    }
}

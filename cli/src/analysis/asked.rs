//! Analyses for other programs: what they ask for, and what they are given. Nothing is written, and the tables are those of the
//! command.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use whirl_codegen::diagnostic::{Diagnostics, Located, suggest};
use whirl_solver::cache::Cache;
use whirl_solver::linear::LinearMachine;

use super::subject::Subject;
use crate::case::{self, Analysis, AnalysisKind, Case, CaseText, MatrixFormat};
use crate::errors::Failure;
use crate::signals::Interruption;

/// An analysis that a program asks for.
#[derive(Debug, Clone, Copy)]
pub enum Asked<'a> {
    /// That of a table `[analysis.NAME]`.
    Named(&'a str),
    /// One of a kind.
    Described(&'a Described),
}

/// What the keys of a table would say; what is left empty has its usual value.
#[derive(Debug, Clone, Default)]
pub struct Described {
    /// A kind, such as `campbell`.
    pub kind: String,
    /// The body whose speed it is.
    pub of: Option<String>,
    /// One speed or range each, with units.
    pub speeds: Vec<String>,
    /// Speeds of bodies over that of `of`.
    pub ratios: Vec<(String, f64)>,
    /// How many modes.
    pub count: Option<usize>,
    /// Orders of critical speeds.
    pub orders: Vec<f64>,
    /// One stiffness or range, with units.
    pub stiffness: Option<String>,
}

/// What an analysis comes to.
#[derive(Debug, Clone)]
pub struct Analysed {
    /// Under which its files stand.
    pub name: String,
    /// Its kind.
    pub kind: &'static str,
    /// What the command prints.
    pub text: String,
    /// Tables as CSV, matrices as NPZ, by the names of their files.
    pub files: Vec<(String, Vec<u8>)>,
    /// What limits its worth.
    pub notes: Vec<String>,
}

impl Asked<'_> {
    /// Does the analysis of a case. `text`: that of the case, for variants of a lateral analysis; `linear`: its machine, if it
    /// was made before; `ends`: a flag that ends it. `warnings` are added to.
    ///
    /// # Errors
    /// What is wrong with what is asked for; a machine that does not stand; an interruption.
    pub fn found(
        &self,
        (case, text): (&Case, Option<&CaseText>),
        linear: &dyn Fn() -> Result<Arc<LinearMachine>, Failure>,
        (cache, ends): (Option<&Cache>, Arc<AtomicBool>),
        warnings: &mut Vec<String>,
    ) -> Result<Analysed, Failure> {
        let analysis = match self {
            Asked::Named(name) => named(case, name)?,
            Asked::Described(own) => described(case, own)?,
        };
        // What is built in has its text in the program.
        let found = match (text, Subject::needs_text(&analysis)) {
            (None, true) => Some(CaseText::find(case.name(), None)?),
            _ => None,
        };
        let linear = if Subject::is_alone(analysis.kind) { None } else { Some(linear()?) };
        let interruption = Interruption::by(ends);
        let subject = Subject {
            case,
            text: text.or(found.as_ref()),
            linear: linear.as_deref(),
            cache,
            interruption: &interruption,
            figures: false,
            space: None,
        };
        let found = subject.found(&analysis, warnings)?;
        if found.interrupted {
            let reason = "interrupted".to_owned();
            return Err(Failure::Unfinished { reason, kept: None, help: None });
        }
        Ok(Analysed {
            kind: analysis.kind.word(),
            name: analysis.name,
            text: found.text,
            files: found.files,
            notes: found.facts.notes,
        })
    }
}

fn named(case: &Case, name: &str) -> Result<Analysis, Failure> {
    let Some(own) = case.analyses.iter().find(|own| own.name == name) else {
        let names: Vec<&str> = case.analyses.iter().map(|own| own.name.as_str()).collect();
        let all = match names.as_slice() {
            [] => format!("add a table `[analysis.{name}]` with a `kind`"),
            names => format!("its analyses: {}", names.join(", ")),
        };
        return Err(Failure::Argument {
            message: format!("`{}` has no analysis `{name}`", case.name),
            help: suggest(name, &names).unwrap_or(all),
        });
    };
    // Matrices of a program are in memory.
    Ok(Analysis { format: MatrixFormat::Npz, ..own.clone() })
}

fn described(case: &Case, asked: &Described) -> Result<Analysis, Failure> {
    let Some(kind) = AnalysisKind::of(&asked.kind) else {
        return Err(Failure::Argument {
            message: format!("`{}` is no kind of analysis", asked.kind),
            help: "write one such as `campbell`".to_owned(),
        });
    };
    let mut errors = Diagnostics::new();
    let mut analysis = Analysis::of_kind(kind);
    let mut body = |key: &str, name: &str| {
        let found = case::turning(&case.machine, &Located::alone(key, name));
        found.map_err(|error| errors.push(*error)).ok()
    };
    analysis.of = asked.of.as_ref().and_then(|name| body("of", name));
    if !asked.ratios.is_empty() {
        analysis.ratios = vec![None; case.machine.bodies.len()];
        for (name, ratio) in &asked.ratios {
            if let Some(place) = body("ratios", name) {
                analysis.ratios[place] = Some(*ratio);
            }
        }
    }
    for text in &asked.speeds {
        match case::speeds(&Located::alone("speeds", text)) {
            Ok(own) => analysis.speeds.extend(own),
            Err(error) => errors.push(*error),
        }
    }
    analysis.speeds.sort_by(f64::total_cmp);
    analysis.speeds.dedup();
    if let Some(text) = &asked.stiffness {
        match case::stiffness(&Located::alone("stiffness", text)) {
            Ok(own) => analysis.stiffness = own,
            Err(error) => errors.push(*error),
        }
    }
    analysis.count = asked.count.unwrap_or(analysis.count);
    if !asked.orders.is_empty() {
        analysis.orders.clone_from(&asked.orders);
    }
    let wrong =
        |message: String, help: &str| Err(Failure::Argument { message, help: help.to_owned() });
    if let Some(order) = asked.orders.iter().find(|own| !(**own > 0.0)) {
        return wrong(format!("`{order}` is no order of a rotation"), "give positive numbers");
    }
    if analysis.count == 0 {
        return wrong("no modes are asked for".to_owned(), "give a `count` such as 10");
    }
    errors.into_result(analysis).map_err(Failure::from)
}

//! Over which speeds of which body an analysis is.

use whirl_solver::bodies::Rotation;
use whirl_solver::linear::LinearMachine;

use crate::case::{Analysis, AnalysisKind, Case};
use crate::errors::Failure;

/// Speeds of a Campbell diagram where none are asked for.
const COUNT: usize = 31;
/// Of a response, which has peaks.
pub(super) const FINE: usize = 121;
/// How far they reach, of the top speed of the case.
const BEYOND: f64 = 1.25;

/// Speeds of a body.
pub(super) struct Wanted {
    /// The body, by its place; none of a machine in which nothing turns.
    pub(super) of: Option<usize>,
    /// rad/s, ascending.
    pub(super) speeds: Vec<f64>,
}

/// Those that are asked for, or those of the case.
///
/// # Errors
/// Nothing turns, or no speed is known.
pub(super) fn wanted(
    case: &Case,
    linear: &LinearMachine,
    analysis: &Analysis,
) -> Result<Wanted, Failure> {
    let top = |body: usize| case.machine.top_speed(body, case.run());
    // Of equally fast ones the first whose speed is given, and not found.
    let is_given = |body: usize| case.machine.bodies[body].rotation != Some(Rotation::Free);
    let fastest = linear.turning().max_by(|&a, &b| {
        let both = top(a).total_cmp(&top(b)).then(is_given(a).cmp(&is_given(b)));
        both.then(b.cmp(&a))
    });
    let at_one = matches!(
        analysis.kind,
        AnalysisKind::Modes
            | AnalysisKind::Coefficients
            | AnalysisKind::Matrices
            | AnalysisKind::Forces
    );
    let Some(of) = analysis.of.or(fastest) else {
        if at_one && analysis.speeds.is_empty() {
            return Ok(Wanted { of: None, speeds: vec![0.0] });
        }
        return Err(Failure::Argument {
            message: format!("nothing turns in `{}`: it has no speeds", case.name),
            help: "`whirl modes` and `whirl coefficients` without `--speeds` are of machines that stand; a body turns by \
                   `turns = \"prescribed\"` and its `speed`"
                .to_owned(),
        });
    };
    if !analysis.speeds.is_empty() {
        return Ok(Wanted { of: Some(of), speeds: analysis.speeds.clone() });
    }
    let top = case.machine.fastest(of, case.run());
    if at_one || analysis.kind == AnalysisKind::Map {
        return Ok(Wanted { of: Some(of), speeds: vec![top] });
    }
    if top == 0.0 {
        return Err(Failure::Argument {
            message: format!("`{}` gives no speed up to which modes could be followed", case.name),
            help:
                "write `--speeds \"0 rpm .. 30000 rpm, 61\"`, or `speeds` in its `[analysis.NAME]`"
                    .to_owned(),
        });
    }
    let count = if analysis.kind == AnalysisKind::Response { FINE } else { COUNT };
    let at = |k: usize| BEYOND * top * k as f64 / (count - 1) as f64;
    let mut speeds: Vec<f64> = (0..count).map(at).collect();
    if top < 0.0 {
        speeds.reverse();
        speeds[count - 1] = 0.0;
    }
    Ok(Wanted { of: Some(of), speeds })
}

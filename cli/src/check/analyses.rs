//! What is said of analyses that would come to nothing.

use whirl_solver::cache::Cache;
use whirl_solver::linear::LinearMachine;

use crate::analysis::foreseen;
use crate::case::{Case, CaseText};
use crate::errors::Failure;
use crate::machine::Built;

/// Warns of each that cannot be done, as far as that shows without doing it.
///
/// # Errors
/// A machine that has no small motions at all.
pub(super) fn warn(
    (case, text): (&Case, Option<&CaseText>),
    built: &Built,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<(), Failure> {
    if case.analyses.is_empty() {
        return Ok(());
    }
    let linear = LinearMachine::new(built.machine.clone())?;
    for analysis in &case.analyses {
        let Err(error) = foreseen((case, text), &linear, analysis, cache) else { continue };
        let remedy = match &error {
            Failure::Argument { help, .. } => format!("; {help}"),
            _ => String::new(),
        };
        warnings.push(format!("the analysis `{}` cannot be done: {error}{remedy}", analysis.name));
    }
    Ok(())
}

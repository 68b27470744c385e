//! What keeps an analysis from being done, as far as one or two speeds of it show that.

use whirl_solver::cache::Cache;
use whirl_solver::linear::LinearMachine;

use super::{forces, lateral, periodic, response, speeds};
use crate::case::{Analysis, AnalysisKind, Case, CaseText};
use crate::errors::Failure;

/// Looks at the machine at the ends of the speeds of an analysis.
///
/// # Errors
/// Why the analysis cannot be done; that the machine does not stand at the ends.
pub(crate) fn foreseen(
    (case, text): (&Case, Option<&CaseText>),
    linear: &LinearMachine,
    analysis: &Analysis,
    cache: Option<&Cache>,
) -> Result<(), Failure> {
    match analysis.kind {
        AnalysisKind::Lateral => return lateral::foreseen(case, analysis, cache),
        AnalysisKind::Periodic => return periodic::foreseen((case, text), analysis, cache),
        AnalysisKind::Forces => forces::foreseen(case)?,
        AnalysisKind::Torsion => return speeds::wanted(case, linear, analysis).map(|_| ()),
        _ => {}
    }
    let wanted = speeds::wanted(case, linear, analysis)?;
    let mut ends: Vec<f64> =
        wanted.speeds.first().into_iter().chain(wanted.speeds.last()).copied().collect();
    // Films carry more the faster the machine turns.
    ends.sort_by(|a, b| b.abs().total_cmp(&a.abs()));
    ends.dedup();
    let mut lost = None;
    for speed in ends {
        let at = wanted.of.map_or(Vec::new(), |of| linear.speeds(of, speed, &analysis.ratios));
        match linear.standing(&at, None) {
            Ok(here) if analysis.kind == AnalysisKind::Response => {
                return response::foreseen(case, linear, &here);
            }
            Ok(_) => return Ok(()),
            Err(error) if error.is_of_balance() => lost = lost.or(Some(error)),
            Err(error) => return Err(error.into()),
        }
    }
    lost.map_or(Ok(()), |error| Err(error.into()))
}

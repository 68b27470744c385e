//! From a case to a machine that can be marched: meshes, sets, reduced bodies, springs, loads.

mod built;
mod described;
pub(crate) mod fineness;
mod forces;
mod joined;
mod laws;
mod masses;
mod meshes;
mod plan;
mod selections;
mod springs;
mod wording;

use whirl_codegen::document::tree::Tree;
use whirl_solver::cache::{Cache, Key};
use whirl_solver::machine::MachineParts;

pub use built::Built;
pub(crate) use built::{BodyFacts, Counts};
pub(crate) use joined::{JoinedPlan, PlannedBody, Watched};
pub(crate) use meshes::placed as placed_errors;
pub(crate) use plan::BodyPlan;

use self::described::Described;
use crate::case::{self, Case, CaseText, Draft, MarchSettings, Purpose};
use crate::errors::Failure;

/// Reads the case that the user called `name`, and checks its meshes and sets even where
/// the case has errors, so that all are reported at once. `warnings` are added to, here and below.
///
/// # Errors
/// Everything that is wrong with the case; of its meshes and sets only where the case has errors.
pub(crate) fn read(name: &str, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    checked(case::draft(name, Purpose::March)?, warnings)
}

/// As [`read`], of a case that need not be marched.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_to_analyse(name: &str, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    checked(case::draft(name, Purpose::Analysis)?, warnings)
}

/// As [`read`], of a case that is described.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_to_check(name: &str, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    checked(case::draft(name, Purpose::Check)?, warnings)
}

/// As [`read`], of a text.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_text(text: &CaseText, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    checked(case::draft_of(text, Purpose::March)?, warnings)
}

/// As [`read_text`], of a case that need not be marched.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_text_to_analyse(
    text: &CaseText,
    warnings: &mut Vec<String>,
) -> Result<Case, Failure> {
    checked(case::draft_of(text, Purpose::Analysis)?, warnings)
}

/// As [`read_text`], with other values of some keys.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_with(
    text: &CaseText,
    values: Tree,
    purpose: Purpose,
    warnings: &mut Vec<String>,
) -> Result<Case, Failure> {
    checked(case::draft_with(text, values, purpose)?, warnings)
}

fn checked(mut draft: Draft, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    if let (false, Some(machine)) = (draft.errors.is_empty(), &draft.machine) {
        match JoinedPlan::new(machine, (&[], None), warnings) {
            Err(Failure::Input(found)) => draft.errors.append(found),
            Err(other) => return Err(other),
            Ok(_) => {}
        }
    }
    Ok(draft.finish()?)
}

/// The bodies and joints of a case before the reduction. Its meshes are read or made here.
///
/// # Errors
/// Whatever is wrong with meshes and sets.
pub(crate) fn plan(case: &Case, warnings: &mut Vec<String>) -> Result<JoinedPlan, Failure> {
    let wanted = (case.outputs.as_slice(), case.fields.as_ref());
    let mut plan = JoinedPlan::new(&case.machine, wanted, warnings)?;
    let run = case.march.as_ref().map(|_| case.run());
    warnings.extend(joined::idle_loads(&case.machine, run));
    if let Some(ground) = &case.machine.ground {
        warnings.extend(ground.doubts(case.march.as_ref().map(MarchSettings::duration)));
    }
    if let Some(limit) = case.memory_limit {
        plan.meshed().for_each(|body| body.spec.memory = limit);
    }
    Ok(plan)
}

/// Builds the machine of a case from its [`plan`]; reduced bodies come from the cache where it has them.
///
/// # Errors
/// Whatever is wrong with constraints and laws.
pub(crate) fn build(
    case: &Case,
    plan: &JoinedPlan,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<Built, Failure> {
    Described::of(case, plan)?.build(cache, warnings)
}

/// As [`build`], with a plan of its own.
///
/// # Errors
/// As [`plan`] and [`build`].
pub(crate) fn build_planned(
    case: &Case,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<Built, Failure> {
    let plan = plan(case, warnings)?;
    build(case, &plan, cache, warnings)
}

/// The keys under which the bodies of a case are kept that are reduced.
///
/// # Errors
/// Whatever is wrong with meshes and sets.
pub(crate) fn keys(case: &Case) -> Result<Vec<Key>, Failure> {
    let plan = plan(case, &mut Vec::new())?;
    Ok(Described::of(case, &plan)?.model.keys())
}

/// What the machine of a case is made from.
///
/// # Errors
/// As [`build`].
pub(crate) fn parts(case: &Case, warnings: &mut Vec<String>) -> Result<MachineParts, Failure> {
    let plan = plan(case, warnings)?;
    Described::of(case, &plan)?.parts(warnings)
}

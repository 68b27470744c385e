//! From a case to a machine that can be marched: meshes, sets, reduced bodies, springs, loads.

mod described;
pub(crate) mod fineness;
mod forces;
mod joined;
mod laws;
mod lumped;
mod masses;
mod meshes;
mod outputs;
mod plan;
mod selections;
mod springs;

use serde::Serialize;
use whirl_codegen::document::tree::Tree;
use whirl_solver::cache::{Cache, Key};
use whirl_solver::dynamics::BodyStart;
use whirl_solver::history::{Column, History};
use whirl_solver::machine::{Machine, MachineParts};
use whirl_solver::mesh::Mesh;

pub(crate) use joined::{JoinedPlan, PlannedBody};
pub(crate) use meshes::placed as placed_errors;
pub(crate) use plan::BodyPlan;

use self::described::Described;
use crate::case::{self, Case, CaseText, Draft, LawSource, System, SystemDraft};
use crate::errors::Failure;

/// A machine with what results say about how it came about.
pub struct Built {
    /// The machine.
    pub(crate) machine: Machine,
    /// How the bodies begin.
    pub(crate) initial: Vec<BodyStart>,
    /// Radial clearance of each bearing, m.
    pub(crate) clearances: Vec<f64>,
    /// The laws with the values with which they are used, in the order in which the case first names them.
    pub(crate) laws: Vec<LawSource>,
    /// Names of the laws, and hashes of what they were made from.
    pub(crate) law_hashes: Vec<(String, String)>,
    /// The bodies, where they were reduced from meshes.
    pub(crate) bodies: Option<BodyFacts>,
    /// The meshes of bodies that are written as wholes, in the order of the machine's fields.
    pub(crate) fields: Vec<FieldMesh>,
}

impl Built {
    /// The machine.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The columns of its history.
    pub fn columns(&self) -> Vec<Column> {
        History::columns_of(&self.machine)
    }
}

/// A mesh whose motion is written.
pub(crate) struct FieldMesh {
    /// The mesh.
    pub(crate) mesh: Mesh,
    /// x and y in space of the axis from which its coordinates count (m).
    pub(crate) axis: [f64; 2],
    /// Whether it deforms.
    pub(crate) flexible: bool,
}

/// Facts about the reduced bodies.
pub(crate) struct BodyFacts {
    /// Each of them.
    pub(crate) bodies: Vec<BodyFact>,
    /// Wall time of reading, assembling and reducing, s.
    pub(crate) wall: f64,
    /// Whether the reduced bodies were found in the cache.
    pub(crate) cached: bool,
}

/// Facts about a reduced body.
pub(crate) struct BodyFact {
    /// Its name.
    pub(crate) name: String,
    /// Its sizes.
    pub(crate) counts: Counts,
    /// Fixed-interface frequencies, Hz.
    pub(crate) hertz: Vec<f64>,
    /// A hash of what it and its output nodes depend on.
    pub(crate) content: Key,
}

/// Sizes of a body, as in the paper's Table 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub(crate) struct Counts {
    /// Cells.
    pub(crate) elements: usize,
    /// Nodes.
    pub(crate) nodes: usize,
    /// Three a node.
    pub(crate) physical_dofs: usize,
    /// Physical dofs that are not retained.
    pub(crate) internal_dofs: usize,
    /// Dofs kept as they are.
    pub(crate) retained_dofs: usize,
    /// Fixed-interface modes kept.
    pub(crate) modes: usize,
    /// Modes and retained dofs.
    pub(crate) craig_bampton_dofs: usize,
}

/// Reads the case that the user called `name`, and checks its meshes and sets even where
/// the case has errors, so that all are reported at once. `warnings` are added to, here and below.
///
/// # Errors
/// Everything that is wrong with the case; of its meshes and sets only where the case has errors.
pub(crate) fn read(name: &str, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    checked(case::draft(name)?, warnings)
}

/// As [`read`], of a text.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_text(text: &CaseText, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    checked(case::draft_of(text)?, warnings)
}

/// As [`read_text`], with other values of some keys.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_with(
    text: &CaseText,
    values: Tree,
    warnings: &mut Vec<String>,
) -> Result<Case, Failure> {
    checked(case::draft_with(text, values)?, warnings)
}

fn checked(mut draft: Draft, warnings: &mut Vec<String>) -> Result<Case, Failure> {
    if let (false, SystemDraft::Joined(Some(machine))) = (draft.errors.is_empty(), &draft.system) {
        match JoinedPlan::new(machine, (&[], None), warnings) {
            Err(Failure::Input(found)) => draft.errors.append(found),
            Err(other) => return Err(other),
            Ok(_) => {}
        }
    }
    Ok(draft.finish()?)
}

/// What is to be reduced of a case; nothing of a lumped one. Its meshes are read or made here.
///
/// # Errors
/// Whatever is wrong with meshes and sets.
pub(crate) fn plan(case: &Case, warnings: &mut Vec<String>) -> Result<Option<JoinedPlan>, Failure> {
    let wanted = (case.outputs.as_slice(), case.fields.as_ref());
    let System::Joined(machine) = &case.system else { return Ok(None) };
    let mut plan = JoinedPlan::new(machine, wanted, warnings)?;
    if let Some(limit) = case.memory_limit {
        plan.meshed().for_each(|body| body.spec.memory = limit);
    }
    Ok(Some(plan))
}

/// Builds the machine of a case from its [`plan`]; reduced bodies come from the cache where it has them.
///
/// # Errors
/// Whatever is wrong with constraints and laws.
pub(crate) fn build(
    case: &Case,
    plan: Option<&JoinedPlan>,
    cache: Option<&Cache>,
    warnings: &mut Vec<String>,
) -> Result<Built, Failure> {
    describe(case, plan)?.build(cache, warnings)
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
    build(case, plan.as_ref(), cache, warnings)
}

/// The keys under which the bodies of a case are kept that are reduced.
///
/// # Errors
/// Whatever is wrong with meshes and sets.
pub(crate) fn keys(case: &Case) -> Result<Vec<Key>, Failure> {
    let plan = plan(case, &mut Vec::new())?;
    Ok(describe(case, plan.as_ref())?.model.keys())
}

/// What the machine of a case is made from.
///
/// # Errors
/// As [`build`].
pub(crate) fn parts(case: &Case, warnings: &mut Vec<String>) -> Result<MachineParts, Failure> {
    let plan = plan(case, warnings)?;
    describe(case, plan.as_ref())?.parts(warnings)
}

/// The case as the solver takes it, by its own [`plan`].
fn describe<'a>(case: &'a Case, plan: Option<&'a JoinedPlan>) -> Result<Described<'a>, Failure> {
    let outputs = case.outputs.as_slice();
    match (&case.system, plan) {
        (System::Joined(own), Some(plan)) => joined::describe(own, outputs, plan),
        (System::Lumped(own), _) => lumped::describe(own, outputs),
        (System::Joined(_), None) => unreachable!("a plan of another case"),
    }
}

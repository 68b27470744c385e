//! Tilts of the sides of bushings, and their displacement along the axis.

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::bearing::MotionKind;
use whirl_solver::mesh::MeanComponent;

use super::planned_body::PlannedBody;
use super::section::nodes_at;
use crate::case::{Joint, JointSide, LawSource, OtherLaw};
use crate::machine::plan::BodyPlan;

/// A law on another motion than the displacement in the plane, on its bodies.
pub(super) struct PlannedOther {
    pub(super) kind: MotionKind,
    /// Of both sides among the measures of their bodies; none on the ground.
    pub(super) sections: [Option<usize>; 2],
    /// The law with its values.
    pub(super) law: LawSource,
}

/// The components of a mean motion that a law is on.
fn components(kind: MotionKind) -> &'static [MeanComponent] {
    match kind {
        MotionKind::Tilts => &[MeanComponent::Rotation(0), MeanComponent::Rotation(1)],
        MotionKind::Along => &[MeanComponent::Displacement(2)],
    }
}

/// Places the laws of a joint on other motions; what is wrong is noted.
pub(super) fn place(
    joint: &Joint,
    bodies: &mut [PlannedBody],
    errors: &mut Diagnostics,
) -> Vec<PlannedOther> {
    let mut placed = Vec::with_capacity(joint.others.len());
    for own in &joint.others {
        let sections = joint.sides.each_ref().map(|side| match &mut bodies[side.body?] {
            PlannedBody::Meshed(plan) => section(own, side, plan, errors),
            // Its motion as a whole.
            PlannedBody::Rigid(_) => Some(0),
        });
        match own.law.used(&own.parameters, &joint.bearing.facts) {
            Ok(law) => placed.push(PlannedOther { kind: own.kind, sections, law }),
            Err(found) => errors.append(found),
        }
    }
    placed
}

/// The section of a side as a place among the means, its motion retained: all nodes of its sets, or all at the z of the
/// only one.
fn section(
    own: &OtherLaw,
    side: &JointSide,
    plan: &mut BodyPlan,
    errors: &mut Diagnostics,
) -> Option<usize> {
    let name = side.sets.first()?;
    let mut nodes = Vec::new();
    for set in &side.sets {
        nodes.extend(plan.nodes(set, errors));
    }
    nodes.sort_unstable();
    nodes.dedup();
    if let ([only], false) = (&nodes[..], plan.is_cut(name)) {
        nodes = nodes_at(&plan.mesh, plan.mesh.nodes()[*only][2]);
    }
    if nodes.is_empty() {
        return None;
    }
    let place = plan.mean_of(&side.sets, &nodes);
    let tilts = own.kind == MotionKind::Tilts;
    if tilts && !(0..2).all(|axis| plan.spec.means[place].turns_about(axis)) {
        let message = format!(
            "the nodes of `{}` are on one line on {}: they do not define both tilts",
            name.text(),
            plan.mesh.origin()
        );
        let help = "name a set of the nodes of a section or of a surface";
        errors.push(name.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    for &component in components(own.kind) {
        plan.retain_mean(name, place, component);
    }
    Some(place)
}

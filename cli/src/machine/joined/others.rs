//! Tilts of the sides of joints, and their displacement along the axis: by laws of bushings, or by the law of a whole joint.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_codegen::kinds::law::Acts;
use whirl_solver::bearing::MotionKind;
use whirl_solver::mesh::MeanComponent;

use super::planned_body::PlannedBody;
use super::section::nodes_at;
use crate::case::{JoinedMachine, Joint, LawSource};
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
            PlannedBody::Meshed(plan) => section(&[own.kind], &side.sets, plan, errors),
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

/// The sections whose tilts and displacement along z the law of a whole joint sees: those of the middle of the sets of both
/// sides; none on the ground, and none of a law that acts in planes.
pub(super) fn whole_sections(
    joint: &Joint,
    bodies: &mut [PlannedBody],
    errors: &mut Diagnostics,
) -> [Option<usize>; 2] {
    let law = &joint.bearing.law.source;
    if law.acts() != Acts::Joint {
        return [None; 2];
    }
    let motions = [MotionKind::Tilts, MotionKind::Along];
    let motions: Vec<MotionKind> = motions.into_iter().filter(|own| law.needs(*own)).collect();
    joint.sides.each_ref().map(|side| match &mut bodies[side.body?] {
        PlannedBody::Meshed(plan) => {
            let middle = side.sets.get(side.sets.len() / 2)?;
            section(&motions, std::slice::from_ref(middle), plan, errors)
        }
        PlannedBody::Rigid(_) => Some(0),
    })
}

/// Warnings of forces that the law of a whole joint gives, and neither of its sides can follow.
pub(super) fn on_nothing(joint: &Joint, joined: &JoinedMachine) -> Vec<String> {
    let law = &joint.bearing.law.source;
    // A film sees tilts where there are any.
    if law.acts() != Acts::Joint || law.film().is_some() {
        return Vec::new();
    }
    let moves = |motion: MotionKind| joint.sides.iter().any(|side| joined.side_has(side, motion));
    let kinds = [
        (MotionKind::Tilts, "tilts", "moments about x and y", "a `transverse_inertia`"),
        (MotionKind::Along, "moves along z", "force along z", "`moves_along_z = true`"),
    ];
    let held = kinds.into_iter().filter(|(motion, ..)| joint.acts_on(*motion) && !moves(*motion));
    held.map(|(_, does, gives, key)| {
        format!(
            "{}: neither side of `{}` {does}: the {gives} of its law move nothing; give a rigid body of it {key}, or take a law \
             without them",
            joint.name.source().path.display(),
            joint.name.text()
        )
    })
    .collect()
}

/// A section as a place among the means, its motions retained: all nodes of the sets, or all at the z of the only one.
fn section(
    motions: &[MotionKind],
    sets: &[Located],
    plan: &mut BodyPlan,
    errors: &mut Diagnostics,
) -> Option<usize> {
    let name = sets.first()?;
    let mut nodes = Vec::new();
    for set in sets {
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
    let place = plan.mean_of(sets, &nodes);
    let tilts = motions.contains(&MotionKind::Tilts);
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
    for &component in motions.iter().flat_map(|own| components(*own)) {
        plan.retain_mean(name, place, component);
    }
    Some(place)
}

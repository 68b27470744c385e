//! Discs and unbalance on the sections of a body that turns.

use std::cell::OnceCell;

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::assembly::mass_properties;
use whirl_solver::mesh::MeanComponent;
use whirl_solver::model::{Attachment, AttachmentKind, Place};

use super::planned_body::PlannedBody;
use super::section::section_at;
use crate::case::Attached;
use crate::machine::plan::BodyPlan;
use crate::machine::wording::mm;

/// Share of the body's mass from which masses on a section have its tilts and its turn as coordinates, too.
const HEAVY: f64 = 0.05;

/// Finds the sections, and retains their centres where there are nodes.
pub(super) fn plan(
    attached: &[Attached],
    body: &mut PlannedBody,
    errors: &mut Diagnostics,
) -> Vec<Attachment> {
    let mut all = Vec::with_capacity(attached.len());
    let mass = OnceCell::new();
    for own in attached {
        let at = match body {
            PlannedBody::Meshed(plan) => {
                let mass_of_body =
                    || mass_properties(&plan.mesh).map_or(f64::INFINITY, |own| own.mass);
                let is_heavy = matches!(own.what, AttachmentKind::Mass { .. })
                    && carried_beside(attached, own) > HEAVY * mass.get_or_init(mass_of_body);
                section((own, is_heavy), plan, errors).map(Place::Mean)
            }
            PlannedBody::Rigid(rigid) => {
                let [x, y] = off_axis(own);
                Some(Place::Nodes(vec![rigid.node([x, y, own.z])]))
            }
        };
        all.extend(at.map(|at| Attachment { at, z: own.z, kind: own.what }));
    }
    all
}

/// The masses at the z of one of them, all together (kg).
fn carried_beside(attached: &[Attached], own: &Attached) -> f64 {
    let masses = attached.iter().filter_map(|other| match other.what {
        AttachmentKind::Mass { mass, .. } if other.z == own.z => Some(mass),
        _ => None,
    });
    masses.sum()
}

/// The mean motion of the section nearest to where something is, with masses there that are heavy or not.
fn section(
    (own, is_heavy): (&Attached, bool),
    plan: &mut BodyPlan,
    errors: &mut Diagnostics,
) -> Option<usize> {
    let mean = match section_at(plan, own.z) {
        Ok(mean) => mean,
        Err(lack) => {
            errors.push(own.name.error_here(Code::BAD_VALUE, lack.message).help(lack.help));
            return None;
        }
    };
    let on_axis = matches!(own.what, AttachmentKind::Disc { .. });
    if !is_section(plan, mean, on_axis) {
        let message = format!(
            "the section of {} at z = {} could not carry `{}`: {}",
            plan.mesh.origin(),
            mm(own.z),
            own.name.text(),
            if on_axis { "its middle is not on the axis" } else { "it defines no rotation" }
        );
        let help = "give a `z` at which the body is around its axis";
        errors.push(own.name.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    // What is heavy beside the body moves with coordinates of its own: modes of the body alone would hold it.
    const MOTIONS: [MeanComponent; 5] = [
        MeanComponent::Displacement(0),
        MeanComponent::Displacement(1),
        MeanComponent::Rotation(0),
        MeanComponent::Rotation(1),
        MeanComponent::Rotation(2),
    ];
    let own_motions: &[MeanComponent] = match own.what {
        AttachmentKind::Disc { .. } => &MOTIONS,
        AttachmentKind::Mass { .. } => {
            if is_heavy {
                &MOTIONS
            } else {
                &MOTIONS[..2]
            }
        }
        AttachmentKind::Unbalance(_) => &[],
    };
    for component in own_motions {
        plan.retain_mean(&own.name, mean, *component);
    }
    Some(mean)
}

/// Whether a section shows all turns and, if asked for, has its centre on the axis to a part of how far it reaches.
fn is_section(plan: &BodyPlan, mean: usize, on_axis: bool) -> bool {
    const CENTRED: f64 = 0.1;
    let own = &plan.spec.means[mean];
    let reach = |node: &usize| plan.mesh.nodes()[*node][0].hypot(plan.mesh.nodes()[*node][1]);
    let farthest = own.nodes().iter().map(reach).fold(0.0, f64::max);
    let [x, y, _] = own.centre();
    (0..3).all(|axis| own.turns_about(axis)) && (!on_axis || x.hypot(y) <= CENTRED * farthest)
}

/// x and y of the point of a section that moves with what it carries (m).
fn off_axis(own: &Attached) -> [f64; 2] {
    match own.what {
        AttachmentKind::Mass { offset, .. } => offset,
        AttachmentKind::Disc { .. } | AttachmentKind::Unbalance(_) => [0.0; 2],
    }
}

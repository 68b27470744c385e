//! Joints compared with the meshes on which they stand.

use std::borrow::Cow;

use whirl_codegen::diagnostic::Diagnostics;
use whirl_solver::mesh::Mesh;

use super::of_case::turns;
use super::planned_body::PlannedBody;
use super::planned_joint::PlannedJoint;
use super::{clearance, surfaces};
use crate::case::{JoinedMachine, JointKind};
use crate::errors::Failure;
use crate::machine::plan::geometry::{bearing, stations};

/// Notes whatever does not stand where it should: journals off the axis, bores beside them, radii that do not fit.
pub(super) fn compare(
    joined: &JoinedMachine,
    joints: &[PlannedJoint],
    bodies: &[PlannedBody],
    warnings: &mut Vec<String>,
    errors: &mut Diagnostics,
) -> Result<(), Failure> {
    for (place, (joint, own)) in joined.joints.iter().zip(joints).enumerate() {
        if !matches!(joint.kind, JointKind::Bearing | JointKind::Stop) {
            continue;
        }
        if let Some(circles) = own.circles {
            clearance::warn(joint, circles, warnings);
        }
        if joint.sides.iter().any(|side| side.surface) {
            surfaces::compare(joint, own, bodies, warnings, errors);
            stations::check(&own.bearing, own.extent(joint, bodies), errors);
            continue;
        }
        let of_journal = joined.bodies[own.sides.bodies[0]].axis;
        let about = |body: usize| -> Result<Option<Cow<Mesh>>, Failure> {
            let Some(PlannedBody::Meshed(plan)) = bodies.get(body) else { return Ok(None) };
            Ok(Some(match turns(joined, body) || of_journal == [0.0; 2] {
                true => Cow::Borrowed(&plan.mesh),
                false => Cow::Owned(plan.mesh.clone().moved(of_journal.map(|x| -x))?),
            }))
        };
        let (journal, bore) = (about(own.sides.bodies[0])?, about(own.sides.bodies[1])?);
        let names = joined.is_named().then(|| joint.sides.each_ref().map(|side| side.place.text()));
        let (meshes, extent) = ([journal.as_deref(), bore.as_deref()], own.extent(joint, bodies));
        bearing::compare((place, &own.bearing, of_journal), names, meshes, extent, errors);
    }
    Ok(())
}

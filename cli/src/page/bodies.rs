//! The shapes of a case by its plan.

use whirl_solver::model::AttachmentKind;
use whirl_solver::rigid::RigidBody;

use super::marks::marks;
use super::shapes::{Meshed, Shapes, Solid};
use crate::case::Case;
use crate::machine::{JoinedPlan, PlannedBody};

impl Shapes {
    /// Surfaces of bodies, and cylinders for what has no mesh, discs on others among them if they are wanted.
    pub(crate) fn of_case(case: &Case, plan: &JoinedPlan, discs: bool) -> Option<Shapes> {
        let bodies = || case.machine.bodies.iter().zip(&plan.bodies).enumerate();
        let meshed = Shapes::of(bodies().filter_map(|(body, (own, plan))| {
            let turns = own.turns();
            let axis = if turns { own.axis } else { [0.0; 2] };
            Some(Meshed { name: own.name.text(), body, turns, axis, mesh: &plan.meshed()?.mesh })
        }));
        if case.machine.is_mass() {
            return meshed;
        }
        let rigid = bodies().filter_map(|(body, (own, planned))| {
            let PlannedBody::Rigid(rigid) = planned else { return None };
            let RigidBody { mass, polar_inertia, transverse_inertia, centre, .. } = rigid.body;
            // What does not tilt has no place along the axis but that of its joints.
            let joints = case.machine.joints.iter().enumerate();
            let own_joints =
                joints.filter(|(_, joint)| joint.sides.iter().any(|side| side.body == Some(body)));
            let z: Vec<f64> = own_joints.flat_map(|(joint, _)| plan.stations(joint)).collect();
            let mean = z.iter().sum::<f64>() / z.len() as f64;
            let anywhere = transverse_inertia.is_none() && !z.is_empty();
            Some(Solid {
                name: own.name.text(),
                body,
                carried: None,
                turns: own.turns(),
                axis: own.axis,
                z: if anywhere { mean } else { centre[2] },
                mass,
                polar: polar_inertia,
                across: transverse_inertia,
            })
        });
        let discs = bodies().filter(|_| discs).flat_map(|(place, (body, _))| {
            body.attached.iter().enumerate().filter_map(move |(carried, own)| {
                let AttachmentKind::Disc { mass, polar_inertia, diametral_inertia } = own.what
                else {
                    return None;
                };
                Some(Solid {
                    name: own.name.text(),
                    body: place,
                    carried: Some(carried),
                    turns: true,
                    axis: body.axis,
                    z: own.z,
                    mass,
                    polar: polar_inertia,
                    across: Some(diametral_inertia),
                })
            })
        });
        let all = Shapes::sketched(meshed, rigid.chain(discs));
        all.map(|own| own.joined(marks(case, plan)))
    }
}

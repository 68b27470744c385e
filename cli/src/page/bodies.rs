//! The shapes of a case by its plan.

use whirl_solver::model::AttachmentKind;
use whirl_solver::rigid::RigidBody;

use super::along::placed;
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
        let solid = |body: usize| {
            let (own, planned) = (&case.machine.bodies[body], &plan.bodies[body]);
            let PlannedBody::Rigid(rigid) = planned else { return None };
            let RigidBody { mass, polar_inertia, transverse_inertia, centre, .. } = rigid.body;
            let mut films = case.machine.joints.iter().zip(&plan.laws);
            let pad = films.find(|(joint, _)| joint.sides[1].body == Some(body));
            Some(Solid {
                name: own.name.text(),
                body,
                carried: None,
                turns: own.turns(),
                axis: own.axis,
                centre: [centre[0], centre[1]],
                z: centre[2],
                mass,
                polar: polar_inertia,
                across: transverse_inertia,
                pad: pad.and_then(|(_, law)| law.film()?.pad()),
            })
        };
        let mut solids: Vec<Solid> = (0..plan.bodies.len()).filter_map(solid).collect();
        let mut lengths = vec![0.0; plan.bodies.len()];
        let mut spans: Vec<Option<[f64; 2]>> = plan.bodies.iter().map(reach).collect();
        for own in &solids {
            let length = own.pad.map(|pad| pad[3]).or(own.cylinder().map(|own| own[1]));
            lengths[own.body] = length.unwrap_or(0.0);
            let half = 0.5 * lengths[own.body];
            // What does not tilt has no place along the axis.
            spans[own.body] = own.across.map(|_| [own.z - half, own.z + half]);
        }
        let free: Vec<bool> = spans.iter().map(Option::is_none).collect();
        let z = placed(case, plan, spans, &lengths);
        let free: Vec<Option<f64>> = z.iter().zip(free).map(|(z, own)| own.then_some(*z)).collect();
        solids.iter_mut().for_each(|own| own.z = z[own.body]);
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
                    centre: [0.0; 2],
                    z: own.z,
                    mass,
                    polar: polar_inertia,
                    across: Some(diametral_inertia),
                    pad: None,
                })
            })
        });
        let all = Shapes::sketched(meshed, solids.into_iter().chain(discs));
        all.map(|own| own.joined(marks(case, plan, &free)))
    }
}

/// From where to where a mesh reaches along z (m).
fn reach(own: &PlannedBody) -> Option<[f64; 2]> {
    let nodes = own.meshed()?.mesh.nodes().iter().map(|node| node[2]);
    Some(nodes.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], z| [a.min(z), b.max(z)]))
}

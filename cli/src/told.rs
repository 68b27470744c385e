//! What a page tells of a case beside its numbers: in words, and the shapes of its bodies.

use whirl_solver::model::AttachmentKind;
use whirl_solver::rigid::RigidBody;

use crate::case::Case;
use crate::check;
use crate::errors::Failure;
use crate::machine::{JoinedPlan, PlannedBody};
use crate::page::{Meshed, Section, Shapes, Solid};

/// Both of them.
pub(crate) struct Told {
    pub(crate) words: Vec<Section>,
    pub(crate) shapes: Option<Shapes>,
}

impl Told {
    /// Of a case by its plan.
    ///
    /// # Errors
    /// Of linear algebra.
    pub(crate) fn of(case: &Case, plan: &JoinedPlan) -> Result<Self, Failure> {
        Ok(Told { words: check::words(case, plan)?, shapes: shapes(case, plan) })
    }
}

/// Surfaces of bodies, and cylinders for what has no mesh.
fn shapes(case: &Case, plan: &JoinedPlan) -> Option<Shapes> {
    let bodies = || case.machine.bodies.iter().zip(&plan.bodies);
    let meshed = Shapes::of(bodies().filter_map(|(own, plan)| {
        let turns = own.turns();
        let axis = if turns { own.axis } else { [0.0; 2] };
        Some(Meshed { name: own.name.text(), turns, axis, mesh: &plan.meshed()?.mesh })
    }));
    if case.machine.is_mass() {
        return meshed;
    }
    let rigid = bodies().filter_map(|(own, plan)| {
        let PlannedBody::Rigid(rigid) = plan else { return None };
        let RigidBody { mass, polar_inertia, transverse_inertia, centre, .. } = rigid.body;
        Some(Solid {
            name: own.name.text(),
            turns: own.turns(),
            axis: own.axis,
            z: centre[2],
            mass,
            polar: polar_inertia,
            across: transverse_inertia,
        })
    });
    // Where bodies are seen to move, discs would stand still.
    let shown = bodies().filter(|_| case.fields.is_none());
    let discs = shown.flat_map(|(body, _)| {
        body.attached.iter().filter_map(|own| {
            let AttachmentKind::Disc { mass, polar_inertia, diametral_inertia } = own.what else {
                return None;
            };
            Some(Solid {
                name: own.name.text(),
                turns: true,
                axis: body.axis,
                z: own.z,
                mass,
                polar: polar_inertia,
                across: Some(diametral_inertia),
            })
        })
    });
    Shapes::sketched(meshed, rigid.chain(discs))
}

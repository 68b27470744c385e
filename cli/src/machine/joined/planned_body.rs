//! A body before its reduction: a mesh, or numbers with the nodes that are needed on it.

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::model::{Form, LoadAction, Place};
use whirl_solver::rigid::RigidBody;

use super::section::section_at;
use crate::case::{self, JoinedLoad, OutputPoint};
use crate::machine::plan::BodyPlan;

/// The only mean motion of a rigid body, which is its motion as a whole.
const WHOLE: Place = Place::Mean(0);

/// A body before its reduction, if it needs one.
pub(crate) enum PlannedBody {
    /// A mesh.
    Meshed(Box<BodyPlan>),
    /// Numbers.
    Rigid(RigidPlan),
}

/// A rigid body, and the nodes that joints and loads need on it.
pub(crate) struct RigidPlan {
    /// Its numbers.
    pub(crate) body: RigidBody,
    /// Positions of its nodes, m.
    pub(crate) nodes: Vec<[f64; 3]>,
}

impl RigidPlan {
    /// Adds a node; its place.
    pub(super) fn node(&mut self, position: [f64; 3]) -> usize {
        self.nodes.push(position);
        self.nodes.len() - 1
    }

    /// √(inertia / mass), where a couple has its forces (m).
    pub(super) fn radius_of_gyration(&self) -> f64 {
        (self.body.polar_inertia / self.body.mass).sqrt()
    }
}

impl PlannedBody {
    /// Its plan, if it has a mesh.
    pub(crate) fn meshed(&self) -> Option<&BodyPlan> {
        match self {
            PlannedBody::Meshed(plan) => Some(plan),
            PlannedBody::Rigid(_) => None,
        }
    }

    /// The body as the solver takes it.
    pub(super) fn form(&self) -> Form<'_> {
        match self {
            PlannedBody::Meshed(plan) => plan.form(),
            PlannedBody::Rigid(RigidPlan { body, nodes }) => Form::Rigid(body, nodes),
        }
    }

    /// Where a couple drives it.
    pub(super) fn driven(&mut self, drive: &case::Drive, errors: &mut Diagnostics) -> Place {
        match self {
            PlannedBody::Meshed(plan) if plan.mean_frame => plan.tie(&drive.section, errors),
            // A section that the case names turns with the frame, or all of a body that is rigid or held to it.
            PlannedBody::Meshed(plan) => plan.driven(&drive.section, errors).0,
            PlannedBody::Rigid(_) => WHOLE,
        }
    }

    /// Where a load acts on it.
    pub(super) fn loaded(&mut self, load: &JoinedLoad, errors: &mut Diagnostics) -> Place {
        match self {
            PlannedBody::Meshed(plan) => plan.loaded((&load.load, load.name.text()), errors),
            PlannedBody::Rigid(_) if matches!(load.load.acting, LoadAction::Couple(_)) => WHOLE,
            PlannedBody::Rigid(own) => {
                let [x, y, z] = own.body.centre;
                Place::Nodes(vec![own.node([x, y, load.z.unwrap_or(z)])])
            }
        }
    }

    /// The point of an output: its place among the output nodes.
    pub(super) fn output(&mut self, point: &OutputPoint, errors: &mut Diagnostics) -> usize {
        match (self, point) {
            (PlannedBody::Meshed(plan), OutputPoint::Set(set)) => {
                match plan.nodes(set, errors).as_slice() {
                    [] => 0,
                    [node] if !plan.is_cut(set) => plan.output_node(*node),
                    nodes => plan.output_mean(set, nodes),
                }
            }
            (PlannedBody::Meshed(plan), OutputPoint::Section(z, place)) => {
                match section_at(plan, *z) {
                    Ok(mean) => plan.output_on(mean, plan.spec.means[mean].centre()),
                    Err(lack) => {
                        errors
                            .push(place.error_here(Code::BAD_VALUE, lack.message).help(lack.help));
                        0
                    }
                }
            }
            (PlannedBody::Meshed(_), OutputPoint::At(_)) => 0,
            (PlannedBody::Rigid(own), point) => {
                let [x, y, centre] = own.body.centre;
                let OutputPoint::At(Some(z)) = point else { return own.node([x, y, centre]) };
                own.node([x, y, *z])
            }
        }
    }
}

//! Discs and unbalance on the sections of a body that turns.

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::attached::{Disc, PointMass, Unbalance};
use whirl_solver::linalg::Matrix;
use whirl_solver::mesh::MeanComponent;
use whirl_solver::shaft::Shaft;

use super::PlannedBody;
use super::bodies::retain_in_plane;
use super::section::{FLAT, ends, nodes_at};
use crate::case::{Attached, Carried};
use crate::machine::plan::BodyPlan;
use crate::machine::plan::geometry::mm;

/// A section is at most this part of the body's length away from where it is looked for.
const NEAR: f64 = 0.01;

/// Something on a section.
pub(crate) struct PlannedAttached {
    own: Attached,
    at: Place,
}

/// Where a body carries something.
enum Place {
    /// One of the output nodes of a rigid body.
    Node(usize),
    /// One of the mean motions of a mesh.
    Section(usize),
}

/// Finds the sections, and retains their centres where there are nodes.
pub(super) fn plan(
    attached: &[Attached],
    body: &mut PlannedBody,
    errors: &mut Diagnostics,
) -> Vec<PlannedAttached> {
    let mut all = Vec::with_capacity(attached.len());
    for own in attached {
        let at = match body {
            PlannedBody::Meshed(plan) => section(own, plan, errors).map(Place::Section),
            PlannedBody::Rigid(rigid) => {
                let [x, y] = off_axis(own);
                Some(Place::Node(rigid.node([x, y, own.z])))
            }
        };
        all.extend(at.map(|at| PlannedAttached { own: own.clone(), at }));
    }
    all
}

/// The mean motion of the section nearest to where something is.
fn section(own: &Attached, plan: &mut BodyPlan, errors: &mut Diagnostics) -> Option<usize> {
    let nodes = plan.mesh.nodes();
    let ends = ends(&plan.mesh);
    let length = ends[1] - ends[0];
    let away = |node: &[f64; 3]| (node[2] - own.z).abs();
    let nearest = nodes.iter().min_by(|a, b| away(a).total_cmp(&away(b))).copied();
    let Some(nearest) = nearest.filter(|node| away(node) <= NEAR * length) else {
        let message = format!(
            "no section of {} is at z = {}; it has nodes from {} to {}",
            plan.mesh.origin(),
            mm(own.z),
            mm(ends[0]),
            mm(ends[1])
        );
        let help = match nearest {
            Some(node) => format!("the nearest nodes are at `z = \"{}\"`", mm(node[2])),
            None => "the mesh has no nodes".to_owned(),
        };
        errors.push(own.name.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    };
    let found = nodes_at(&plan.mesh, nearest[2]);
    let on_axis = |&&node: &&usize| {
        let [x, y, _] = plan.mesh.nodes()[node];
        x.hypot(y) <= FLAT * length
    };
    if let (Some(&centre), Carried::Disc { .. }) = (found.iter().find(on_axis), own.what) {
        retain_in_plane(plan, &own.name, centre);
    }
    let mean = plan.mean(&found);
    if let Carried::Mass { .. } = own.what {
        for axis in 0..2 {
            plan.retain_mean(&own.name, mean, MeanComponent::Displacement(axis));
        }
    }
    Some(mean)
}

/// x and y of the point of a section that moves with what it carries (m).
fn off_axis(own: &Attached) -> [f64; 2] {
    match own.what {
        Carried::Mass { place, .. } => place,
        Carried::Disc { .. } | Carried::Unbalance(_) => [0.0; 2],
    }
}

/// The shaft with all that it carries.
pub(super) fn attach(shaft: Shaft, attached: &[PlannedAttached]) -> Shaft {
    attached.iter().fold(shaft, |shaft, PlannedAttached { own, at }| {
        let [x, y] = off_axis(own);
        let (centre, mean) = match at {
            Place::Node(place) => (shaft.nodes[*place].clone(), None),
            Place::Section(place) => {
                let mean = shaft.measures[*place].clone();
                (mean.node_at([x, y, own.z]), Some(mean))
            }
        };
        match (own.what, mean) {
            (Carried::Unbalance(moment), _) => {
                shaft.with_unbalance(&Unbalance { moment, node: &centre })
            }
            (Carried::Mass { mass, .. }, _) => {
                shaft.with_point_mass(&PointMass { mass, node: &centre })
            }
            (Carried::Disc { mass, polar_inertia, transverse_inertia }, Some(mean)) => {
                let rows = |first: usize, count: usize| {
                    Matrix::from_fn(count, mean.rotation.cols, |i, j| mean.rotation[(first + i, j)])
                };
                let (tilt, twist) = (rows(0, 2), rows(2, 1));
                shaft.with_disc(&Disc {
                    mass,
                    polar_inertia,
                    diametral_inertia: transverse_inertia,
                    z: own.z,
                    displacement: &centre.shapes,
                    tilt: &tilt,
                    twist: Some(&twist.data),
                })
            }
            // The case refuses a disc on a rigid body.
            (Carried::Disc { .. }, None) => shaft,
        }
    })
}

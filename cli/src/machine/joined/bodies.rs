//! Bodies before their reduction: meshes with what is held and retained, and rigid bodies with their nodes.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::constraints::GroundSpring;
use whirl_solver::mesh::{MeanComponent, Mesh, NodeSetMean};

use super::of_case::{meshed, turns};
use super::planned_body::{PlannedBody, RigidPlan};
use super::section;
use crate::case::{self, Form, JoinedMachine, MeshedBody, NamedBody};
use crate::errors::Failure;
use crate::machine::plan::{BodyPlan, HoldingWords};
use crate::machine::wording::AXES;
use crate::machine::{fineness, meshes};

/// The bodies of a case: meshes that turn with their own axis at x = y = 0, all else in space.
pub(super) fn plan(
    joined: &JoinedMachine,
    warnings: &mut Vec<String>,
) -> Result<Vec<PlannedBody>, Failure> {
    let (mut bodies, mut errors, mut rest) = (Vec::new(), Diagnostics::new(), None);
    for body in &joined.bodies {
        match planned(joined, body, warnings) {
            Ok(own) => bodies.push(own),
            Err(Failure::Input(found)) => errors.append(found),
            Err(other) => rest = rest.or(Some(other)),
        }
    }
    errors.into_result(())?;
    rest.map_or(Ok(bodies), Err)
}

fn planned(
    joined: &JoinedMachine,
    body: &NamedBody,
    warnings: &mut Vec<String>,
) -> Result<PlannedBody, Failure> {
    let own = match &body.form {
        Form::Rigid(rigid) => {
            let (z, mut own) = (rigid.centre[2], RigidPlan { body: *rigid, nodes: Vec::new() });
            if body.turns() {
                // How far the body reaches, by which couples are compared with forces.
                let radius = own.radius_of_gyration();
                own.node([radius, 0.0, z]);
            } else if !own.body.rocks {
                own.body.centre = [body.axis[0], body.axis[1], z];
            }
            return Ok(PlannedBody::Rigid(own));
        }
        Form::Meshed(own) => own,
    };
    let mesh = meshes::mesh((&own.body, body.axis), warnings)?;
    if let (case::Mesh::Generated(made), false) = (&own.body.mesh, own.rigid) {
        fineness::warn(body.name.text(), &made.table, made.dimensions.fineness(), warnings);
    }
    // Meshes of files stand in space, those made from dimensions about their own axis.
    let by = match (&own.body.mesh, body.turns()) {
        (case::Mesh::File(_) | case::Mesh::Matrices(_), true) => body.axis.map(|x| -x),
        (case::Mesh::Generated(_), false) => body.axis,
        _ => [0.0; 2],
    };
    let mesh = if by == [0.0; 2] { mesh } else { mesh.moved(by)? };
    let held_by = own.axial_restraint.as_ref().or(own.held.first()).unwrap_or(&body.name);
    suits(&mesh, own, body.turns())?;
    let mut plan = BodyPlan::new(mesh, &own.body, held_by);
    plan.spec.stiffening = own.stiffening;
    plan.rigid = own.rigid;
    plan.turning = body.turns();
    plan.along = own.moves_along_z;
    let free = body.is_free();
    plan.held_to_frame = body.turns() && held_against_turning(&plan.mesh, &own.held);
    plan.mean_frame = free && own.section.is_empty() && !plan.held_to_frame;
    let springs = match body.turns() {
        _ if !joined.is_named() => return Ok(PlannedBody::Meshed(Box::new(plan))),
        false => format!(
            ", add a spring `[[body.{}.ground_spring]]`, or join it at more nodes",
            body.name.text()
        ),
        true => " or join it at more places: bearings and bushings retain the nodes of their sets"
            .to_owned(),
    };
    Ok(PlannedBody::Meshed(Box::new(plan.saying(HoldingWords { springs, held: "held" }))))
}

/// Notes matrices that lack what is asked of the body, or contradict each other there.
fn suits(mesh: &Mesh, own: &MeshedBody, turns: bool) -> Result<(), Failure> {
    let Some(matrices) = mesh.matrices() else { return Ok(()) };
    let lacks = match (own.rigid, turns) {
        (true, _) => matrices.lacks_to_be_free("rigid"),
        (false, true) => matrices
            .lacks_to_be_free("that turns")
            .or_else(|| matrices.lacks_to_turn(own.stiffening))
            .or_else(|| matrices.wrong_spin_load(mesh)),
        (false, false) => None,
    };
    let place = own.body.mesh.place();
    match lacks {
        None => Ok(()),
        Some((what, help)) => {
            let message = format!("{}: {what}", mesh.origin());
            Err(Diagnostics::from(place.error_here(Code::BAD_VALUE, message).help(help)).into())
        }
    }
}

/// Whether sets that are held keep a mesh from turning about z.
fn held_against_turning(mesh: &Mesh, sets: &[Located]) -> bool {
    let nodes = sets.iter().filter_map(|set| mesh.node_set(set.text()).ok()).flatten();
    let nodes: Vec<usize> = nodes.copied().collect();
    NodeSetMean::new(mesh, &nodes).is_ok_and(|mean| mean.turns_about(2))
}

impl PlannedBody {
    /// Holds a mesh: its held sets, its springs, its place along z, and the section that turns with its frame.
    pub(super) fn hold(&mut self, place: usize, joined: &JoinedMachine, errors: &mut Diagnostics) {
        let PlannedBody::Meshed(plan) = self else { return };
        if plan.rigid {
            return;
        }
        let Some(case) = meshed(joined, place) else { return };
        if let Some(axial) = &case.axial_restraint {
            let held = match plan.nodes(axial, errors).as_slice() {
                [] => None,
                [node] if !plan.is_cut(axial) => Some(plan.retain(axial, *node, 2)),
                nodes => {
                    let mean = plan.mean_of(std::slice::from_ref(axial), nodes);
                    Some(plan.retain_mean(axial, mean, MeanComponent::Displacement(2)))
                }
            };
            if let Some(held) = held {
                plan.spec.constraints.fix(format!("axial_restraint ({} z)", axial.text()), held);
            }
        }
        clamp(plan, case, errors);
        // What is held to the frame turns with it.
        if turns(joined, place) && !plan.held_to_frame {
            tie(plan, place, case, joined, errors);
        }
        plan.bound(errors);
    }
}

/// Ties the flexible body to the frame that turns with it, where no drive does so.
fn tie(
    plan: &mut BodyPlan,
    place: usize,
    case: &MeshedBody,
    joined: &JoinedMachine,
    errors: &mut Diagnostics,
) {
    let driven = joined.drives.iter().any(|drive| drive.body == place);
    match case.section.as_slice() {
        [] if driven => {}
        [] if plan.cannot_turn() => {}
        [] => {
            let restraint = case.axial_restraint.as_ref();
            section::tie(plan, &joined.bodies[place].name, restraint, errors);
        }
        sets => {
            let names: Vec<&str> = sets.iter().map(Located::text).collect();
            plan.frame = Some(format!("the section {}", names.join(", ")));
            plan.tie(sets, errors);
        }
    }
}

/// Holds nodes in all directions, and springs them to the ground.
fn clamp(plan: &mut BodyPlan, case: &MeshedBody, errors: &mut Diagnostics) {
    for set in &case.held {
        let held = plan.nodes(set, errors);
        if held.len() == plan.mesh.nodes().len() {
            let message = format!(
                "`held` holds every node of {}: nothing of it could move",
                plan.mesh.origin()
            );
            let help = "name the nodes of its mounts only; or leave the body out, and let its joints name the ground";
            errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
        }
        plan.hold("held", set, &held);
    }
    for spring in &case.ground_springs {
        for node in plan.nodes(&spring.set, errors) {
            let axis = AXES[spring.direction];
            let own = GroundSpring {
                name: format!("ground spring ({} {axis})", spring.set.text()),
                dof: 3 * node + spring.direction,
                stiffness: spring.stiffness,
            };
            plan.spring(&spring.set, own);
        }
    }
}

/// Retains x and y of a node.
pub(super) fn retain_in_plane(plan: &mut BodyPlan, name: &Located, node: usize) {
    plan.retain(name, node, 0);
    plan.retain(name, node, 1);
}

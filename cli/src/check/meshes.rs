//! What `whirl check` says of meshes and of what their bodies are reduced to.

use std::fmt::Write;

use whirl_solver::mesh::{self as solid, Fineness};

use crate::case::{Form, JoinedMachine, Mesh, NamedBody};
use crate::errors::Failure;
use crate::machine::{Built, JoinedPlan, PlannedBody, fineness};
use crate::report::table;

/// Sizes, cells, frames, sets and materials.
///
/// # Errors
/// Of linear algebra.
pub(super) fn say(
    text: &mut String,
    joined: &JoinedMachine,
    plan: &JoinedPlan,
    built: &Built,
) -> Result<(), Failure> {
    line!(text, "\nModel");
    text.push_str(&sizes(plan, joined, built));
    line!(text, "{} active coordinates", built.machine.active());
    line!(text, "motion: {}", joined.motion.origin.title);
    for (body, own) in joined.bodies.iter().zip(&plan.bodies) {
        let name = body.name.text();
        if let Some(found) = fineness_of(body) {
            line!(text, "{name}: {}", fineness::described(&found));
        }
        let PlannedBody::Meshed(meshed) = own else { continue };
        if let Some(frame) = meshed.frame.as_ref().filter(|_| !meshed.rigid) {
            line!(text, "the frame of {name} turns with {frame}");
        }
        materials(text, name, &meshed.mesh);
        super::sets::say(text, name, &meshed.mesh)?;
    }
    Ok(())
}

/// How fine the layers of a flexible body are that is made from dimensions.
fn fineness_of(body: &NamedBody) -> Option<Fineness> {
    match &body.form {
        Form::Meshed(own) if !own.rigid => match &own.body.mesh {
            Mesh::Generated(made) => made.dimensions.fineness(),
            _ => None,
        },
        _ => None,
    }
}

/// Materials of a mesh, with the cells that have them; none of matrices.
fn materials(text: &mut String, name: &str, mesh: &solid::Mesh) {
    let of = |(place, material): (usize, &solid::Material)| {
        let blocks = mesh.blocks().iter().filter(|block| block.material == place);
        let cells: usize = blocks.map(|block| block.len()).sum();
        format!("{} ({cells} cells)", material.name)
    };
    let all: Vec<String> = mesh.materials().iter().enumerate().map(of).collect();
    if !all.is_empty() {
        line!(text, "materials of {name}: {}", all.join(", "));
    }
}

/// The table of what is reduced.
fn sizes(plan: &JoinedPlan, joined: &JoinedMachine, built: &Built) -> String {
    let heads = ["", "elements", "nodes", "physical dofs", "retained dofs", "modes", "active"];
    let mut rows = vec![heads.map(str::to_string).to_vec()];
    let places = built.machine.places();
    for ((body, own), place) in joined.bodies.iter().zip(&plan.bodies).zip(places) {
        let PlannedBody::Meshed(own) = own else { continue };
        if own.rigid {
            continue;
        }
        let counts = own.counts();
        let mut row = vec![body.name.text().to_string()];
        let numbers = [
            counts.elements,
            counts.nodes,
            counts.physical_dofs,
            counts.retained_dofs,
            counts.modes,
            place.flexible.len(),
        ];
        row.extend(numbers.iter().map(ToString::to_string));
        rows.push(row);
    }
    if rows.len() == 1 { String::new() } else { table(&rows) }
}

//! The node sets that a case adds to a mesh.

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::mesh::{Mesh, Selection};

use super::plan::AXES;
use super::plan::geometry::mm;
use crate::case::NamedSelection;
use crate::errors::Failure;

/// The mesh with these sets; cylinders about which the case says no axis are about `axis` (m).
///
/// # Errors
/// Those without nodes, and those whose name the mesh has.
pub(super) fn with_selections(
    mesh: Mesh,
    selections: &[NamedSelection],
    axis: [f64; 2],
) -> Result<Mesh, Failure> {
    let mut errors = Diagnostics::new();
    let mut all = mesh;
    for NamedSelection { name, selection, about_axis } in selections {
        if all.node_set(name.text()).is_ok() {
            let message = format!("{} has a node set `{}` of its own", all.origin(), name.text());
            let help = "give this one another name";
            errors.push(name.error_here(Code::BAD_VALUE, message).help(help));
            continue;
        }
        let placed = match *selection {
            Selection::Cylinder { radius, within, z, .. } if *about_axis => {
                Selection::Cylinder { centre: axis, radius, within, z }
            }
            other => other,
        };
        let nodes = all.selected(&placed);
        if nodes.is_empty() {
            let (message, help) = nothing(&all, &placed);
            errors.push(name.error_here(Code::BAD_VALUE, message).help(help));
        }
        all = all.with_node_set(name.text(), nodes);
    }
    Ok(errors.into_result(all)?)
}

/// What is said of a selection that finds nothing, and of the nearest there is.
fn nothing(mesh: &Mesh, selection: &Selection) -> (String, String) {
    let origin = mesh.origin();
    match *selection {
        Selection::Cylinder { centre, radius, within, z } => {
            let found = mesh.cylinders(centre);
            let beside = |own: &[f64; 2]| (z[0] - own[1]).max(own[0] - z[1]).max(0.0);
            let away = |own: &whirl_solver::mesh::Cylinder| {
                (own.radius - radius).abs() + beside(&own.z).min(1e3)
            };
            let nearest = found.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
            let range = match z {
                [from, to] if from.is_finite() && to.is_finite() => {
                    format!(", from z = {} to {}", mm(from), mm(to))
                }
                _ => String::new(),
            };
            let message = format!(
                "no face of {origin} is on a cylinder of radius {} ± {} about x = {}, y = {}{range}",
                mm(radius),
                mm(within),
                mm(centre[0]),
                mm(centre[1])
            );
            let help = match nearest {
                Some(own) => format!(
                    "the nearest has `radius = \"{}\"`, from z = {} to {}",
                    mm(own.radius),
                    mm(own.z[0]),
                    mm(own.z[1])
                ),
                None => "its surface has no cylinder about this axis: check `centre`, and that the axis is along z"
                    .to_owned(),
            };
            (message, help)
        }
        Selection::Point { at, within } => {
            let square =
                |node: &[f64; 3]| -> f64 { (0..3).map(|k| (node[k] - at[k]).powi(2)).sum() };
            let nearest = mesh.nodes().iter().min_by(|a, b| square(a).total_cmp(&square(b)));
            let [x, y, z] = at.map(mm);
            let message =
                format!("no node of {origin} is within {} of ({x}, {y}, {z})", mm(within));
            let help = nearest.map_or_else(String::new, |node| {
                let [x, y, z] = node.map(mm);
                format!("the nearest is at ({x}, {y}, {z}), {} away", mm(square(node).sqrt()))
            });
            (message, help)
        }
        Selection::Plane { across, at, within } => {
            let along = || mesh.nodes().iter().map(|node| node[across]);
            let nearest = along().min_by(|a, b| (a - at).abs().total_cmp(&(b - at).abs()));
            let axis = AXES[across];
            let message =
                format!("no face of {origin} is in the plane {axis} = {} ± {}", mm(at), mm(within));
            let help = format!(
                "the mesh reaches from {axis} = {} to {}; its nodes nearest to the plane are at {axis} = {}",
                mm(along().fold(f64::INFINITY, f64::min)),
                mm(along().fold(f64::NEG_INFINITY, f64::max)),
                mm(nearest.unwrap_or(0.0))
            );
            (message, help)
        }
    }
}

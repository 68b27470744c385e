//! The node sets that a case adds to a mesh.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::mesh::{Mesh, Selection, SetPlace};
use whirl_text::rounded;

use super::wording::{AXES, mm};
use crate::case::NamedSelection;
use crate::errors::Failure;

/// Faces that cover less than this part of a band are warned of.
const COVERED: f64 = 0.98;
/// So are those whose middle is farther from the axis than this part of the radius.
const CENTRED: f64 = 0.01;

/// The mesh with these sets; cylinders about which the case says no axis are about `axis` (m). `warnings` are added to.
///
/// # Errors
/// Those without nodes, and those whose name the mesh has.
pub(super) fn with_selections(
    mesh: Mesh,
    selections: &[NamedSelection],
    axis: [f64; 2],
    warnings: &mut Vec<String>,
) -> Result<Mesh, Failure> {
    let mut errors = Diagnostics::new();
    let mut all = mesh;
    for own in selections {
        let NamedSelection { name, selection, about_axis, .. } = own;
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
        let place = one_side(&all, own, all.select(&placed), warnings, &mut errors);
        if place.nodes.is_empty() {
            let (message, help) = nothing(&all, &placed);
            errors.push(name.error_here(Code::BAD_VALUE, message).help(help));
        }
        all = all.with_place(name.text(), place);
        warnings.extend(uneven(&all, name, &placed)?);
    }
    Ok(errors.into_result(all)?)
}

/// Of both sides of a thin wall the one that is nearer to the radius, where the case does not say how far nodes may be
/// from it.
fn one_side(
    mesh: &Mesh,
    own: &NamedSelection,
    place: SetPlace,
    warnings: &mut Vec<String>,
    errors: &mut Diagnostics,
) -> SetPlace {
    let Selection::Cylinder { centre, radius, within, z } = place.selection else { return place };
    let Some([outer, hole]) = place.two_sides(mesh) else { return place };
    let name = &own.name;
    let both = format!(
        "`{}` has both sides of a wall of {}: faces up to {} from the radius {} count",
        name.text(),
        mesh.origin(),
        mm(within),
        mm(radius)
    );
    if own.within_given {
        warnings.push(format!(
            "{}: {both}; write a smaller `within` if one side is meant",
            name.source().path.display()
        ));
        return place;
    }
    let [near, far] = if outer[1] <= hole[1] { [outer, hole] } else { [hole, outer] };
    if near[1] < far[0] {
        let within = 0.5 * (near[1] + far[0]);
        return mesh.select(&Selection::Cylinder { centre, radius, within, z });
    }
    let help = "write the radius of one side, and `within = \"0.1 mm\"`, less than the thickness of the wall";
    errors.push(name.error_here(Code::BAD_VALUE, both).help(help));
    place
}

/// What is said of faces that leave much of a band open, or whose middle is beside the axis.
fn uneven(mesh: &Mesh, name: &Located, selection: &Selection) -> Result<Option<String>, Failure> {
    let Selection::Cylinder { centre, radius, z, .. } = *selection else { return Ok(None) };
    if mesh.node_set(name.text()).is_ok_and(<[usize]>::is_empty) {
        return Ok(None);
    }
    let caught = mesh.caught(name.text())?;
    let (Some(share), Some(off)) = (caught.share, caught.off_axis) else { return Ok(None) };
    if share >= COVERED && off <= CENTRED * radius {
        return Ok(None);
    }
    let of_band = match z {
        [from, to] if from.is_finite() && to.is_finite() => {
            format!("the band from z = {} to {}", mm(from), mm(to))
        }
        _ => "the band from its first to its last face".to_owned(),
    };
    let there = mesh.nearest_cylinder(centre, radius, z).map_or_else(String::new, |own| {
        let [from, to] = own.z;
        format!(
            "; the cylinder of radius {} is from z = {} to {}",
            mm(own.radius),
            mm(from),
            mm(to)
        )
    });
    Ok(Some(format!(
        "{}: the faces of `{}` cover {} % of {of_band} of {}, and their middle is {} off its axis{there}: check \
         `z`, `radius` and `within` unless this is intended",
        name.source().path.display(),
        name.text(),
        rounded(100.0 * share, 3),
        mesh.origin(),
        mm(off)
    )))
}

/// What is said of a selection that finds nothing, and of the nearest there is.
fn nothing(mesh: &Mesh, selection: &Selection) -> (String, String) {
    let origin = mesh.origin();
    match *selection {
        Selection::Cylinder { centre, radius, within, z } => {
            let nearest = mesh.nearest_cylinder(centre, radius, z);
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
                    "the nearest has `radius = \"{}\"`, from z = {} to {}; `within` says how far nodes may be from it",
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
        Selection::Section { at, within, .. } => {
            let along = || mesh.nodes().iter().map(|node| node[2]);
            let nearest = along().min_by(|a, b| (a - at).abs().total_cmp(&(b - at).abs()));
            let message = format!("no node of {origin} is at z = {} ± {}", mm(at), mm(within));
            let help = format!(
                "the mesh reaches from z = {} to {}; its nodes nearest to this z are at z = {}",
                mm(along().fold(f64::INFINITY, f64::min)),
                mm(along().fold(f64::NEG_INFINITY, f64::max)),
                mm(nearest.unwrap_or(0.0))
            );
            (message, help)
        }
        Selection::Plane { across, at, within } => {
            let along = || mesh.nodes().iter().map(|node| node[across]);
            let nearest = along().min_by(|a, b| (a - at).abs().total_cmp(&(b - at).abs()));
            let axis = AXES[across];
            let message =
                format!("no face of {origin} is in the plane {axis} = {} ± {}", mm(at), mm(within));
            let there = along().filter(|own| (own - at).abs() <= within).count();
            let rest = match (there, nearest) {
                (0, nearest) => format!(
                    "its nodes nearest to the plane are at {axis} = {}",
                    mm(nearest.unwrap_or(0.0))
                ),
                (count, _) => format!(
                    "{count} of its nodes are in the plane, and no face at its outside has all of its own there"
                ),
            };
            let help = format!(
                "the mesh reaches from {axis} = {} to {}; {rest}",
                mm(along().fold(f64::INFINITY, f64::min)),
                mm(along().fold(f64::NEG_INFINITY, f64::max))
            );
            (message, help)
        }
    }
}

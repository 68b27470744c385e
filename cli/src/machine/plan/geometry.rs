//! What a case joins is compared with where it stands: bearings, driven nodes, loads. The solver takes sets
//! at their word, so that a bore beside its journal would carry it all the same.

pub(in crate::machine) mod bearing;
mod place;
mod sets;
pub(in crate::machine) mod stations;

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::mesh::Mesh;
use whirl_solver::model::LoadAction;

pub(in crate::machine) use self::place::nodes_of;
pub(in crate::machine) use self::sets::rim_of;

use self::place::single;
use crate::case::{self, Spread};
use crate::machine::wording::mm;

/// The arm of the driving couple is at least this part of the distance of its nodes. Below it the forces
/// along y are ten times those that the distance asks for, and stretch the section between them.
const LEAST_ARM: f64 = 0.1;
/// The driven nodes stand in one section: along the axis they are apart by at most this part of the arm, so
/// that the moment that tilts the section stays below this part of the torque.
const SECTION: f64 = 0.01;

/// Driven nodes between which a couple of forces along y has no arm, or tilts the section.
pub(in crate::machine) fn driven(section: &[Located], shaft: &Mesh, errors: &mut Diagnostics) {
    let [first, last] = section else { return };
    let (Some(top), Some(bottom)) = (single(shaft, first), single(shaft, last)) else { return };
    // One node for both has been noted.
    if top == bottom {
        return;
    }
    let [a, b] = [top, bottom].map(|node| shaft.nodes()[node]);
    let (x, y, z) = (a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    let names = format!("the driven nodes `{}` and `{}`", first.text(), last.text());
    let mut note = |message: String, help: &str| {
        errors.push(last.error_here(Code::BAD_VALUE, message).help(help));
    };
    if !(x.abs() > LEAST_ARM * x.hypot(y)) {
        note(
            format!(
                "{names} are at x = {} and {}: their forces along y have a lever arm of only {}",
                mm(a[0]),
                mm(b[0]),
                mm(x.abs())
            ),
            "name two nodes at opposite ends of a diameter along x",
        );
    } else if !(z.abs() <= SECTION * x.abs()) {
        note(
            format!(
                "{names} are in different sections: at z = {} and {}, {} apart",
                mm(a[2]),
                mm(b[2]),
                mm(z.abs())
            ),
            "name two nodes of one section, at opposite ends of a diameter along x",
        );
    }
}

/// Nodes that would carry the force of one load twice.
pub(in crate::machine) fn loaded_twice(load: &case::Load, shaft: &Mesh, errors: &mut Diagnostics) {
    // A mean counts every node once.
    if load.spread == Spread::Mean || matches!(load.acting, LoadAction::Couple(_)) {
        return;
    }
    for (second, set) in load.sets.iter().enumerate() {
        let Some(nodes) = nodes_of(shaft, set) else { continue };
        let shared = load.sets[..second].iter().find_map(|first| {
            let other = nodes_of(shaft, first)?;
            let both = nodes.iter().filter(|node| other.contains(node)).count();
            (both > 0).then_some((first, both))
        });
        let Some((first, both)) = shared else { continue };
        let (message, help) = match first.text().eq_ignore_ascii_case(set.text()) {
            true => (
                format!("`{}` is listed twice: its nodes would carry the force twice", set.text()),
                "list it once, and write twice the force if that is meant",
            ),
            false => (
                format!(
                    "`{}` and `{}` have {} in common, which would carry the force twice",
                    first.text(),
                    set.text(),
                    if both == 1 { "a node".to_string() } else { format!("{both} nodes") }
                ),
                "name sets that share no node, or write a second load if that is meant",
            ),
        };
        errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
    }
}

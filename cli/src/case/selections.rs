//! Node sets by where they are: `[body.NAME.sets.SET]`, `[shaft.sets.SET]`, `[support.sets.SET]`.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_solver::mesh::Selection;

use super::names::in_order;

/// A node set that the case adds to a mesh.
#[derive(Debug, Clone)]
pub(crate) struct NamedSelection {
    /// Its name, at its table.
    pub(crate) name: Located,
    /// Its nodes, in the coordinates of the mesh.
    pub(crate) selection: Selection,
    /// Whether a cylinder is about the axis of the body, as the case does not say about which.
    pub(crate) about_axis: bool,
    /// Whether the case says how far nodes may be from it.
    pub(crate) within_given: bool,
}

/// Nodes of a cylinder are this part of its radius from it at most, if the case does not say it.
const ROUND: f64 = 0.01;
/// Nodes of a plane are so far from it at most (m), if the case does not say it.
const FLAT: f64 = 1e-5;

/// Which keys there are besides `within`.
const KINDS: [&str; 4] = ["radius", "point", "plane", "section"];

/// The sets of a body.
pub(super) fn read(table: &Table) -> Vec<NamedSelection> {
    let tables = in_order(table, "sets").into_iter();
    tables.filter_map(|(name, own)| own.read(|own| one(name, own))).collect()
}

fn one(name: Located, own: &Table) -> Option<NamedSelection> {
    let (radius, point, plane) =
        (own.quantity("radius"), own.quantity_triple("point"), own.quantity("plane"));
    let section = own.quantity("section");
    let (within, z, centre) = (own.quantity("within"), range(own), own.quantity_pair("centre"));
    let given: Vec<&str> = KINDS.into_iter().filter(|key| own.gives(key)).collect();
    for key in ["z", "centre"] {
        if own.gives(key) && !own.gives("radius") {
            let message = format!("`{key}` is of a cylinder, which has a `radius`");
            let help = "take it out, or add the `radius`";
            own.push(own.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
    }
    let across = match own.optional_word("across") {
        Some("x") => 0,
        Some("y") => 1,
        _ => 2,
    };
    if own.gives("across") && !own.gives("plane") {
        let message = "`across` is of a plane";
        let help = "take it out, or add the `plane`";
        own.push(own.written("across").error_here(Code::BAD_VALUE, message).help(help));
    }
    match given[..] {
        [_] => {}
        [] => {
            let help = "add `radius = \"20 mm\"` for a cylinder (faces count that are up to `within`, 1 % of it, away from it), \
                        `point = [\"0 mm\", \"0 mm\", \"100 mm\"]` for nodes near it, or `plane = \"0 mm\"` for faces across the axis (with `across = \"x\"` across x), \
                        `section = \"50 mm\"` for all nodes at a z";
            own.absent("radius", help);
            return None;
        }
        [first, second, ..] => {
            own.conflict(first, second);
            return None;
        }
    }
    let selection = if let Some(radius) = radius {
        let (within, centre) = (within.unwrap_or(ROUND * radius), centre.unwrap_or_default());
        Selection::Cylinder { centre, radius, within, z: z? }
    } else if let Some(at) = point {
        if !own.has("within") {
            own.absent("within", "add `within = \"1 mm\"`, the distance up to which nodes count");
        }
        Selection::Point { at, within: within? }
    } else if own.gives("section") {
        Selection::Section { at: section?, within: within.unwrap_or(FLAT), innermost: false }
    } else {
        Selection::Plane { across, at: plane?, within: within.unwrap_or(FLAT) }
    };
    let (about_axis, within_given) = (!own.gives("centre"), own.gives("within"));
    Some(NamedSelection { name, selection, about_axis, within_given })
}

/// From where to where along z: everywhere if the case does not say it. None if what it says is wrong.
fn range(own: &Table) -> Option<[f64; 2]> {
    if !own.has("z") {
        return Some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let [from, to] = own.quantity_pair("z")?;
    if from < to {
        return Some([from, to]);
    }
    let message = "`z` runs from its smaller to its larger value".to_owned();
    let help = "such as `z = [\"20 mm\", \"40 mm\"]`";
    own.push(own.written("z").error_here(Code::BAD_VALUE, message).help(help));
    None
}

//! Where joints stand along z.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::mesh::NodeSetMean;

use super::planned_body::PlannedBody;
use super::surfaces;
use crate::case::{Joint, JointKind, JointSide};
use crate::machine::plan::geometry::nodes_of;
use crate::machine::wording::mm;

/// Sides are apart along the axis by at most this part of the joint's length or of its radius.
const PLANES: f64 = 0.05;

/// z of the left end, the middle and the right end.
pub(super) fn planes(
    joint: &Joint,
    bodies: &[PlannedBody],
    errors: &mut Diagnostics,
) -> Option<[f64; 3]> {
    let [of_journal, of_bore] = joint.sides.each_ref().map(|side| on_mesh(side, bodies));
    let (of_journal, of_bore) = match ends_of_surfaces(joint, bodies, errors)? {
        Some(ends) => (Some(ends), None),
        None => (of_journal, of_bore),
    };
    let stations = &joint.bearing.stations;
    let given = joint.sides.each_ref().map(|side| side.z);
    let centre = |side: &JointSide| match &bodies[side.body?] {
        PlannedBody::Rigid(own) => Some(own.body.centre[2]),
        PlannedBody::Meshed(_) => None,
    };
    let z = of_journal.or(of_bore).unwrap_or_else(|| {
        let ends = stations
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |ends, &z| [ends[0].min(z), ends[1].max(z)]);
        if stations.len() > 1 {
            return [ends[0], 0.5 * (ends[0] + ends[1]), ends[1]];
        }
        let own = given[0].or(given[1]).or(stations.first().copied());
        [own.or_else(|| centre(&joint.sides[0])).unwrap_or(0.0); 3]
    });
    if let (JointKind::Bushing | JointKind::Gear, Some(own), Some(other)) =
        (joint.kind, of_journal, of_bore)
    {
        apart_on_meshes(joint, [own[1], other[1]], bodies, errors)?;
    }
    let radius = joint.bearing.journal_radius.unwrap_or(0.0);
    let allowed = (PLANES * (z[2] - z[0]).abs().max(radius)).max(1e-6);
    for side in &joint.sides {
        let Some(own) = side.z else { continue };
        let apart = (own - z[1]).abs();
        if apart > allowed && joint.kind != JointKind::Coupling {
            let message = format!(
                "the sides of this joint are {} apart along the axis: at z = {} on `{}`, and at {}",
                mm(apart),
                mm(own),
                side.place.text(),
                mm(z[1])
            );
            let help = format!("write `z = \"{}\"`, or leave it out", mm(z[1]));
            errors.push(side.place.error_here(Code::BAD_VALUE, message).help(help));
            return None;
        }
    }
    Some(z)
}

/// z of the left end, the middle and the right end of a joint with surfaces: where both sides are. None without surfaces.
#[allow(clippy::option_option, reason = "outside what is wrong, inside what there is")]
fn ends_of_surfaces(
    joint: &Joint,
    bodies: &[PlannedBody],
    errors: &mut Diagnostics,
) -> Option<Option<[f64; 3]>> {
    if !joint.sides.iter().any(|side| side.surface) {
        return Some(None);
    }
    let mut common = [f64::NEG_INFINITY, f64::INFINITY];
    let mut ranges = Vec::new();
    for side in &joint.sides {
        let Some(PlannedBody::Meshed(plan)) = side.body.map(|body| &bodies[body]) else { continue };
        let own = match (side.surface, side.sets.as_slice()) {
            (true, [set]) => {
                let nodes = plan.nodes(set, errors);
                if nodes.is_empty() {
                    return None;
                }
                surfaces::ends(plan, set, errors)?
            }
            (_, sets @ [_, _, _]) => {
                let Some([left, _, right]) = on_mesh(side, bodies) else {
                    // Says which is missing.
                    sets.iter().for_each(|set| drop(plan.nodes(set, errors)));
                    return None;
                };
                [left, right]
            }
            _ => continue,
        };
        ranges.push((own, side));
        common = [common[0].max(own[0].min(own[1])), common[1].min(own[0].max(own[1]))];
    }
    if let (false, [(first, _), (second, side)]) = (common[0] < common[1], ranges.as_slice()) {
        let message = format!(
            "the journal is from z = {} to {}, and the bore from {} to {}: they do not meet",
            mm(first[0]),
            mm(first[1]),
            mm(second[0]),
            mm(second[1])
        );
        let help = "name surfaces that overlap along z";
        errors.push(side.sets[0].error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    Some(Some([common[0], 0.5 * (common[0] + common[1]), common[1]]))
}

/// Notes sides of a bushing that stand at different z on their meshes, to a hundredth of the first one's length.
fn apart_on_meshes(
    joint: &Joint,
    z: [f64; 2],
    bodies: &[PlannedBody],
    errors: &mut Diagnostics,
) -> Option<()> {
    let [first, second] = &joint.sides;
    let PlannedBody::Meshed(plan) = &bodies[first.body?] else { return Some(()) };
    let along = || plan.mesh.nodes().iter().map(|node| node[2]);
    let length = along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min);
    if (z[0] - z[1]).abs() <= 0.01 * length {
        return Some(());
    }
    let message = format!(
        "the sides of this joint are {} apart along the axis: at z = {} on `{}`, and at {}",
        mm((z[0] - z[1]).abs()),
        mm(z[1]),
        second.place.text(),
        mm(z[0])
    );
    let help = "name sets at the same z";
    errors.push(second.place.error_here(Code::BAD_VALUE, message).help(help));
    None
}

/// z of the sets of a side on a mesh: their means.
fn on_mesh(side: &JointSide, bodies: &[PlannedBody]) -> Option<[f64; 3]> {
    let PlannedBody::Meshed(plan) = &bodies[side.body?] else { return None };
    let z = |set: &Located| {
        if plan.is_cut(set) {
            return Some(NodeSetMean::of_sets(&plan.mesh, &[set.text()]).ok()?.centre()[2]);
        }
        let nodes = nodes_of(&plan.mesh, set)?;
        let sum: f64 = nodes.iter().map(|&node| plan.mesh.nodes()[node][2]).sum();
        Some(sum / nodes.len() as f64)
    };
    match side.sets.as_slice() {
        [one] => Some([z(one)?; 3]),
        [left, middle, right] => Some([z(left)?, z(middle)?, z(right)?]),
        _ => None,
    }
}

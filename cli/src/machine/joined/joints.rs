//! Where the sides of joints stand on their bodies.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::bearing::Sides;
use whirl_solver::mesh::MeanComponent;
use whirl_solver::mesh::measure::Circle;
use whirl_text::rounded;

use super::bodies::retain_in_plane;
use super::section::nodes_at;
use super::{PlannedBody, at, clearance, meshed, surfaces, turns};
use crate::case::{self, JoinedMachine, Joint, JointKind, JointSide};
use crate::machine::laws::Measured;
use crate::machine::plan::BodyPlan;
use crate::machine::plan::geometry::{mm, nodes_of};
use crate::machine::rotor;
use crate::machine::springs::angles;

/// Nodes around the bore of a rigid body, which move with it.
const AROUND: usize = 8;
/// Sides are apart along the axis by at most this part of the joint's length or of its radius.
const PLANES: f64 = 0.05;

/// A joint on its bodies.
pub(super) struct PlannedJoint {
    /// The bearing, with its station where it is in one plane.
    pub(super) bearing: case::Bearing,
    /// The bodies, and how their axes stand to each other.
    pub(super) sides: Sides,
    /// Axis of the journal among the nodes of its body (m).
    pub(super) axis: [f64; 2],
    /// Places among the output nodes of the first body.
    pub(super) journal: [usize; 3],
    /// Places among the output nodes of the second body; none of the ground.
    pub(super) bore: [Vec<usize>; 3],
    /// z of the left end, the middle and the right end, m.
    pub(super) z: [f64; 3],
    /// The circles of journal and bore, where the meshes have both.
    pub(super) circles: Option<[Circle; 2]>,
}

impl PlannedJoint {
    /// What meshes say of it.
    pub(super) fn measured(&self, bodies: &[PlannedBody]) -> Measured {
        let [x, y] = self.sides.bore_axis;
        let bore = match bodies.get(self.sides.bodies[1]) {
            Some(PlannedBody::Meshed(plan)) => {
                let points = self.sides.surface.iter().flat_map(|own| own.points.iter().flatten());
                let on_faces = points.flatten().map(|&(place, _)| place);
                let all: BTreeSet<usize> =
                    self.bore.iter().flatten().copied().chain(on_faces).collect();
                let positions = all.into_iter().map(|place| plan.position(place));
                positions.map(|position| [position[0] - x, position[1] - y]).collect()
            }
            _ => Vec::new(),
        };
        Measured { bore, ends: [self.z[0], self.z[2]] }
    }
}

/// Places a joint; what is wrong is noted, and a joint that cannot be placed is none.
pub(super) fn place(
    joint: &Joint,
    joined: &JoinedMachine,
    bodies: &mut [PlannedBody],
    errors: &mut Diagnostics,
) -> Option<PlannedJoint> {
    let ground = joined.bodies.len();
    let [first, second] = joint.sides.each_ref().map(|side| side.body.unwrap_or(ground));
    let (z, mut bearing) = (planes(joint, bodies, errors)?, joint.bearing.clone());
    if z[0] == z[2] && bearing.stations.is_empty() {
        bearing.stations = vec![z[1]];
    }
    let axis = |body: usize| joined.bodies.get(body).map_or([0.0; 2], |own| own.axis);
    let bore_turns = joint.sides[1].body.is_some_and(|body| turns(joined, body));
    let (own, other) = (axis(first), axis(second));
    let coupling = joint.kind == JointKind::Coupling;
    let mut sides = Sides { bodies: [first, second], ..Sides::default() };
    match bore_turns {
        true if coupling => {}
        true => sides.apart = [own[0] - other[0], own[1] - other[1]],
        false if stands_on_axis(joint, joined) => {
            sides.bore_axis = other;
            sides.offset = [[other[0] - own[0], other[1] - own[1]]; 3];
        }
        false => sides.bore_axis = own,
    }
    for (place, own) in joint.offset.iter().enumerate() {
        sides.offset[place] = [0, 1].map(|axis| sides.offset[place][axis] + own[axis]);
    }
    if coupling {
        for (place, side) in joint.sides.iter().enumerate() {
            if let Some(PlannedBody::Meshed(plan)) = side.body.map(|body| &mut bodies[body]) {
                sides.sections[place] = turning_section(side, plan, errors);
            }
        }
    }
    let of_journal = if turns(joined, first) { [0.0; 2] } else { own };
    let journal = journal(joint, &mut bodies[first], (of_journal, z), errors)?;
    if joint.kind == JointKind::Bushing {
        // Where it stands, and not on the axis of a body: its second side may turn a little.
        let [x, y] = position(&bodies[first], journal[1]);
        let turned = turns(joined, first);
        sides.bore_axis = if turned { [own[0] + x, own[1] + y] } else { [x, y] };
    }
    let bore = match bodies.get_mut(second) {
        Some(PlannedBody::Meshed(plan)) if joint.sides[1].surface => {
            let set = &joint.sides[1].sets[0];
            let stations = rotor::stations(&bearing, [z[0], z[2]]);
            let springs = surfaces::Springs {
                axis: sides.bore_axis,
                stations: stations.iter().map(|s| z[0] + s * (z[2] - z[0])).collect(),
                middle: z[1],
                angles: &joint.angle.map_or_else(|| angles(bearing.springs), |angle| vec![angle]),
            };
            let nodes = plan.nodes(set, errors);
            if is_loose(joint, joined) {
                retain_ends(plan, joint, &nodes);
            }
            sides.surface = Some(surfaces::bore(plan, (set, &nodes), springs, errors)?);
            [const { Vec::new() }; 3]
        }
        Some(body) if !coupling => bore(joint, joined, body, (z, sides.bore_axis), errors)?,
        _ => [const { Vec::new() }; 3],
    };
    let rigid = !matches!(bodies.get(second), Some(PlannedBody::Meshed(_)));
    if let (true, None, Some(what)) =
        (rigid, bearing.journal_radius, bearing.law.source.at_surface())
    {
        let name = &bearing.law.name;
        let message = format!(
            "the law `{}` needs the journal's radius for `{what}`, but the joint gives none and its bore has no mesh",
            name.text()
        );
        let help = "add `journal_radius = \"25 mm\"`, with the radius that the journal has";
        errors.push(name.error_here(Code::MISSING_KEY, message).help(help));
    }
    clearance::measure((joint, &sides), bodies, &mut bearing, errors)?;
    let of_bearing = joint.kind == JointKind::Bearing;
    let circles = clearance::circles(joint, bodies).filter(|_| of_bearing);
    Some(PlannedJoint { bearing, sides, axis: of_journal, journal, bore, z, circles })
}

/// Warnings of a bushing that pushes away what moves, as a magnetic pull does: the symmetric part of its stiffness or of
/// its damping has a negative eigenvalue.
pub(super) fn pushes_away(joint: &Joint) -> Vec<String> {
    if joint.kind != JointKind::Bushing {
        return Vec::new();
    }
    let value = |name: String| {
        let own = joint.bearing.parameters.iter().find(|own| own.name() == name);
        own.map_or(0.0, |own| own.value())
    };
    let mut warnings = Vec::new();
    for (letter, called, unit) in [("k", "stiffness", "N/m"), ("c", "damping", "N s/m")] {
        let [xx, xy, yx, yy] = ["xx", "xy", "yx", "yy"].map(|own| value(format!("{letter}_{own}")));
        let least = 0.5 * (xx + yy) - (0.5 * (xx - yy)).hypot(0.5 * (xy + yx));
        if least < -1e-9 * [xx, xy, yx, yy].map(f64::abs).into_iter().fold(0.0, f64::max) {
            warnings.push(format!(
                "the {called} of the bushing `{}` is negative along one direction at least ({} {unit}): it drives what \
                 it joins apart",
                joint.name.text(),
                rounded(least, 6)
            ));
        }
    }
    warnings
}

/// Whether a bore or a stop that does not turn stands about the axis of its own body.
fn stands_on_axis(joint: &Joint, joined: &JoinedMachine) -> bool {
    matches!(joint.kind, JointKind::Bearing | JointKind::Stop)
        && joint.sides[1].body.is_some_and(|body| joined.bodies[body].bores_on_axis())
}

/// z of the left end, the middle and the right end.
fn planes(joint: &Joint, bodies: &[PlannedBody], errors: &mut Diagnostics) -> Option<[f64; 3]> {
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
    if let (JointKind::Bushing, Some(own), Some(other)) = (joint.kind, of_journal, of_bore) {
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
                surfaces::ends(plan, set, &nodes, errors)?
            }
            (_, [_, _, _]) => on_mesh(side, bodies).map(|[left, _, right]| [left, right])?,
            _ => continue,
        };
        ranges.push((own, side));
        common = [common[0].max(own[0].min(own[1])), common[1].min(own[0].max(own[1]))];
    }
    if !joint.sides.iter().any(|side| side.surface) {
        return Some(None);
    }
    if let (false, [(first, _), (second, side)]) = (common[0] < common[1], ranges.as_slice()) {
        let message = format!(
            "the journal is from z = {} to {}, and the bore from {} to {}: they do not meet",
            mm(first[0]),
            mm(first[1]),
            mm(second[0]),
            mm(second[1])
        );
        let help = "name surfaces that are around each other";
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
    let help = "name sets that stand at the same z";
    errors.push(second.place.error_here(Code::BAD_VALUE, message).help(help));
    None
}

/// z of the sets of a side on a mesh: their means.
fn on_mesh(side: &JointSide, bodies: &[PlannedBody]) -> Option<[f64; 3]> {
    let PlannedBody::Meshed(plan) = &bodies[side.body?] else { return None };
    let z = |set| {
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

/// The section on which a side of a coupling stands, as a place among the means; none where the case names no set. Its
/// turn is retained.
fn turning_section(
    side: &JointSide,
    plan: &mut BodyPlan,
    errors: &mut Diagnostics,
) -> Option<usize> {
    let set = side.sets.first()?;
    let nodes = match plan.nodes(set, errors).as_slice() {
        [] => return None,
        [one] => nodes_at(&plan.mesh, plan.mesh.nodes()[*one][2]),
        nodes => nodes.to_vec(),
    };
    let place = plan.mean(&nodes);
    if !plan.spec.means[place].turns_about(2) {
        let message = format!(
            "the nodes of `{}` stand on the axis of {}: they show no turn about it",
            set.text(),
            plan.mesh.origin()
        );
        let help = "name a set of the nodes of a section, or leave `sets` out for the section that turns with the frame";
        errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    plan.retain_mean(set, place, MeanComponent::Rotation(2));
    Some(place)
}

/// The nodes of the first side.
fn journal(
    joint: &Joint,
    body: &mut PlannedBody,
    (axis, z): ([f64; 2], [f64; 3]),
    errors: &mut Diagnostics,
) -> Option<[usize; 3]> {
    let plan = match body {
        PlannedBody::Rigid(own) => {
            let [x, y, _] = own.body.centre;
            return Some(match z[0] == z[2] {
                true => [own.node([x, y, z[1]]); 3],
                false => z.map(|z| own.node([x, y, z])),
            });
        }
        PlannedBody::Meshed(plan) => plan,
    };
    if joint.kind == JointKind::Coupling {
        // Only angles count: any node will do.
        return Some([plan.output_node(0); 3]);
    }
    if let (true, [set]) = (joint.sides[0].surface, joint.sides[0].sets.as_slice()) {
        let nodes = plan.nodes(set, errors);
        return surfaces::journal(plan, (set, &nodes), (axis, z), errors);
    }
    let mut journal = [0; 3];
    for (place, set) in joint.bearing.journal.iter().take(3).enumerate() {
        let known = joint.bearing.journal[..place].iter().position(|own| own.text() == set.text());
        if let Some(known) = known {
            journal[place] = journal[known];
            continue;
        }
        let nodes = plan.nodes(set, errors);
        if nodes.is_empty() {
            return None;
        }
        journal[place] = plan.output_in_plane(set, &nodes);
    }
    Some(journal)
}

/// The nodes of the second side, around `axis` in the planes at `z`.
fn bore(
    joint: &Joint,
    joined: &JoinedMachine,
    body: &mut PlannedBody,
    (z, axis): ([f64; 3], [f64; 2]),
    errors: &mut Diagnostics,
) -> Option<[Vec<usize>; 3]> {
    let plan = match body {
        PlannedBody::Rigid(own) => {
            let bearing = &joint.bearing;
            let radius = bearing.journal_radius.unwrap_or(0.0) + bearing.radial_clearance;
            // Of what has no radius, any will do: the nodes move alike.
            let radius = if radius > 0.0 { radius } else { 1e-3 };
            let mut ring = |z: f64| -> Vec<usize> {
                let node = |k: usize| {
                    let (sin, cos) = (TAU * k as f64 / AROUND as f64).sin_cos();
                    [axis[0] + radius * cos, axis[1] + radius * sin, z]
                };
                (0..AROUND).map(|k| own.node(node(k))).collect()
            };
            return Some(match z[0] == z[2] {
                true => {
                    let all = ring(z[1]);
                    [all.clone(), all.clone(), all]
                }
                false => z.map(&mut ring),
            });
        }
        PlannedBody::Meshed(plan) => plan,
    };
    let loose = is_loose(joint, joined);
    let mut bore = [const { Vec::new() }; 3];
    for (place, set) in joint.bearing.bore.iter().take(3).enumerate() {
        let known = joint.bearing.bore[..place].iter().position(|own| own.text() == set.text());
        if let Some(known) = known {
            bore[place] = bore[known].clone();
            continue;
        }
        let nodes = plan.nodes(set, errors);
        if nodes.is_empty() {
            return None;
        }
        if loose {
            retain_ends(plan, joint, &nodes);
        }
        bore[place] = nodes.into_iter().map(|node| plan.output_node(node)).collect();
    }
    Some(bore)
}

/// Whether nothing but its joints holds the body of the second side.
fn is_loose(joint: &Joint, joined: &JoinedMachine) -> bool {
    let case = joint.sides[1].body.and_then(|body| meshed(joined, body));
    case.is_some_and(|case| case.held.is_empty() && case.ground_springs.is_empty())
}

/// Retains two nodes of a bore that are far apart: nothing but its joints holds the body.
fn retain_ends(plan: &mut BodyPlan, joint: &Joint, nodes: &[usize]) {
    let at_node = |node: usize| plan.mesh.nodes()[node];
    let distance = |a: [f64; 3], b: [f64; 3]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let first = nodes[0];
    let from_first = |node: &usize| distance(at_node(*node), at_node(first));
    let far = nodes.iter().max_by(|a, b| from_first(a).total_cmp(&from_first(b)));
    for node in [first, far.copied().unwrap_or(first)] {
        let name = at(&joint.name, format!("node {}", plan.mesh.labels()[node]));
        retain_in_plane(plan, &name, node);
    }
}

/// x and y of an output node.
fn position(body: &PlannedBody, place: usize) -> [f64; 2] {
    let [x, y, _] = match body {
        PlannedBody::Meshed(plan) => plan.position(place),
        PlannedBody::Rigid(own) => own.nodes[place],
    };
    [x, y]
}

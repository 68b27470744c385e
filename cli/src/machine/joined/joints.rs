//! Where the sides of joints stand on their bodies.

use std::f64::consts::TAU;

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_codegen::kinds::law::Acts;
use whirl_codegen::rational::nearest;
use whirl_solver::bearing::{Gear, Sides};
use whirl_solver::film::Grid;
use whirl_solver::mesh::MeanComponent;

use super::bodies::retain_in_plane;
use super::of_case::{meshed, turns};
use super::others;
use super::planes::planes;
use super::planned_body::PlannedBody;
use super::planned_joint::PlannedJoint;
use super::section::{self, nodes_at};
use super::{clearance, surfaces};
use crate::case::{self, JoinedMachine, Joint, JointKind, JointSide};
use crate::machine::plan::BodyPlan;
use crate::machine::springs::angles;

/// Nodes around the bore of a rigid body, which move with it.
const AROUND: usize = 8;

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
    if z[0] == z[2] && bearing.stations.is_empty() && joined.is_named() {
        bearing.stations = vec![z[1]];
    }
    let axis = |body: usize| joined.bodies.get(body).map_or([0.0; 2], |own| own.axis);
    let bore_turns = joint.sides[1].body.is_some_and(|body| turns(joined, body));
    let (own, other) = (axis(first), axis(second));
    let coupling = joint.kind == JointKind::Coupling;
    let gear = joint.kind == JointKind::Gear;
    let mut sides = Sides { bodies: [first, second], ..Sides::default() };
    match bore_turns {
        true if coupling || gear => {}
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
    if coupling || gear {
        for (place, side) in joint.sides.iter().enumerate() {
            if let Some(PlannedBody::Meshed(plan)) = side.body.map(|body| &mut bodies[body]) {
                sides.sections[place] = turning_section(side, plan, errors);
            }
        }
    }
    if let (false, true, PlannedBody::Meshed(plan)) =
        (coupling || gear, bearing.law.source.gives_torque(), &mut bodies[first])
    {
        sides.torque_section = torque_section(&joint.sides[0], plan);
    }
    sides.whole_sections = others::whole_sections(joint, bodies, errors);
    let of_journal = if turns(joined, first) { [0.0; 2] } else { own };
    let journal = journal(joint, &mut bodies[first], (of_journal, z), errors)?;
    // A side on the ground is an error that was noted.
    let pair = joint.sides.each_ref().map(|side| Some(&joined.bodies[side.body?]));
    if let (Some(gears), [Some(own), Some(other)]) = (&joint.gears, pair) {
        let second = centre_of(&joint.sides[1], &mut bodies[second], z[1], errors)?;
        sides.gear = Some(Gear { second, flanks: gears.flanks(case::axes_apart([own, other])) });
    }
    if joint.kind == JointKind::Bushing {
        // Where it stands, and not on the axis of a body: its second side may turn a little.
        let [x, y] = position(&bodies[first], journal[1]);
        let turned = turns(joined, first);
        sides.bore_axis = if turned { [own[0] + x, own[1] + y] } else { [x, y] };
    }
    for (place, side) in joint.sensor.iter().flat_map(|own| own.sides.iter().enumerate()) {
        if let Some(body) = side.body {
            let z = side.z.unwrap_or(z[1]);
            sides.sensor[place] = Some(centre_of(side, &mut bodies[body], z, errors)?);
        }
    }
    let mut film = None;
    let bore = match bodies.get_mut(second) {
        Some(PlannedBody::Meshed(plan)) if joint.sides[1].surface => {
            let set = &joint.sides[1].sets[0];
            let stations = stations(&bearing, [z[0], z[2]]);
            let stations: Vec<f64> = stations.iter().map(|s| z[0] + s * (z[2] - z[0])).collect();
            film = film_grid(&bearing, plan, (&stations, z));
            let springs = surfaces::Springs {
                axis: sides.bore_axis,
                film: film.as_ref(),
                stations,
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
        Some(body) if !coupling && !gear => {
            bore(joint, joined, body, (z, sides.bore_axis), errors)?
        }
        _ => [const { Vec::new() }; 3],
    };
    let asked = bearing.law.source.film().and_then(|own| own.asked_to_give_way());
    let meshed = bodies.get(second).and_then(PlannedBody::meshed);
    if let (Some(at), false) =
        (asked, meshed.is_some_and(|own| sides.surface.is_some() && !own.rigid))
    {
        let message =
            "the bore of this film cannot give way: it is no `surface` of a flexible body";
        let help = "write `bore = { body = \"NAME\", surface = \"SET\" }` with a set of all its faces on a mesh, or leave `flexible` out";
        errors.push(at.error_here(Code::BAD_VALUE, message).help(help));
    }
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
    let others = others::place(joint, bodies, errors);
    Some(PlannedJoint {
        bearing,
        sides,
        axis: of_journal,
        journal,
        bore,
        z,
        others,
        film: film.map(|(grid, _)| grid),
        circles,
    })
}

/// The nodes of a film under which a bore on a mesh gives way, and z of its middle; none of other laws.
fn film_grid(
    bearing: &case::Bearing,
    plan: &BodyPlan,
    (stations, z): (&[f64], [f64; 3]),
) -> Option<(Grid, f64)> {
    let (Some(film), [middle], false) = (bearing.law.source.film(), stations, plan.rigid) else {
        return None;
    };
    let length = bearing.facts.length.as_ref().map_or(z[2] - z[0], nearest);
    Some((film.grid_that_gives_way(length)?, *middle))
}

/// Whether a bore or a stop that does not turn stands about the axis of its own body.
fn stands_on_axis(joint: &Joint, joined: &JoinedMachine) -> bool {
    matches!(joint.kind, JointKind::Bearing | JointKind::Stop)
        && joint.sides[1].body.is_some_and(|body| joined.bodies[body].bores_on_axis())
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
        [one] if !plan.is_cut(set) => nodes_at(&plan.mesh, plan.mesh.nodes()[*one][2]),
        nodes => nodes.to_vec(),
    };
    let place = plan.mean_of(std::slice::from_ref(set), &nodes);
    if !plan.spec.means[place].turns_about(2) {
        let message = format!(
            "the nodes of `{}` are on the axis of {}: they define no rotation about it",
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

/// The section of a journal that the torque of its joint turns, as a place among the means, its turn retained: that of the
/// middle of its sets. None of a rigid body, and where the set shows no section.
fn torque_section(side: &JointSide, plan: &mut BodyPlan) -> Option<usize> {
    let set = side.sets.get(side.sets.len() / 2).filter(|_| !plan.rigid)?;
    let nodes = section::of_set(&plan.mesh, set)?;
    let place = plan.mean(&nodes);
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
            let [x, y] = joint.sides[0].at.as_ref().map_or([x, y], |(place, _)| *place);
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

/// The centre of a gear or of the section that a sensor sees: a node of its body.
fn centre_of(
    side: &JointSide,
    body: &mut PlannedBody,
    z: f64,
    errors: &mut Diagnostics,
) -> Option<usize> {
    match body {
        PlannedBody::Rigid(own) => {
            let [x, y, _] = own.body.centre;
            Some(own.node([x, y, z]))
        }
        PlannedBody::Meshed(plan) => {
            let set = side.sets.first()?;
            let nodes = plan.nodes(set, errors);
            (!nodes.is_empty()).then(|| plan.output_in_plane(set, &nodes))
        }
    }
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

/// Text at the place of another.
fn at(place: &Located, text: String) -> Located {
    Located::new(place.source(), place.span(), text)
}

/// Rings of springs by their distance from the left end over the length; `ends` are the z of the ends. A bearing
/// in one plane has its only ring there, which the middle is; so has one whose law acts once.
pub(super) fn stations(bearing: &case::Bearing, [left, right]: [f64; 2]) -> Vec<f64> {
    match bearing.stations.as_slice() {
        _ if matches!(bearing.law.source.acts(), Acts::Joint | Acts::Sensor | Acts::Gear) => {
            vec![0.5]
        }
        [] => vec![0.0, 0.5, 1.0],
        [_] if left == right => vec![0.5],
        stations => stations.iter().map(|z| (z - left) / (right - left)).collect(),
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

//! The clearance of a journal in its bore, measured on the meshes of both.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_codegen::rational::nearest;
use whirl_solver::bearing::Sides;
use whirl_solver::mesh::measure::{Circle, circle};

use super::planned_body::PlannedBody;
use crate::case::{self, Joint, JointSide, rounded};
use crate::machine::plan::geometry::nodes_of;
use crate::machine::wording::mm;

/// Nodes further from their circle than this part of its radius are not on one.
const ROUND: f64 = 0.05;
/// A journal or a bore that is out of round by more than this part of the clearance is warned of.
const OUT_OF_ROUND: f64 = 0.5;
/// A distance that is the clearance to this part is none beyond it.
const ROUNDING: f64 = 1e-9;
/// What a message says after the sentence about a mesh without a radius.
const WRITE: &str = "write the clearance, such as `radial_clearance = \"35 um\"`";

/// The circle through the nodes of a side, as seen along the axis; none of one node, and of nodes on a line.
pub(super) fn circle_of(side: &JointSide, bodies: &[PlannedBody]) -> Option<Circle> {
    let PlannedBody::Meshed(plan) = &bodies[side.body?] else { return None };
    let mut nodes = Vec::new();
    for set in &side.sets {
        // Of faces that are cut all nodes are on the circle, within the band or not.
        match plan.mesh.place_of(set.text()) {
            Some(place) if plan.is_cut(set) => nodes.extend(place.face_nodes()),
            _ => nodes.extend_from_slice(nodes_of(&plan.mesh, set)?),
        }
    }
    let points: Vec<[f64; 2]> =
        nodes.into_iter().map(|node| plan.mesh.nodes()[node]).map(|[x, y, _]| [x, y]).collect();
    circle(&points)
}

/// The circles of journal and bore, where both have one.
pub(super) fn circles(joint: &Joint, bodies: &[PlannedBody]) -> Option<[Circle; 2]> {
    let [journal, bore] = joint.sides.each_ref().map(|side| circle_of(side, bodies));
    let found = [journal?, bore?];
    found.iter().all(|own| own.deviation <= ROUND * own.radius).then_some(found)
}

/// Gives a bearing the clearance that its meshes leave, where the case says so; notes why they do not say it.
pub(super) fn measure(
    (joint, sides): (&Joint, &Sides),
    bodies: &[PlannedBody],
    bearing: &mut case::Bearing,
    errors: &mut Diagnostics,
) -> Option<()> {
    if !joint.clearance_from_mesh {
        return Some(());
    }
    let mut note = |at: &Located, message: String, help: String| {
        errors.push(at.error_here(Code::BAD_VALUE, message).help(help));
        None
    };
    let key = place_of(joint, "radial_clearance");
    let mut found = Vec::with_capacity(2);
    for (side, word) in joint.sides.iter().zip(joint.kind.words().1) {
        let body = side.place.text();
        let Some(PlannedBody::Meshed(_)) = side.body.map(|body| &bodies[body]) else {
            let message = format!(
                "`radial_clearance` is to be measured on the meshes, but the {word} of this joint is on `{body}`, which has \
                 none"
            );
            let help = match side.body {
                Some(_) => format!("{WRITE}, or give `{body}` a mesh"),
                None => format!("{WRITE}, or name a body with a mesh as `{word}`"),
            };
            return note(&key, message, help);
        };
        let names: Vec<String> = side.sets.iter().map(|set| format!("`{}`", set.text())).collect();
        let names = names.join(", ");
        let at = side.sets.first().unwrap_or(&side.place);
        let all_around = format!(
            "write `{word} = {{ body = {body:?}, surface = \"SET\" }}` with a set of all faces of the {word}, or {WRITE}"
        );
        let Some(circle) = circle_of(side, bodies) else {
            let message = format!(
                "`radial_clearance` is to be measured on the meshes, but the nodes of the {word} {names} of `{body}` are on \
                 no circle: they have no radius"
            );
            return note(at, message, all_around);
        };
        if circle.deviation > ROUND * circle.radius {
            let message = format!(
                "`radial_clearance` is to be measured on the meshes, but the nodes of the {word} {names} of `{body}` are up \
                 to {} off the circle of radius {} through them",
                mm(circle.deviation),
                mm(circle.radius)
            );
            return note(at, message, all_around);
        }
        found.push(circle);
    }
    let [journal, bore] = [found[0], found[1]];
    let clearance = rounded(bore.radius - journal.radius)?;
    let c = nearest(&clearance);
    if c <= 0.0 {
        let message = format!(
            "the meshes leave no clearance: the radius of the journal is {}, that of the bore {}, which is {} less",
            mm(journal.radius),
            mm(bore.radius),
            mm(-c)
        );
        let help = format!(
            "name the bore of this journal, or {WRITE}: nodes of a mesh made from dimensions are not all on the true circle"
        );
        return note(&key, message, help);
    }
    let far = |[x, y]: [f64; 2]| Some(x.hypot(y)).filter(|far| *far > c * (1.0 + ROUNDING));
    for (key, places) in [("run_out", &joint.run_out), ("offset", &joint.offset)] {
        if let Some(far) = places.iter().find_map(|place| far(*place)) {
            let message = format!(
                "this `{key}` is {}, more than the radial clearance of {} that the meshes leave: the journal would \
                 be inside the wall",
                mm(far),
                mm(c)
            );
            let help = format!("write a smaller one, such as `{key} = [\"5 um\", \"0 um\"]`");
            return note(&place_of(joint, key), message, help);
        }
    }
    let [own, all] = [joint.offset[1], sides.offset[1]];
    let axes = [0, 1].map(|k| all[k] - own[k] + sides.apart[k]);
    if let Some(far) = far(axes) {
        let message = format!(
            "the axes of the two bodies are {} apart, more than the radial clearance of {} that the meshes leave",
            mm(far),
            mm(c)
        );
        let help = "give both bodies the same `axis`, or axes less than that apart".to_owned();
        return note(&joint.sides[1].place, message, help);
    }
    bearing.radial_clearance = c;
    bearing.facts.radial_clearance = Some(clearance);
    if bearing.journal_radius.is_none() {
        bearing.journal_radius = Some(journal.radius);
        bearing.facts.journal_radius = rounded(journal.radius);
    }
    Some(())
}

/// Says which of both is out of round by much of a clearance that was measured.
pub(super) fn warn(joint: &Joint, [journal, bore]: [Circle; 2], warnings: &mut Vec<String>) {
    let c = bore.radius - journal.radius;
    for (word, circle) in [("journal", journal), ("bore", bore)] {
        if joint.clearance_from_mesh && circle.deviation > OUT_OF_ROUND * c {
            warnings.push(format!(
                "{}: the nodes of the {word} of the joint `{}` are up to {} off their circle, and the clearance between the \
                 mean radii is {}: refine the mesh, or write the clearance",
                joint.name.source().path.display(),
                joint.name.text(),
                mm(circle.deviation),
                mm(c)
            ));
        }
    }
}

/// Where the case says `key`, or the joint.
fn place_of(joint: &Joint, key: &str) -> Located {
    joint.bearing.places.get(key).unwrap_or(&joint.bearing.table).clone()
}

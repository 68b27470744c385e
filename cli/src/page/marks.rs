//! Where joints stand in the picture of the machine.

use serde::Serialize;

use crate::case::{Case, Joint, JointKind, JointSide, NamedBody, axes_apart};
use crate::machine::JoinedPlan;

/// A joint, or a gear of two, about an axis.
#[derive(Debug, Serialize)]
pub(super) struct Mark {
    name: String,
    /// The body of its journal or first side; that of its bore or second side, none of the ground.
    of: String,
    to: Option<String>,
    /// x and y of the axis about which it stands, and z of its planes (m).
    axis: [f64; 2],
    z: Vec<f64>,
    /// Of the journal or the pitch circle (m); none where the surface of the body tells it.
    radius: Option<f64>,
    /// Whether it stands at a point beside the axis of its body.
    point: bool,
    /// Of a stop on one side (rad from x).
    angle: Option<f64>,
    /// Where its name stands (rad from x): in the middle of a pad.
    named_at: f64,
    /// Whether the radius is that of its ring, whatever stands for the body: of a pad.
    exact: bool,
}

/// All of a case; `free`: where bodies stand along the axis (m) of which the case does not say it.
pub(super) fn marks(case: &Case, plan: &JoinedPlan, free: &[Option<f64>]) -> Vec<Mark> {
    let joints = case.machine.joints.iter().enumerate();
    joints.flat_map(|(place, joint)| of_joint(case, plan, (place, joint), free)).collect()
}

/// Whether the case says where a joint stands along the axis.
pub(super) fn has_place(joint: &Joint) -> bool {
    let told = |side: &JointSide| !side.sets.is_empty() || side.z.is_some();
    joint.sides.iter().any(told) || !joint.bearing.stations.is_empty()
}

fn of_joint(
    case: &Case,
    plan: &JoinedPlan,
    (place, joint): (usize, &Joint),
    free: &[Option<f64>],
) -> Vec<Mark> {
    let bodies = &case.machine.bodies;
    let [first, second] = joint.sides.each_ref().map(|side| side.body.map(|body| &bodies[body]));
    let Some(first) = first else { return Vec::new() };
    let pad = plan.laws[place].film().and_then(|own| own.pad());
    let mark = |of: &NamedBody, to: Option<&NamedBody>, axis: [f64; 2], radius: Option<f64>| Mark {
        name: joint.called.title.clone(),
        of: of.name.text().to_owned(),
        to: to.map(|own| own.name.text().to_owned()),
        axis,
        z: match joint.sides[0].body.and_then(|body| free[body]).filter(|_| !has_place(joint)) {
            Some(z) => vec![z],
            None => plan.stations(place),
        },
        radius: radius.filter(|own| *own > 0.0),
        point: joint.sides[0].at.is_some(),
        angle: joint.angle,
        named_at: pad.map_or(0.0, |[start, size, ..]| start + 0.5 * size),
        exact: pad.is_some() && joint.bearing.journal_radius.is_some(),
    };
    if let (Some(gears), Some(second)) = (&joint.gears, second) {
        let [x, y] = axes_apart([first, second]);
        let [own, other] = gears.pitch_radii(x.hypot(y)).map(Some);
        let wheel = mark(second, Some(first), second.axis, other);
        return vec![mark(first, Some(second), first.axis, own), wheel];
    }
    let axis = match joint.kind {
        JointKind::Bushing => plan.place_of_bushing(place),
        _ => first.axis,
    };
    let circles = plan.clearance(place).1;
    let radius = circles.map(|[journal, _]| journal.radius).or(joint.bearing.journal_radius);
    vec![mark(first, second, axis, radius)]
}

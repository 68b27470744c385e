//! Meshes that turn about another axis than the one about which they are made.

use super::planned_body::PlannedBody;
use crate::case::{JoinedMachine, JointKind};
use crate::machine::plan::geometry::rim_of;
use crate::machine::wording::mm;

/// Rims may be this part of their radius off the axis, and of their distance from it apart.
const CENTRED: f64 = 1e-3;
const TOGETHER: f64 = 0.1;

/// Warns of bodies that turn, and all of whose joints go around one other axis: their unbalance would be that of the distance.
pub(super) fn warn(joined: &JoinedMachine, bodies: &[PlannedBody], warnings: &mut Vec<String>) {
    for (place, (body, planned)) in joined.bodies.iter().zip(bodies).enumerate() {
        let Some(plan) = planned.meshed().filter(|_| body.turns()) else { continue };
        // Journals that are off the axis are errors.
        let others = joined
            .joints
            .iter()
            .filter(|own| !matches!(own.kind, JointKind::Bearing | JointKind::Stop));
        let sides = others.flat_map(|joint| &joint.sides);
        let sides = sides.filter(|side| side.body == Some(place));
        let rims: Vec<_> =
            sides.flat_map(|side| &side.sets).filter_map(|set| rim_of(&plan.mesh, set)).collect();
        let Some(first) = rims.first() else { continue };
        let [x, y] = first.centre;
        let off = x.hypot(y);
        let is_off = rims.iter().all(|own| {
            let [a, b] = own.centre;
            (a - x).hypot(b - y) <= TOGETHER * off && a.hypot(b) > CENTRED * own.radius
        });
        if is_off {
            let name = body.name.text();
            warnings.push(format!(
                "{}: all that joints take of `{name}` stands about x = {}, y = {}, {} off the axis about which it turns: write `axis = [\"{}\", \"{}\"]` in [body.{name}] to turn it about that",
                body.name.source().path.display(),
                mm(x),
                mm(y),
                mm(off),
                mm(x + body.axis[0]),
                mm(y + body.axis[1])
            ));
        }
    }
}

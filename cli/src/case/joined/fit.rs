//! Whether a journal can be in its bore: axes, run-outs and offsets compared with the clearance.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_text::rounded;

use crate::case::joined_machine::JoinedMachine;
use crate::case::joint::{Joint, JointKind};
use crate::case::named_body::NamedBody;

/// Values of three digits may be this part apart from what they mean.
const DIGITS: f64 = 0.01;
/// A distance that is the clearance to this part is none beyond it.
const ROUNDING: f64 = 1e-9;

/// How far a journal may be from the middle of its bore, and what that is called.
pub(super) struct Room {
    /// m.
    size: f64,
    name: &'static str,
    /// Of a stop on one side: only x counts.
    along_x: bool,
}

impl Room {
    /// That of a bearing or a stop; none where neither its clearance nor a radius is known.
    pub(super) fn of(
        kind: JointKind,
        angle: Option<f64>,
        clearance: f64,
        radius: Option<f64>,
    ) -> Option<Room> {
        let along_x = angle.is_some();
        let (size, name) = match kind {
            JointKind::Stop if along_x => (clearance.abs(), "gap"),
            JointKind::Stop if clearance > 0.0 => (clearance, "gap"),
            JointKind::Bearing if clearance > 0.0 => (clearance, "radial clearance"),
            JointKind::Bearing | JointKind::Stop => (radius?, "journal's radius"),
            JointKind::Bushing | JointKind::Coupling | JointKind::Gear => return None,
        };
        Some(Room { size, name, along_x })
    }

    /// The part of `distance` that is beyond it, and says so.
    fn beyond(&self, [x, y]: [f64; 2]) -> Option<String> {
        let far = if self.along_x { x.abs() } else { x.hypot(y) };
        (far > self.size * (1.0 + ROUNDING)).then(|| {
            let along = if self.along_x { " along x" } else { "" };
            format!("{}{along}, more than the {} of {}", length(far), self.name, length(self.size))
        })
    }

    /// Notes places that are not in it.
    pub(super) fn check(&self, table: &Table, key: &str, places: &[[f64; 2]]) {
        // A run-out turns.
        let room = Room { along_x: self.along_x && key == "offset", ..*self };
        if let Some(far) = places.iter().find_map(|place| room.beyond(*place)) {
            let message = format!("this `{key}` is {far}: the journal would be inside the wall");
            let help = format!("write a smaller one, such as `{key} = [\"5 um\", \"0 um\"]`");
            table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
    }
}

/// What is wrong between the axes of the bodies of a joint, and how to fix it, at the bore's body.
pub(super) fn axes(
    machine: &JoinedMachine,
    joint: &Joint,
) -> Option<(Located, String, &'static str)> {
    let [journal, bore] = joint.sides.each_ref();
    let [own, other] = [journal.body?, bore.body?].map(|body| &machine.bodies[body]);
    if !other.bores_on_axis() {
        return None;
    }
    let (bearing, angle) = (&joint.bearing, joint.angle);
    let room = Room::of(joint.kind, angle, bearing.radial_clearance, bearing.journal_radius)?;
    let far = room.beyond([0, 1].map(|axis| other.axis[axis] - own.axis[axis]))?;
    let named = |body: &NamedBody| {
        let [x, y] = body.axis.map(length);
        let given = if body.axis_given { "" } else { " (it gives no `axis`)" };
        format!("that of `{}`{given} at x = {x}, y = {y}", body.name.text())
    };
    let message =
        format!("the axes of the two bodies are {far} apart: {}, and {}", named(own), named(other));
    let help = "give both bodies the same `axis`, or axes less than that apart";
    Some((bore.place.clone(), message, help))
}

/// Notes a polar inertia that is more than twice the transverse one, which no mass has.
pub(super) fn inertias(table: &Table, polar: Option<f64>, transverse: Option<f64>) {
    let (Some(polar), Some(transverse)) = (polar, transverse) else { return };
    if polar > 2.0 * transverse * (1.0 + DIGITS) {
        let at = table.written("polar_inertia");
        let message = format!(
            "a `polar_inertia` of {} is more than twice the `transverse_inertia` of {}, which no body has: a thin disc has \
             twice as much, all that is longer has less",
            at.text().trim_matches('"'),
            table.written("transverse_inertia").text().trim_matches('"')
        );
        let help = "swap the two, if they are in each other's place";
        table.push(at.error_here(Code::BAD_VALUE, message).help(help));
    }
}

/// A length with its unit.
fn length(metres: f64) -> String {
    match metres.abs() {
        far if far > 0.0 && far < 0.1e-3 => format!("{} µm", rounded(1e6 * metres, 6)),
        _ => format!("{} mm", rounded(1e3 * metres, 6)),
    }
}

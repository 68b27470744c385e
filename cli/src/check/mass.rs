//! What `whirl check` says of a point mass.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_solver::model::{AttachmentKind, LoadAction};
use whirl_text::rounded;

use super::loads;
use crate::case::{Form, JoinedMachine};
use crate::machine::JoinedPlan;

/// The mass, how it begins, and its stops.
pub(super) fn say(text: &mut String, machine: &JoinedMachine, plan: &JoinedPlan) {
    let own = &machine.bodies[0];
    let Form::Rigid(body) = &own.form else { return };
    let (mass, [stiffness, _], [damping, _]) = (body.mass, body.stiffness, body.damping);
    let force = machine.loads.iter().map(|own| match own.load.acting {
        LoadAction::Force([x, ..]) => x,
        LoadAction::Couple(_) => 0.0,
    });
    let force = force.fold(0.0, |all, x| all + x);
    line!(
        text,
        "\nmass {mass} kg, stiffness {stiffness} N/m, damping {damping} N s/m, force {force} N"
    );
    if stiffness > 0.0 {
        line!(text, "natural frequency {} Hz", rounded((stiffness / mass).sqrt() / TAU, 6));
    }
    let [displacement, velocity] = [&own.start.position, &own.start.velocity].map(|all| all[0]);
    line!(text, "initial displacement {displacement} m, initial velocity {velocity} m/s");
    for attached in &own.attached {
        if let (AttachmentKind::Unbalance([x, y]), Some(speed)) = (attached.what, own.spin()) {
            line!(
                text,
                "unbalance: eccentricity {} mm, turning at {} rpm",
                rounded(1e3 * x.hypot(y) / mass, 10),
                rounded(60.0 * speed / TAU, 10)
            );
        }
    }
    loads::ground(machine).iter().for_each(|own| line!(text, "{own}"));
    for (place, (joint, law)) in machine.joints.iter().zip(&plan.laws).enumerate() {
        let side = match joint.angle {
            Some(0.0) => "above",
            Some(_) => "below",
            None => "around",
        };
        // A law of a ring that does not say which of its parameters is the gap has it in itself.
        let gap = match plan.clearance(place).0 {
            0.0 if joint.angle.is_none() => String::new(),
            gap => format!(", gap {gap} m"),
        };
        line!(text, "stop {side}{gap}, law {}", law.name());
    }
}

//! What `whirl check` says of a point mass.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_text::rounded;

use crate::case::{Lumped, Side, Unbalance};

/// The mass, how it begins, and its stops.
pub(super) fn say(text: &mut String, lumped: &Lumped) {
    let Lumped { mass, stiffness, damping, displacement, velocity, force, .. } = lumped;
    line!(
        text,
        "\nmass {mass} kg, stiffness {stiffness} N/m, damping {damping} N s/m, force {force} N"
    );
    if *stiffness > 0.0 {
        line!(text, "natural frequency {} Hz", rounded((stiffness / mass).sqrt() / TAU, 6));
    }
    line!(text, "initial displacement {displacement} m, initial velocity {velocity} m/s");
    if let Some(Unbalance { eccentricity, speed }) = lumped.unbalance {
        line!(
            text,
            "unbalance: eccentricity {} mm, turning at {} rpm",
            rounded(1e3 * eccentricity, 10),
            rounded(60.0 * speed / TAU, 10)
        );
    }
    for stop in &lumped.stops {
        let side = format!("{:?}", stop.side).to_lowercase();
        // A law of a ring that does not say which of its parameters is the gap has it in itself.
        let gap = match stop.side {
            Side::Around if stop.gap == 0.0 => String::new(),
            _ => format!(", gap {} m", stop.gap),
        };
        line!(text, "stop {side}{gap}, law {}", stop.law.name());
    }
}

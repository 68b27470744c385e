//! What is said of bodies that turn and are not round.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_solver::Error;
use whirl_text::rounded;

use crate::case::{Case, NamedBody};
use crate::errors::Failure;
use crate::machine::Built;

/// Says it of each, with what moves at twice its speed.
///
/// # Errors
/// A mass that is not positive definite.
pub(super) fn say(text: &mut String, case: &Case, built: &Built) -> Result<(), Failure> {
    for (place, body) in built.machine.bodies.iter().enumerate() {
        let turns = case.machine.bodies.get(place).is_some_and(NamedBody::turns);
        let Some(shaft) = body.shaft().filter(|_| turns) else { continue };
        let speed = case.machine.top_speed(place, case.run());
        let found = shaft.roundness().map_err(Error::from)?;
        if found.is_round_at(speed) {
            continue;
        }
        let reason = found.lack();
        let hertz = speed.abs() * 2.0 / TAU;
        let at = if hertz > 0.0 {
            format!(", {} Hz at its top speed", rounded(hertz, 5))
        } else {
            String::new()
        };
        line!(
            text,
            "{} is not round: {reason}. Under loads fixed in space, such as its weight, it vibrates at twice its \
             speed{at}; a start in equilibrium leaves that motion out",
            body.name()
        );
    }
    Ok(())
}

//! What is said of how round bodies are that turn.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_solver::Error;
use whirl_text::rounded;

use crate::case::{Case, NamedBody};
use crate::errors::Failure;
use crate::machine::Built;

/// Share by which a body is off its mean over turns that is rounding.
const EXACT: f64 = 1e-9;

/// Says of each that is not round what moves at twice its speed, of the others what their mean over turns leaves out.
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
            let shares = found.shares.iter().map(|(_, share)| *share);
            let off = shares.chain([found.splitting, found.rows]).fold(0.0, f64::max);
            if off > EXACT {
                let [pairs, most] = [found.splitting, off]
                    .map(|share| whirl_text::shown(100.0 * share, 2, 1e-4..1e2));
                line!(
                    text,
                    "{} is round: its pairs of modes differ by up to {pairs} %, its matrices from their means over a turn, \
                     which linear analyses take, by up to {most} %",
                    body.name()
                );
            }
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

//! What `whirl check` says of the natural frequencies of bodies.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_text::rounded;

use crate::case::{JoinedMachine, Run};
use crate::errors::Failure;
use crate::machine::Built;
use crate::report::table;

/// Frequencies of a body that are said.
const FIRST: usize = 5;

/// The lowest natural frequencies of every body that deforms, by itself: at rest and, if it turns, at its top speed with all
/// that it carries.
///
/// # Errors
/// Of linear algebra.
pub(super) fn say(
    text: &mut String,
    joined: &JoinedMachine,
    built: &Built,
    run: Run,
) -> Result<(), Failure> {
    let (mut rows, mut beyond) = (Vec::new(), Vec::new());
    let facts = built.bodies.iter().flat_map(|facts| &facts.bodies);
    for body in facts.filter(|body| !body.hertz.is_empty()) {
        let place = joined.bodies.iter().position(|own| own.name.text() == body.name);
        let turning = place.and_then(|place| Some((place, built.machine.bodies[place].shaft()?)));
        let Some((place, shaft)) = turning else {
            rows.push(row(body.name.clone(), &body.hertz));
            continue;
        };
        let at = |speed: f64| shaft.frequencies_at(speed).map_err(whirl_solver::Error::from);
        rows.push(row(format!("{}, at rest", body.name), &at(0.0)?.unwrap_or_default()));
        let speed = joined.top_speed(place, run);
        if speed > 0.0 {
            let of = format!("{}, at {} rpm", body.name, rpm(speed));
            match at(speed)? {
                Some(found) => rows.push(row(format!("{of}, rotating frame"), &found)),
                None => beyond.push(format!("{of}: above a critical speed of the body held so")),
            }
        }
    }
    if rows.is_empty() {
        return Ok(());
    }
    line!(
        text,
        "\nNatural frequencies of each body with its joints, loads and restraints held (Hz); assembled: `whirl modes`"
    );
    text.push_str(&table(&rows));
    beyond.iter().for_each(|own| line!(text, "{own}"));
    Ok(())
}

fn row(name: String, hertz: &[f64]) -> Vec<String> {
    let first = hertz.iter().take(FIRST).map(|own| format!("{own:.2}"));
    let more = (hertz.len() > FIRST).then(|| "…".to_owned());
    std::iter::once(name).chain(first).chain(more).collect()
}

/// A speed (rad/s) in rpm.
pub(super) fn rpm(speed: f64) -> f64 {
    rounded(speed * 60.0 / TAU, 10)
}

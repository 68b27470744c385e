//! What is said of bodies that turn and are not round.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_solver::Error;
use whirl_solver::machine::Rotation;
use whirl_solver::roundness::{ASYMMETRY, Roundness};
use whirl_text::rounded;

use crate::case::{Case, System};
use crate::errors::Failure;
use crate::machine::Built;

/// Says it of each, with what moves at twice its speed.
///
/// # Errors
/// A mass that is not positive definite.
pub(super) fn say(text: &mut String, case: &Case, built: &Built) -> Result<(), Failure> {
    for (place, body) in built.machine.bodies.iter().enumerate() {
        let turns = !matches!(body.rotation(), Some(Rotation::Held | Rotation::Spinning { .. }));
        let Some(shaft) = body.shaft().filter(|_| turns) else { continue };
        let speed = match &case.system {
            System::Joined(joined) => joined.top_speed(place, case.run()),
            System::Lumped(_) => continue,
        };
        let found = shaft.roundness().map_err(Error::from)?;
        if found.is_round_at(speed) {
            continue;
        }
        let reason = reason(&found);
        let hertz = speed.abs() * 2.0 / TAU;
        let at = if hertz > 0.0 {
            format!(", {} Hz at its top speed", rounded(hertz, 5))
        } else {
            String::new()
        };
        line!(
            text,
            "{} is not round: {reason}. Under loads fixed in space, such as its weight, its deflection moves at twice its \
             speed{at}; a start in equilibrium leaves that motion out",
            body.name()
        );
    }
    Ok(())
}

/// Why a body does not count as round.
fn reason(found: &Roundness) -> String {
    let percent = |share: f64| format!("{} %", rounded(100.0 * share, 3));
    if !found.has_pairs() {
        return "nothing on its axis shows its motion along x and y alike".to_owned();
    }
    if found.splitting >= ASYMMETRY {
        let modes = if found.split > 0.0 {
            format!("a pair of modes at {} Hz", rounded(found.split, 5))
        } else {
            "its rigid motions".to_owned()
        };
        return format!("{modes} along x and y differ by {}", percent(found.splitting));
    }
    if let Some(alone) = found.alone {
        let hertz = rounded(alone, 5);
        return format!("its mode at {hertz} Hz, retained motions held, has no partner across");
    }
    let worst = found
        .shares
        .iter()
        .fold(("rows", found.rows), |worst, own| if own.1 > worst.1 { *own } else { worst });
    format!("its {} is off that of a round body by {}", worst.0, percent(worst.1))
}

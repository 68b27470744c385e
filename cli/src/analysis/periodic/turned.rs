//! A case at a speed: what turns in it as the analysis has it, and no longer as its march.

use whirl_solver::bodies::Rotation;

use crate::case::{Analysis, Case};
use crate::errors::Failure;

/// The body whose speeds are given.
///
/// # Errors
/// There are speeds, and no body turns.
pub(super) fn of(case: &Case, analysis: &Analysis) -> Result<Option<usize>, Failure> {
    let bodies = &case.machine.bodies;
    let top = |body: &usize| case.machine.top_speed(*body, case.run());
    let fastest = (0..bodies.len()).filter(|body| bodies[*body].turns()).max_by(|a, b| {
        let is_given = |body: usize| !bodies[body].is_free();
        let both = top(a).total_cmp(&top(b)).then(is_given(*a).cmp(&is_given(*b)));
        both.then(b.cmp(a))
    });
    let of = analysis.of.or(fastest);
    if of.is_none() && !analysis.speeds.is_empty() {
        return Err(Failure::Argument {
            message: format!(
                "`{}` is over speeds, and no body of `{}` turns",
                analysis.name, case.name
            ),
            help: "leave out `speeds`: the cycle is that of the loads, or of the unbalance of the mass"
                .to_owned(),
        });
    }
    Ok(of)
}

/// The case with a body at a speed (rad/s), and others in proportion.
pub(super) fn at(case: &Case, analysis: &Analysis, speed: Option<(usize, f64)>) -> Case {
    let mut own = case.clone();
    own.fields = None;
    let Some((of, speed)) = speed else { return own };
    let known = |body: usize| case.machine.constant_speed(body, case.run());
    let of_case = known(of).filter(|own| *own != 0.0);
    for (place, body) in own.machine.bodies.iter_mut().enumerate().filter(|own| own.1.turns()) {
        let ratio = analysis.ratios.get(place).copied().flatten();
        let turns = match (ratio, known(place), of_case) {
            _ if place == of => Some(speed),
            (Some(ratio), ..) => Some(ratio * speed),
            (None, Some(other), Some(of_case)) => Some(other / of_case * speed),
            (None, other, _) => other,
        };
        if let Some(speed) = turns {
            body.rotation = Some(Rotation::Prescribed { speed, acceleration: 0.0 });
            (body.initial_speed, body.speeds) = (None, None);
        }
    }
    own
}

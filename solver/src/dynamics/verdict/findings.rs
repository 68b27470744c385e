//! What the program itself believes of a run.

use super::energy::EnergyBalance;
use super::film_findings::of_films;
use super::finding::{Finding, beyond, mended, shorter};
use super::periods::{FewestSteps, LEAST_STEPS};
use super::quality::Quality;
use super::rings::{RINGING, Ringing, RingingPart};
use super::state_errors::StateError;
use crate::dynamics::iteration::{HalvedAt, HalvedSteps};
use crate::dynamics::lengths::AutomaticStep;
use crate::dynamics::motion::MovingPart;

/// Energy made by steps, as a fraction of what flowed. A linear contact of frequency ω makes (ωΔt)²/6 of the energy that it takes,
/// on average over where in a step it begins and ends, so that its peaks are off by half of that: by (ωΔt)²/12, which is 1 % at
/// this limit, as for [`LOCAL_ERROR`]. It lasts nine steps then.
const ENERGY_MADE: f64 = 0.02;
/// Local error of a step as a fraction of the largest displacement of the body. In motion at ω it is (ωΔt)³/12, and the period
/// is wrong by (ωΔt)²/12: 1 % at this limit.
const LOCAL_ERROR: f64 = 3.5e-3;
/// Motion in a step in modes with ωΔt ≥ 1, as a fraction of the largest displacement of the body. A mode that rings with the
/// fraction s of it moves by 0.9 s and more a step; one that follows a load of 23 steps a period by 0.27 s at most.
const UNRESOLVED_MOTION: f64 = 0.3;
/// False inertia forces of bodies that turn, as a fraction of their largest force. In motion at ω of a body that does not
/// turn they are (ωΔt)²/6 of it: 2 % where the period is wrong by 1 %.
const INERTIA_ERROR: f64 = 0.02;
/// Error that steps add up to in a state of a law, as a fraction of its range. In motion at ω it is (ωΔt)²/12 of the amplitude, as
/// the period of motion.
const SUMMED_ERROR: f64 = 0.01;
/// A rate times the step in which a state that comes to rest by it is followed.
const FOLLOWED: f64 = 0.3;
/// What does not balance, as a fraction of the energy in play.
const ENERGY_ERROR: f64 = 0.05;

/// Steps that could not be solved whole, as a fraction of all: more than a contact here and there; and of few steps so many.
const HALVED_STEPS: f64 = 0.05;
const FEW_STEPS: f64 = 10.0;

/// What is beyond its limit in steps of `time_step` s, or in parts of them that the march chose; nothing where the run is
/// sound.
pub fn findings(
    quality: &Quality,
    energy: &EnergyBalance,
    (time_step, automatic): (f64, Option<AutomaticStep>),
) -> Vec<Finding> {
    // What the local error asks for: it grows with Δt³, and in motion that a step cannot follow less.
    let follow = |error: f64| {
        let factor = (LOCAL_ERROR / error).cbrt();
        time_step * if factor.is_nan() { 0.1 } else { factor.clamp(0.1, 0.5) }
    };
    // They fall with Δt².
    let slower = |error: f64| {
        let factor = (INERTIA_ERROR / error).sqrt();
        time_step * if factor.is_nan() { 0.1 } else { factor.clamp(0.1, 0.7) }
    };
    let made = quality.resolving_step.map_or(0.1 * time_step, |step| step.min(0.5 * time_step));
    let resolved = quality.mode_step.map_or(0.1 * time_step, |step| step.min(0.5 * time_step));
    let measured = [
        (
            "energy created or lost by the steps, as a fraction of what flowed",
            (quality.bearing, None),
            quality.energy_made_share,
            ENERGY_MADE,
            made,
        ),
        (
            "local error that one step in twenty exceeds, as a fraction of the largest displacement",
            (None, quality.local_error_of),
            quality.local_error,
            LOCAL_ERROR,
            follow(quality.local_error),
        ),
        (
            "motion in one step, in modes faster than the step, that one step in twenty exceeds, as a fraction of \
             the largest displacement",
            (None, quality.unresolved_motion_of),
            quality.unresolved_motion,
            UNRESOLVED_MOTION,
            resolved,
        ),
        (
            "false inertia forces of a body that turns, whose motion is constant or slow in space, that one step in \
             twenty exceeds, as a fraction of the largest force that holds it",
            (None, quality.inertia_error_of),
            quality.inertia_error,
            INERTIA_ERROR,
            slower(quality.inertia_error),
        ),
        (
            "error of the energy balance, as a fraction of the energy in play",
            (None, None),
            energy.error_fraction(),
            ENERGY_ERROR,
            0.5 * time_step,
        ),
    ];
    let found = measured.into_iter().filter(|(_, _, value, limit, _)| {
        // A measure that is no number is beyond every limit.
        !value.is_finite() || value > limit
    });
    type Measured = (&'static str, (Option<usize>, Option<MovingPart>), f64, f64, f64);
    let finding = |(what, (bearing, part), value, limit, step): Measured| {
        let own = beyond(what, (value, limit, "1"), mended(step, automatic));
        Finding { bearing, part, ..own }
    };
    let unjudged = (!quality.judged).then(|| {
        let what =
            "parts of the machine that move in modes which steps resolve, so that a local error can be judged";
        beyond(what, (0.0, 1.0, "parts"), mended(resolved, automatic))
    });
    let too_far = runaway(quality).into_iter();
    let often = halved(quality, (time_step, automatic)).into_iter();
    let too_fast = outrun(quality, time_step, automatic.is_some());
    let rings = rings(quality, time_step, automatic);
    let forgets = quality.states.and_then(|own| missed(&own, time_step, automatic));
    let of_films = quality.films.map(|own| of_films(&own, (time_step, automatic)));
    let of_steps =
        found.map(finding).chain(unjudged).chain(forgets).chain(of_films.into_iter().flatten());
    too_far.chain(too_fast).chain(of_steps).chain(rings).chain(often).collect()
}

/// Whether something changes its sign from step to step.
fn rings(quality: &Quality, time_step: f64, automatic: Option<AutomaticStep>) -> Option<Finding> {
    let ringing: &Ringing = &quality.ringing;
    let value = ringing.share;
    // What the velocities of a rigid body ring by moves it little while it follows a load; that is judged by itself.
    let limit = match ringing.of {
        Some(RingingPart::Velocity(_)) => UNRESOLVED_MOTION,
        _ => RINGING,
    };
    if value <= limit {
        return None;
    }
    let body = |body: usize, turns: bool| (None, Some(MovingPart { body, turns }));
    let (called, (bearing, part)) = match ringing.of {
        Some(RingingPart::Force(bearing)) => ("a force", (Some(bearing), None)),
        Some(RingingPart::Moment(bearing)) => ("a moment", (Some(bearing), None)),
        Some(RingingPart::Couple(own)) => ("the couple of loads and drives", body(own, true)),
        Some(RingingPart::Speed(own)) => ("the speed", body(own, true)),
        Some(RingingPart::Velocity(own)) => ("the velocities", body(own, false)),
        None => ("a quantity", (None, None)),
    };
    let shorter = mended(0.1 * time_step, automatic);
    let what = format!(
        "part of {called} that alternates from step to step, for forty steps or more, as a fraction of its range"
    );
    let remedy = match (ringing.damped, quality.films) {
        (true, _) => format!("set a smaller `spectral_radius` in [march], or {shorter}"),
        (false, Some(_)) => {
            format!("begin in equilibrium, let loads rise over some steps, or {shorter}")
        }
        (false, None) => format!(
            "set `integrator = \"generalized-alpha\"` in [march], which damps motion far faster than the step, \
             or {shorter}"
        ),
    };
    Some(Finding { bearing, part, ..beyond(what, (value, limit, "1"), remedy) })
}

/// Whether steps miss what the states of laws do.
fn missed(
    states: &StateError,
    time_step: f64,
    automatic: Option<AutomaticStep>,
) -> Option<Finding> {
    let StateError { local, summed, fastest } = *states;
    let rate = whirl_text::shown(fastest, 3, 1e-3..1e7);
    let (what, (value, bearing), limit, factor) = if !(local.0 <= LOCAL_ERROR) {
        let what = format!(
            "local error of a state of a law that one step in twenty exceeds, as a fraction of its range; the fastest \
             comes to rest by itself at {rate} 1/s"
        );
        (what, local, LOCAL_ERROR, (LOCAL_ERROR / local.0).cbrt())
    } else if !(summed.0 <= SUMMED_ERROR) {
        let what = "error of a state of a law that steps add up to, as a fraction of its range; most of it where its rate \
                    changes within a few steps";
        (what.to_owned(), summed, SUMMED_ERROR, (SUMMED_ERROR / summed.0).sqrt())
    } else {
        return None;
    };
    let factor = if factor.is_nan() { 0.1 } else { factor.clamp(0.1, 0.5) };
    let by_rate = if fastest > 0.0 { FOLLOWED / fastest } else { f64::INFINITY };
    let step = (factor * time_step).min(by_rate.max(0.1 * time_step));
    // What comes to rest within half a step alternates in it.
    let alternates = fastest * time_step > 2.0;
    let shorter = mended(step, automatic);
    let remedy = match alternates {
        true => format!(
            "set `integrator = \"generalized-alpha\"` in [march], which damps what is far faster than the step, or {shorter}"
        ),
        false => shorter,
    };
    Some(Finding { bearing: Some(bearing), ..beyond(what, (value, limit, "1"), remedy) })
}

/// Whether steps had to be halved again and again to be solved.
fn halved(
    quality: &Quality,
    (time_step, automatic): (f64, Option<AutomaticStep>),
) -> Option<Finding> {
    let HalvedSteps { steps, of, halvings, at } = quality.halved;
    let limit = (HALVED_STEPS * of as f64).max(FEW_STEPS).floor();
    let often = steps as f64 > limit;
    let [bearing, coordinate] = match at {
        Some(HalvedAt::Bearing(bearing)) => [Some(bearing), None],
        Some(HalvedAt::Coordinate(place)) => [None, Some(place)],
        None => [None; 2],
    };
    let cause = match at {
        Some(HalvedAt::Bearing(_)) => "forces that do not settle",
        _ => "an equation that remains unsolved",
    };
    let jumps = "look for a law, or a table of a load, that jumps or is very steep there";
    often.then(|| {
        let what = format!(
            "steps that could not be solved whole, halved {halvings} times in all, most often for {cause}"
        );
        let remedy = match automatic {
            Some(_) => jumps.to_owned(),
            None => format!("{jumps}; or {}", shorter(0.1 * time_step)),
        };
        Finding { bearing, coordinate, ..beyond(what, (steps as f64, limit, "steps"), remedy) }
    })
}

/// Whether a body left the machine.
fn runaway(quality: &Quality) -> Option<Finding> {
    let (value, limit) = (quality.largest_displacement, quality.sensible_displacement);
    let too_far = value.is_nan() || value > limit;
    let remedy = "look for a stiffness or damping that is negative or missing at this body, and for a load that nothing carries";
    too_far.then(|| Finding {
        part: quality.farthest.map(|body| MovingPart { body, turns: false }),
        ..beyond("displacement larger than the machine", (value, limit, "m"), remedy.to_owned())
    })
}

/// Whether a load that follows an angle had too few steps in its period.
fn outrun(quality: &Quality, time_step: f64, automatic: bool) -> Option<Finding> {
    let FewestSteps { steps, body, speed } = quality.fewest_steps?;
    // What a case is held to may be missed by rounding.
    let too_few = steps < LEAST_STEPS * (1.0 - 1e-6);
    too_few.then(|| {
        let rpm = whirl_text::shown(speed.abs() * 60.0 / std::f64::consts::TAU, 4, 1e-3..1e7);
        let what =
            format!("fewest steps in a period of a load that follows the angle, at {rpm} rpm");
        let remedy = match automatic {
            true => "set a shorter `output_step` in [march]".to_owned(),
            false => shorter(time_step * steps / LEAST_STEPS),
        };
        let own = beyond(what, (steps, LEAST_STEPS, "steps"), remedy);
        Finding { part: Some(MovingPart { body, turns: true }), ..own }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOUND: Quality = Quality {
        energy_made_share: ENERGY_MADE,
        bearing: Some(1),
        energy_made: ENERGY_MADE,
        energy_flowed: 1.0,
        local_error: LOCAL_ERROR,
        local_error_of: Some(MovingPart { body: 2, turns: true }),
        largest_local_error: 1.0,
        unresolved_motion: UNRESOLVED_MOTION,
        unresolved_motion_of: Some(MovingPart { body: 1, turns: false }),
        inertia_error: INERTIA_ERROR,
        inertia_error_of: Some(MovingPart { body: 0, turns: false }),
        largest_displacement: 1.5,
        farthest: Some(1),
        sensible_displacement: 1.5,
        ringing: Ringing { share: RINGING, of: Some(RingingPart::Force(0)), damped: false },
        states: None,
        films: None,
        row_error: 1.0,
        judged: true,
        halved: HalvedSteps { steps: 50, of: 1000, halvings: 99, at: None },
        resolving_step: Some(1e-9),
        mode_step: Some(1e-9),
        fewest_steps: Some(FewestSteps { steps: LEAST_STEPS, body: 0, speed: 1.0 }),
    };

    /// Out of balance by a fraction of 100 J.
    fn balance(fraction: f64) -> EnergyBalance {
        EnergyBalance { work_in: 100.0 * fraction, in_play: 100.0, ..EnergyBalance::default() }
    }

    fn found(quality: Quality) -> Finding {
        let mut found = findings(&quality, &balance(0.0), (2.36e-3, None));
        assert_eq!(found.len(), 1, "{found:?}");
        found.remove(0)
    }

    fn set(step: &str) -> String {
        format!("set `time_step = \"{step} s\"` in [march], and as many more steps")
    }

    #[test]
    fn what_is_at_its_limit_is_sound() {
        assert_eq!(findings(&SOUND, &balance(ENERGY_ERROR), (1e-3, None)), []);
        let nothing = Quality { judged: true, ..Quality::default() };
        assert_eq!(findings(&nothing, &EnergyBalance::default(), (1e-3, None)), []);
    }

    #[test]
    fn the_step_of_a_remedy_has_two_digits_and_is_not_longer_than_half() {
        // That which resolves the springs, or the modes; half of the step where it is longer; a tenth where it is
        // unknown.
        for (step, set_to) in [(Some(1.27e-4), "1.2e-4"), (Some(2e-3), "1.1e-3"), (None, "2.3e-4")]
        {
            let made = Quality { energy_made_share: 0.2, resolving_step: step, ..SOUND };
            let made = found(made);
            assert_eq!((made.remedy, made.bearing), (set(set_to), Some(1)));
            let moved = Quality { unresolved_motion: 0.31, mode_step: step, ..SOUND };
            assert_eq!(found(moved).remedy, set(set_to));
        }
        // The third root of the error; from a tenth to half of the step.
        for (times, step) in [(27.0, "7.8e-4"), (1.01, "1.1e-3"), (1e9, "2.3e-4")] {
            let local_error = times * LOCAL_ERROR;
            assert_eq!(found(Quality { local_error, ..SOUND }).remedy, set(step));
        }
        let unbalanced = findings(&SOUND, &balance(-0.051), (2.36e-3, None));
        assert_eq!((unbalanced.len(), &unbalanced[0].remedy), (1, &set("1.1e-3")));
    }

    #[test]
    fn steps_that_nothing_judges_are_not_sound() {
        let found = found(Quality { judged: false, local_error: 0.0, ..SOUND });
        assert_eq!((found.value, found.limit, found.unit.as_str()), (0.0, 1.0, "parts"));
        // That which resolves all modes.
        assert!(found.remedy.contains("time_step = \"1.0e-9 s\""), "{}", found.remedy);
    }

    #[test]
    fn what_rings_is_named_with_its_cure() {
        let rings = |of, damped| {
            let ringing = Ringing { share: 0.3, of: Some(of), damped };
            found(Quality { ringing, ..SOUND })
        };
        let force = rings(RingingPart::Force(2), false);
        assert_eq!((force.bearing, force.part, force.limit), (Some(2), None, RINGING));
        assert!(force.remedy.contains("`integrator = \"generalized-alpha\"`"), "{}", force.remedy);
        let speed = rings(RingingPart::Speed(1), true);
        assert_eq!(speed.part, Some(MovingPart { body: 1, turns: true }));
        assert!(speed.remedy.contains("`spectral_radius`"), "{}", speed.remedy);
        let ringing = Ringing { share: f64::NAN, ..Ringing::default() };
        assert!(found(Quality { ringing, ..SOUND }).value.is_nan());
    }

    #[test]
    fn a_body_that_leaves_the_machine_is_not_sound() {
        let found = found(Quality { largest_displacement: 1.6, ..SOUND });
        assert_eq!(found.part, Some(MovingPart { body: 1, turns: false }));
        assert_eq!((found.value, found.limit, found.unit.as_str()), (1.6, 1.5, "m"));
        assert!(found.remedy.contains("negative or missing"), "{}", found.remedy);
    }

    #[test]
    fn a_load_that_outruns_the_steps_is_not_sound() {
        let fewest = FewestSteps { steps: 9.2, body: 1, speed: std::f64::consts::TAU };
        let found = found(Quality { fewest_steps: Some(fewest), ..SOUND });
        assert_eq!(found.part, Some(MovingPart { body: 1, turns: true }));
        assert_eq!((found.value, found.limit, found.unit.as_str()), (9.2, 23.0, "steps"));
        assert!(found.what.ends_with("at 60 rpm"), "{}", found.what);
        // 2.36e-3 s · 9.2/23.
        assert_eq!(found.remedy, set("9.4e-4"));
    }

    #[test]
    fn steps_that_are_halved_again_and_again_are_a_finding_with_their_place() {
        let times = |steps, of, at| Quality {
            halved: HalvedSteps { steps, of, halvings: 777, at },
            ..SOUND
        };
        // One in twenty, and ten of few.
        for (most, of) in [(50, 1000), (10, 11)] {
            assert_eq!(findings(&times(most, of, None), &balance(0.0), (1e-3, None)), []);
            let row = found(times(most + 1, of, Some(HalvedAt::Coordinate(3))));
            assert_eq!((row.coordinate, row.bearing), (Some(3), None));
            assert_eq!((row.value, row.limit), ((most + 1) as f64, most as f64));
            assert!(row.what.contains("halved 777 times") && row.what.contains("an equation"));
            assert!(row.remedy.contains("time_step = \"2.3e-4 s\""), "{}", row.remedy);
        }
        let joint = found(times(51, 1000, Some(HalvedAt::Bearing(1))));
        assert_eq!((joint.coordinate, joint.bearing), (None, Some(1)));
        assert!(joint.what.contains("forces that do not settle"), "{}", joint.what);
    }

    #[test]
    fn chosen_steps_are_mended_by_their_tolerance() {
        let automatic = Some(AutomaticStep { tolerance: 2e-3, longest: 1.0 });
        let found = findings(&SOUND, &balance(0.06), (1e-3, automatic));
        assert_eq!(found[0].remedy, "set `step_tolerance = 2.0e-4` or less in [march]");
    }

    #[test]
    fn what_is_no_number_is_not_sound() {
        let bad = f64::NAN;
        let quality =
            Quality { energy_made_share: bad, local_error: bad, unresolved_motion: bad, ..SOUND };
        let found = findings(&quality, &balance(bad), (1e-3, None));
        assert_eq!(found.len(), 4);
        assert!(found.iter().all(|own| own.value.is_nan() && !own.remedy.contains("NaN")));
    }
}

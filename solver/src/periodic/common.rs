//! What repeats in a machine, and after which time all of it has.

use std::f64::consts::TAU;

use crate::bodies::Rotation;
use crate::dynamics::settled_from;
use crate::error::{Error, PeriodicError};
use crate::loads::{Load, TimeFunction};
use crate::machine::Machine;

/// Periods of the slowest in a common one at most.
const MOST: usize = 64;
/// Part of a period by which others may miss the end of a common one.
const MISSED: f64 = 1e-9;

/// Distance of a centre of mass from the axis that is rounding (m).
const BALANCED: f64 = 1e-12;

/// What the motion of the ground is called.
pub const GROUND_MOTION: &str = "the motion of the ground";

/// Something that repeats.
#[derive(Debug, Clone, PartialEq)]
pub struct Repeating {
    /// How often (Hz).
    pub hertz: f64,
    /// What it is, in words.
    pub what: String,
}

/// Everything that repeats in a machine: rotations and loads.
///
/// # Errors
/// A load or a speed that changes without repeating; a speed that is not known.
pub fn repeating(machine: &Machine) -> Result<Vec<Repeating>, Error> {
    let mut all: Vec<Repeating> = Vec::new();
    let mut add = |hertz: f64, what: String| {
        let is_new = all.iter().all(|own| (own.hertz - hertz).abs() > MISSED * hertz);
        if hertz > 0.0 && is_new {
            all.push(Repeating { hertz, what });
        }
    };
    for load in &machine.loads {
        let not_repeated = || PeriodicError::OneOff { load: called(load).to_owned() };
        match &load.time_function {
            TimeFunction::Sine { frequency, .. } => add(frequency.abs(), load.name.clone()),
            TimeFunction::OverTime(curve) => {
                let period = curve.period().ok_or_else(not_repeated)?;
                add(1.0 / period, load.name.clone());
            }
            _ => {}
        }
    }
    let speeds = speeds(machine)?;
    for (body, speed) in machine.bodies.iter().zip(&speeds) {
        add(speed.abs() / TAU, format!("the rotation of {}", body.name()));
    }
    for load in &machine.loads {
        if let Some((body, rate)) = load.time_function.periods() {
            add(rate * speeds[body].abs() / TAU, load.name.clone());
        }
    }
    Ok(all)
}

/// What a load is called. Of those that no table of loads describes only the motion of the ground varies.
fn called(load: &Load) -> &str {
    if load.name.is_empty() { GROUND_MOTION } else { &load.name }
}

/// What of all that a machine is told changes in space though speeds are constant, in words: a load that varies or turns, an unbalance,
/// a body that is not round.
///
/// # Errors
/// As [`repeating`]; a mass that is not positive definite.
pub(super) fn driven(machine: &Machine) -> Result<Option<String>, Error> {
    let varies = |load: &Load| match &load.time_function {
        TimeFunction::Constant => load.turns_with_its_body(),
        _ => true,
    };
    let load =
        machine.loads.iter().find(|load| load.action.amplitude() != [0.0; 3] && varies(load));
    if let Some(load) = load {
        return Ok(Some(called(load).to_owned()));
    }
    let speeds = speeds(machine)?;
    for (number, (body, speed)) in machine.bodies.iter().zip(speeds).enumerate() {
        let turns = speed != 0.0 && !machine.spins(number);
        let Some(shaft) = body.shaft().filter(|_| turns) else { continue };
        let roundness = shaft.roundness()?;
        if !roundness.is_round_at(0.0) {
            return Ok(Some(format!("{}, which is not round,", body.name())));
        }
        let once = roundness.generator.apply_transpose(&shaft.y0);
        let out = roundness.generator.apply_transpose(&once);
        let size = out.iter().map(|own| own * own).sum::<f64>().sqrt();
        if size > BALANCED * shaft.centre_of_mass.mass.max(shaft.y0.len() as f64 * f64::EPSILON) {
            return Ok(Some(format!("the unbalance of {}", body.name())));
        }
    }
    if machine.springs.have_run_out() {
        return Ok(Some("a run-out".to_owned()));
    }
    Ok(None)
}

/// Speeds of the bodies in a cycle (rad/s); 0 of those that stand.
///
/// # Errors
/// A speed that changes for ever, or is not known.
pub(super) fn speeds(machine: &Machine) -> Result<Vec<f64>, Error> {
    let settled = settled_from(machine);
    let told = |body: usize| -> Result<Option<f64>, PeriodicError> {
        let name = || machine.bodies[body].name().to_owned();
        match machine.bodies[body].rotation() {
            None => Ok(Some(0.0)),
            Some(Rotation::Prescribed { acceleration, .. }) if *acceleration != 0.0 => {
                Err(PeriodicError::SpeedChanges { body: name() })
            }
            Some(rotation) => {
                let given = rotation.given(settled, false).map(|own| own[1]);
                Ok(rotation.spin().or(given))
            }
        }
    };
    let bodies = 0..machine.bodies.len();
    let told: Vec<Option<f64>> = bodies.clone().map(told).collect::<Result<_, _>>()?;
    let trains = machine.trains();
    let speeds = bodies.clone().map(|body| {
        let tied = || {
            let turns = |other: &usize| machine.bodies[*other].rotation().is_some();
            let mut others =
                bodies.clone().filter(turns).filter(|own| trains.train(*own) == trains.train(body));
            others.find_map(|own| Some(told[own]? * trains.ratio(body) / trains.ratio(own)))
        };
        let name = || machine.bodies[body].name().to_owned();
        told[body].or_else(tied).ok_or_else(|| PeriodicError::TurnsFreely { body: name() })
    });
    Ok(speeds.collect::<Result<_, _>>()?)
}

/// The shortest time (s) that is whole periods of all.
///
/// # Errors
/// Nothing repeats, or there is none of up to 64 periods of the slowest.
pub fn common_period(all: &[Repeating]) -> Result<f64, PeriodicError> {
    let slowest = all.iter().map(|own| own.hertz).reduce(f64::min);
    let Some(slowest) = slowest else { return Err(PeriodicError::NothingRepeats) };
    let missed = |hertz: f64, time: f64| (hertz * time - (hertz * time).round()).abs();
    let fits = |time: &f64| {
        all.iter().all(|own| missed(own.hertz, *time) <= MISSED * (own.hertz * time).max(1.0))
    };
    if let Some(time) = (1..=MOST).map(|k| k as f64 / slowest).find(fits) {
        return Ok(time);
    }
    let first = all.iter().find(|own| own.hertz == slowest).expect("it is one of them");
    let is_apart = |own: &&Repeating| {
        let times = (1..=MOST).map(|k| k as f64 / slowest);
        times.into_iter().all(|time| missed(own.hertz, time) > MISSED * (own.hertz * time).max(1.0))
    };
    // Each may fit the slowest, and all together no time that is short enough.
    let other = all.iter().find(is_apart).or_else(|| all.iter().find(|own| *own != first));
    let other = other.unwrap_or(first);
    let ratio = other.hertz / slowest;
    Err(PeriodicError::NoCommon {
        all: [first.what.clone(), other.what.clone()],
        hertz: [slowest, other.hertz],
        nearest: nearest(ratio),
    })
}

/// The quotient of whole numbers nearest to one, with a divisor of up to 16.
fn nearest(ratio: f64) -> [f64; 2] {
    let all = (1..=16).map(|below| {
        let below = f64::from(below);
        [(ratio * below).round(), below]
    });
    let apart = |own: &[f64; 2]| (own[0] / own[1] - ratio).abs() * (1.0 + 1e-12 * own[1]);
    all.reduce(|best, own| if apart(&own) < apart(&best) { own } else { best })
        .unwrap_or([ratio, 1.0])
}

/// When a cycle of such a period begins (s), by which all that begins has begun.
pub fn start(machine: &Machine, period: f64) -> f64 {
    let settled = settled_from(machine);
    period * (settled / period - MISSED).ceil().max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(all: &[f64]) -> Vec<Repeating> {
        all.iter().map(|hertz| Repeating { hertz: *hertz, what: format!("{hertz}") }).collect()
    }

    #[test]
    fn a_common_period_has_whole_periods_of_all() {
        let period = |all: &[f64]| common_period(&of(all));
        assert!((period(&[37.5, 75.0]).unwrap() * 37.5 - 1.0).abs() < 1e-12);
        assert!((period(&[60.0, 75.0, 100.0]).unwrap() * 5.0 - 1.0).abs() < 1e-12);
        assert_eq!(period(&[]), Err(PeriodicError::NothingRepeats));
        // What is rounded to five digits does not close.
        let error = period(&[50.0, 16.667]).unwrap_err();
        let PeriodicError::NoCommon { hertz, nearest, .. } = error else { panic!("{error}") };
        assert_eq!((hertz, nearest), ([16.667, 50.0], [3.0, 1.0]));
        assert!(matches!(
            period(&[50.0, 50.0 * 2_f64.sqrt()]),
            Err(PeriodicError::NoCommon { .. })
        ));
    }
}

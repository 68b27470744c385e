//! Loads as they count in a state that stands: those that go by an angle with their mean, ramps at their end.

use std::f64::consts::TAU;

use crate::bodies::Rotation;
use crate::loads::{Action, Load, Onset, TimeFunction};

/// Share by which two speeds may differ that are one.
const SAME: f64 = 1e-9;

/// How a load that varies counts in a state that stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Counted {
    /// With its value at t = 0, as it varies in time.
    AtStart,
    /// In full, as at the end of its ramp.
    InFull,
    /// Not at all, as it begins later (s).
    Later(f64),
    /// Not at all, as it is fixed in one body that turns and goes by the angle of another.
    OfTwoAngles,
    /// Not at all but for its mean, as it has this order, which is no multiple of half an order.
    BetweenOrders(f64),
}

/// How a load counts, if that is to be said.
pub(super) fn counted(load: &Load) -> Option<Counted> {
    match (load.onset, &load.time_function) {
        (Onset::Step(from), _) if from > 0.0 => Some(Counted::Later(from)),
        (Onset::Start, TimeFunction::OverTime(curve)) if curve.is_constant() => None,
        (_, TimeFunction::Sine { .. } | TimeFunction::OverTime(_)) => Some(Counted::AtStart),
        (Onset::Ramp(..), _) => Some(Counted::InFull),
        _ => None,
    }
}

/// Whether a load is fixed in one body that turns and goes by the angle of another: it has orders of neither.
pub(super) fn is_of_two_angles(load: &Load) -> bool {
    load.turns_with_its_body() && load.time_function.follows().is_some_and(|own| own != load.body)
}

/// Whether a load is a part of what turns with a body that spins in its frame: its unbalance.
pub(super) fn spins_with(load: &Load, rotation: Option<&Rotation>) -> bool {
    match (&load.time_function, rotation) {
        (TimeFunction::Sine { frequency, .. }, Some(Rotation::Spinning { speed })) => {
            load.name.starts_with("unbalance.")
                && (TAU * frequency.abs() - speed.abs()).abs() <= SAME * speed.abs()
        }
        _ => false,
    }
}

/// The same load without any force.
pub(super) fn nothing(load: &Load) -> Load {
    Load {
        action: scaled(&load.action, 0.0),
        time_function: TimeFunction::Constant,
        ..load.clone()
    }
}

/// A load that has its ramp behind it.
pub(super) fn begun(load: &Load) -> Load {
    let onset = match load.onset {
        Onset::Ramp(..) => Onset::Start,
        other => other,
    };
    Load { onset, ..load.clone() }
}

/// A load that stands, without what goes by the angle of a body: with its mean over turns.
pub(super) fn mean(load: &Load) -> Load {
    if load.turns_with_its_body() {
        return load.clone();
    }
    let factor = match &load.time_function {
        TimeFunction::Order { order, phase, .. } if *order == 0.0 => phase.sin(),
        TimeFunction::Order { .. } => 0.0,
        TimeFunction::OverAngle { curve, .. } => match curve.period() {
            Some(_) => curve.mean(),
            None => return load.clone(),
        },
        _ => return load.clone(),
    };
    Load {
        action: scaled(&load.action, factor),
        time_function: TimeFunction::Constant,
        ..load.clone()
    }
}

/// An action times a factor.
fn scaled(action: &Action, factor: f64) -> Action {
    let times = |own: [f64; 3]| own.map(|own| factor * own);
    match action.clone() {
        Action::Force { node, force } => Action::Force { node, force: times(force) },
        Action::Couple { turn, couple } => Action::Couple { turn, couple: times(couple) },
    }
}

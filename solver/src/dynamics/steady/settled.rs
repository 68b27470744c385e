//! From when on nothing changes that is told over time: before, a motion that repeats is no steady state.

use crate::loads::{Load, Onset, TimeFunction};
use crate::machine::{Body, Machine, Rotation};

/// The last time (s) at which a load begins, a ramp ends, or a table over time or a told rotation changes; infinite where a prescribed
/// speed never stops to change.
pub(crate) fn settled_from(machine: &Machine) -> f64 {
    let loads = machine.loads.iter().map(of_load);
    let rotations = machine.bodies.iter().filter_map(Body::rotation).map(of_rotation);
    loads.chain(rotations).fold(0.0, f64::max)
}

fn of_load(load: &Load) -> f64 {
    let begun = match load.onset {
        Onset::Start => 0.0,
        Onset::Step(time) | Onset::Ramp(_, time) => time,
    };
    match &load.time_function {
        TimeFunction::OverTime(curve) => begun.max(curve.last_change().unwrap_or(0.0)),
        _ => begun,
    }
}

fn of_rotation(rotation: &Rotation) -> f64 {
    match rotation {
        Rotation::Prescribed { acceleration, .. } if *acceleration != 0.0 => f64::INFINITY,
        Rotation::Scheduled(schedule) => schedule.last(),
        _ => 0.0,
    }
}

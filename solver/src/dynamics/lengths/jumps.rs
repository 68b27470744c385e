//! Where loads begin at once, and the accelerations of told rotations jump.

use crate::loads::Onset;
use crate::machine::{Body, Machine, Rotation};

/// Times (s), ascending, at which a load begins at once, or the acceleration of a told rotation jumps.
pub(in crate::dynamics) fn jumps(machine: &Machine) -> Vec<f64> {
    let mut jumps: Vec<f64> = Vec::new();
    jumps.extend(machine.loads.iter().filter_map(|load| match load.onset {
        Onset::Step(time) => Some(time),
        _ => None,
    }));
    for rotation in machine.bodies.iter().filter_map(Body::rotation) {
        if let Rotation::Scheduled(schedule) = rotation {
            jumps.extend(schedule.jumps());
        }
    }
    jumps.sort_by(f64::total_cmp);
    jumps.dedup();
    jumps
}

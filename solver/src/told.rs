//! What a march is told from outside while it is under way: amplitudes of loads, speeds of rotations. Both are lines over time
//! from an instant on, which hold until others are told.

use serde::{Deserialize, Serialize};

use crate::loads::Load;

/// The amplitude of a load over time, in place of its own.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct ToldLoad {
    /// From when on (s).
    pub(crate) since: f64,
    /// Along x, y, z at that time (N, N·m).
    pub(crate) value: [f64; 3],
    /// Its rate (N/s, N·m/s).
    pub(crate) rate: [f64; 3],
}

impl ToldLoad {
    /// The amplitude at time `t` (s).
    pub(crate) fn at(&self, t: f64) -> [f64; 3] {
        let along = |axis: usize| match self.rate[axis] {
            0.0 => self.value[axis],
            rate => self.value[axis] + rate * (t - self.since),
        };
        [along(0), along(1), along(2)]
    }
}

/// The amplitude of a load at time `t` (s): as it was told, if it was.
pub(crate) fn told_or_own(load: &Load, told: Option<&ToldLoad>, t: f64) -> [f64; 3] {
    told.map_or_else(|| load.action.amplitude(), |told| told.at(t))
}

/// A rotation over time, in place of that which its body is given.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct ToldTurn {
    /// From when on (s).
    pub(crate) since: f64,
    /// θ (rad) and θ̇ (rad/s) at that time.
    pub(crate) angle: f64,
    pub(crate) speed: f64,
    /// θ̈ (rad/s²).
    pub(crate) rate: f64,
}

impl ToldTurn {
    /// θ (rad), θ̇ (rad/s) and θ̈ (rad/s²) at time `t` (s).
    pub(crate) fn at(&self, t: f64) -> [f64; 3] {
        let passed = t - self.since;
        let angle = self.angle + (self.speed + 0.5 * self.rate * passed) * passed;
        [angle, self.speed + self.rate * passed, self.rate]
    }
}

//! What is carried of a part of the machine for the verdict.

use serde::{Deserialize, Serialize};

use super::histogram::Histogram;

/// What is carried of a part of the machine (m).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct PartSums {
    /// Whether the modes are no longer those in which it moves, and were not taken anew yet.
    pub(super) changed: bool,
    /// Whether it moves in modes that would not be judged, and should be.
    pub(super) unknown: bool,
    /// Of the steps of which it could be judged.
    pub(super) errors: Histogram,
    pub(super) largest_error: f64,
    /// Largest displacement that measures are fractions of, in modes on which something acts, and in all directions (m).
    pub(super) reach: f64,
    pub(super) displacement: f64,
    /// Motion in a step in modes that are not resolved.
    pub(super) motions: Histogram,
    /// The most kinetic energy, without rotations (J).
    pub(super) kinetic: f64,
}

impl PartSums {
    pub(super) fn new() -> Self {
        PartSums {
            changed: false,
            unknown: false,
            errors: Histogram::new(),
            largest_error: 0.0,
            reach: 0.0,
            displacement: 0.0,
            motions: Histogram::new(),
            kinetic: 0.0,
        }
    }
}

//! A part of a machine as steps are judged by it.

use serde::{Deserialize, Serialize};

/// A part of a machine whose steps are judged by themselves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct MovingPart {
    /// The body, by its place in the machine.
    pub body: usize,
    /// Whether it is the rotation of the body, not its deformation and motion.
    pub turns: bool,
}

/// A part whose largest displacement is a smaller fraction of that of any part is measured by that fraction: what hardly
/// moves is of no account.
pub(in crate::dynamics) const SMALLEST: f64 = 1e-3;

/// How long the steps of a march are (s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum StepLength {
    /// So long; parts of a step that was cut are judged as what the whole one resolves.
    Fixed(f64),
    /// So long at most: each is judged by its own length.
    Most(f64),
}

impl StepLength {
    pub(in crate::dynamics) fn most(self) -> f64 {
        match self {
            StepLength::Fixed(dt) | StepLength::Most(dt) => dt,
        }
    }

    /// That by which a step of `dt` s is judged.
    pub(in crate::dynamics) fn of(self, dt: f64) -> f64 {
        match self {
            StepLength::Fixed(all) => all,
            StepLength::Most(_) => dt,
        }
    }
}

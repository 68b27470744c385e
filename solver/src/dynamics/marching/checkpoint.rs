//! What a march needs to go on after it was interrupted.

use serde::{Deserialize, Serialize};

use crate::bearing::Worst;
use crate::dynamics::iteration::{Halvings, NewtonState};
use crate::dynamics::steady::SteadyTest;
use crate::dynamics::verdict::MeterSums;
use crate::equations::State;
use crate::told::{ToldLoad, ToldTurn};

/// From when a march counts its time: that at the end of its step n is time + (step + n) Δt, so that a march which goes on
/// with the same step has the times of one that was never cut, to the bit.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(in crate::dynamics) struct Clock {
    /// s.
    pub(in crate::dynamics) time: f64,
    /// Steps of Δt since then before the first of the march.
    pub(in crate::dynamics) step: usize,
}

/// What a march has counted and summed up; all of it is in its checkpoints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::dynamics) struct Tally {
    /// Steps done.
    pub(in crate::dynamics) step: usize,
    pub(super) iterations: usize,
    pub(super) halvings: Halvings,
    pub(super) steady: Option<SteadyTest>,
}

/// Everything that a march needs to go on after a step, but its machine and its options.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    pub(in crate::dynamics) state: State,
    /// Time at which the system was last evaluated (s): that of the state, rounded as its step had it.
    pub(in crate::dynamics) time: f64,
    pub(in crate::dynamics) clock: Clock,
    /// Which driving loads have stopped.
    pub(in crate::dynamics) released: Vec<bool>,
    /// Which loads have amplitudes that they were told.
    pub(in crate::dynamics) told: Vec<Option<ToldLoad>>,
    /// Rotations that were told, by their places in q.
    pub(super) turns: Vec<Option<ToldTurn>>,
    /// Where the factors that are kept were computed.
    pub(in crate::dynamics) newton: NewtonState,
    pub(in crate::dynamics) meters: MeterSums,
    /// Of the measures by which the laws may be believed.
    pub(super) worst: Vec<Option<Worst>>,
    pub(in crate::dynamics) tally: Tally,
}

impl Checkpoint {
    /// Steps done.
    pub fn step(&self) -> usize {
        self.tally.step
    }
}

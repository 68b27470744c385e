//! What a march needs to go on after it was interrupted.

use serde::{Deserialize, Serialize};

use super::halvings::Halvings;
use super::meters::MeterSums;
use super::newton::NewtonState;
use super::steady::SteadyTest;
use crate::bearing::Worst;
use crate::equations::State;
use crate::told::{ToldLoad, ToldTurn};

/// From when a march counts its time: that at the end of its step n is time + (step + n) Δt, so that a march which goes on
/// with the same step has the times of one that was never cut, to the bit.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Clock {
    /// s.
    pub(super) time: f64,
    /// Steps of Δt since then before the first of the march.
    pub(super) step: usize,
}

/// What a march has counted and summed up; all of it is in its checkpoints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Tally {
    /// Steps done.
    pub(super) step: usize,
    pub(super) iterations: usize,
    pub(super) halvings: Halvings,
    pub(super) steady: Option<SteadyTest>,
}

/// Everything that a march needs to go on after a step, but its machine and its options.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    pub(super) state: State,
    /// Time at which the system was last evaluated (s): that of the state, rounded as its step had it.
    pub(super) time: f64,
    pub(super) clock: Clock,
    /// Which driving loads have stopped.
    pub(super) released: Vec<bool>,
    /// Which loads have amplitudes that they were told.
    pub(super) told: Vec<Option<ToldLoad>>,
    /// Rotations that were told, by their places in q.
    pub(super) turns: Vec<Option<ToldTurn>>,
    /// Where the factors that are kept were computed.
    pub(super) newton: NewtonState,
    pub(super) meters: MeterSums,
    /// Of the measures by which the laws may be believed.
    pub(super) worst: Vec<Option<Worst>>,
    pub(super) tally: Tally,
}

impl Checkpoint {
    /// Steps done.
    pub fn step(&self) -> usize {
        self.tally.step
    }
}

//! What a march gave.

use crate::bearing::Worst;
use crate::dynamics::lengths::PartsTaken;
use crate::dynamics::steady::SteadyState;
use crate::dynamics::verdict::{EnergyBalance, Quality};
use crate::error::Error;
use crate::history::History;

/// Where a march is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Steps done.
    pub step: usize,
    /// Steps asked for.
    pub steps: usize,
    /// Time (s).
    pub time: f64,
    /// Newton iterations of the last step.
    pub iterations: usize,
}

/// What a march gave.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Outcome {
    /// One row a step where [`march`](crate::dynamics::march()) kept them; none of a [`March`](crate::dynamics::March), whose driver
    /// takes the rows.
    pub history: History,
    /// Where the work of the loads went.
    pub energy: EnergyBalance,
    /// What the steps were worth.
    pub quality: Quality,
    /// The worst value of every measure by which the laws may be believed, in the order of
    /// [`Springs::measures`](crate::bearing::Springs::measures); none before the first step.
    pub worst: Vec<Option<Worst>>,
    /// When the steady state was reached.
    pub steady: Option<SteadyState>,
    /// What was left to change at the end, as a fraction of what varies in a cycle, infinite where nothing settles; none where it
    /// was not estimated.
    pub left: Option<f64>,
    /// Until when (s) something changes that is told over time, infinite where it never ends.
    pub told_until: f64,
    /// Newton iterations in all.
    pub iterations: usize,
    /// Matrices factored in all.
    pub factorisations: usize,
    /// Steps that had to be halved, as they could not be solved.
    pub halved_steps: usize,
    /// The parts that steps took, where the march chose them.
    pub parts: Option<PartsTaken>,
}

/// A march that ended early, with what it gave up to there.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure {
    /// Why.
    pub error: Error,
    /// The steps before.
    pub outcome: Outcome,
}

//! How a periodic motion is looked for.

use super::cycle::Cycle;
use crate::dynamics::NewtonOptions;

/// How the state is found that a cycle leaves as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Anderson's acceleration of the cycles: no derivative, a cycle each time.
    Accelerated,
    /// Newton's method with the derivative of the cycle.
    Shooting,
    /// Harmonic balance: the motion as a sum of harmonics, without steps.
    Harmonic,
}

/// How a periodic motion is looked for.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicOptions {
    /// The cycle, in steps.
    pub cycle: Cycle,
    /// By which method; the one that takes less time, with the other where it fails, if none is told.
    pub method: Option<Method>,
    /// Harmonics beside the mean, where these are balanced; as many as are enough, if they are not told.
    pub harmonics: Option<usize>,
    /// Cycles that are marched first; as the method needs, if they are not told.
    pub marched: Option<usize>,
    /// ‖x(T) − x(0)‖/‖x‖ in the energy norm at which the motion counts as periodic; below it what is left falls to rounding.
    pub tolerance: f64,
    /// Cycles that are marched at most.
    pub most_cycles: usize,
    /// Multipliers that are wanted, the largest ones, of machines with so many states that not all are found.
    pub multipliers: usize,
    /// How steps are solved; to rounding whatever is told here.
    pub newton: NewtonOptions,
    /// Whether the motion and its multipliers are compared with those of steps half as long.
    pub judged: bool,
}

impl PeriodicOptions {
    /// The usual ones for a cycle.
    pub fn of(cycle: Cycle) -> Self {
        PeriodicOptions {
            cycle,
            method: None,
            harmonics: None,
            marched: None,
            tolerance: 1e-10,
            most_cycles: 400,
            multipliers: 10,
            newton: NewtonOptions::default(),
            judged: true,
        }
    }
}

/// How far the search is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleProgress {
    /// Cycles marched so far.
    pub cycles: usize,
    /// ‖x(T) − x(0)‖/‖x‖ of the last one.
    pub miss: f64,
}

//! Marching a machine in time.
//!
//! ```text
//! starts     where a march begins: in equilibrium, at the end of another, at one time again and again
//! marching   the march from step to step: its options, steps, rows, checkpoints, outcome
//! verdict    what steps are measured by, and what the program believes of a run
//! lengths    how long the parts of steps are, and where they end
//! iteration  how a step is solved: Newmark's formulas, Newton's method, its factors
//! steady     whether a motion repeats
//! motion     what of the motion of a machine is judged by itself: parts, turns, modes
//! ```
//!
//! Each names only those below it.

mod iteration;
mod lengths;
mod marching;
mod motion;
#[cfg(test)]
mod small;
mod starts;
mod steady;
mod verdict;

pub use iteration::{Coefficients, HalvedAt, HalvedSteps, Integrator, Newmark, NewtonOptions};
pub use lengths::{AutomaticStep, PartsTaken};
pub use marching::{
    Acceleration, Amplitude, BodyStart, Checkpoint, Failure, March, MarchOptions, Outcome,
    Progress, march,
};
pub(crate) use marching::{Changes, LinearStep, LinearSteps, write_row};
pub use motion::MovingPart;
pub use starts::{Equilibrium, LastState, equilibrium};
pub(crate) use starts::{Standing, standing_at};
pub(crate) use steady::settled_from;
pub use steady::{SteadyRule, SteadyState};
pub use verdict::{
    EnergyBalance, FewestSteps, FilmQuality, Finding, LEAST_STEPS, Quality, Ringing, RingingPart,
    StateError, findings,
};

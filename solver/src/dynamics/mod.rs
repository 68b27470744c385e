//! Marching a machine in time.
//!
//! ```text
//! start      equilibrium, restart, accelerate, early
//! march      march ─▶ step (splits, halvings, jumps, watched, periods, tell) ─▶ newton (newmark, rows, merit)
//! iteration  factors (factored, costs, splits) with secants, kept_columns, extrapolation; condensed: in the measures of joints
//! steps      control: lengths of parts that the march chooses, by part_errors and contacts
//! verdict    meters ─▶ energy, quality_meter (sampled, ringing, state_errors, turns, in_space, film_rates) ─▶ quality ─▶ verdict
//!            in the modes of linearised (modes, rings, parts, stiffest); by windows and histogram
//! end        steady; checkpoint: what all of these carry over an interruption
//! cycles     cycle, linear_steps: for periodic motions
//! ```

mod accelerate;
mod checkpoint;
mod condensed;
mod contacts;
mod control;
mod costs;
mod cycle;
mod early;
mod energy;
mod equilibrium;
mod extrapolation;
mod factored;
mod factors;
mod film_rates;
mod halvings;
mod histogram;
mod in_space;
mod jumps;
mod kept_columns;
mod linear_steps;
mod linearised;
mod march;
mod masses;
mod merit;
mod meters;
mod modes;
mod moving_part;
mod newmark;
mod newton;
mod part_errors;
mod part_sums;
mod parts;
mod periods;
mod quality;
mod quality_meter;
mod restart;
mod ringing;
mod rings;
mod row;
mod rows;
mod sampled;
mod sampling;
mod secants;
#[cfg(test)]
mod small;
mod splits;
mod state_errors;
mod steady;
mod step;
mod stiffest;
mod stored_oil;
mod tell;
mod turn_sums;
mod turns;
mod verdict;
mod watched;
mod windows;

pub use checkpoint::Checkpoint;
pub use control::{AutomaticStep, PartsTaken};
pub use energy::EnergyBalance;
pub use equilibrium::{Equilibrium, equilibrium};
pub(crate) use equilibrium::{Standing, standing_at};
pub use film_rates::FilmRates;
pub use halvings::{HalvedAt, HalvedSteps};
pub(crate) use linear_steps::{Changes, LinearStep, LinearSteps};
pub use march::{BodyStart, Failure, March, MarchOptions, Outcome, Progress, march};
pub use moving_part::MovingPart;
pub use newmark::{Coefficients, Integrator, Newmark};
pub use newton::NewtonOptions;
pub use periods::{FewestSteps, LEAST_STEPS};
pub use quality::Quality;
pub use restart::LastState;
pub use rings::{Ringing, RingingPart};
pub use state_errors::StateError;
pub(crate) use steady::settled_from;
pub use steady::{SteadyRule, SteadyState};
pub use tell::{Acceleration, Amplitude};
pub use verdict::{Finding, findings};

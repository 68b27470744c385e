//! The march from step to step.
//!
//! ```text
//! march      options ─▶ march ─▶ outcome; checkpoint: what it carries over an interruption
//! step       step: its parts, split where something jumps; accelerate: anew behind a jump; linear_steps: small changes in it
//! between    row: what is recorded; stored_oil; tell: what is to act from there on
//! ```

mod accelerate;
mod checkpoint;
mod linear_steps;
mod march;
mod options;
mod outcome;
mod row;
mod step;
mod stored_oil;
mod tell;

pub(super) use accelerate::accelerate;
pub use checkpoint::Checkpoint;
pub(super) use checkpoint::Clock;
pub(crate) use linear_steps::{Changes, LinearStep, LinearSteps};
pub use march::{March, march};
pub use options::{BodyStart, MarchOptions};
pub use outcome::{Failure, Outcome, Progress};
pub(crate) use row::write_row;
pub use tell::{Acceleration, Amplitude};

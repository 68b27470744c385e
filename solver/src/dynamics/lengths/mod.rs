//! How long the parts of steps are, and where they end.
//!
//! ```text
//! control    parts that the march chooses, by what each is worth; contacts: what begins and ends within one
//! splits     how often a step may be split or halved
//! jumps      where loads begin at once, and told accelerations jump
//! watched    curves by which loads vary, and the rows of their tables that steps pass
//! ```

mod contacts;
mod control;
mod jumps;
mod splits;
mod watched;

pub(super) use contacts::Contacts;
pub use control::{AutomaticStep, PartsTaken};
pub(super) use control::{ControlMemory, FORESEEN, MOST_HALVINGS, Measured, StepControl};
pub(super) use jumps::jumps;
pub(super) use splits::{MOST_SPLITS, SPARE_FACTORS, most_halvings};
pub(super) use watched::{Watched, watched};

//! Schedules as readable Rust, through quote, syn and prettyplease.

mod identifier;
pub mod motion;
mod statement;
mod tables;
mod text;

pub use identifier::identifier;
pub use motion::{MotionFunctions, motion};
pub use statement::{NumberText, Numbers, number, operand, statements};
pub use text::{documented, formatted};

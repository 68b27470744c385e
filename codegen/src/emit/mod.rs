//! Schedules as readable Rust, through quote, syn and prettyplease.

mod identifier;
mod motion;
mod statement;
mod text;

pub use identifier::identifier;
pub use motion::motion;
pub use statement::{Numbers, number, operand, statements};
pub use text::{documented, formatted};

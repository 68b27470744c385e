//! Schedules as readable Rust, through quote, syn and prettyplease.

mod identifier;
mod statement;
mod text;

pub use identifier::identifier;
pub use statement::{Numbers, number, operand, statements};
pub use text::{documented, formatted};

//! Schedules as readable Rust, through quote, syn and prettyplease.

mod identifier;
mod statement;
mod tables;
mod text;
mod work;

pub use identifier::identifier;
pub use statement::{NumberText, Numbers, number, operand, statements};
pub(crate) use text::{count, names};
pub use text::{documented, formatted};
pub(crate) use work::{Head, Loop, Size, Value, Work};

//! From spec files to Rust kernels: formulas, derivatives, schedules, emission and tape.

pub mod diagnostic;
pub mod document;
pub mod element;
pub mod emit;
pub mod expression;
pub mod formula;
pub mod generate;
mod hash;
pub mod kinds;
pub mod operation;
pub mod rational;
pub mod schedule;
mod simplify;
pub mod tape;
pub mod units;

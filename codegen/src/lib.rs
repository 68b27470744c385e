//! From spec files to Rust kernels: formulas, derivatives, schedules, emission and tape.

pub mod diagnostic;
pub mod document;
pub mod element;
#[cfg(feature = "emit")]
pub mod emit;
pub mod expression;
pub mod form;
pub mod formula;
#[cfg(feature = "emit")]
pub mod generate;
pub mod lagrange;
pub mod operation;
pub mod rational;
pub mod schedule;
pub mod simplify;
pub mod spec;
pub mod tape;
pub mod units;

//! From spec files to Rust kernels: formulas, derivatives, schedules, emission and tape.

pub mod diagnostic;
pub mod expression;
pub mod formula;
pub mod schedule;
pub mod spec;
pub mod units;

//! Benchmarks: generated kernels against hand-written kernels.

pub mod hand;
pub mod history;
pub mod measure;
pub mod plain;
pub mod specs;
pub mod textbook;

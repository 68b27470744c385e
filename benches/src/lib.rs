//! Benchmarks: generated kernels against hand-written twins.

pub mod hand;
pub mod measure;
pub mod specs;
pub mod textbook;

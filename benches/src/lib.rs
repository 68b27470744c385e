//! Benchmarks: generated kernels against hand-written twins.

pub mod hand;

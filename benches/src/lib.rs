//! Benchmarks: generated kernels against hand-written twins.

//! Hand-written twins of generated kernels.

pub mod elements;

//! Hand-written references of generated kernels.

pub mod clearance;
pub mod elements;
pub mod law;
pub mod motion;
pub mod product;

//! Bilinear forms in u (trial) and v (test): expanded into products of values and gradients of two basis
//! functions, and the structure found in the result.

mod expand;
mod structure;

pub use expand::{Bilinear, Names, Place, expand};
pub use structure::{Pattern, Structure, structure};

//! Finite elements: reference cells, shape functions, quadrature, and the proofs that they are sound.

mod cell;
pub mod exact;
mod prove;
pub mod quadrature;

pub use cell::Cell;
pub use prove::prove;
pub use quadrature::{Point, Quadrature};

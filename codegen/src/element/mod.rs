//! Finite elements: reference cells, shape functions, quadrature, and the proofs that they are sound.

mod cell;
pub mod direct;
pub mod exact;
mod prove;
pub mod quadrature;
mod table;

pub use cell::Cell;
pub use prove::prove;
pub use quadrature::{Point, Quadrature};
pub use table::{Products, Table};

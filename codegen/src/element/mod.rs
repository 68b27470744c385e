//! Finite elements: reference cells, shape functions, quadrature, and the proofs that they are sound.

pub mod algebraic;
mod cell;
pub mod demand;
pub mod direct;
pub mod polynomial;
mod prove;
pub mod quadrature;
pub mod rules;
mod table;

pub use cell::Cell;
pub use polynomial::Polynomial;
pub use prove::prove;
pub use quadrature::{Point, Quadrature};
pub use table::{Products, Table};

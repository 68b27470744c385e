//! The mathematics of finite elements: reference cells, polynomials, and quadrature with exact numbers.

pub mod algebraic;
mod cell;
pub mod polynomial;
pub mod quadrature;
pub mod rules;

pub use cell::Cell;
pub use polynomial::Polynomial;
pub use quadrature::{Point, Quadrature};

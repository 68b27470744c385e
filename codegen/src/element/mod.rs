//! The mathematics of finite elements: reference cells, polynomials, and quadrature with exact numbers.

pub(crate) mod algebraic;
mod cell;
pub(crate) mod face;
pub(crate) mod polynomial;
pub(crate) mod quadrature;
pub(crate) mod rules;

pub use cell::Cell;
pub use polynomial::Polynomial;
pub use quadrature::{Point, Quadrature};

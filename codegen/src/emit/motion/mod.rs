//! Motions as Rust: kernels over vectors and matrices of run-time length n, in loops.
//!
//! A kernel multiplies out what it computes, so that every output is a linear combination of
//! matrix–vector products (such as Y η), stored matrices and outer products, with scalar
//! coefficients. Each product is then computed once, all in one pass over the columns of the matrices.

mod combination;
mod form;
mod functions;
mod kernel;
mod plan;
mod product;

pub use form::{Combination, Group, Term};
pub use functions::{MotionFunctions, Planned, motion, planned};
pub use kernel::ResultKind;
pub use plan::{AFTER, BEFORE, DotProduct, MatrixProduct, Plan};

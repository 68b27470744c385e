//! Motions as Rust: kernels over vectors and matrices of run-time length n, in loops.
//!
//! A kernel multiplies out what it computes, so that every output is a linear combination of words
//! (matrices applied to a vector, such as Y η), stored matrices and outer products, with scalar
//! coefficients. Each word is then computed once, all in one pass over the columns of the matrices.

mod combination;
mod form;
mod functions;
mod kernel;
mod plan;
mod word;

pub use form::{Form, Group, Term};
pub use functions::{MotionFunctions, Planned, motion, planned};
pub use kernel::Kind;
pub use plan::{AFTER, BEFORE, DotProduct, Plan, Word};

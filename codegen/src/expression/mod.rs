//! Expressions as a hash-consed graph: scalars with exact rationals, vectors and matrices of run-time
//! length n with what is known of them (symmetric, skew).
//!
//! Equal expressions have equal [`Id`]s as far as the rules of the constructors reach; [`normal`]
//! decides equality of polynomials in dot products and matrix–vector products exactly.

mod bytecode;
mod differentiate;
mod display;
mod fold;
mod graph;
mod linear;
mod node;
pub mod normal;
mod scalar;
mod signature;
mod substitute;
#[cfg(test)]
mod tests;

pub use differentiate::DifferentiateError;
pub use display::{display, display_rounded};
pub(crate) use fold::{Algebra, Folded};
pub use graph::Graph;
pub use node::{Function, Id, Node, Rational, Relation, Shape, Symbol, Symmetry};
pub use signature::Points;

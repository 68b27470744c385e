//! Verification: each layer against exact solutions, other methods, or its own definition.

mod block;
mod reduction;

//! From meshes and kernels to histories: assembly, reduction, Newmark–Newton.

pub mod assembly;
pub mod body;
pub mod cache;
pub mod constraints;
pub mod error;
pub mod linalg;
pub mod mesh;
pub mod ordering;
pub mod reduction;
pub mod shaft;
pub mod sparse;
pub mod support;

pub use error::Error;

//! From meshes and kernels to histories: assembly, reduction, Newmark–Newton.

pub mod assembly;
pub mod error;
pub mod linalg;
pub mod mesh;
pub mod ordering;
pub mod reduction;
pub mod sparse;

pub use error::Error;

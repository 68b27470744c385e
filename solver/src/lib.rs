//! From meshes and kernels to histories: assembly, reduction, Newmark–Newton.

pub mod error;
pub mod linalg;
pub mod mesh;
pub mod ordering;

pub use error::Error;

//! From meshes and kernels to histories: assembly, reduction, Newmark–Newton.

pub mod linalg;

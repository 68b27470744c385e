//! From meshes and kernels to histories: assembly, reduction, Newmark–Newton. The pipeline is in [`model`].

pub mod assembly;
pub mod attached;
pub mod bearing;
pub mod bodies;
pub mod body;
pub mod cache;
pub mod centre_of_mass;
pub mod constraints;
pub mod contacts;
pub mod curve;
pub mod dynamics;
pub mod error;
pub mod gravity;
pub mod history;
pub mod linalg;
pub mod loads;
pub mod machine;
mod mean_frame;
pub mod measure;
pub mod mesh;
pub mod model;
mod ordering;
pub mod output;
pub mod reduced;
pub mod reduction;
mod requested;
pub mod rigid;
mod rotating;
pub mod schedule;
pub mod shaft;
pub mod sparse;
mod stiffening;
pub mod support;
mod time_function;

pub use error::Error;

//! The physics as spec files, and the kernels generated from them.
//!
//! The files under `elements/`, `films/`, `forms/`, `laws/` and `motion/` are the source; the build script hands
//! them to `whirl-codegen` and this crate includes the text it writes. [`ELEMENTS`], [`LAWS`],
//! [`MOTIONS`], [`CLEARANCES`] and [`FILMS`] list what was found, each entry with its facts and its functions;
//! [`FORMS`] the forms that the elements integrate, and [`generated`] holds the text itself.

mod cell_kernel;
pub mod cells;
pub mod columns;
mod condensation;
#[cfg(test)]
mod counted;
mod film;
pub mod generated;
mod jacobian;
pub mod lane;
mod matrices;
mod number;
mod origin;
mod pairs;
mod register;
pub mod registers;
mod registry;
mod rows;
#[cfg(target_arch = "x86_64")]
mod sine;
#[cfg(test)]
mod traced;
mod triangle;
pub mod vector;
mod wide;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use cell_kernel::{CellKernel, FormKernel, StressKernel, Structure};
pub use film::{
    Film, FilmEdge, FilmField, FilmFieldKind, FilmForce, FilmFunction, FilmKernel, FilmParameter,
    FilmSlope, FilmValues, each_of_film,
};
pub use lane::{FUNCTIONS, Lane, Shared};
pub use matrices::{Batch, CellMatrix, Matrix};
pub use origin::{Origin, Variable};
pub use registers::{Register, Registers};
pub use registry::*;
pub use rows::{
    SkeletonKernel, SpringKernel, each_spring, each_spring_with, rows, rows_mut, strided,
    strided_mut,
};

include!(concat!(env!("OUT_DIR"), "/kernels.rs"));

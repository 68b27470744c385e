//! What a spec file may say, read with every error at once, and what is made of it: a folder a kind.

mod cells;
pub mod clearance;
pub mod element;
pub mod film;
pub mod form;
pub(crate) mod kernel;
pub mod kind;
pub mod law;
pub mod list;
pub mod motion;
pub mod page;
mod read;

//! What a spec file may say, read with every error at once, and what is made of it: a folder a kind.

pub mod clearance;
mod document;
pub mod element;
pub mod form;
#[cfg(feature = "emit")]
pub(crate) mod kernel;
#[cfg_attr(not(feature = "emit"), allow(dead_code, reason = "only builds look at all specs"))]
pub mod kind;
pub mod law;
pub mod list;
pub mod motion;
pub mod page;
pub mod read;
pub mod schema;

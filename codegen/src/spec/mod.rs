//! What a spec file may say, read with every error at once.

pub mod clearance;
mod document;
pub mod element;
pub mod form;
pub mod law;
pub mod motion;
pub mod read;
pub mod schema;

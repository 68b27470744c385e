//! What a spec file may say, read with every error at once.

mod document;
pub mod law;
pub mod motion;
pub mod read;

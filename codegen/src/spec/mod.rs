//! What a spec file may say, read with every error at once.

pub mod clearance;
pub mod element;
pub mod form;
pub mod law;
pub mod motion;

pub(crate) use crate::document as read;
pub(crate) use crate::document::schema;

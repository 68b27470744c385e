//! Values of a key, one or a range of them.

pub(crate) mod level;
pub(crate) mod range;

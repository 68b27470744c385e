//! What a spec file may say, read with every error at once.

pub mod read;

//! What an analysis comes to.

use crate::errors::Failure;

/// What is left of an analysis that was interrupted before its first speed was done: nothing.
pub(super) fn nothing() -> Failure {
    let reason = "interrupted before the first speed".to_owned();
    Failure::Unfinished { reason, kept: None, help: None }
}

/// A text, and files.
pub(super) struct Found {
    /// For people.
    pub(super) text: String,
    /// Files by their names.
    pub(super) files: Vec<(String, Vec<u8>)>,
    /// Whether it was interrupted before its end.
    pub(super) interrupted: bool,
}

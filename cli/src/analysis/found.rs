//! What an analysis comes to.

/// A text, and files.
pub(super) struct Found {
    /// For people.
    pub(super) text: String,
    /// Files by their names.
    pub(super) files: Vec<(String, Vec<u8>)>,
    /// Whether it was interrupted before its end.
    pub(super) interrupted: bool,
}

//! What a file of a history for another program is called.

/// A file for other programs, which a run writes beside it where an option asks for it.
pub(crate) struct Format {
    /// Name of the file.
    pub(crate) name: &'static str,
    /// The option.
    pub(crate) option: &'static str,
    /// What the file is.
    pub(crate) meaning: &'static str,
    /// Name of the file while it is written, where it has one of its own.
    pub(crate) part: Option<&'static str>,
}

//! Where the bodies of the short form stand among those of the machine.

/// `[shaft]`.
pub(super) const SHAFT: usize = 0;
/// `[support]`.
pub(super) const SUPPORT: usize = 1;

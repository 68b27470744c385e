//! What is marched, as far as a case says it.

use super::joined_machine::JoinedMachine;
use super::lumped::Lumped;

/// As [`System`](super::System), as far as the case says it.
pub(crate) enum SystemDraft {
    /// One mass, if enough of it is right.
    Lumped(Option<Lumped>),
    /// Bodies and what joins them, if enough of them is right.
    Joined(Option<Box<JoinedMachine>>),
}

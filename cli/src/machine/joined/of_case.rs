//! Bodies as the case says them, by their places.

use crate::case::{self, JoinedMachine};

/// Whether a body turns.
pub(super) fn turns(joined: &JoinedMachine, body: usize) -> bool {
    joined.bodies[body].turns()
}

/// The mesh of a body, as the case says it.
pub(super) fn meshed(joined: &JoinedMachine, body: usize) -> Option<&case::MeshedBody> {
    match &joined.bodies[body].form {
        case::Form::Meshed(meshed) => Some(meshed),
        case::Form::Rigid(_) => None,
    }
}

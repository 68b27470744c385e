//! What is to be reduced: meshes with the dofs to retain and to hold, and the output nodes, found by the sets
//! of the case.

mod body;
mod driven;
pub(super) mod geometry;
mod matrices;

pub(crate) use self::body::BodyPlan;
pub(super) use self::body::HoldingWords;
pub(super) use self::driven::Turn;

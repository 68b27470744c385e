//! What a page tells of a case beside its numbers: in words, and the shapes of its bodies.

use crate::case::Case;
use crate::check;
use crate::errors::Failure;
use crate::machine::JoinedPlan;
use crate::page::{Section, Shapes};

/// Both of them.
pub(crate) struct Told {
    pub(crate) words: Vec<Section>,
    pub(crate) shapes: Option<Shapes>,
}

impl Told {
    /// Of a case by its plan.
    ///
    /// # Errors
    /// Of linear algebra.
    pub(crate) fn of(case: &Case, plan: &JoinedPlan) -> Result<Self, Failure> {
        // Where bodies are seen to move, discs would stand still.
        let shapes = Shapes::of_case(case, plan, case.fields.is_none());
        Ok(Told { words: check::words(case, plan)?, shapes })
    }
}

//! What a page tells of a case beside its numbers: in words, and the shapes of its bodies.

use crate::case::Case;
use crate::check;
use crate::errors::Failure;
use crate::machine::{self, Built, JoinedPlan};
use crate::page::{About, Section, Shapes};

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

/// about.json and, of a machine with bodies, shapes.json of a run in memory. `steady`: whether it came to a steady state, in words.
///
/// # Errors
/// As [`Told::of`]; meshes that cannot be read any more.
pub(crate) fn of_run(
    (case, built): (&Case, &Built),
    steady: String,
) -> Result<(String, Option<String>), Failure> {
    let plan = machine::plan(case, &mut Vec::new())?;
    let Told { words, shapes } = Told::of(case, &plan)?;
    let about = About::of_run((case, built), words, steady);
    Ok((about.json(), shapes.map(|own| own.json())))
}

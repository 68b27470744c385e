//! A machine as it stands at a speed of a range.

use super::linearised::{Linearised, Standstill};
use super::range::Range;
use super::round::LinearMachine;
use crate::error::Error;

/// The state that stands at a speed, and its equations.
pub(super) struct Stood {
    pub(super) speed: f64,
    pub(super) at: Standstill,
    pub(super) equations: Linearised,
}

impl LinearMachine {
    /// The machine as it stands at a speed, from a state nearby if there is one.
    pub(super) fn stood(
        &self,
        range: &Range,
        speed: f64,
        near: Option<&Standstill>,
    ) -> Result<Stood, Error> {
        let speeds = self.speeds(range.of, speed, &range.ratios);
        let at = self.standing_round(&speeds, near)?;
        let equations = self.linearised(&at)?;
        Ok(Stood { speed, at, equations })
    }
}

//! Where the bodies of the condensed iteration were evaluated, and when they are to be evaluated anew.

use serde::{Deserialize, Serialize};

use super::super::costs::{Work, cost};
use super::super::factored::Factored;
use crate::machine::Machine;

/// Steps for which bodies are worth evaluating.
const SOON: usize = 16;

/// Where the bodies were evaluated, and what steps took since.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::dynamics::iteration) struct KeptBodies {
    /// Nowhere, if they are to be evaluated.
    pub(in crate::dynamics::iteration) at: Factored,
    /// Iterations more than one a step.
    more: usize,
    /// Whether bodies that turn are solved twice, and steps since they are, or since all were evaluated.
    again: bool,
    steps: usize,
}

impl KeptBodies {
    /// Evaluated nowhere.
    pub(in crate::dynamics::iteration) fn none(machine: &Machine) -> Self {
        KeptBodies { at: Factored::nowhere(machine), more: 0, again: false, steps: 0 }
    }

    /// Begins to count anew.
    pub(in crate::dynamics::iteration) fn begin(&mut self) {
        (self.more, self.again, self.steps) = (0, false, 0);
    }

    /// Whether bodies that turn are solved twice.
    pub(in crate::dynamics::iteration) fn are_solved_twice(&self) -> bool {
        self.again
    }

    /// Counts the iterations of a step that is solved. Bodies that have gone too far from where L⁻¹ was made have it made anew, or
    /// are solved twice where that would be due again soon, until that is not enough or has taken as long.
    pub(in crate::dynamics::iteration) fn count(&mut self, iterations: usize) {
        self.steps += 1;
        self.more += iterations - 1;
        let bodies = cost(Work::Bodies);
        let made_anew = match self.again {
            true => {
                let (more, twice) = (cost(Work::Iteration), cost(Work::Again));
                self.more * more > bodies || self.steps * twice >= bodies
            }
            false => self.more > 0 && self.steps > SOON,
        };
        if made_anew {
            self.at.forget();
        } else if self.more > 0 && !self.again {
            (self.again, self.more, self.steps) = (true, 0, 0);
        }
    }
}

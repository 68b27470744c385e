//! When a steady state was reached.

use serde::{Deserialize, Serialize};

/// When the steady state was reached, if it was.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SteadyState {
    /// End of the cycle (s) from which on less than 1 % was left, or of the first one over which the test held at every step.
    pub time: f64,
}

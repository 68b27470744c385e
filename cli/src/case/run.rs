//! How long a case runs.

/// How long a case runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Run {
    /// s.
    pub(crate) duration: f64,
    /// Whether it goes on from a state, whose time and speeds are those of another run.
    pub(crate) goes_on: bool,
}

impl Run {
    /// When it ends (s); infinite where that is not known.
    pub(crate) fn end(self) -> f64 {
        if self.goes_on { f64::INFINITY } else { self.duration }
    }
}

//! Speeds over which modes are followed.

/// What is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Range {
    /// The body whose speed it is over.
    pub of: usize,
    /// Speeds (rad/s), ascending.
    pub speeds: Vec<f64>,
    /// By body the ratio of its speed to that, where it is told.
    pub ratios: Vec<Option<f64>>,
    /// How many modes are listed, the slowest ones.
    pub count: usize,
    /// Orders of which critical speeds are wanted.
    pub orders: Vec<f64>,
}

/// Modes that are followed beyond those that are asked for, so that these may change places with them.
const BEYOND: usize = 4;

impl Range {
    /// How many modes are looked for at each speed.
    pub(super) fn looked_for(&self) -> usize {
        self.count + BEYOND
    }
}

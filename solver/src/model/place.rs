//! Places on bodies before these are reduced.

/// Where on a body something acts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// On points of it, by their places.
    Nodes(Vec<usize>),
    /// On one of its mean motions, by its place.
    Mean(usize),
}

//! Keys that vary in step, and how points go on from each other along them.

/// Keys that vary in step, by their places among all.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    pub(super) keys: Vec<usize>,
    pub(super) count: usize,
}

impl Axis {
    pub(super) fn new(keys: Vec<usize>, count: usize) -> Self {
        Axis { keys, count }
    }
}

/// How points go on from each other along the last axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Along {
    /// From the least value to the largest.
    Up,
    /// From the largest value to the least.
    Down,
    /// First up, and from there down again.
    Both,
}

impl Along {
    /// As a sweep file says it.
    pub(super) fn new(word: &str) -> Self {
        match word {
            "down" => Along::Down,
            "both" => Along::Both,
            _ => Along::Up,
        }
    }

    /// How often a value is passed.
    pub(super) fn passes(self) -> usize {
        if self == Along::Both { 2 } else { 1 }
    }

    /// The ways on which values are passed.
    pub(super) fn ways(self) -> &'static [&'static str] {
        match self {
            Along::Up => &["up"],
            Along::Down => &["down"],
            Along::Both => &["up", "down"],
        }
    }

    /// The value at a place of a chain of `count` points, and the way that goes through it.
    pub(super) fn value(self, place: usize, count: usize) -> (usize, &'static str) {
        match self {
            Along::Up => (place, "up"),
            Along::Down => (count - 1 - place, "down"),
            Along::Both if place < count / 2 => (place, "up"),
            Along::Both => (count - 1 - place, "down"),
        }
    }
}

//! What a sweep is: a case, and what varies of it.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Located, Source};

use super::axis::{Along, Axis};
use super::vary::Varied;
use crate::case::CaseText;

/// A case, and what varies of it.
#[derive(Debug)]
pub struct Sweep {
    /// Name under which results are kept: that of the file without its ending.
    pub(super) name: String,
    /// One-line description.
    pub(super) title: String,
    /// The case, as far as its points have it alike.
    pub(super) base: CaseText,
    /// Where it is said what varies.
    pub(super) source: Arc<Source>,
    /// In the order in which they stand there.
    pub(super) keys: Vec<Varied>,
    /// The last one varies fastest.
    pub(super) axes: Vec<Axis>,
    /// Whether points go on from each other.
    pub(super) along: Option<Along>,
    /// Points of a Latin hypercube, if it is one.
    pub(super) samples: Option<usize>,
    pub(super) keep: Keep,
    /// Whether points are marched.
    pub(super) marches: bool,
    /// Names of the analyses that are done of each.
    pub(super) analyses: Vec<Located>,
}

/// What is kept of every point beside its row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keep {
    Nothing,
    /// History, summary and last state.
    Histories,
}

impl Sweep {
    /// Name under which results are kept.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// One-line description; empty if it says none.
    pub fn title(&self) -> &str {
        &self.title
    }
}

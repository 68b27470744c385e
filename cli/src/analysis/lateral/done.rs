//! What a variant comes to.

use super::model::Model;
use super::placement::Unbalance;
use super::response::{Close, Probe, Responses};
use super::stability::Stability;

/// The case as its own variant.
pub(super) const AS_IT_IS: &str = "as given";

/// What one variant comes to.
pub(super) struct Done {
    pub(super) name: String,
    pub(super) model: Model,
    pub(super) unbalance: Vec<Unbalance>,
    pub(super) probes: Vec<Probe>,
    pub(super) closes: Vec<Close>,
    pub(super) responses: Responses,
    pub(super) stability: Option<Stability>,
    pub(super) notes: String,
}

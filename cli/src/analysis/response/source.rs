//! What makes points move.

use whirl_solver::linear::{Peak, Vibration};

/// A body and an order of its rotation, with what the points do at each speed.
pub(super) struct Source {
    pub(super) body: usize,
    pub(super) order: f64,
    /// By speeds, by points.
    pub(super) motions: Vec<Vec<Vibration>>,
    /// By points.
    pub(super) peaks: Vec<Vec<Peak>>,
    /// Speeds beside the peaks with the motions of the points there, for figures.
    pub(super) near: Vec<(f64, Vec<Vibration>)>,
}

impl Source {
    /// The largest amplitude of all points and speeds (m).
    pub(super) fn size(&self) -> f64 {
        let all = self.motions.iter().flatten().map(|own| own.orbit().major);
        all.fold(0.0, f64::max)
    }
}

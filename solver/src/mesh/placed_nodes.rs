//! Where nodes are, and sets of them, as files of meshes say it.

use std::collections::{BTreeMap, HashMap};

/// Nodes with their places and sets, whether cells have them or not.
#[derive(Debug, Clone, Default)]
pub(super) struct PlacedNodes {
    /// Place (m) of every node by its label.
    pub(super) places: HashMap<u64, [f64; 3]>,
    /// Labels of the nodes of each set.
    pub(super) sets: BTreeMap<String, Vec<u64>>,
    /// Nodes whose displacements are along axes of their own, with the label of the coordinate system.
    pub(super) turned: HashMap<u64, u64>,
}

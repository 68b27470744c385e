//! A place from which the measures of springs move.

use super::springs::Springs;

/// Measures that a plane has beside those of its bore: the angle and both displacements of its journal.
pub(super) const RING: usize = 3;

/// Where the measures stand, and their rates, before they are moved.
pub(super) struct Mark {
    pub(super) rings: Vec<[[f64; RING]; 2]>,
    pub(super) bores: Vec<[Vec<f64>; 2]>,
}

impl Mark {
    pub(super) fn new(springs: &Springs) -> Self {
        let bore = |rows: usize| [vec![0.0; rows], vec![0.0; rows]];
        Mark {
            rings: vec![[[0.0; RING]; 2]; springs.planes.len()],
            bores: springs.bores.iter().map(|own| bore(own.rows.rows)).collect(),
        }
    }
}

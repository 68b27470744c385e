//! Where grid points are.

use std::collections::HashMap;

use super::super::raw::{LinePosition, MeshReport};
use super::frame::Point;
use super::nodes::Grids;
use super::systems::{Frames, Systems};

impl Grids {
    /// Where all are, in the basic system, in the order of the file.
    pub(super) fn positions(
        &self,
        systems: &Systems,
        frames: &Frames,
        report: &mut MeshReport,
    ) -> Vec<Point> {
        let mut unknown: HashMap<u64, usize> = HashMap::new();
        let mut first_of: Vec<(u64, LinePosition, u64)> = Vec::new();
        let mut positions = Vec::with_capacity(self.list.len());
        for grid in &self.list {
            let system = self.system(grid);
            match frames.get(system) {
                Ok(Some(frame)) => positions.push(frame.position(grid.at)),
                Ok(None) => positions.push([0.0; 3]),
                Err(()) => {
                    positions.push([0.0; 3]);
                    *unknown.entry(system).or_insert_with(|| {
                        first_of.push((system, grid.place, grid.label));
                        0
                    }) += 1;
                }
            }
        }
        for (system, place, label) in first_of {
            let what = match unknown[&system] {
                1 => format!(
                    "node {label} is given in coordinate system {system}, which is not defined"
                ),
                number => format!(
                    "{number} nodes, such as {label}, are given in coordinate system {system}, which is not defined"
                ),
            };
            report.error(place, what, systems.known());
        }
        positions
    }
}

//! Nodes at one place become one node, where a case asks for it.

use whirl_text::shown;

use super::RawMesh;
use super::grid::{PointGrid, distance, spacing};
use super::report::{LinePosition, MeshReport, count};

impl RawMesh {
    /// Merges nodes that are at most `within` (m) apart: cells and sets then have the first of them.
    pub(super) fn merge_nodes(&mut self, within: f64, report: &mut MeshReport) {
        let positions = &self.nodes.positions;
        if !positions.iter().flatten().all(|x| x.is_finite()) {
            // An error of its own.
            return;
        }
        // What is larger than an edge would join a great many.
        let near = |a: usize, b: usize| distance(positions[a], positions[b]) <= within;
        if self.refuse_flattened(within, near, report) {
            return;
        }
        let all: Vec<usize> = (0..positions.len()).collect();
        let grid = PointGrid::new(positions, &all, spacing(positions, all.len()).max(4.0 * within));
        // The first of those that are joined stands for them.
        let mut first = all.clone();
        for &node in &all {
            grid.each_near(positions, (positions[node], within), |other, _| {
                if other < node {
                    let (a, b) = (root(&mut first, other), root(&mut first, node));
                    first[a.max(b)] = a.min(b);
                }
            });
        }
        let first: Vec<usize> = all.iter().map(|&node| root(&mut first, node)).collect();
        // Others may lie between two nodes of a cell that are farther apart.
        if self.refuse_flattened(within, |a, b| first[a] == first[b], report) {
            return;
        }
        let merged = all.iter().filter(|&&node| first[node] != node).count();
        if merged == 0 {
            let what = format!("`merge`: no nodes are within {} m of each other", metres(within));
            let help = "leave it out, or write a larger distance";
            report.warn(LinePosition::default(), what, help);
            return;
        }
        let what = format!(
            "{} merged with others within {} m, as `merge` asks for",
            count(merged, "node"),
            metres(within)
        );
        report.warn(LinePosition::default(), what, "");
        self.nodes.named.sets.map_members(|node| first[node]);
        let cells = self.cells.list.iter_mut().flat_map(|cell| &mut cell.nodes);
        cells.for_each(|node| *node = first[*node]);
        let rows = self.ties.iter_mut().flat_map(|tie| &mut tie.rows);
        rows.flatten().for_each(|(dof, _)| *dof = 3 * first[*dof / 3] + *dof % 3);
        self.keep_nodes(|node| first[node] == node);
    }

    /// Notes the cell of which two nodes `join`, of several the one with the shortest distance between them; whether there
    /// is one.
    fn refuse_flattened(
        &self,
        within: f64,
        join: impl Fn(usize, usize) -> bool,
        report: &mut MeshReport,
    ) -> bool {
        let positions = &self.nodes.positions;
        let of_cell = |nodes: &[usize]| {
            let pairs =
                nodes.iter().enumerate().flat_map(|(k, a)| nodes[..k].iter().map(move |b| (a, b)));
            pairs
                .filter(|&(&a, &b)| join(a, b))
                .map(|(&a, &b)| distance(positions[a], positions[b]))
                .min_by(f64::total_cmp)
        };
        let cells = self.cells.list.iter().enumerate();
        let found = cells.filter_map(|(place, cell)| Some((place, of_cell(&cell.nodes)?)));
        let Some((cell, shortest)) = found.min_by(|a, b| a.1.total_cmp(&b.1)) else { return false };
        let (between, help) = match shortest <= within {
            true => ("", "make it smaller than the shortest edge of the mesh"),
            false => (
                ", and nodes that lie between them join them",
                "make it smaller than the distances to the nodes between them",
            ),
        };
        let what = format!(
            "`merge` joins nodes that are up to {} m apart, which would flatten cell {}: two of its nodes are {} m \
             apart{between}",
            metres(within),
            self.cells.named.labels[cell],
            metres(shortest)
        );
        report.error(self.cells.named.places[cell], what, help);
        true
    }
}

/// The node that stands for this one; the way to it is made shorter.
fn root(first: &mut [usize], node: usize) -> usize {
    let mut top = node;
    while first[top] != top {
        first[top] = first[first[top]];
        top = first[top];
    }
    top
}

/// A length in m, for people.
pub(super) fn metres(length: f64) -> String {
    shown(length, 6, 1e-3..1e6)
}

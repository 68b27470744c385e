//! Which nodes of a file the cells have.

use super::super::raw::{MeshReport, count, list};
use super::bulk::Bulk;
use super::tie_card::RawCard;

/// Nodes that belong to cells.
pub(super) struct Used {
    /// Indices of the grid points.
    pub(super) nodes: Vec<usize>,
    /// New index of every grid point; `usize::MAX` where no cell has it.
    pub(super) place: Vec<usize>,
    /// Labels and new indices, by label.
    pub(super) labels: Vec<(u64, usize)>,
}

impl Bulk {
    /// Warns of nodes in no cell, but for those that elements that are left out have.
    pub(super) fn used(&self, report: &mut MeshReport) -> Used {
        let mut place = vec![usize::MAX; self.grids.len()];
        let nodes = self.cells.list.iter().flat_map(|cell| &cell.nodes);
        for node in nodes.filter_map(|&node| self.grids.place_of(node)) {
            place[node] = 0;
        }
        let nodes: Vec<usize> = (0..place.len()).filter(|&node| place[node] == 0).collect();
        let mut labels = Vec::with_capacity(nodes.len());
        for (new, &node) in nodes.iter().enumerate() {
            place[node] = new;
            labels.push((self.grids.label(node), new));
        }
        labels.sort_unstable();
        let mut others: Vec<u64> = self.spiders.iter().map(|spider| spider.reference).collect();
        others.extend(self.masses.iter().map(|mass| mass.node));
        others.extend(self.ties.iter().flat_map(RawCard::nodes));
        others.extend(&self.named);
        others.extend(self.systems.grids());
        others.sort_unstable();
        let unused: Vec<usize> = (0..place.len())
            .filter(|&node| place[node] == usize::MAX)
            .filter(|&node| others.binary_search(&self.grids.label(node)).is_err())
            .collect();
        if let Some(&first) = unused.first() {
            let labels = list(unused.iter().map(|&node| self.grids.label(node)));
            let what = format!("{} in no cell, left out: {labels}", count(unused.len(), "node"));
            let help = "delete them, or add the cells that they belong to";
            report.warn(self.grids.at(first), what, help);
        }
        Used { nodes, place, labels }
    }
}

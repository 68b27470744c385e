//! What cards of ties name: nodes, sets and surfaces.

use std::collections::BTreeSet;

use super::super::raw::{Cells, FileDof, MeshReport, NodeTable, TiePoint, count, did_you_mean};
use super::cards::Token;
use super::combined::Surfaces;
use super::others::OtherElements;
use super::values::whole;

/// What else to do where a tie cannot be read.
pub(super) const REMEDY: &str = "write it as *EQUATION, let the meshes share nodes, or write a file for each body and join \
                                 them in the case";

/// What cards of ties name.
pub(super) struct Joining<'a> {
    pub(super) nodes: &'a NodeTable,
    pub(super) cells: &'a Cells,
    pub(super) others: &'a OtherElements,
    pub(super) surfaces: &'a Surfaces,
    pub(super) of_cells: Vec<bool>,
    /// Where x, y and z of a part point in its instance.
    pub(super) axes: [[f64; 3]; 3],
}

impl<'a> Joining<'a> {
    pub(super) fn new(
        (nodes, cells): (&'a NodeTable, &'a Cells),
        others: &'a OtherElements,
        surfaces: &'a Surfaces,
        axes: [[f64; 3]; 3],
    ) -> Joining<'a> {
        let mut of_cells = vec![false; nodes.positions.len()];
        cells.list.iter().flat_map(|cell| &cell.nodes).for_each(|&node| of_cells[node] = true);
        Joining { nodes, cells, others, surfaces, of_cells, axes }
    }

    /// A node as a point of ties.
    pub(super) fn point(&self, node: usize) -> TiePoint {
        let dof = |k: usize| match self.of_cells[node] && k < 3 {
            true => FileDof::Cell(3 * node + k),
            false => FileDof::Other(node as u64, k),
        };
        TiePoint { dofs: std::array::from_fn(dof), at: self.nodes.positions[node] }
    }

    /// The nodes of a label or of a set; labels and names may have the name of an instance before a point. What is not there
    /// is noted.
    pub(super) fn named(&self, token: &Token, report: &mut MeshReport) -> Vec<usize> {
        let (index, sets) = (&self.nodes.named.index, &self.nodes.named.sets);
        let found = |text: &str| -> Option<&[usize]> {
            let label = whole(text).and_then(|label| u64::try_from(label).ok());
            match label {
                Some(label) => index.get(&label).map(std::slice::from_ref),
                None => sets.get(text),
            }
        };
        let text = token.text.trim_matches('"');
        let own = found(text).or_else(|| found(text.rsplit_once('.')?.1));
        if own.is_none() && !self.nodes.named.lost {
            let what = format!("no node and no set of nodes is called {text}");
            report.error(*token, what, did_you_mean(text, sets.names()));
        }
        let mut seen = BTreeSet::new();
        own.unwrap_or_default().iter().copied().filter(|&node| seen.insert(node)).collect()
    }

    /// Whether cells have a node.
    pub(super) fn is_of_cells(&self, node: usize) -> bool {
        self.of_cells[node]
    }

    /// The only node of a parameter or of a value.
    pub(super) fn single(&self, token: &Token, report: &mut MeshReport) -> Option<usize> {
        match self.named(token, report)[..] {
            [node] => Some(node),
            [] => None,
            ref many => {
                let what = format!(
                    "{} has {}, where one is needed",
                    token.text,
                    count(many.len(), "node")
                );
                report.error(*token, what, "name one node, or a set of one");
                None
            }
        }
    }
}

//! Ties: what a file says of nodes that move together beside the cells that they share.

use std::collections::BTreeSet;

use crate::sparse::Row;

/// A card by which dofs follow from others: equations Σ cᵢ uᵢ = 0 between dofs 3·node + component.
#[derive(Debug, Clone, PartialEq)]
pub struct Tie {
    /// How messages call it, such as `RBE2 12` or `*TIE BOND`.
    pub name: String,
    /// The equations; where one may be solved for its first dof, it is.
    pub rows: Vec<Row>,
}

impl Tie {
    /// The nodes that it names, ascending.
    pub fn nodes(&self) -> BTreeSet<usize> {
        self.rows.iter().flatten().map(|(dof, _)| dof / 3).collect()
    }

    /// Pairs of nodes that one equation has.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        self.rows.iter().flat_map(|row| {
            let first = row.first().map_or(0, |(dof, _)| dof / 3);
            row.iter().map(move |(dof, _)| (first, dof / 3))
        })
    }

    /// What does not fit to a mesh of so many nodes.
    pub(super) fn misfit(&self, nodes: usize) -> Option<String> {
        let Tie { name, rows } = self;
        if rows.iter().any(Vec::is_empty) {
            return Some(format!("an equation of {name} has no terms"));
        }
        let mut terms = rows.iter().flatten();
        if terms.any(|(dof, c)| *dof >= 3 * nodes || !c.is_finite()) {
            return Some(format!("{name} names a node that is not there, or has no numbers"));
        }
        None
    }
}

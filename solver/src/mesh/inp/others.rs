//! Elements that are no solids: lines, faces, shells, beams, masses, springs. They are left out and counted; sets of them
//! are sets of their nodes, as physical groups of faces are in files of Gmsh.

use std::collections::{BTreeMap, HashMap};

use super::super::raw::{Cells, LinePosition, MeshReport, NodeTable, Sets};
use super::cards::{Card, Token};

/// Elements that are left out.
#[derive(Default)]
pub(super) struct OtherElements {
    /// Number and first place by type.
    types: BTreeMap<String, (usize, LinePosition)>,
    /// Indices of the nodes of each, as far as they are there.
    pub(super) nodes: Vec<Vec<usize>>,
    pub(super) index: HashMap<u64, usize>,
    pub(super) sets: Sets,
}

impl OtherElements {
    /// Takes the elements of a card.
    pub(super) fn read(&mut self, card: &Card, nodes: &NodeTable) {
        let value = |name: &str| card.parameter(name).and_then(|parameter| parameter.value);
        let mut members = Vec::new();
        // The number of nodes is not known: a line that ends with a comma goes on in the next one.
        let mut goes_on = false;
        for (line, &open) in card.lines.iter().zip(&card.open) {
            let number = |token: &Token| token.text.parse::<u64>().ok();
            let mut labels = line.iter().map(number);
            if !goes_on {
                let index = self.nodes.len();
                self.nodes.push(Vec::new());
                members.push(index);
                if let Some(label) = labels.next().flatten() {
                    self.index.insert(label, index);
                }
            }
            if let Some(own) = self.nodes.last_mut() {
                own.extend(labels.flatten().filter_map(|label| nodes.named.index.get(&label)));
            }
            goes_on = open;
        }
        let name = value("TYPE").map_or(String::new(), |name| name.text.to_uppercase());
        self.types.entry(name).or_insert((0, card.place.into())).0 += members.len();
        if let Some(set) = value("ELSET") {
            self.sets.add(set.text, members);
        }
    }

    /// Says in one line what is left out.
    pub(super) fn tell(&self, report: &mut MeshReport) {
        let Some((_, first)) = self.types.values().min_by_key(|(_, place)| *place) else { return };
        let listed: Vec<String> =
            self.types.iter().map(|(name, (number, _))| format!("{number} {name}")).collect();
        let what = format!("left out, as only solid elements are read: {}", listed.join(", "));
        report.warn(
            *first,
            what,
            "their element sets are node sets of those of their nodes that cells have",
        );
    }

    /// Makes node sets of the sets that have no cells, unless one of that name is there.
    pub(super) fn into_node_sets(self, nodes: &mut NodeTable, cells: &Cells) {
        let mut of_cells = vec![false; nodes.positions.len()];
        cells.list.iter().flat_map(|cell| &cell.nodes).for_each(|&node| of_cells[node] = true);
        for (name, members) in self.sets.iter() {
            let taken = cells.named.sets.get(name).is_some_and(|cells| !cells.is_empty())
                || nodes.named.sets.get(name).is_some();
            let own: Vec<usize> = members
                .iter()
                .flat_map(|&element| self.nodes[element].iter().copied())
                .filter(|&node| of_cells[node])
                .collect();
            if !taken && !own.is_empty() {
                nodes.named.sets.add(name, own);
            }
        }
    }
}

//! Cards that tie nodes to one another. What they join is not joined in the mesh: where that is nodes of cells, the file
//! is refused. A spider from a node beside the cells is an interface: its node set is all that is read of it.

use std::collections::BTreeSet;

use super::super::raw::{Cells, MeshReport, NodeTable};
use super::cards::{Card, Token};

/// Cards of equations and of ties, that join all that they name.
const JOIN: [&str; 7] = [
    "EQUATION",
    "MPC",
    "TIE",
    "EMBEDDED ELEMENT",
    "SHELL TO SOLID COUPLING",
    "CYCLIC SYMMETRY MODEL",
    "FASTENER",
];
/// Cards of a reference node with the nodes that follow it, or that it follows.
const SPIDERS: [&str; 4] =
    ["COUPLING", "KINEMATIC COUPLING", "DISTRIBUTING COUPLING", "RIGID BODY"];

/// Whether a card ties nodes.
pub(super) fn is_tie(keyword: &str) -> bool {
    JOIN.contains(&keyword) || SPIDERS.contains(&keyword)
}

/// Notes what of these cards joins nodes of cells, and what of them is left out.
pub(super) fn check(cards: &[&Card], nodes: &NodeTable, cells: &Cells, report: &mut MeshReport) {
    let mut of_cells = vec![false; nodes.positions.len()];
    cells.list.iter().flat_map(|cell| &cell.nodes).for_each(|&node| of_cells[node] = true);
    let named = |token: &Token| -> Vec<usize> {
        let own = match token.text.parse() {
            Ok(label) => nodes.named.index.get(&label).map(std::slice::from_ref),
            Err(_) => nodes.named.sets.get(token.text),
        };
        own.unwrap_or_default().iter().copied().filter(|&node| of_cells[node]).collect()
    };
    let mut skipped: BTreeSet<&str> = BTreeSet::new();
    for card in cards.iter().filter(|card| is_tie(&card.keyword)) {
        let keyword = card.keyword.as_str();
        let value = |name: &str| card.parameter(name).and_then(|parameter| parameter.value);
        let solids = value("ELSET").is_some_and(|set| {
            cells.named.sets.get(set.text).is_some_and(|cells| !cells.is_empty())
        });
        let joined: BTreeSet<usize> = match SPIDERS.contains(&keyword) {
            // The others are a set that a case may name; this one would join them to its part.
            true => ["REF NODE", "PIN NSET", "TIE NSET"]
                .iter()
                .filter_map(|name| value(name))
                .flat_map(|token| named(&token))
                .collect(),
            false if keyword == "EQUATION" => of_equations(card).flat_map(named).collect(),
            false => card.lines.iter().flatten().flat_map(named).collect(),
        };
        let joins = match keyword {
            "EQUATION" | "MPC" => joined.len() > 1,
            _ => !joined.is_empty(),
        };
        if joins || solids {
            let what = format!("*{keyword} ties nodes of cells to one another, which is not read");
            let help = "let the meshes share nodes, or write a file for each body and join them in the case; for what \
                        carries a load or a bearing name a set of its nodes";
            report.error(card.place, what, help);
        } else if skipped.insert(keyword) {
            let (what, help) = match SPIDERS.contains(&keyword) {
                true => (
                    format!(
                        "*{keyword} is not rigid here: a joint at a set of its nodes sees their mean motion"
                    ),
                    "where the part is stiff, mesh it",
                ),
                false => (format!("*{keyword} is left out: it joins no two nodes of cells"), ""),
            };
            report.warn(card.place, what, help);
        }
    }
}

/// The nodes of equations: a line with the number of terms, then a node, a component and a coefficient a term.
fn of_equations<'c, 'a>(card: &'c Card<'a>) -> impl Iterator<Item = &'c Token<'a>> {
    let mut terms = 0;
    card.lines.iter().flat_map(move |line| {
        let first = match terms {
            0 => {
                terms = line.first().and_then(|number| number.text.parse().ok()).unwrap_or(0);
                line.len()
            }
            _ => {
                terms = usize::saturating_sub(terms, line.len().div_ceil(3));
                0
            }
        };
        line.iter().skip(first).step_by(3)
    })
}

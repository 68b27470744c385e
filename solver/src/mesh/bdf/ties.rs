//! Cards that tie nodes to one another, such as `MPC` and `RBAR`. What they join is not joined in the mesh: where that is
//! two nodes of solid elements, the file is refused.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use super::super::raw::{LinePosition, MeshReport, list};
use super::cells::Cells;
use super::fields::Card;
use super::known::BY_SPIDERS;
use super::numbers;

/// A card as written.
pub(super) struct Tie {
    name: String,
    /// Its label; that of an `MPC` is the one of its set.
    label: Option<u64>,
    /// Labels of its nodes, among which components may be.
    nodes: BTreeSet<u64>,
    place: LinePosition,
}

impl Tie {
    pub(super) fn read(card: &Card) -> Tie {
        let at = |at: usize| numbers::whole(card.field(at)?.text);
        let nodes: BTreeSet<u64> = match card.name.as_ref() {
            // Node, component and coefficient, twice a line.
            "MPC" => (0..card.fields.len())
                .filter(|i| [1, 4].contains(&(i % 8)))
                .filter_map(at)
                .collect(),
            "RBAR" | "RBAR1" | "RROD" => (1..3).filter_map(at).collect(),
            "RTRPLT" | "RTRPLT1" => (1..4).filter_map(at).collect(),
            _ => (1..card.fields.len()).filter_map(at).collect(),
        };
        Tie { name: card.name.to_string(), label: at(0), nodes, place: card.place }
    }
}

/// Refuses cards that join nodes of cells; gives the others.
pub(super) fn refuse(
    ties: &[Tie],
    cells: &Cells,
    report: &mut MeshReport,
) -> Vec<(String, LinePosition)> {
    let of_cells: HashSet<u64> = if ties.is_empty() {
        HashSet::new()
    } else {
        cells.list.iter().flat_map(|cell| cell.nodes.iter().copied()).collect()
    };
    let mut refused: BTreeMap<&str, Vec<&Tie>> = BTreeMap::new();
    let mut others = Vec::new();
    for tie in ties {
        match tie.nodes.iter().filter(|node| of_cells.contains(node)).count() {
            0 | 1 => others.push((tie.name.clone(), tie.place)),
            _ => refused.entry(&tie.name).or_default().push(tie),
        }
    }
    for (name, own) in refused {
        let labels = list(own.iter().filter_map(|tie| tie.label));
        let all = match own.len() {
            1 => String::new(),
            number => format!(" ({number} cards)"),
        };
        let what = format!(
            "{name} {labels} ties nodes of elements to one another, which is not read{all}"
        );
        report.error(own[0].place, what, BY_SPIDERS);
    }
    others
}

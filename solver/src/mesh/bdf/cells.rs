//! Solid elements.

use std::collections::HashMap;

use whirl_specs::Element;

use super::super::raw::{FACE_MIDDLES, LinePosition, MeshReport, count, has_face_middles, list};
use super::fields::{Card, Field};
use super::nodes::Grids;

/// A solid element as written.
#[derive(Debug, Clone)]
pub(super) struct RawCell {
    pub(super) label: u64,
    pub(super) property: u64,
    /// `None` where the card is wrong, which is an error by itself.
    pub(super) element: Option<&'static Element>,
    /// Labels of the nodes, in the order of the card; 0 where an edge has none.
    pub(super) nodes: Vec<u64>,
    pub(super) place: LinePosition,
}

/// Solid elements in the order of the file.
#[derive(Debug)]
pub(super) struct Cells {
    elements: Vec<&'static Element>,
    pub(super) list: Vec<RawCell>,
    index: HashMap<u64, usize>,
}

/// Cards of solid elements, with their corners; the other nodes stand on edges.
const SOLIDS: [(&str, usize); 4] = [("CTETRA", 4), ("CPYRAM", 5), ("CPENTA", 6), ("CHEXA", 8)];

impl Cells {
    /// None so far, of these elements.
    pub(super) fn new(elements: &[&'static Element]) -> Cells {
        Cells { elements: elements.to_vec(), list: Vec::new(), index: HashMap::new() }
    }

    /// Whether a card is one of a solid element.
    pub(super) fn are(&self, name: &str) -> bool {
        SOLIDS.iter().any(|(solid, _)| *solid == name) || self.called(name).next().is_some()
    }

    fn called(&self, name: &str) -> impl Iterator<Item = &'static Element> {
        let is = move |element: &&Element| {
            element.nastran.is_some_and(|(card, _)| card.eq_ignore_ascii_case(name))
        };
        self.elements.iter().copied().filter(is)
    }

    pub(super) fn read(&mut self, card: &Card, report: &mut MeshReport) {
        let Some(label) = report.label(card, 0, "label of the element") else { return };
        let property = match card.field(1) {
            Some(_) => report.label(card, 1, "property").unwrap_or(0),
            None => label,
        };
        let mut fields: Vec<&Field> = card.fields.iter().skip(2).collect();
        let is_blank = |field: &&Field| field.text.is_empty() || field.text == "0";
        while fields.last().is_some_and(is_blank) {
            fields.pop();
        }
        let mut element = self.element(label, card, &fields, report);
        let mut nodes = Vec::with_capacity(fields.len());
        for field in fields {
            let node = match is_blank(&field) {
                true => Some(0),
                false => report.label_in(card, field, "label of a node"),
            };
            // A label that cannot be read is an error by itself.
            let Some(node) = node else {
                element = None;
                continue;
            };
            nodes.push(node);
        }
        if let Some(element) = element {
            nodes.resize(element.nodes, 0);
        }
        if let Some(&first) = self.index.get(&label) {
            let line = report.line(self.list[first].place, card.place);
            let what = format!("element {label} is defined twice");
            report.error(
                card.place,
                what,
                format!("{line} has the first; give this one another label"),
            );
            return;
        }
        self.index.insert(label, self.list.len());
        self.list.push(RawCell { label, property, element, nodes, place: card.place });
    }

    /// The element of a card by the nodes that it has.
    fn element(
        &self,
        label: u64,
        card: &Card,
        fields: &[&Field],
        report: &mut MeshReport,
    ) -> Option<&'static Element> {
        let name = &card.name;
        let blank: Vec<usize> = (0..fields.len())
            .filter(|&at| fields[at].text.is_empty() || fields[at].text == "0")
            .collect();
        let known: Vec<usize> = self.called(name).map(|element| element.nodes).collect();
        let corners =
            SOLIDS.iter().find(|(solid, _)| *solid == name.as_ref()).map(|(_, corners)| *corners);
        let corners = corners.or(known.iter().min().copied()).unwrap_or(0);
        let edges = corners.min(fields.len());
        let lacking = blank.iter().filter(|&&at| at < edges).count() + corners - edges;
        if lacking > 0 {
            let what = format!("{name} {label} lacks {} of its {corners} corners", lacking);
            let help = "list all corners behind label and property; the card may have lost its continuation";
            report.error(card.place, what, help);
            return None;
        }
        let found = self.called(name).find(|element| element.nodes == fields.len());
        if found.is_some() && blank.is_empty() {
            return found;
        }
        let full = match corners {
            4 => 10,
            5 => 13,
            6 => 15,
            8 => 20,
            other => known.iter().max().copied().unwrap_or(other),
        };
        if fields.len() > full {
            let what = format!(
                "{name} {label} has {}, it can have {full} at most",
                count(fields.len(), "node")
            );
            let help = match has_face_middles(fields.len()) {
                true => FACE_MIDDLES,
                false => "take out what stands behind its last node",
            };
            report.error(fields[full].place, what, help);
        } else if let Some(element) = self.called(name).find(|element| element.nodes == full) {
            // Edges without a node get one in their middle.
            return Some(element);
        } else {
            let what = format!("no element is known for {name} {label} with nodes on its edges");
            let help = match known.contains(&corners) {
                true => format!(
                    "write {name} with its {corners} corners only, or mesh this part with other elements"
                ),
                false => "mesh this part with other elements".to_owned(),
            };
            report.error(card.place, what, help);
        }
        None
    }

    /// Notes nodes of cells that are not there, or that a cell has twice.
    pub(super) fn check_nodes(&self, grids: &Grids, report: &mut MeshReport) {
        let mut sorted: Vec<u64> = Vec::new();
        for cell in self.list.iter().filter(|cell| cell.element.is_some()) {
            let label = cell.label;
            let named = || cell.nodes.iter().filter(|node| **node > 0);
            let missing = || named().filter(|node| grids.place_of(**node).is_none());
            let help = "add its GRID, or correct the label";
            match missing().count() {
                0 => {}
                _ if grids.lost => {}
                1 => {
                    let what = format!(
                        "element {label} has node {}, which is not defined",
                        list(missing())
                    );
                    report.error(cell.place, what, help);
                }
                _ => {
                    let what = format!(
                        "element {label} has nodes {}, which are not defined",
                        list(missing())
                    );
                    report.error(cell.place, what, "add their GRID, or correct the labels");
                }
            }
            sorted.clear();
            sorted.extend(named());
            sorted.sort_unstable();
            if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
                let what = format!("element {label} has node {} twice", pair[0]);
                let help = "correct the label, or use an element with fewer nodes, such as CPENTA for CHEXA";
                report.error(cell.place, what, help);
            }
        }
    }
}

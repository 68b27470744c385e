//! Nodes, cells and the sections that give cells their material.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use whirl_specs::Element;

use super::cards::{Card, Token};
use super::materials::RawMaterial;
use super::sets::{Labelled, did_you_mean};
use super::{LinePosition, MeshReport, NodeTable, count, list};

/// A cell as written.
#[derive(Debug, Clone)]
pub(super) struct RawCell {
    pub(super) label: u64,
    /// `None` where the type is not known, which is an error by itself.
    pub(super) element: Option<&'static Element>,
    /// Labels of the nodes, in the order of the file.
    pub(super) nodes: Vec<u64>,
}

/// Cells in the order of the file.
pub(super) struct Cells {
    pub(super) list: Vec<RawCell>,
    pub(super) named: Labelled,
}

impl Cells {
    /// Notes cells that have the nodes of others, and would give them their stiffness and mass again.
    pub(super) fn stand_once(&self, report: &mut MeshReport) {
        let mut first: HashMap<Vec<u64>, usize> = HashMap::new();
        let mut again = Vec::new();
        for (place, cell) in self.list.iter().enumerate().filter(|(_, cell)| !cell.nodes.is_empty())
        {
            let mut nodes = cell.nodes.clone();
            nodes.sort_unstable();
            match first.entry(nodes) {
                Entry::Occupied(other) => again.push((place, *other.get())),
                Entry::Vacant(free) => drop(free.insert(place)),
            }
        }
        let Some(&(place, other)) = again.first() else { return };
        let label = |place: usize| self.list[place].label;
        let line = self.named.places[other].line;
        let (what, help) = match again.len() {
            1 => (
                format!("cell {} has the nodes of cell {}", label(place), label(other)),
                format!("take one of them out: line {line} has the first"),
            ),
            number => (
                format!(
                    "{number} cells have the nodes of others: {}; cell {} those of cell {}",
                    list(again.iter().map(|&(place, _)| label(place))),
                    label(place),
                    label(other)
                ),
                format!("take them out, or their originals, of which line {line} has the first"),
            ),
        };
        report.error(self.named.places[place], what, help);
    }
}

pub(super) fn read_nodes(cards: &[&Card], report: &mut MeshReport) -> NodeTable {
    let mut nodes = NodeTable { positions: Vec::new(), named: Labelled::new("node") };
    for card in cards.iter().filter(|card| card.keyword == "NODE") {
        if let Some(system) = card.parameter("SYSTEM") {
            report.error(system.place, "only rectangular coordinates are read", "write x, y, z");
        }
        let mut members = Vec::new();
        for line in &card.lines {
            let Some(token) = line.first() else { continue };
            let Some(label) = report.label(token, "label of a node") else { continue };
            let mut position = [0.0; 3];
            if line.len() == 4 {
                for (value, token) in position.iter_mut().zip(&line[1..]) {
                    *value = report.number(token, "coordinate").unwrap_or(0.0);
                }
            } else {
                let what = format!("node {label} has {}", count(line.len() - 1, "coordinate"));
                report.error(*token, what, "write label, x, y, z");
            }
            if let Some(index) = nodes.named.add(label, token, report) {
                nodes.positions.push(position);
                members.push(index);
            }
        }
        if let Some(name) = card.parameter("NSET").and_then(|parameter| parameter.value) {
            nodes.named.sets.add(name.text, members);
        }
    }
    nodes
}

pub(super) fn read_elements(
    cards: &[&Card],
    elements: &[&'static Element],
    nodes: &NodeTable,
    report: &mut MeshReport,
) -> Cells {
    let mut cells = Cells { list: Vec::new(), named: Labelled::new("cell") };
    for card in cards.iter().filter(|card| card.keyword == "ELEMENT") {
        let element = element(card, elements, report);
        let mut members = Vec::new();
        for tokens in cell_lines(card, element) {
            let Some(&token) = tokens.first() else { continue };
            let Some(label) = report.label(&token, "label of a cell") else { continue };
            let nodes = match element {
                Some(element) => cell_nodes(label, &tokens, element, nodes, report),
                None => Vec::new(),
            };
            if let Some(index) = cells.named.add(label, &token, report) {
                cells.list.push(RawCell { label, element, nodes });
                members.push(index);
            }
        }
        if let Some(name) = card.parameter("ELSET").and_then(|parameter| parameter.value) {
            cells.named.sets.add(name.text, members);
        }
    }
    cells
}

fn element(
    card: &Card,
    elements: &[&'static Element],
    report: &mut MeshReport,
) -> Option<&'static Element> {
    let name = report.required(card, "TYPE", "*ELEMENT, TYPE=C3D8I, ELSET=NAME")?;
    let is_named = |element: &&&Element| {
        element.abaqus.iter().any(|known| known.eq_ignore_ascii_case(name.text))
    };
    let found = elements.iter().find(is_named).copied();
    if found.is_none() {
        let types: Vec<&str> =
            elements.iter().flat_map(|element| element.abaqus.iter().copied()).collect();
        let known = format!("types that are read: {}", types.join(", "));
        let help = match alike(name.text, &types) {
            Some(other) => {
                format!(
                    "write TYPE={other}, an element of the same nodes in the same order; {known}"
                )
            }
            None => known,
        };
        report.error(name, format!("no element is known for type {}", name.text), help);
    }
    found
}

/// The type among `types` that has as many nodes as `name`, as its number says: for elements that differ in
/// their integration (R), are hybrid (H) or modified (M). One with incompatible modes, if there is any.
fn alike<'t>(name: &str, types: &[&'t str]) -> Option<&'t str> {
    let name = name.to_uppercase();
    let stem = name.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let numbered = stem.starts_with("C3D") && stem.ends_with(|c: char| c.is_ascii_digit());
    let mut fitting: Vec<&str> = types
        .iter()
        .copied()
        .filter(|known| {
            let rest = known.strip_prefix(stem);
            numbered && rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
        })
        .collect();
    fitting.sort_by_key(|known| !known.ends_with('I'));
    fitting.first().copied()
}

/// The tokens of each cell: a cell goes on in the next line until it has all its nodes.
fn cell_lines<'a>(card: &Card<'a>, element: Option<&Element>) -> Vec<Vec<Token<'a>>> {
    let Some(element) = element else { return card.lines.clone() };
    let mut cells: Vec<Vec<Token>> = Vec::new();
    for line in &card.lines {
        match cells.last_mut() {
            Some(cell)
                if cell.len() <= element.nodes && cell.len() + line.len() <= element.nodes + 1 =>
            {
                cell.extend(line);
            }
            _ => cells.push(line.clone()),
        }
    }
    cells
}

fn cell_nodes(
    label: u64,
    tokens: &[Token],
    element: &Element,
    nodes: &NodeTable,
    report: &mut MeshReport,
) -> Vec<u64> {
    if tokens.len() != element.nodes + 1 {
        let what = format!(
            "cell {label} has {}, {} needs {}",
            count(tokens.len() - 1, "node"),
            element.origin.name,
            element.nodes
        );
        report.error(tokens[0], what, "write label, then the nodes");
        return Vec::new();
    }
    let mut list: Vec<u64> = Vec::with_capacity(element.nodes);
    for token in &tokens[1..] {
        let Some(node) = report.label(token, "label of a node") else { continue };
        if !nodes.named.index.contains_key(&node) {
            let what = format!("cell {label} has node {node}, which is not defined");
            report.error(*token, what, "add it under *NODE, or correct the label");
        } else if list.contains(&node) {
            let what = format!("cell {label} has node {node} twice");
            report.error(*token, what, "correct the label, or use an element with fewer nodes");
        }
        list.push(node);
    }
    list
}

/// Index of the material of every cell, from `*SOLID SECTION`; one beyond the materials for those that have
/// none, where the sections are left `open`. Errors for cells with none otherwise, or with two.
pub(super) fn assign_sections(
    cards: &[&Card],
    cells: &Cells,
    materials: &[RawMaterial],
    open: bool,
    report: &mut MeshReport,
) -> Vec<usize> {
    let mut material_of: Vec<Option<(usize, LinePosition)>> = vec![None; cells.list.len()];
    let mut all_found = cells.named.complete;
    for card in cards.iter().filter(|card| card.keyword == "SOLID SECTION") {
        let example = "*SOLID SECTION, ELSET=NAME, MATERIAL=NAME";
        let set = report.required(card, "ELSET", example);
        let material = report.required(card, "MATERIAL", example);
        let members = set.and_then(|set| {
            let members = cells.named.sets.get(set.text);
            if members.is_none() {
                let what = format!("no set of cells is called {}", set.text);
                report.error(set, what, did_you_mean(set.text, cells.named.sets.names()));
            }
            members
        });
        let material = material.and_then(|name| {
            let same = |raw: &RawMaterial| raw.name.eq_ignore_ascii_case(name.text);
            let found = materials.iter().position(same);
            if found.is_none() {
                let known = materials.iter().map(|raw| raw.name.as_str());
                let what = format!("no material is called {}", name.text);
                report.error(name, what, did_you_mean(name.text, known));
            }
            found
        });
        let Some(members) = members else {
            all_found = false;
            continue;
        };
        // An unknown material has been reported: its cells count as having a section.
        let material = material.unwrap_or(0);
        let mut twice = Vec::new();
        for &cell in members {
            match material_of[cell] {
                Some((other, _)) if other != material => twice.push(cells.list[cell].label),
                _ => material_of[cell] = Some((material, card.place.into())),
            }
        }
        if let Some(first) = twice.first() {
            let above = cells.named.index[first];
            let line = material_of[above].map_or(0, |(_, place)| place.line);
            let what = format!(
                "{} with two materials: {}",
                count(twice.len(), "cell"),
                list(twice.iter().copied())
            );
            report.error(card.place, what, format!("line {line} gave the first"));
        }
    }
    // Where a set is not there or not whole, cells without a section are no further error.
    let bare: Vec<usize> = (0..cells.list.len()).filter(|&c| material_of[c].is_none()).collect();
    if let Some(&first) = bare.first().filter(|_| all_found && !open) {
        let labels = list(bare.iter().map(|&cell| cells.list[cell].label));
        let what = format!("{} without a section: {labels}", count(bare.len(), "cell"));
        let help = "add *SOLID SECTION, ELSET=…, MATERIAL=… for a set that holds them; in a case `material` \
                    serves, too";
        report.error(cells.named.places[first], what, help);
    }
    let none = materials.len();
    material_of.into_iter().map(|section| section.map_or(none, |(material, _)| material)).collect()
}

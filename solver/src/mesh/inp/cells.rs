//! Nodes, cells and the sections that give cells their material.

use std::collections::BTreeMap;

use whirl_specs::Element;

use super::super::raw::{
    Cells, LinePosition, MeshReport, NodeTable, RawCell, RawMaterial, count, did_you_mean,
    in_own_order, list,
};
use super::assembly::Assembly;
use super::cards::{Card, Token};
use super::others::OtherElements;
use super::types::{self, Kind, Remark};
use super::values::{label, number, required};

pub(super) fn read_nodes(
    cards: &[&Card],
    assembly: &Assembly,
    report: &mut MeshReport,
) -> NodeTable {
    let mut nodes = NodeTable::new();
    for card in cards.iter().filter(|card| card.keyword == "NODE") {
        let motion = assembly.motion(card.owner);
        if let Some(system) = card.parameter("SYSTEM")
            && !system.value.is_some_and(|value| value.text.eq_ignore_ascii_case("R"))
        {
            report.error(system.place, "only rectangular coordinates are read", "write x, y, z");
        }
        let mut members = Vec::new();
        for line in &card.lines {
            let Some(token) = line.first() else { continue };
            let Some(label) = label(token, "label of a node", report) else {
                nodes.named.lost = true;
                continue;
            };
            // What is left out is 0; behind z a normal may stand, which says nothing of solids.
            let mut position = [0.0; 3];
            let given = line[1..].iter().zip(&mut position);
            for (token, value) in given.filter(|(token, _)| !token.text.is_empty()) {
                *value = number(token, "coordinate", report).unwrap_or(0.0);
            }
            if line.len() > 7 {
                let what = format!("node {label} has {}", count(line.len() - 1, "coordinate"));
                report.error(*token, what, "write label, x, y, z");
            }
            let position = motion.place(position);
            // A node may stand twice, where two files share it.
            let known = nodes.named.index.get(&label).copied();
            if let Some(known) = known.filter(|&known| nodes.positions[known] == position) {
                members.push(known);
            } else if let Some(index) = nodes.named.add(label, *token, report) {
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

/// Reads the solids, and notes what else there is.
pub(super) fn read_elements(
    cards: &[&Card],
    elements: &[&'static Element],
    nodes: &NodeTable,
    report: &mut MeshReport,
) -> (Cells, OtherElements) {
    let mut cells = Cells::new();
    let mut others = OtherElements::default();
    let mut remarks: BTreeMap<String, (usize, LinePosition, Remark)> = BTreeMap::new();
    for card in cards.iter().filter(|card| card.keyword == "ELEMENT") {
        let set = card.parameter("ELSET").and_then(|parameter| parameter.value);
        let (element, remark) = match types::of_card(card, elements, report) {
            Kind::Solid(element, remark) => (element, remark),
            Kind::LeftOut => {
                others.read(card, nodes);
                if let Some(set) = set {
                    cells.named.sets.add(set.text, []);
                }
                continue;
            }
            Kind::Refused => {
                cells.named.lost = true;
                continue;
            }
        };
        let mut members = Vec::new();
        for tokens in cell_lines(card, element) {
            let Some(&token) = tokens.first() else { continue };
            let Some(label) = label(&token, "label of a cell", report) else {
                cells.named.lost = true;
                continue;
            };
            let nodes = cell_nodes(label, &tokens, element, nodes, report);
            if let Some(index) = cells.named.add(label, token, report) {
                cells.list.push(RawCell { element: Some(element), nodes });
                members.push(index);
            }
        }
        if let Some(remark) = remark {
            let name = card.parameter("TYPE").and_then(|kind| kind.value);
            let name = name.map_or(String::new(), |name| name.text.to_uppercase());
            let new = (0, card.place.into(), remark);
            remarks.entry(name).or_insert(new).0 += members.len();
        }
        if let Some(set) = set {
            cells.named.sets.add(set.text, members);
        }
    }
    for (name, (number, place, Remark { what, difference })) in remarks {
        let what = format!("{} of {name} {what}", count(number, "cell"));
        report.warn(place, what, difference);
    }
    others.tell(report);
    (cells, others)
}

/// The tokens of each cell: a cell goes on in the next line until it has all its nodes.
fn cell_lines<'a>(card: &Card<'a>, element: &Element) -> Vec<Vec<Token<'a>>> {
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

/// Indices of the nodes, in the element's own order; none after an error.
fn cell_nodes(
    cell: u64,
    tokens: &[Token],
    element: &Element,
    nodes: &NodeTable,
    report: &mut MeshReport,
) -> Vec<usize> {
    if tokens.len() != element.nodes + 1 {
        let what = format!(
            "cell {cell} has {}, {} needs {}",
            count(tokens.len() - 1, "node"),
            element.origin.name,
            element.nodes
        );
        report.error(tokens[0], what, "write label, then the nodes");
        return Vec::new();
    }
    let mut listed: Vec<usize> = Vec::with_capacity(element.nodes);
    for token in &tokens[1..] {
        let Some(node) = label(token, "label of a node", report) else { continue };
        match nodes.named.index.get(&node) {
            None if nodes.named.lost => {}
            None => {
                let what = format!("cell {cell} has node {node}, which is not defined");
                report.error(*token, what, "add it under *NODE, or correct the label");
            }
            Some(index) if listed.contains(index) => {
                let what = format!("cell {cell} has node {node} twice");
                report.error(*token, what, "correct the label, or use an element with fewer nodes");
            }
            Some(&index) => listed.push(index),
        }
    }
    match listed.len() == element.nodes {
        true => in_own_order(&listed, element.abaqus_order),
        false => Vec::new(),
    }
}

/// Index of the material of every cell that has one, from `*SOLID SECTION`, and whether no set or member of one
/// was lost. Errors for cells with two.
pub(super) fn assign_sections(
    cards: &[&Card],
    cells: &Cells,
    materials: &[RawMaterial],
    report: &mut MeshReport,
) -> (Vec<Option<usize>>, bool) {
    let mut material_of: Vec<Option<(usize, LinePosition)>> = vec![None; cells.list.len()];
    let mut all_found = cells.named.complete && !cells.named.lost;
    for card in cards.iter().filter(|card| card.keyword == "SOLID SECTION") {
        let example = "*SOLID SECTION, ELSET=NAME, MATERIAL=NAME";
        let set = required(card, "ELSET", example, report);
        let material = required(card, "MATERIAL", example, report);
        let members = set.and_then(|set| {
            let members = cells.named.sets.get(set.text);
            if members.is_none() && !cells.named.lost {
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
        let mut twice = Vec::new();
        for &cell in members {
            // An unknown material has been reported: its cells count as having a section.
            let Some(material) = material else {
                material_of[cell].get_or_insert((usize::MAX, card.place.into()));
                continue;
            };
            match material_of[cell] {
                Some((usize::MAX, _)) => {}
                Some((other, _)) if other != material => twice.push(cells.named.labels[cell]),
                _ => material_of[cell] = Some((material, card.place.into())),
            }
        }
        if let Some(first) = twice.first() {
            let above = cells.named.index[first];
            let line = material_of[above]
                .map_or(String::new(), |(_, place)| report.line(place, card.place.into()));
            let what = format!(
                "{} with two materials: {}",
                count(twice.len(), "cell"),
                list(twice.iter().copied())
            );
            report.error(card.place, what, format!("{line} gave the first"));
        }
    }
    let sections = material_of.into_iter().map(|section| section.map(|(material, _)| material));
    (sections.collect(), all_found)
}

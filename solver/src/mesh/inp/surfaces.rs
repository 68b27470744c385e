//! `*SURFACE`: node sets of the nodes of faces, or of nodes.

use std::collections::HashMap;

use whirl_specs::{Element, Face};

use super::super::raw::{Cells, FaceOfCell, MeshReport, NodeTable, did_you_mean};
use super::cards::{Card, Token};
use super::combined::{self, Surfaces};
use super::others::OtherElements;
use super::values::{label, required};

/// Corners of the faces S1, S2, … by their places in a line of the file, from 0.
const TETRAHEDRON: &[&[usize]] = &[&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]];
const PYRAMID: &[&[usize]] = &[&[0, 1, 2, 3], &[0, 4, 1], &[1, 4, 2], &[2, 4, 3], &[3, 4, 0]];
const WEDGE: &[&[usize]] = &[&[0, 1, 2], &[3, 5, 4], &[0, 3, 4, 1], &[1, 4, 5, 2], &[2, 5, 3, 0]];
const HEXAHEDRON: &[&[usize]] =
    &[&[0, 1, 2, 3], &[4, 7, 6, 5], &[0, 4, 5, 1], &[1, 5, 6, 2], &[2, 6, 7, 3], &[3, 7, 4, 0]];

/// Corners of all faces of an element, by their places in a line of the file.
fn corners(element: &Element) -> &'static [&'static [usize]] {
    match (element.faces.len(), element.nodes) {
        (4, _) => TETRAHEDRON,
        (5, 5 | 13) => PYRAMID,
        (5, _) => WEDGE,
        (6, _) => HEXAHEDRON,
        _ => &[],
    }
}

/// Corners in a mesh of the faces of a cell, in ascending order.
fn corner_nodes<'c>(
    element: &'static Element,
    nodes: &'c [usize],
) -> impl Iterator<Item = Vec<usize>> + 'c {
    corners(element).iter().map(move |face| {
        let own = face.iter().map(|&corner| nodes[element.abaqus_order[corner]]);
        let mut own: Vec<usize> = own.collect();
        own.sort_unstable();
        own
    })
}

/// Which faces one cell only has, by their corners.
#[derive(Default)]
struct Exposed(HashMap<Vec<usize>, bool>);

impl Exposed {
    /// Counts the faces of all cells, at first use.
    fn of(&mut self, cells: &Cells) {
        let own = cells.list.iter().filter(|_| self.0.is_empty());
        let mut all = HashMap::new();
        for cell in own.filter(|cell| !cell.nodes.is_empty()) {
            for face in cell.element.iter().flat_map(|own| corner_nodes(own, &cell.nodes)) {
                all.entry(face).and_modify(|exposed| *exposed = false).or_insert(true);
            }
        }
        self.0.extend(all);
    }

    /// Numbers of the faces of a cell, from 1.
    fn faces(&self, element: &'static Element, nodes: &[usize]) -> Vec<usize> {
        let all = (1..).zip(corner_nodes(element, nodes));
        all.filter(|(_, own)| self.0.get(own) == Some(&true)).map(|(number, _)| number).collect()
    }
}

/// Face `number` (from 1) of an element.
fn face(element: &'static Element, number: usize) -> Option<&'static Face> {
    let corners = corners(element).get(number.checked_sub(1)?)?;
    let of_face = |nodes: &[usize]| {
        corners.iter().all(|&corner| nodes.contains(&element.abaqus_order[corner]))
    };
    element.faces.iter().find(|face| of_face(face.nodes))
}

/// Reads the surfaces: faces of cells and sets of them, or nodes and sets of them. All are node sets; the faces are given.
pub(super) fn read(
    cards: &[&Card],
    nodes: &mut NodeTable,
    (cells, others): (&Cells, &OtherElements),
    report: &mut MeshReport,
) -> Surfaces {
    let mut surfaces = Surfaces::new();
    let mut exposed = Exposed::default();
    for card in cards.iter().filter(|card| card.keyword == "SURFACE") {
        let Some(name) = required(card, "NAME", "*SURFACE, NAME=BORE, TYPE=ELEMENT", report) else {
            continue;
        };
        let kind = card.parameter("TYPE").and_then(|parameter| parameter.value);
        let (mut members, mut faces) = (Vec::new(), Vec::new());
        // An error of its own.
        if card.parameter("CROP").is_some() {
            continue;
        }
        match kind.map_or("ELEMENT".to_owned(), |kind| kind.text.to_uppercase()).as_str() {
            _ if card.parameter("COMBINE").is_some() => {
                let Some(how) = required(card, "COMBINE", "COMBINE=UNION", report) else {
                    continue;
                };
                let found = combined::of_others(card, how, (nodes, &surfaces), report);
                let Some((own, of_cells)) = found else { continue };
                // Nodes of faces are those of the faces that remain.
                let of_faces = of_cells.iter().flat_map(|&(cell, face)| {
                    face.nodes.iter().map(move |&place| cells.list[cell].nodes[place])
                });
                members = if of_cells.is_empty() { own } else { of_faces.collect() };
                faces = of_cells;
            }
            "ELEMENT" => {
                for line in &card.lines {
                    let found = (&mut members, &mut faces);
                    of_faces(line, (cells, others, &mut exposed), found, report);
                }
            }
            "NODE" => {
                for line in &card.lines {
                    of_nodes(line, nodes, &mut members, report);
                }
            }
            other => {
                let what = format!("*SURFACE of type {other} is left out");
                report.warn(card.place, what, "write TYPE=ELEMENT or TYPE=NODE");
                continue;
            }
        }
        if nodes.named.sets.get(name.text).is_some() {
            let what = format!(
                "the surface {} has the name of a node set or of another surface: the node set holds the nodes \
                 of both",
                name.text
            );
            report.warn(name, what, "rename one of them");
        }
        nodes.named.sets.add(name.text, members);
        surfaces.entry(name.text.to_uppercase()).or_default().extend(faces);
    }
    surfaces
}

/// A line such as `OUTER, S2` or `17, S2`; of faces that are elements themselves it has their nodes. Without a face it has those
/// that no other cell has, without cells those of all.
fn of_faces(
    line: &[Token],
    (cells, others, exposed): (&Cells, &OtherElements, &mut Exposed),
    (members, faces): (&mut Vec<usize>, &mut Vec<FaceOfCell>),
    report: &mut MeshReport,
) {
    let Some(&whose) = line.first() else { return };
    let at = line.get(1).filter(|token| !token.text.is_empty());
    let all: Vec<usize>;
    let named = if is_label(&whose) { label(&whose, "label of a cell", report) } else { None };
    let (chosen, left) = match named {
        Some(label) => (
            cells.named.index.get(&label).map(std::slice::from_ref),
            others.index.get(&label).map(std::slice::from_ref),
        ),
        None if whose.text.is_empty() => {
            all = (0..cells.list.len()).collect();
            (Some(&all[..]), None)
        }
        None => (cells.named.sets.get(whose.text), others.sets.get(whose.text)),
    };
    let left = left.unwrap_or_default();
    // E1, E2, … are edges of theirs.
    if at.is_none_or(|at| !at.text.to_uppercase().starts_with('E')) {
        members.extend(left.iter().flat_map(|&element| &others.nodes[element]));
    }
    if !left.is_empty() && chosen.is_none_or(<[usize]>::is_empty) {
        return;
    }
    let Some(chosen) = chosen else {
        if !cells.named.lost {
            let what = format!("no cell and no set of cells is called {}", whose.text);
            report.error(whose, what, did_you_mean(whose.text, cells.named.sets.names()));
        }
        return;
    };
    let number =
        at.map(|at| (at, at.text.strip_prefix(['S', 's']).and_then(|own| own.parse().ok())));
    if let Some((at, None)) = number {
        let what = format!("a face of cells is S1, S2, …, found `{}`", at.text);
        report.error(*at, what, "write its number, or the cells alone for all their outer faces");
        return;
    }
    if number.is_none() {
        exposed.of(cells);
    }
    for &index in chosen {
        let cell = &cells.list[index];
        let Some(element) = cell.element.filter(|_| !cell.nodes.is_empty()) else { continue };
        let numbers = match number {
            Some((_, number)) => number.into_iter().collect(),
            None => exposed.faces(element, &cell.nodes),
        };
        for number in numbers {
            match face(element, number) {
                Some(face) => {
                    members.extend(face.nodes.iter().map(|&place| cell.nodes[place]));
                    faces.push((index, face));
                }
                None => {
                    let what = format!("{} has no face S{number}", element.origin.name);
                    let help = format!("its faces are S1 to S{}", element.faces.len());
                    report.error(at.copied().unwrap_or(whose), what, help);
                    return;
                }
            }
        }
    }
}

/// A line such as `TIPS` or `17`, which an area may follow.
fn of_nodes(line: &[Token], nodes: &NodeTable, members: &mut Vec<usize>, report: &mut MeshReport) {
    let Some(&whose) = line.first() else { return };
    if !is_label(&whose) {
        match nodes.named.sets.get(whose.text) {
            Some(set) => members.extend(set),
            None if nodes.named.lost => {}
            None => {
                let what = format!("no set of nodes is called {}", whose.text);
                report.error(whose, what, did_you_mean(whose.text, nodes.named.sets.names()));
            }
        }
    } else if let Some(label) = label(&whose, "label of a node", report) {
        match nodes.named.index.get(&label) {
            Some(&node) => members.push(node),
            None if nodes.named.lost => {}
            None => {
                let help = "define it, or take it out of the surface";
                report.error(whose, format!("node {label} is not defined"), help);
            }
        }
    }
}

fn is_label(token: &Token) -> bool {
    token.text.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+')
}

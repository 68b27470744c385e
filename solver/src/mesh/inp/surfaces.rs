//! `*SURFACE`: node sets of the nodes of faces, or of nodes.

use std::collections::BTreeMap;

use whirl_specs::{Element, Face};

use super::super::raw::{Cells, FaceOfCell, MeshReport, NodeTable, did_you_mean};
use super::cards::{Card, Token};
use super::others::OtherElements;
use super::values::{label, required};

/// Corners of the faces S1, S2, … by their places in a line of the file, from 0.
const TETRAHEDRON: &[&[usize]] = &[&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]];
const PYRAMID: &[&[usize]] = &[&[0, 1, 2, 3], &[0, 4, 1], &[1, 4, 2], &[2, 4, 3], &[3, 4, 0]];
const WEDGE: &[&[usize]] = &[&[0, 1, 2], &[3, 5, 4], &[0, 3, 4, 1], &[1, 4, 5, 2], &[2, 5, 3, 0]];
const HEXAHEDRON: &[&[usize]] =
    &[&[0, 1, 2, 3], &[4, 7, 6, 5], &[0, 4, 5, 1], &[1, 5, 6, 2], &[2, 6, 7, 3], &[3, 7, 4, 0]];

/// Faces of cells by the names of surfaces, in capitals.
pub(super) type Surfaces = BTreeMap<String, Vec<FaceOfCell>>;

/// Face `number` (from 1) of an element.
fn face(element: &'static Element, number: usize) -> Option<&'static Face> {
    let cell = match (element.faces.len(), element.nodes) {
        (4, _) => TETRAHEDRON,
        (5, 5 | 13) => PYRAMID,
        (5, _) => WEDGE,
        (6, _) => HEXAHEDRON,
        _ => return None,
    };
    let corners = cell.get(number.checked_sub(1)?)?;
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
    for card in cards.iter().filter(|card| card.keyword == "SURFACE") {
        let Some(name) = required(card, "NAME", "*SURFACE, NAME=BORE, TYPE=ELEMENT", report) else {
            continue;
        };
        let kind = card.parameter("TYPE").and_then(|parameter| parameter.value);
        let (mut members, mut faces) = (Vec::new(), Vec::new());
        match kind.map_or("ELEMENT".to_owned(), |kind| kind.text.to_uppercase()).as_str() {
            "ELEMENT" => {
                for line in &card.lines {
                    of_faces(line, (cells, others), (&mut members, &mut faces), report);
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

/// A line such as `OUTER, S2` or `17, S2`; of faces that are elements themselves it has their nodes.
fn of_faces(
    line: &[Token],
    (cells, others): (&Cells, &OtherElements),
    (members, faces): (&mut Vec<usize>, &mut Vec<FaceOfCell>),
    report: &mut MeshReport,
) {
    let Some(&whose) = line.first() else { return };
    let named = if is_label(&whose) { label(&whose, "label of a cell", report) } else { None };
    let (chosen, left) = match named {
        Some(label) => (
            cells.named.index.get(&label).map(std::slice::from_ref),
            others.index.get(&label).map(std::slice::from_ref),
        ),
        None => (cells.named.sets.get(whose.text), others.sets.get(whose.text)),
    };
    let left = left.unwrap_or_default();
    // E1, E2, … are edges of theirs.
    if line.get(1).is_none_or(|at| !at.text.to_uppercase().starts_with('E')) {
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
    let at = line.get(1).filter(|token| !token.text.is_empty());
    let number = at.and_then(|token| token.text.strip_prefix(['S', 's'])?.parse().ok());
    let (Some(at), Some(number)) = (at, number) else {
        let what = "a surface of cells needs their faces";
        report.error(at.copied().unwrap_or(whose), what, "write them as S1, S2, … after the cells");
        return;
    };
    for &index in chosen {
        let cell = &cells.list[index];
        let Some(element) = cell.element.filter(|_| !cell.nodes.is_empty()) else { continue };
        match face(element, number) {
            Some(face) => {
                members.extend(face.nodes.iter().map(|&place| cell.nodes[place]));
                faces.push((index, face));
            }
            None => {
                let faces = element.faces.len();
                let what = format!("{} has no face {}", element.origin.name, at.text);
                report.error(*at, what, format!("its faces are S1 to S{faces}"));
                return;
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

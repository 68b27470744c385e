//! Meshes in universal files (UNV), as of Salome, I-DEAS, NX and Gmsh.
//!
//! Solids of datasets 2412 (780) become cells; groups of nodes and elements (2467, 2477, 2452, 2435 and older ones) node sets and
//! element sets. Nodes are those of datasets 2411 (781) and 15. Lengths are in the units of
//! dataset 164 unless the case says otherwise; materials come from the case.

mod contents;
mod kinds;
mod lines;

use std::collections::{BTreeMap, BTreeSet, HashMap};

use whirl_specs::Element;

use self::contents::{Contents, Group, Listed};
use self::kinds::{Kind, element, kind};
use super::raw::{
    Cells, FACE_MIDDLES, LinePosition, MeshReport, NodeTable, RawCell, RawMesh, Remedies, count,
    has_face_middles, in_own_order, list,
};
use super::reading::{ReadMesh, ReadOptions};
use super::units::MeshUnits;
use crate::error::InputErrors;

const REMEDIES: Remedies = Remedies {
    no_cells: "read are tetrahedra, wedges and hexahedra of order 1 and 2 (descriptors 111, 112, 113, 115, 116, 118); pyramids have \
               no descriptor in this format: export Gmsh's format",
    no_section: "materials of universal files are not read: write `material = \"…\"`, or `regions` by groups, in the case",
    lacks: |name, symbol, _| (format!("material {name} has no {symbol}"), String::new()),
};

/// Whether a text begins as a universal file does.
pub(super) fn is_universal(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(400)]);
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let number = |line: &str| !line.is_empty() && line.bytes().all(|own| own.is_ascii_digit());
    lines.next() == Some("-1") && lines.next().is_some_and(number)
}

/// Reads a mesh; `path` is used in messages only.
///
/// # Errors
/// All that is wrong, with its lines, and how to fix it.
pub(super) fn read(text: &str, path: &str, options: &ReadOptions) -> Result<ReadMesh, InputErrors> {
    let mut report = MeshReport::new(path);
    let mut nodes = NodeTable::new();
    let mut contents = Contents::default();
    let read = lines::datasets(text).and_then(|mut all| {
        all.iter_mut().try_for_each(|own| contents.systems(own))?;
        all.iter_mut().try_for_each(|own| contents.dataset(own, &mut nodes, &mut report))
    });
    if let Err(stop) = read {
        report.error(stop.place, stop.what, stop.help);
        return Err(report.into_errors());
    }
    let options = ReadOptions { units: units(&contents, options, &mut report), ..*options };
    assemble(&contents, nodes, options.elements, &mut report).finish(&REMEDIES, &options, report)
}

/// The line of an element, from 1.
pub(super) fn line_of_element(text: &str, label: u64) -> Option<usize> {
    let mut contents = Contents::default();
    for mut data in lines::datasets(text).ok()? {
        contents.elements_only(&mut data).ok()?;
    }
    let own = contents.elements.iter().find(|own| own.label == label)?;
    Some(own.place.line)
}

/// The units to read in: those of the case; where it leaves them out, those that the file says.
fn units(contents: &Contents, options: &ReadOptions, report: &mut MeshReport) -> MeshUnits {
    const SAME: f64 = 1e-6;
    // Programs that know of no unit write metres.
    let Some([length, force]) = contents.units.filter(|own| (own[0] - 1.0).abs() > SAME) else {
        return options.units;
    };
    let near = |value: f64, known: f64| (value / known - 1.0).abs() < SAME;
    let own = [1e-3, 0.01, 0.0254, 0.3048].into_iter().find(|known| near(1.0 / length, *known));
    let own = own.unwrap_or(1.0 / length);
    if !options.units_given && options.units == MeshUnits::default() {
        let what = format!("lengths are in units of {own} m, as dataset 164 says");
        report.warn(
            LinePosition::default(),
            what,
            "`units` beside `mesh` in the case is for other units",
        );
        let force = 1.0 / force;
        return MeshUnits { length: own, force, mass: force / own };
    }
    if !near(options.units.length, own) {
        let what = format!(
            "the file says (dataset 164) that its unit of length is {own} m, but it is read in units of {} m",
            options.units.length
        );
        report.warn(
            LinePosition::default(),
            what,
            "leave out `units` of the mesh if the file is right",
        );
    }
    options.units
}

/// Cells, and sets of nodes and cells by the names of groups.
fn assemble(
    contents: &Contents,
    mut nodes: NodeTable,
    elements: &[&'static Element],
    report: &mut MeshReport,
) -> RawMesh {
    let mut cells = Cells::new();
    let mut flat: HashMap<u64, &Listed> = HashMap::new();
    let mut left_out = [0_usize; 3];
    let mut refused = BTreeSet::new();
    for own in &contents.elements {
        match kind(own.descriptor) {
            Kind::Flat(dimension) => {
                left_out[dimension] += 1;
                flat.insert(own.label, own);
            }
            Kind::Solid(of_gmsh, order) => match element(of_gmsh, elements) {
                Some(element) => solid(own, (element, order), &nodes, &mut cells, report),
                None => refuse(own, "cells of this kind", &mut refused, report),
            },
            Kind::Other(words) => refuse(own, words, &mut refused, report),
        }
    }
    tell(contents, left_out, report);
    sets(contents, &flat, &mut nodes, &mut cells, report);
    let sections = vec![None; cells.list.len()];
    let (materials, ties, named_by_ties) = (Vec::new(), Vec::new(), BTreeSet::new());
    let sections_complete = refused.is_empty();
    RawMesh { nodes, cells, materials, sections, sections_complete, ties, named_by_ties }
}

/// Notes cells that are not read, once for each descriptor.
fn refuse(own: &Listed, words: &str, refused: &mut BTreeSet<u64>, report: &mut MeshReport) {
    if refused.insert(own.descriptor) {
        let what = format!("{words} are not read (descriptor {})", own.descriptor);
        let help = "mesh with tetrahedra, wedges or hexahedra of order 1 or 2";
        report.error(own.place, what, help);
    }
}

fn solid(
    own: &Listed,
    (element, order): (&'static Element, &[usize]),
    nodes: &NodeTable,
    cells: &mut Cells,
    report: &mut MeshReport,
) {
    if own.nodes.len() != order.len() {
        let what = format!(
            "cell {} has {} nodes, where the descriptor {} has {}",
            own.label,
            own.nodes.len(),
            own.descriptor,
            order.len()
        );
        let help = if has_face_middles(own.nodes.len()) { FACE_MIDDLES } else { lines::DAMAGED };
        report.error(own.place, what, help);
        return;
    }
    let mut listed: Vec<usize> = Vec::with_capacity(order.len());
    for node in &own.nodes {
        match nodes.named.index.get(node) {
            None => {
                let what = format!("cell {} has node {node}, which is not defined", own.label);
                report.error(
                    own.place,
                    what,
                    "are nodes missing in dataset 2411? Export the file again",
                );
            }
            Some(index) if listed.contains(index) => {
                let what = format!("cell {} has node {node} twice", own.label);
                report.error(own.place, what, "mesh again: this cell is degenerate");
            }
            Some(index) => listed.push(*index),
        }
    }
    let own_nodes =
        if listed.len() == order.len() { in_own_order(&listed, order) } else { Vec::new() };
    if cells.named.add(own.label, own.place, report).is_some() {
        cells.list.push(RawCell { element: Some(element), nodes: own_nodes });
    }
}

/// A line each of what is in the file beside solids.
fn tell(contents: &Contents, numbers: [usize; 3], report: &mut MeshReport) {
    let nouns = ["point", "line", "face"];
    let there = numbers.into_iter().zip(nouns).filter(|own| own.0 > 0);
    let listed: Vec<String> = there.map(|(number, noun)| count(number, noun)).collect();
    if !listed.is_empty() {
        let what =
            format!("left out: {}; the nodes of their groups are node sets", listed.join(", "));
        report.warn(LinePosition::default(), what, "");
    }
    if !contents.left_out.is_empty() {
        let what = format!("left out: datasets {}", list(&contents.left_out));
        report.warn(LinePosition::default(), what, "");
    }
    if contents.other_members > 0 {
        let what = format!(
            "left out: {} of groups that are neither nodes nor elements",
            count(contents.other_members, "member")
        );
        report.warn(LinePosition::default(), what, "");
    }
}

/// Node sets and element sets of groups.
fn sets(
    contents: &Contents,
    flat: &HashMap<u64, &Listed>,
    nodes: &mut NodeTable,
    cells: &mut Cells,
    report: &mut MeshReport,
) {
    let mut of_solids = vec![false; nodes.positions.len()];
    cells.list.iter().flat_map(|cell| &cell.nodes).for_each(|&node| of_solids[node] = true);
    let mut taken: BTreeMap<String, LinePosition> = BTreeMap::new();
    for group in &contents.groups {
        let (members, own) = members(group, flat, nodes, cells, report);
        let members: Vec<usize> = members.into_iter().filter(|node| of_solids[*node]).collect();
        if members.is_empty() {
            let what = format!("no node of the group `{}` belongs to a solid", group.name);
            let help = "its node set is left out: mesh the body and its faces together";
            report.warn(group.place, what, help);
            continue;
        }
        if let Some(first) = taken.insert(group.name.to_uppercase(), group.place) {
            let line = report.line(first, group.place);
            let what = format!(
                "`{}` is the name of a group before, too ({line}): their sets are one",
                group.name
            );
            report.warn(group.place, what, "rename one of them");
        }
        nodes.named.sets.add(&group.name, members);
        if !own.is_empty() {
            cells.named.sets.add(&group.name, own);
        }
    }
}

/// Indices of the nodes and of the cells of a group, ascending and once each. Labels that nothing has are warned of.
fn members(
    group: &Group,
    flat: &HashMap<u64, &Listed>,
    nodes: &NodeTable,
    cells: &Cells,
    report: &mut MeshReport,
) -> (BTreeSet<usize>, BTreeSet<usize>) {
    let mut missing: Vec<u64> = Vec::new();
    let (mut own, mut of_cells) = (BTreeSet::new(), BTreeSet::new());
    for label in &group.nodes {
        match nodes.named.index.get(label) {
            Some(&node) => drop(own.insert(node)),
            None => missing.push(*label),
        }
    }
    for label in &group.elements {
        if let Some(&cell) = cells.named.index.get(label) {
            of_cells.insert(cell);
            own.extend(&cells.list[cell].nodes);
        } else if let Some(listed) = flat.get(label) {
            own.extend(listed.nodes.iter().filter_map(|own| nodes.named.index.get(own)));
        } else {
            missing.push(*label);
        }
    }
    if !missing.is_empty() {
        let what = format!(
            "the group `{}` has members that are not in the file: {}",
            group.name,
            list(&missing)
        );
        report.warn(group.place, what, "they are left out");
    }
    (own, of_cells)
}

//! Meshes in Nastran's bulk data, in small, large and free fields.
//!
//! Read are `GRID` and `GRDSET` with coordinate systems (`CORD1R`, `CORD2R`, …), the solid elements that
//! specs/elements names, `MAT1`, `PSOLID`, `RBE2` and `RBE3` as sets of their nodes, what ties
//! nodes, `SET` of case control, `SET1`,
//! `SET3`, `CONM2`, `PARAM,WTMASS` and `INCLUDE`. Other elements, loads and supports are left out with a line that
//! counts them; what would make the mesh another one is an error. A file's errors are all given at once.

mod bulk;
mod cells;
mod components;
mod continuations;
mod cut;
mod dmig;
mod edges;
mod fields;
mod files;
mod frame;
mod interfaces;
mod known;
mod masses;
mod materials;
mod names;
mod nodes;
mod numbers;
mod positions;
mod properties;
mod sets;
mod spiders;
mod systems;
mod tie_card;
mod ties;
mod used;
mod values;

use std::collections::BTreeSet;

pub(super) use self::dmig::{Dmig, DmigColumn, DmigEntry, grid_points, matrices};
pub use self::files::Load;
use super::raw::{Cells, MeshReport, NodeTable, RawCell, RawMesh, Remedies, in_own_order};
pub use super::reading::AddedMass;
use super::reading::{ReadMesh, ReadOptions};
use crate::error::InputErrors;

const REMEDIES: Remedies = Remedies {
    no_cells: "add CTETRA, CPENTA, CPYRAM or CHEXA; points, lines and shells are not read",
    no_section: "add PSOLID and MAT1; in a case `material` serves, too",
    // E and ν are there, or the card is refused.
    lacks: |name, _, steel| {
        let help = format!(
            "write ρ into field 6 of its MAT1, such as {steel} (steel), or give the elements another material by \
             `regions` in the case"
        );
        (format!("material {name} has no density"), help)
    },
};

/// Reads a mesh; `path` is used in messages, and to find included files, which `load` reads.
///
/// # Errors
/// All that is wrong, each with file, line, column, and how to fix it.
pub fn read(
    text: &str,
    path: &str,
    options: &ReadOptions,
    load: Load<'_>,
) -> Result<ReadMesh, InputErrors> {
    let mut report = MeshReport::new(path);
    let sources = files::read(text, load, &mut report);
    // What stands in a file that is not there is missing because of that.
    let lost = report.error_count() > 0;
    let mut bulk = bulk::read(&sources, options.elements, &mut report);
    bulk.grids.lost |= lost;
    let frames = bulk.systems.resolve(&bulk.grids, &mut report);
    let mut positions = bulk.grids.positions(&bulk.systems, &frames, &mut report);
    bulk.cells.check_nodes(&bulk.grids, &mut report);
    edges::fill(&mut bulk.cells, &mut bulk.grids, &mut positions, &mut report);
    let regions = materials::regions(&bulk, options.open || lost, &mut report);
    let used = bulk.used(&mut report);
    let ties = bulk.tied(&frames, &positions, &used, &mut report);
    let interfaces = interfaces::find(&bulk, &frames, &positions, &used, &mut report);
    let mut nodes = NodeTable::new();
    for &node in &used.nodes {
        nodes.positions.push(positions[node]);
        nodes.named.add(bulk.grids.label(node), bulk.grids.at(node), &mut report);
    }
    interfaces.sets.into_iter().for_each(|(name, members)| nodes.named.sets.add(&name, members));
    let mut cells = Cells::new();
    let mut sections = Vec::with_capacity(bulk.cells.list.len());
    for cell in &bulk.cells.list {
        let place = |node: &u64| Some(used.place[bulk.grids.place_of(*node)?]);
        let listed: Option<Vec<usize>> = cell.nodes.iter().map(place).collect();
        let nodes = match (listed, cell.element) {
            (Some(listed), Some(element)) => {
                in_own_order(&listed, element.nastran.map_or(&[], |(_, order)| order))
            }
            _ => Vec::new(),
        };
        cells.list.push(RawCell { element: cell.element, nodes });
        let index = cells.named.add(cell.label, cell.place, &mut report);
        let region = regions.by_property.get(&cell.property);
        if let Some(region) = region {
            cells.named.sets.add(&region.set, index);
        }
        sections.push(region.and_then(|region| region.material));
    }
    let materials = regions.materials;
    // A property without a material is an error by itself.
    let sections_complete = false;
    // Nodes that no cell has are not among these.
    let named_by_ties = BTreeSet::new();
    let raw = RawMesh { nodes, cells, materials, sections, sections_complete, ties, named_by_ties };
    let mut read = raw.finish(&REMEDIES, options, report)?;
    read.masses = interfaces.masses;
    read.masses.iter_mut().for_each(|mass| mass.convert(&options.units));
    Ok(read)
}

/// Whether a file is bulk data: it says so, or one of its first lines is a card of nodes or of solid elements.
pub(super) fn is_bulk_data(bytes: &[u8]) -> bool {
    const MOST: usize = 1 << 16;
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(MOST)]);
    let mut lines = text.lines().map(str::trim_start).filter(|line| !line.starts_with('$'));
    let cards = ["GRID", "GRDSET", "CEND", "INCLUDE", "CTETRA", "CHEXA", "CPENTA", "CPYRAM"];
    lines.any(|line| {
        let name = line.split([',', ' ', '\t', '*', '\'']).next().unwrap_or_default();
        cards.iter().any(|card| name.eq_ignore_ascii_case(card))
            || files::is_command(line, "BEGIN") && line.to_ascii_uppercase().contains("BULK")
    })
}

/// The line of a text, from 1, in which a solid element begins.
pub(super) fn line_of_element(text: &str, label: u64) -> Option<usize> {
    let begins = |line: &str| {
        let field = match line.split_once(',') {
            Some((_, rest)) => rest.split(',').next(),
            None => {
                let wide = line.get(..8).is_some_and(|name| name.contains('*'));
                line.get(8..).map(|rest| rest.get(..if wide { 16 } else { 8 }).unwrap_or(rest))
            }
        };
        line.starts_with(['C', 'c'])
            && field.and_then(|field| field.trim().parse().ok()) == Some(label)
    };
    text.lines().position(begins).map(|number| number + 1)
}

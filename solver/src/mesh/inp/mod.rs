//! Meshes in the input format of Abaqus and CalculiX.
//!
//! Read are `*NODE`, `*ELEMENT`, `*NSET`, `*ELSET` (with `GENERATE`), `*SURFACE` (as a node set), `*MATERIAL` with
//! `*ELASTIC` and `*DENSITY`, `*SOLID SECTION`, and what ties nodes, in any order and from files that are included; one part with one
//! instance is put in its place. Other keywords are left out with a warning, but for those that would change the mesh, which are errors, and those that say nothing of it. A file's errors are all given
//! at once.

mod cards;
mod cells;
mod couplings;
mod equations;
mod include;
mod instance;
mod joining;
mod materials;
mod others;
mod parameters;
mod piece;
mod sets;
mod surfaces;
mod ties;
mod types;
mod values;

use std::collections::BTreeSet;

use whirl_specs::Element;
use whirl_text::nearest_in_any_case;

use self::cards::{Card, cards};
use self::cells::{assign_sections, read_elements, read_nodes};
use self::include::pieces;
use self::instance::PARTS;
use self::joining::Joining;
use self::materials::read_materials;
use super::placed_nodes::PlacedNodes;
use super::raw::{MeshReport, RawMesh, Remedies};
pub use super::reading::ReadMesh;
use super::reading::ReadOptions;
pub use super::text::decode;
use crate::error::InputErrors;

/// Reads a mesh in which every cell has a material; `path` is used in messages only, `elements` are those that a
/// cell may have.
///
/// # Errors
/// All that is wrong, each with line, column, and how to fix it.
pub fn read(
    text: &str,
    path: &str,
    elements: &[&'static Element],
) -> Result<ReadMesh, InputErrors> {
    read_with(text, path, &ReadOptions::new(elements))
}

/// Cards by the symbols of a material.
fn card_of(symbol: &str) -> &'static str {
    if symbol == "rho" { "DENSITY" } else { "ELASTIC" }
}

const REMEDIES: Remedies = Remedies {
    no_cells: "add *ELEMENT with its TYPE and cells",
    no_section: "add *SOLID SECTION, ELSET=…, MATERIAL=… for a set that holds them; in a case `material` \
                 serves, too",
    lacks: |name, symbol, steel| {
        let card = card_of(symbol);
        let help = format!(
            "write *{card} and a line such as {steel} (steel) below its *MATERIAL, or give the cells another material \
             by `regions` in the case"
        );
        (format!("material {name} has no *{card}"), help)
    },
};

/// As [`read`], with these options.
///
/// # Errors
/// As [`read`].
pub fn read_with(text: &str, path: &str, options: &ReadOptions) -> Result<ReadMesh, InputErrors> {
    let mut report = MeshReport::new(path);
    let pieces = pieces(text, path, &mut report);
    let all = cards(&pieces);
    let cards = readable(&all, &mut report);
    // What a file lacks that is not there, or a card that is not read, follows from that error.
    let lost = report.error_count() > 0;
    if !instance::is_one(&all, &mut report) {
        return Err(report.into_errors());
    }
    let mut nodes = read_nodes(&cards, &mut report);
    nodes.named.lost |= lost;
    instance::place(&all, &mut nodes, &mut report);
    let (mut cells, mut others) = read_elements(&cards, options.elements, &nodes, &mut report);
    cells.named.lost |= lost;
    sets::read_of_elements(&cards, &mut cells, &mut others, &mut report);
    sets::read_of_nodes(&cards, &mut nodes, Some((&cells, &others)), &mut report);
    let surfaces = surfaces::read(&cards, &mut nodes, (&cells, &others), &mut report);
    let all_others = &others;
    let joining = Joining::new((&nodes, &cells), all_others, &surfaces, instance::axes(&all));
    let (ties, named_by_ties) = ties::read((&all, &cards), &joining, &mut report);
    others.into_node_sets(&mut nodes, &cells);
    let materials = read_materials(&cards, &mut report);
    let (sections, sections_complete) = assign_sections(&cards, &cells, &materials, &mut report);
    // Sets of elements that are left out have sections, too.
    cells.named.sets.drop_empty();
    let raw = RawMesh { nodes, cells, materials, sections, sections_complete, ties, named_by_ties };
    raw.finish(&REMEDIES, options, report)
}

/// Nodes and sets of nodes of the last file of a report, which is `path`, whether cells have them or not; in units of the file.
/// Other cards are left out.
pub(super) fn placed_nodes(text: &str, path: &str, report: &mut MeshReport) -> PlacedNodes {
    let pieces = pieces(text, path, report);
    let all = cards(&pieces);
    let kept: Vec<&Card> =
        all.iter().filter(|card| ["NODE", "NSET"].contains(&card.keyword.as_str())).collect();
    if !instance::is_one(&all, report) {
        return PlacedNodes::default();
    }
    let mut nodes = read_nodes(&kept, report);
    instance::place(&all, &mut nodes, report);
    if let Some(card) =
        all.iter().find(|card| ["TRANSFORM", "SYSTEM"].contains(&card.keyword.as_str()))
    {
        let what = format!("*{} turns the axes of nodes, and is not read", card.keyword);
        report.error(card.place, what, "write places and dofs in x, y, z");
    }
    sets::read_of_nodes(&kept, &mut nodes, None, report);
    let labels = &nodes.named.labels;
    let places = labels.iter().copied().zip(nodes.positions.iter().copied()).collect();
    let sets = std::mem::take(&mut nodes.named.sets).into_map(|node| labels[node]);
    PlacedNodes { places, sets, ..PlacedNodes::default() }
}

const READ: [&str; 9] = [
    "NODE",
    "ELEMENT",
    "NSET",
    "ELSET",
    "SURFACE",
    "MATERIAL",
    "ELASTIC",
    "DENSITY",
    "SOLID SECTION",
];

/// Keywords for people and printers: nothing of the mesh is lost without them.
const SAYS_NOTHING: [&str; 2] = ["HEADING", "PREPRINT"];

/// Keywords that add or move nodes, cells or their matrices: a mesh without them would be another mesh.
const CHANGES_THE_MESH: [&str; 7] = ["NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"];

/// The cards that this reader knows; warns of the others.
fn readable<'c, 'a>(cards: &'c [Card<'a>], report: &mut MeshReport) -> Vec<&'c Card<'a>> {
    let mut kept = Vec::new();
    let mut in_step = false;
    let mut skipped: BTreeSet<&str> = BTreeSet::new();
    let (mut in_assembly, mut in_instance) = (false, false);
    let has_instance = cards.iter().any(|card| card.keyword == "INSTANCE");
    for card in cards {
        let keyword = card.keyword.as_str();
        match keyword {
            "ASSEMBLY" | "END ASSEMBLY" => in_assembly = keyword == "ASSEMBLY",
            "INSTANCE" | "END INSTANCE" => in_instance = keyword == "INSTANCE",
            _ => {}
        }
        let beside = has_instance && in_assembly && !in_instance;
        if keyword == "END STEP" {
            in_step = false;
        } else if in_step || SAYS_NOTHING.contains(&keyword) {
            continue;
        } else if beside && is_of_assembly(card) {
            if skipped.insert("ASSEMBLY") {
                let what = "nodes of the assembly, and what stands on them, are left out";
                report.warn(card.place, what, "");
            }
        } else if READ.contains(&keyword) || PARTS.contains(&keyword) || ties::is_tie(keyword) {
            parameters::check(card, report);
            kept.push(card);
        } else if keyword.is_empty() {
            report.error(card.place, "data before the first keyword", "begin with *NODE");
        } else if CHANGES_THE_MESH.contains(&keyword) {
            let help = "write the mesh out in full, in one file and in x, y, z";
            report.error(card.place, format!("*{keyword} is not read, but changes the mesh"), help);
        } else {
            in_step = keyword == "STEP";
            if skipped.insert(keyword) {
                let close =
                    nearest_in_any_case(keyword, READ).map(|close| format!("is *{close} meant?"));
                let what = format!("*{keyword} is left out");
                report.warn(card.place, what, close.unwrap_or_default());
            }
        }
    }
    kept
}

/// Whether a card beside the instance has nodes of the assembly, such as reference points. Their labels are not those of
/// the part.
fn is_of_assembly(card: &Card) -> bool {
    match card.keyword.as_str() {
        "NODE" | "ELEMENT" => true,
        "NSET" | "ELSET" => {
            let first = card.lines.iter().flatten().next();
            card.parameter("INSTANCE").is_none()
                && first.is_some_and(|label| values::whole(label.text).is_some())
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_card_that_is_read_has_its_parameters_listed() {
        for keyword in READ.iter().chain(&PARTS).chain(&ties::READ) {
            // Those that end something have none.
            let ends = keyword.starts_with("END ");
            let listed = parameters::KNOWN.iter().any(|(own, ..)| own == keyword);
            assert!(ends || listed, "*{keyword}");
        }
    }
}

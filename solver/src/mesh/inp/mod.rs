//! Meshes in the input format of Abaqus and CalculiX.
//!
//! Read are `*NODE`, `*ELEMENT`, `*NSET`, `*ELSET` (with `GENERATE`), `*SURFACE` (as a node set), `*MATERIAL` with
//! `*ELASTIC` and `*DENSITY`, `*SOLID SECTION`, and what ties nodes, in any order and from files that are included; one part with one
//! instance is put in its place. Other keywords are left out with a warning, but for those that would change the mesh, which are errors, and those that say nothing of it. A file's errors are all given
//! at once.

mod assembly;
mod cards;
mod cells;
mod combined;
mod couplings;
mod equations;
mod include;
mod instance;
mod joining;
mod materials;
mod others;
mod parameters;
mod piece;
mod renames;
mod sets;
mod surfaces;
mod temperatures;
mod ties;
mod types;
mod values;

use std::collections::BTreeSet;

use whirl_specs::Element;
use whirl_text::nearest_in_any_case;

use self::assembly::{Assembly, PARTS};
use self::cards::{Card, Owner, Token, cards};
use self::cells::{assign_sections, read_elements, read_nodes};
use self::include::pieces;
use self::joining::Joining;
use self::materials::read_materials;
use self::renames::Renames;
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
    let Some(mut assembly) = assembly::read(cards(&pieces), &mut report) else {
        return Err(report.into_errors());
    };
    let renames = renames::find(&assembly, &mut report);
    let all = renames.apply(std::mem::take(&mut assembly.cards));
    let cards = readable(&all, (&assembly, &renames), &mut report);
    // What a file lacks that is not there, or a card that is not read, follows from that error.
    let lost = report.error_count() > 0;
    let mut nodes = read_nodes(&cards, &assembly, &mut report);
    nodes.named.lost |= lost;
    let (mut cells, mut others) = read_elements(&cards, options.elements, &nodes, &mut report);
    cells.named.lost |= lost;
    sets::read_of_elements(&cards, &mut cells, &mut others, &mut report);
    sets::read_of_nodes(&cards, &mut nodes, Some((&cells, &others)), &mut report);
    let surfaces = surfaces::read(&cards, &mut nodes, (&cells, &others), &mut report);
    let all_others = &others;
    let axes = assembly.motion(Owner::Part).axes();
    let joining = Joining::new((&nodes, &cells), all_others, &surfaces, axes);
    let (ties, mut named_by_ties) = ties::read((&all, &cards), &joining, &mut report);
    // Points of an assembly need no cell.
    let points = nodes.named.labels.iter().filter(|&&label| renames.is_beside(label));
    named_by_ties.extend(points);
    others.into_node_sets(&mut nodes, &cells);
    let labels = &nodes.named.labels;
    nodes.named.sets.drop_those_of(|node| renames.is_beside(labels[node]));
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
    let Some(mut assembly) = assembly::read(cards(&pieces), report) else {
        return PlacedNodes::default();
    };
    let renames = renames::find(&assembly, report);
    let all = renames.apply(std::mem::take(&mut assembly.cards));
    let kept: Vec<&Card> =
        all.iter().filter(|card| ["NODE", "NSET"].contains(&card.keyword.as_str())).collect();
    let mut nodes = read_nodes(&kept, &assembly, report);
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

/// Keywords of Abaqus that look like those that are read.
const OTHERS: [&str; 2] = ["PLASTIC", "SHELL SECTION"];

/// Keywords that add or move nodes, cells or their matrices: a mesh without them would be another mesh.
const CHANGES_THE_MESH: [&str; 8] =
    ["NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "IMPERFECTION"];

/// The cards that this reader knows; warns of the others.
fn readable<'c, 'a>(
    cards: &'c [Card<'a>],
    (assembly, renames): (&Assembly, &Renames),
    report: &mut MeshReport,
) -> Vec<&'c Card<'a>> {
    let mut kept = Vec::new();
    let mut in_step = false;
    let mut skipped: BTreeSet<&str> = BTreeSet::new();
    for card in cards {
        let keyword = card.keyword.as_str();
        let beside = card.owner == Owner::Assembly && !assembly.instances.is_empty();
        if keyword == "END STEP" {
            in_step = false;
        } else if in_step || SAYS_NOTHING.contains(&keyword) {
            continue;
        } else if beside && is_of_assembly(card, assembly.tied, renames) {
            if skipped.insert("ASSEMBLY") {
                let what = match assembly.tied {
                    true => "what stands on nodes of the assembly is left out",
                    false => "nodes of the assembly, and what stands on them, are left out",
                };
                let help = "bodies of other kinds and masses are written in the case";
                report.warn(card.place, what, help);
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
                let close = nearest_in_any_case(keyword, READ)
                    .filter(|_| !OTHERS.contains(&keyword))
                    .map(|close| format!("is *{close} meant?"));
                let what = format!("*{keyword} is left out");
                report.warn(card.place, what, close.unwrap_or_default());
            }
        }
    }
    kept
}

/// Whether a card beside the instances has nodes of the assembly, such as reference points, that nothing needs, or elements on
/// them. Their labels are not those of the part.
fn is_of_assembly(card: &Card, tied: bool, renames: &Renames) -> bool {
    let has_only_own = || {
        let is_own = |label: &Token| {
            let label = values::whole(label.text).and_then(|label| u64::try_from(label).ok());
            label.is_some_and(|label| renames.is_beside(label))
        };
        let ranges = card.parameter("GENERATE").is_some();
        let mut labels = card.lines.iter().flat_map(|line| match ranges {
            true => &line[..line.len().min(2)],
            false => &line[..],
        });
        card.parameter("INSTANCE").is_none()
            && card.lines.iter().any(|line| !line.is_empty())
            && labels.all(is_own)
    };
    match card.keyword.as_str() {
        "NODE" => !tied,
        "ELEMENT" => true,
        "NSET" => !tied && has_only_own(),
        "ELSET" => has_only_own(),
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

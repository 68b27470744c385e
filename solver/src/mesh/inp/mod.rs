//! Meshes in the input format of Abaqus and CalculiX.
//!
//! Read are `*NODE`, `*ELEMENT`, `*NSET`, `*ELSET` (with `GENERATE`), `*MATERIAL` with `*ELASTIC` and
//! `*DENSITY`, and `*SOLID SECTION`, in any order, in m, Pa and kg/m³. Other keywords are left out with a
//! warning, but for those that would change the mesh, which are errors, and those that say nothing of it. A file's errors are all given
//! at once.

mod cards;
mod cells;
mod materials;
mod sets;

use std::collections::{BTreeMap, BTreeSet};

use whirl_specs::Element;
use whirl_text::nearest_in_any_case;

use self::cards::{Card, Token, cards};
use self::cells::{RawCell, assign_sections, read_elements, read_nodes};
use self::materials::{RawMaterial, read_materials};
use self::sets::{Labelled, Sets};
use super::{Block, Cell, Material, Mesh, MeshParts};
use crate::error::{InputError, InputErrors};

/// The text of a file in UTF-8, or else in Latin-1, in which older programs write names and comments.
pub fn decode(bytes: Vec<u8>) -> String {
    match String::from_utf8(bytes) {
        Ok(text) => text,
        // Latin-1 is the first 256 characters of Unicode.
        Err(error) => error.into_bytes().into_iter().map(char::from).collect(),
    }
}

/// A mesh with what was left out of the file.
#[derive(Debug, Clone)]
pub struct ReadMesh {
    /// The mesh.
    pub mesh: Mesh,
    /// What was skipped or looks odd, in the order of the lines.
    pub warnings: Vec<InputError>,
}

/// Reads a mesh; `path` is used in messages only, `elements` are those that a cell may have.
///
/// # Errors
/// All that is wrong, each with line, column, and how to fix it.
pub fn read(
    text: &str,
    path: &str,
    elements: &[&'static Element],
) -> Result<ReadMesh, InputErrors> {
    read_open(text, path, elements, false)
}

/// As [`read`]; where `open` is true, cells without a section are no error: they get a material without name
/// and properties, for which another is to be put.
///
/// # Errors
/// As [`read`].
pub fn read_open(
    text: &str,
    path: &str,
    elements: &[&'static Element],
    open: bool,
) -> Result<ReadMesh, InputErrors> {
    let cards = cards(text);
    let mut report = MeshReport { path, errors: Vec::new(), warnings: Vec::new() };
    let cards = readable(&cards, &mut report);
    let mut nodes = read_nodes(&cards, &mut report);
    let mut cells = read_elements(&cards, elements, &nodes, &mut report);
    sets::read(&cards, "NSET", &mut nodes.named, &mut report);
    sets::read(&cards, "ELSET", &mut cells.named, &mut report);
    let materials = read_materials(&cards, &mut report);
    let sections = assign_sections(&cards, &cells, &materials, open, &mut report);
    cells.stand_once(&mut report);
    if cells.list.is_empty() && report.errors.is_empty() {
        report.error_in_file("the file has no cells", "add *ELEMENT with its TYPE and cells");
    }
    nodes.drop_unused(&cells.list, &mut report);
    report.extent(&nodes.positions);
    if !report.errors.is_empty() {
        report.errors.sort_by_key(|error| (error.line, error.column));
        return Err(InputErrors(report.errors));
    }
    let mut warnings = std::mem::take(&mut report.warnings);
    match build(path, nodes, cells.list, cells.named.sets, &materials, &sections) {
        Ok(mesh) => {
            warnings.sort_by_key(|warning| (warning.line, warning.column));
            Ok(ReadMesh { mesh, warnings })
        }
        Err(error) => {
            report.error_in_file(&error.to_string(), "");
            Err(InputErrors(report.errors))
        }
    }
}

/// Nodes in the order of the file.
struct NodeTable {
    positions: Vec<[f64; 3]>,
    named: Labelled,
}

impl NodeTable {
    /// Leaves out nodes that belong to no cell, with a warning.
    fn drop_unused(&mut self, cells: &[RawCell], report: &mut MeshReport) {
        let used: BTreeSet<u64> =
            cells.iter().flat_map(|cell| cell.nodes.iter().copied()).collect();
        let labels = &self.named.labels;
        let unused: Vec<usize> =
            (0..labels.len()).filter(|&node| !used.contains(&labels[node])).collect();
        let Some(&first) = unused.first() else { return };
        let list = list(unused.iter().map(|&node| labels[node]));
        let what = format!("{} in no cell, left out: {list}", count(unused.len(), "node"));
        report.warn(
            self.named.places[first],
            what,
            "delete them, or add the cells that they belong to",
        );
        let unused: BTreeSet<usize> = unused.into_iter().collect();
        let mut place = vec![usize::MAX; self.positions.len()];
        let kept = (0..self.positions.len()).filter(|node| !unused.contains(node));
        kept.enumerate().for_each(|(new, old)| place[old] = new);
        let keep = |old: usize| place[old] != usize::MAX;
        let mut old = 0..;
        self.positions.retain(|_| keep(old.next().unwrap_or(0)));
        self.named.renumber(&place);
    }
}

/// Blocks by element and material, in the order in which they first appear.
fn build(
    path: &str,
    nodes: NodeTable,
    cells: Vec<RawCell>,
    element_sets: Sets,
    materials: &[RawMaterial],
    sections: &[usize],
) -> Result<Mesh, crate::Error> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut places = Vec::with_capacity(cells.len());
    for (cell, &material) in cells.iter().zip(sections) {
        let Some(element) = cell.element else { continue };
        let same =
            |block: &Block| std::ptr::eq(block.element, element) && block.material == material;
        let block = blocks.iter().position(same).unwrap_or_else(|| {
            let (labels, connectivity) = (Vec::new(), Vec::new());
            blocks.push(Block { element, material, labels, connectivity });
            blocks.len() - 1
        });
        places.push(Cell { block, cell: blocks[block].len() });
        let mut own = vec![0; element.nodes];
        for (node, &place) in cell.nodes.iter().zip(element.abaqus_order) {
            own[place] = nodes.named.index[node];
        }
        blocks[block].labels.push(cell.label);
        blocks[block].connectivity.extend(own);
    }
    let mut materials: Vec<Material> = materials.iter().map(RawMaterial::material).collect();
    if blocks.iter().any(|block| block.material == materials.len()) {
        materials.push(Material { name: String::new(), properties: BTreeMap::new() });
    }
    Mesh::new(MeshParts {
        origin: path.to_owned(),
        nodes: nodes.positions,
        labels: nodes.named.labels,
        blocks,
        materials,
        node_sets: nodes.named.sets.into_map(|node| node),
        element_sets: element_sets.into_map(|cell| places[cell]),
    })
}

/// Errors and warnings as they are found.
struct MeshReport<'a> {
    path: &'a str,
    errors: Vec<InputError>,
    warnings: Vec<InputError>,
}

impl MeshReport<'_> {
    fn entry(&self, place: LinePosition, what: String, help: String) -> InputError {
        InputError {
            file: self.path.to_owned(),
            line: place.line,
            column: place.column,
            what,
            help,
        }
    }

    fn error(
        &mut self,
        at: impl Into<LinePosition>,
        what: impl Into<String>,
        help: impl Into<String>,
    ) {
        let error = self.entry(at.into(), what.into(), help.into());
        self.errors.push(error);
    }

    fn error_in_file(&mut self, what: &str, help: &str) {
        self.error(LinePosition { line: 0, column: 0 }, what, help);
    }

    fn warn(
        &mut self,
        at: impl Into<LinePosition>,
        what: impl Into<String>,
        help: impl Into<String>,
    ) {
        let warning = self.entry(at.into(), what.into(), help.into());
        self.warnings.push(warning);
    }

    /// A positive whole number.
    fn label(&mut self, token: &Token, of: &str) -> Option<u64> {
        match token.text.parse() {
            Ok(label) if label > 0 => Some(label),
            _ => {
                let what = format!("{of} must be a whole number from 1, found `{}`", token.text);
                self.error(*token, what, "");
                None
            }
        }
    }

    /// A finite number; Fortran's D may stand for the exponent.
    fn number(&mut self, token: &Token, of: &str) -> Option<f64> {
        let text = token.text.replace(['d', 'D'], "e");
        let value: Option<f64> = text.parse().ok().filter(|value: &f64| value.is_finite());
        if value.is_none() {
            let what = format!("{of} must be a number, found `{}`", token.text);
            self.error(*token, what, "write it as 0.0115 or 1.15e-2");
        }
        value
    }

    /// The value of a parameter that must be there.
    fn required<'c>(&mut self, card: &Card<'c>, name: &str, example: &str) -> Option<Token<'c>> {
        let parameter = card.parameter(name);
        let value = parameter.and_then(|parameter| parameter.value);
        let value = value.filter(|value| !value.text.is_empty());
        if value.is_none() {
            let names = card.parameters.iter().map(|parameter| parameter.name.as_str());
            let help = match nearest_in_any_case(name, names) {
                Some(close) if close != name => format!("is {close} meant to be {name}?"),
                _ => format!("write {example}"),
            };
            let at = parameter.map_or(card.place, |parameter| parameter.place);
            self.error(at, format!("*{} needs {name}=", card.keyword), help);
        }
        value
    }

    /// A mesh larger than this is usually one in mm.
    fn extent(&mut self, positions: &[[f64; 3]]) {
        const LARGE: f64 = 100.0;
        let axis = |i: usize| {
            let values = || positions.iter().map(|x| x[i]);
            values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
        };
        let extent = (0..3).map(axis).fold(0.0, f64::max);
        if extent > LARGE {
            let what = format!("the mesh is {extent} m long");
            let help = "coordinates are read in m; if they are in mm, divide them by 1000";
            self.warn(LinePosition { line: 0, column: 0 }, what, help);
        }
    }
}

/// Line and column of an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct LinePosition {
    line: usize,
    column: usize,
}

impl From<Token<'_>> for LinePosition {
    fn from(token: Token) -> LinePosition {
        LinePosition { line: token.line, column: token.column }
    }
}

const READ: [&str; 8] =
    ["NODE", "ELEMENT", "NSET", "ELSET", "MATERIAL", "ELASTIC", "DENSITY", "SOLID SECTION"];

/// Keywords for people and printers: nothing of the mesh is lost without them.
const SAYS_NOTHING: [&str; 2] = ["HEADING", "PREPRINT"];

/// Keywords that add or move nodes, cells or their matrices: a mesh without them would be another mesh.
const CHANGES_THE_MESH: [&str; 9] =
    ["INCLUDE", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "ORIENTATION"];

/// The cards that this reader knows; warns of the others.
fn readable<'c, 'a>(cards: &'c [Card<'a>], report: &mut MeshReport) -> Vec<&'c Card<'a>> {
    let mut kept = Vec::new();
    let mut in_step = false;
    let mut skipped: BTreeSet<&str> = BTreeSet::new();
    for card in cards {
        let keyword = card.keyword.as_str();
        if keyword == "END STEP" {
            in_step = false;
        } else if in_step || SAYS_NOTHING.contains(&keyword) {
            continue;
        } else if READ.contains(&keyword) {
            if let Some(input) = card.parameter("INPUT") {
                let help = "write what that file has into this one";
                report.error(input.place, "data in another file is not read", help);
            }
            kept.push(card);
        } else if keyword.is_empty() {
            report.error(card.place, "data before the first keyword", "begin with *NODE");
        } else if CHANGES_THE_MESH.contains(&keyword) {
            let help = "write the mesh out in full, in one file and in x, y, z";
            report.error(card.place, format!("*{keyword} is not read, but changes the mesh"), help);
        } else if keyword == "INSTANCE" && !card.lines.is_empty() {
            let help = "write the nodes where they are";
            report.error(card.place, "an *INSTANCE that is moved or turned is not read", help);
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

/// The first few of a list, in words.
fn list(items: impl IntoIterator<Item = u64>) -> String {
    let mut items = items.into_iter();
    let first: Vec<String> = items.by_ref().take(5).map(|item| item.to_string()).collect();
    let more = if items.next().is_some() { ", …" } else { "" };
    format!("{}{more}", first.join(", "))
}

fn count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

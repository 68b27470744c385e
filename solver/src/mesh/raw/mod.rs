//! A mesh as the reader of a file gives it, and what follows for every format: nodes that no cell has are left
//! out, cells that stand twice are found, units are converted, materials judged, and blocks are made.
//!
//! A reader fills a [`RawMesh`] and tells a [`MeshReport`] what is wrong; [`RawMesh::finish`] does the rest.

mod checks;
mod face_middles;
mod grid;
mod labelled;
mod materials;
mod merge;
mod onto;
mod report;
mod rigid;
mod seams;
mod ties;

use std::collections::{BTreeMap, BTreeSet};

use whirl_specs::Element;

pub(super) use self::face_middles::{FACE_MIDDLES, has_face_middles};
pub(super) use self::labelled::{Labelled, Sets, did_you_mean};
pub(super) use self::materials::RawMaterial;
pub(super) use self::onto::{FaceOfCell, onto_faces};
pub(super) use self::report::{LinePosition, MeshReport, count, list};
pub(super) use self::rigid::{Direction, TiePoint, follows_mean};
pub(super) use self::ties::{FileDof, FileRow, RawTie, eliminate};
use super::reading::{ReadMesh, ReadOptions};
use super::units::MeshUnits;
use super::{Block, Cell, Material, Mesh, MeshParts, Tie};
use crate::error::InputErrors;

/// Nodes in the order of the file.
pub(super) struct NodeTable {
    /// In units of the file.
    pub(super) positions: Vec<[f64; 3]>,
    /// One label a position.
    pub(super) named: Labelled,
}

impl NodeTable {
    pub(super) fn new() -> NodeTable {
        NodeTable { positions: Vec::new(), named: Labelled::new("node") }
    }
}

/// A cell of a file.
#[derive(Debug, Clone)]
pub(super) struct RawCell {
    /// `None` where the type is not known, which is an error by itself.
    pub(super) element: Option<&'static Element>,
    /// Indices into the table of nodes, in the element's own order; empty after an error.
    pub(super) nodes: Vec<usize>,
}

/// Cells in the order of the file.
pub(super) struct Cells {
    pub(super) list: Vec<RawCell>,
    /// One label a cell.
    pub(super) named: Labelled,
}

impl Cells {
    pub(super) fn new() -> Cells {
        Cells { list: Vec::new(), named: Labelled::new("cell") }
    }
}

/// `listed` in the element's own order: `order[i]` is the node of the element at place i of the file.
pub(super) fn in_own_order(listed: &[usize], order: &[usize]) -> Vec<usize> {
    let mut own = vec![0; listed.len()];
    listed.iter().zip(order).for_each(|(&node, &place)| own[place] = node);
    own
}

/// What the reader of a file found, with its units.
pub(super) struct RawMesh {
    pub(super) nodes: NodeTable,
    pub(super) cells: Cells,
    pub(super) materials: Vec<RawMaterial>,
    /// Index of the material of every cell, where the file gives one.
    pub(super) sections: Vec<Option<usize>>,
    /// Whether a cell without a material has none in the file, and none was lost in an error.
    pub(super) sections_complete: bool,
    /// What joins nodes of cells beside the cells.
    pub(super) ties: Vec<Tie>,
    /// Labels of nodes that cards of ties name, which need no cell.
    pub(super) named_by_ties: BTreeSet<u64>,
}

/// What to write into a file of this format.
pub(super) struct Remedies {
    /// Where it has no cells.
    pub(super) no_cells: &'static str,
    /// Where cells have no material.
    pub(super) no_section: &'static str,
    /// What is wrong with the material of a name that lacks a symbol, and the remedy; the last text is what steel has
    /// there, in units of the file.
    pub(super) lacks: fn(&str, &str, &str) -> (String, String),
}

impl RawMesh {
    /// The mesh in SI units, or all that is wrong.
    pub(super) fn finish(
        mut self,
        remedies: &Remedies,
        options: &ReadOptions,
        mut report: MeshReport,
    ) -> Result<ReadMesh, InputErrors> {
        self.convert(&options.units);
        if let Some(within) = options.merge.filter(|_| report.error_count() == 0) {
            self.merge_nodes(within, &mut report);
        }
        self.cells_stand_once(&mut report);
        if self.cells.list.is_empty() && report.error_count() == 0 {
            report.error_in_file("the file has no cells", remedies.no_cells);
        }
        self.materials_are_read(remedies, options, &mut report);
        if !options.open {
            self.cells_have_materials(remedies, &mut report);
        }
        self.drop_unused_nodes(&mut report);
        self.extent(&options.units, &mut report);
        self.are_near(&mut report);
        let units = &options.units;
        self.materials.iter().for_each(|material| material.judge(units, &mut report));
        if report.error_count() > 0 {
            return Err(report.into_errors());
        }
        self.seams(&mut report);
        ties::warn_of_resisting(&self.ties, &self.nodes.positions, &mut report);
        match self.build(&report.files[0]) {
            Ok(mesh) => Ok(ReadMesh { mesh, masses: Vec::new(), warnings: report.into_warnings() }),
            Err(error) => {
                report.error_in_file(
                    error.to_string(),
                    "correct it in the file, or write the file anew",
                );
                Err(report.into_errors())
            }
        }
    }

    fn convert(&mut self, units: &MeshUnits) {
        if *units == MeshUnits::default() {
            return;
        }
        for position in &mut self.nodes.positions {
            *position = position.map(|x| units.length(x));
        }
        self.materials.iter_mut().for_each(|material| material.convert(units));
    }

    /// Blocks by element and material, in the order in which they first appear.
    fn build(self, path: &str) -> Result<Mesh, crate::Error> {
        let RawMesh {
            nodes,
            cells,
            materials,
            sections,
            ties,
            sections_complete: _,
            named_by_ties: _,
        } = self;
        let mut blocks: Vec<Block> = Vec::new();
        let mut places = Vec::with_capacity(cells.list.len());
        for ((cell, &label), section) in cells.list.iter().zip(&cells.named.labels).zip(&sections) {
            let Some(element) = cell.element else { continue };
            let material = section.unwrap_or(materials.len());
            let same =
                |block: &Block| std::ptr::eq(block.element, element) && block.material == material;
            let block = blocks.iter().position(same).unwrap_or_else(|| {
                let (labels, connectivity) = (Vec::new(), Vec::new());
                blocks.push(Block { element, material, labels, connectivity });
                blocks.len() - 1
            });
            places.push(Cell { block, cell: blocks[block].len() });
            blocks[block].labels.push(label);
            blocks[block].connectivity.extend(&cell.nodes);
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
            element_sets: cells.named.sets.into_map(|cell| places[cell]),
            ties,
            matrices: None,
        })
    }
}

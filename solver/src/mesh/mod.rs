//! Meshes of solid bodies: nodes, blocks of cells of one element and material, named sets.
//!
//! A mesh is read ([`mod@format`]: [`inp`], [`msh`], [`bdf`], universal files), made from a few dimensions ([`shaft`], [`crank`], [`support`]) or from a table of
//! sections ([`sections`]), and does not change afterwards. Degree of freedom 3a + i is displacement component i (x, y, z) of node a.

pub mod bdf;
mod body_matrices;
pub mod crank;
mod cut;
mod fineness;
pub mod foreign;
pub mod format;
pub mod inp;
mod layers;
mod material;
pub mod matrices;
mod mean;
pub mod measure;
pub mod msh;
mod place;
mod placed_nodes;
mod quadratic;
mod quality;
mod raw;
mod reading;
mod regions;
pub mod sections;
mod selection;
mod set_place;
pub mod shaft;
pub mod support;
mod surface;
mod surface_face;
mod text;
mod ties;
mod units;
mod unv;

pub use fineness::Fineness;
pub use material::{ImplausibleProperty, Material};
pub use mean::{MeanComponent, NodeSetMean};
pub use place::Caught;
pub use quality::WorstCell;
pub(crate) use regions::connected;
pub use selection::Cylinder;
pub use set_place::{Selection, SetPlace};
pub use surface::{Surface, SurfacePoint};
pub use ties::Tie;

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Serialize;
use whirl_specs::Element;
use whirl_text::nearest_in_any_case;

use self::body_matrices::{BodyMatrices, Slot};
use crate::error::Error;
use crate::sparse::Row;

/// Farthest a coordinate may be from the origin (m): beyond it squares and products of lengths lose what is meant.
const FARTHEST: f64 = 1e6;

/// Cells of one element and one material.
#[derive(Debug, Clone)]
pub struct Block {
    /// The element, with its kernels.
    pub element: &'static Element,
    /// Index into [`Mesh::materials`].
    pub material: usize,
    /// Labels of the cells in the source of the mesh.
    pub labels: Vec<u64>,
    /// Node indices, cells × nodes of the element, in the element's own node order.
    pub connectivity: Vec<usize>,
}

impl Block {
    /// Number of cells.
    pub fn len(&self) -> usize {
        self.labels.len()
    }

    /// Whether there are no cells.
    pub fn is_empty(&self) -> bool {
        self.labels.is_empty()
    }

    /// Node indices of every cell, in the element's own order.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = &[usize]> {
        self.connectivity.chunks_exact(self.element.nodes)
    }
}

/// A cell of a mesh: its block and its place there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cell {
    /// Index into [`Mesh::blocks`].
    pub block: usize,
    /// Index into the block.
    pub cell: usize,
}

/// What a mesh is made of; [`Mesh::new`] checks that it fits together.
#[derive(Debug, Clone, Default)]
pub struct MeshParts {
    /// Path of the file, or words such as `shaft made from dimensions`.
    pub origin: String,
    /// Positions in m.
    pub nodes: Vec<[f64; 3]>,
    /// Labels of the nodes in the source.
    pub labels: Vec<u64>,
    /// Cells.
    pub blocks: Vec<Block>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Indices of nodes by the set's name, in the order of the source.
    pub node_sets: BTreeMap<String, Vec<usize>>,
    /// Cells by the set's name.
    pub element_sets: BTreeMap<String, Vec<Cell>>,
    /// What joins dofs of nodes beside the cells.
    pub ties: Vec<Tie>,
    /// Matrices of a body without cells.
    pub matrices: Option<Arc<BodyMatrices>>,
}

/// A mesh of solid cells, in m, kg, s.
#[derive(Debug, Clone)]
pub struct Mesh {
    parts: MeshParts,
    /// Where the node sets are that are chosen by their place, by name.
    places: BTreeMap<String, SetPlace>,
}

impl Mesh {
    /// A mesh of these parts.
    ///
    /// Errors: an index out of range, lengths that do not fit, or a position that is not finite.
    pub fn new(parts: MeshParts) -> Result<Mesh, Error> {
        let mesh = Mesh { parts, places: BTreeMap::new() };
        match mesh.misfit() {
            None => Ok(mesh),
            Some(what) => Err(Error::Mesh { origin: mesh.parts.origin, what }),
        }
    }

    fn misfit(&self) -> Option<String> {
        let parts = &self.parts;
        let nodes = parts.nodes.len();
        if parts.labels.len() != nodes {
            return Some(format!("{nodes} nodes but {} labels", parts.labels.len()));
        }
        if let Some(bad) = parts.nodes.iter().position(|x| x.iter().any(|x| !x.is_finite())) {
            return Some(format!("the position of node {} is not finite", parts.labels[bad]));
        }
        if let Some(far) = parts.nodes.iter().position(|x| x.iter().any(|x| x.abs() > FARTHEST)) {
            return Some(format!(
                "node {} is farther than 1000 km from the origin: look at the units",
                parts.labels[far]
            ));
        }
        for block in &parts.blocks {
            if block.connectivity.len() != block.len() * block.element.nodes {
                return Some(format!(
                    "{} cells of {} need {} nodes each, but {} are listed",
                    block.len(),
                    block.element.origin.name,
                    block.element.nodes,
                    block.connectivity.len()
                ));
            }
            if block.material >= parts.materials.len() {
                return Some(format!("a block of {} has no material", block.element.origin.name));
            }
            for (cell, label) in block.cells().zip(&block.labels) {
                if cell.iter().any(|&node| node >= nodes) {
                    return Some(format!("cell {label} names a node that is not there"));
                }
            }
        }
        if let Some(what) = parts.ties.iter().find_map(|tie| tie.misfit(nodes)) {
            return Some(what);
        }
        for (name, set) in &parts.node_sets {
            if set.iter().any(|&node| node >= nodes) {
                return Some(format!("node set {name} names a node that is not there"));
            }
        }
        for (name, set) in &parts.element_sets {
            let missing =
                |cell: &Cell| parts.blocks.get(cell.block).is_none_or(|b| cell.cell >= b.len());
            if set.iter().any(missing) {
                return Some(format!("element set {name} names a cell that is not there"));
            }
        }
        None
    }

    /// Path of the file, or the maker of the mesh.
    pub fn origin(&self) -> &str {
        &self.parts.origin
    }

    /// Positions of the nodes in m.
    pub fn nodes(&self) -> &[[f64; 3]] {
        &self.parts.nodes
    }

    /// First and last z of the nodes (m).
    pub fn ends(&self) -> [f64; 2] {
        self.nodes().iter().fold([f64::INFINITY, f64::NEG_INFINITY], |ends, node| {
            [ends[0].min(node[2]), ends[1].max(node[2])]
        })
    }

    /// Labels of the nodes in the source.
    pub fn labels(&self) -> &[u64] {
        &self.parts.labels
    }

    /// Blocks of cells.
    pub fn blocks(&self) -> &[Block] {
        &self.parts.blocks
    }

    /// Materials.
    pub fn materials(&self) -> &[Material] {
        &self.parts.materials
    }

    /// Node indices by the set's name.
    pub fn node_sets(&self) -> &BTreeMap<String, Vec<usize>> {
        &self.parts.node_sets
    }

    /// Cells by the set's name.
    pub fn element_sets(&self) -> &BTreeMap<String, Vec<Cell>> {
        &self.parts.element_sets
    }

    /// What joins dofs of nodes beside the cells.
    pub fn ties(&self) -> &[Tie] {
        &self.parts.ties
    }

    /// All equations of the ties.
    pub fn tie_rows(&self) -> Vec<Row> {
        self.ties().iter().flat_map(|tie| tie.rows.iter().cloned()).collect()
    }

    /// The matrices of a body without cells.
    pub fn matrices(&self) -> Option<&BodyMatrices> {
        self.parts.matrices.as_deref()
    }

    /// Number of nodes that have a place: all of them, but of a body of matrices.
    pub fn placed(&self) -> usize {
        self.matrices().map_or(self.nodes().len(), |own| own.placed)
    }

    /// What the dofs are; empty where all are translations.
    pub fn slots(&self) -> &[Slot] {
        self.matrices().map_or(&[], |own| &own.slots)
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.parts.blocks.iter().map(Block::len).sum()
    }

    /// All of it on which a reduced body depends, for the key of a cache. Names and labels change no number, and sets only say
    /// which nodes are output.
    pub(crate) fn content(&self) -> impl Serialize + '_ {
        let Mesh { parts, places: _ } = self;
        let MeshParts {
            origin: _,
            nodes,
            labels: _,
            blocks,
            materials,
            node_sets: _,
            element_sets: _,
            ties,
            matrices,
        } = parts;
        let block = |block: &'_ Block| {
            let Block { element, material, labels: _, connectivity } = block;
            (element.origin.hash, *material, connectivity.clone())
        };
        let blocks: Vec<_> = blocks.iter().map(block).collect();
        let material = |material: &Material| {
            let Material { name: _, properties } = material;
            properties.clone()
        };
        let materials: Vec<_> = materials.iter().map(material).collect();
        let rows = |Tie { name: _, rows }: &Tie| rows.clone();
        let ties: Vec<_> = ties.iter().map(rows).collect();
        (nodes, blocks, materials, ties, matrices.as_deref().map(BodyMatrices::content))
    }

    /// Number of degrees of freedom: three translations a node.
    pub fn dof_count(&self) -> usize {
        3 * self.parts.nodes.len()
    }

    /// Indices of the nodes of a set; names are compared without regard to case.
    ///
    /// Errors: [`Error::MissingSet`] with the nearest name.
    pub fn node_set(&self, name: &str) -> Result<&[usize], Error> {
        let sets = &self.parts.node_sets;
        let found = sets.get(name).or_else(|| {
            sets.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, set)| set)
        });
        let found = found.map(Vec::as_slice).or_else(|| self.node_by_label(name));
        found.ok_or_else(|| Error::MissingSet {
            origin: self.parts.origin.clone(),
            kind: "node",
            name: name.to_owned(),
            nearest: nearest_in_any_case(name, sets.keys().map(String::as_str)).map(str::to_owned),
        })
    }

    /// The node of a body of matrices that `NODE_7` names, as a set.
    fn node_by_label(&self, name: &str) -> Option<&[usize]> {
        let own = self.matrices()?;
        let prefix = name.get(..5).filter(|prefix| prefix.eq_ignore_ascii_case("NODE_"))?;
        let label: u64 = name[prefix.len()..].parse().ok()?;
        let node = self.labels()[..own.placed].iter().position(|&known| known == label)?;
        own.each.get(node..=node)
    }

    /// The only node of a set.
    ///
    /// Errors: as [`Mesh::node_set`], or the set has another number of nodes.
    pub fn single_node(&self, name: &str) -> Result<usize, Error> {
        match self.node_set(name)? {
            [node] => Ok(*node),
            set => Err(Error::Mesh {
                origin: self.parts.origin.clone(),
                what: format!("node set {name} must have one node, it has {}", set.len()),
            }),
        }
    }
}

//! Cells of a half plane turned about the axis: a mesh of quadratic cells.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use whirl_specs::Element;

use super::partition::{Partition, Piece};
use super::row::SectionRow;
use super::strip::{self, Flat};
use crate::error::Error;
use crate::mesh::layers::element;
use crate::mesh::quadratic::{Middles, corner_radius};
use crate::mesh::shaft::from_abaqus;
use crate::mesh::{Block, Cell, Material, Mesh, MeshParts};

/// Wedges and hexahedra: their sets, what Abaqus calls them, and their corners.
const KINDS: [(&str, &str, usize); 2] = [("Ewedge15", "C3D15", 6), ("Ehex20", "C3D20", 8)];

/// Corners of cells of one kind and one material, and the row of each cell.
#[derive(Default)]
struct Cells {
    corners: Vec<usize>,
    rows: Vec<usize>,
}

/// What the mesh is called in errors.
const ORIGIN: &str = "the body made from its sections";

/// The mesh of a partition of rows, with so many sectors around the axis.
pub(super) fn mesh(
    (rows, sectors): (&[SectionRow], usize),
    partition: &Partition,
    elements: &[&'static Element],
) -> Result<Mesh, Error> {
    let grid = Grid::new(partition, sectors);
    let mut nodes = grid.nodes(partition);
    let mut materials: Vec<Material> = Vec::new();
    let of_row: Vec<usize> = rows
        .iter()
        .map(|row| {
            materials.iter().position(|own| *own == row.material).unwrap_or_else(|| {
                materials.push(row.material.clone());
                materials.len() - 1
            })
        })
        .collect();
    let mut cells: Vec<[Cells; 2]> = materials.iter().map(|_| Default::default()).collect();
    // Corners of the free outside and of the bore of each row.
    let mut surfaces: Vec<[BTreeSet<usize>; 2]> = rows.iter().map(|_| Default::default()).collect();
    for (layer, pieces) in partition.pieces.iter().enumerate() {
        for piece in pieces {
            grid.turn(partition, (layer, piece), &mut cells[of_row[piece.row]]);
            // The axis of a full row is no bore.
            let hollow = rows[piece.row].inner != [0.0; 2];
            let sides = [(piece.free[0] && hollow, 0), (piece.free[1], 1)];
            for (_, side) in sides.into_iter().filter(|own| own.0) {
                let own = &mut surfaces[piece.row][1 - side];
                own.extend(grid.ring(layer, piece.left[side]));
                own.extend(grid.ring(layer + 1, piece.right[side]));
            }
        }
    }
    let (mut middles, mut first_label) = (Middles::default(), 1);
    let largest = partition.radii.iter().flatten().copied().fold(0.0, f64::max);
    let rounds = [([0.0; 2], 2.0 * largest)];
    let (mut blocks, mut element_sets) = (Vec::new(), BTreeMap::<String, Vec<Cell>>::new());
    for (material, kinds) in cells.iter().enumerate() {
        for ((set, name, corners), own) in KINDS.into_iter().zip(kinds) {
            if own.rows.is_empty() {
                continue;
            }
            let raised = middles.raise(&mut nodes, &own.corners, corners, &rounds);
            let block = from_abaqus(element(elements, name, ORIGIN)?, &raised, first_label);
            first_label += block.len() as u64;
            for (cell, &row) in own.rows.iter().enumerate() {
                let cell = Cell { block: blocks.len(), cell };
                element_sets.entry(set.to_owned()).or_default().push(cell);
                if let Some(name) = &rows[row].name {
                    element_sets.entry(name.clone()).or_default().push(cell);
                }
            }
            blocks.push(Block { material, ..block });
        }
    }
    let mut node_sets = BTreeMap::<String, BTreeSet<usize>>::new();
    for (row, sides) in rows.iter().zip(surfaces) {
        let Some(name) = &row.name else { continue };
        for (corners, name) in sides.into_iter().zip([name.clone(), format!("{name}_BORE")]) {
            if !corners.is_empty() {
                let all = middles.with_middles(&corners);
                node_sets.entry(name).or_default().extend(all);
            }
        }
    }
    let last = partition.planes.len() - 1;
    for (name, z) in [("LEFT_END", partition.planes[0]), ("RIGHT_END", partition.planes[last])] {
        let there = (0..nodes.len()).filter(|node| nodes[*node][2] == z);
        node_sets.insert(name.to_owned(), there.collect());
    }
    node_sets.insert("Nall".to_owned(), (0..nodes.len()).collect());
    Mesh::new(MeshParts {
        origin: ORIGIN.to_owned(),
        labels: (1..=nodes.len() as u64).collect(),
        nodes,
        blocks,
        materials,
        node_sets: node_sets
            .into_iter()
            .map(|(name, set)| (name, set.into_iter().collect()))
            .collect(),
        element_sets,
        ties: Vec::new(),
        matrices: None,
    })
}

/// Where nodes stand among all: plane by plane, of each radius one on the axis, or one a sector.
struct Grid {
    sectors: usize,
    /// The first node of each radius of each plane.
    first: Vec<Vec<usize>>,
    on_axis: Vec<bool>,
}

impl Grid {
    fn new(partition: &Partition, sectors: usize) -> Grid {
        let mut next = 0;
        let mut of_plane = |radii: &Vec<f64>| -> Vec<usize> {
            let of_radius = |r: &f64| {
                let own = next;
                next += if *r == 0.0 { 1 } else { sectors };
                own
            };
            radii.iter().map(of_radius).collect()
        };
        let first = partition.radii.iter().map(&mut of_plane).collect();
        let on_axis = partition.radii.iter().map(|radii| radii.first() == Some(&0.0)).collect();
        Grid { sectors, first, on_axis }
    }

    fn node(&self, plane: usize, radius: usize, sector: usize) -> usize {
        let own = self.first[plane][radius];
        if radius == 0 && self.on_axis[plane] { own } else { own + sector % self.sectors }
    }

    fn ring(&self, plane: usize, radius: usize) -> impl Iterator<Item = usize> {
        (0..self.sectors).map(move |sector| self.node(plane, radius, sector))
    }

    /// Positions: circles have the second moment of area of theirs.
    fn nodes(&self, partition: &Partition) -> Vec<[f64; 3]> {
        let mut nodes = Vec::new();
        for (&z, radii) in partition.planes.iter().zip(&partition.radii) {
            for &r in radii {
                if r == 0.0 {
                    nodes.push([0.0, 0.0, z]);
                    continue;
                }
                let r = corner_radius(r, self.sectors);
                nodes.extend((0..self.sectors).map(|sector| {
                    let (sin, cos) = (TAU * sector as f64 / self.sectors as f64).sin_cos();
                    [r * cos, r * sin, z]
                }));
            }
        }
        nodes
    }

    /// Cells of a piece: wedges, then hexahedra.
    fn turn(&self, partition: &Partition, (layer, piece): (usize, &Piece), cells: &mut [Cells; 2]) {
        let [inner, outer] = piece.left;
        let left = &partition.radii[layer][inner..=outer];
        let right = &partition.radii[layer + 1][piece.right[0]..=piece.right[1]];
        let apart = partition.planes[layer + 1] - partition.planes[layer];
        let [wedges, hexahedra] = cells;
        for flat in strip::cells(left, right, apart) {
            for sector in 0..self.sectors {
                let l = |k: usize, next: usize| self.node(layer, inner + k, sector + next);
                let r =
                    |k: usize, next: usize| self.node(layer + 1, piece.right[0] + k, sector + next);
                match flat {
                    Flat::Quadrilateral { left: [a, b], right: [c, d] } if l(a, 0) == l(a, 1) => {
                        let corners = [l(a, 0), l(b, 0), l(b, 1), r(c, 0), r(d, 0), r(d, 1)];
                        wedges.push(&corners, piece.row);
                    }
                    Flat::Quadrilateral { left: [a, b], right: [c, d] } => {
                        let bottom = [l(a, 0), l(b, 0), l(b, 1), l(a, 1)];
                        let top = [r(c, 0), r(d, 0), r(d, 1), r(c, 1)];
                        hexahedra.push([bottom, top].as_flattened(), piece.row);
                    }
                    Flat::OnLeft { left: [a, b], right: c } => {
                        let corners = [0, 1].map(|next| [l(a, next), r(c, next), l(b, next)]);
                        wedges.push(corners.as_flattened(), piece.row);
                    }
                    Flat::OnRight { left: a, right: [c, d] } => {
                        let corners = [0, 1].map(|next| [l(a, next), r(c, next), r(d, next)]);
                        wedges.push(corners.as_flattened(), piece.row);
                    }
                }
            }
        }
    }
}

impl Cells {
    fn push(&mut self, corners: &[usize], row: usize) {
        self.corners.extend_from_slice(corners);
        self.rows.push(row);
    }
}

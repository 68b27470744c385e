//! A solid round shaft, made from a few dimensions.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use whirl_specs::Element;

use super::layers::{LayerPlan, element, length, positive, wrong};
use super::{Block, Cell, Material, Mesh, MeshParts};
use crate::error::Error;

const ORIGIN: &str = "the shaft made from its dimensions";

/// A round shaft along z from z = 0, turning in supports.
///
/// Each layer has wedges around the centre and hexahedra with incompatible modes outside. Node sets:
/// `JOURNALk_LEFT`, `_MIDDLE`, `_RIGHT` and `LOADk` on the centre line (k from 1), `DRIVE_TOP` and
/// `DRIVE_BOTTOM` at the rim of the section z = 0 along +x and −x, `Nall`. Element sets: `Ewedge6`, `Ehex8`.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidShaft {
    /// m.
    pub length: f64,
    /// Of the round section, m; the polygon that stands for it has the same radius of gyration.
    pub diameter: f64,
    /// z of the middle of each support, ascending, m.
    pub supports: Vec<f64>,
    /// Length of each support along z, m.
    pub support_length: f64,
    /// Layers of cells in a support; even.
    pub layers_in_support: usize,
    /// Layers of cells between two supports.
    pub layers_between: usize,
    /// z of the loaded nodes on the centre line, m; each where a layer ends.
    pub loads: Vec<f64>,
    /// Cells of a section.
    pub section: SectionCells,
    /// Its material.
    pub material: Material,
}

/// Cells of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SectionCells {
    /// Around; even, at least 4.
    pub sectors: usize,
    /// From the centre to the rim.
    pub rings: usize,
}

impl Default for SectionCells {
    fn default() -> Self {
        SectionCells { sectors: 8, rings: 3 }
    }
}

impl SolidShaft {
    /// The mesh, with the elements of `elements` that Abaqus calls C3D6 and C3D8I.
    ///
    /// # Errors
    /// [`Error::Dimension`] naming the dimension that cannot be, [`Error::Mesh`] for a missing element.
    pub fn mesh(&self, elements: &[&'static Element]) -> Result<Mesh, Error> {
        let (wedge, hexahedron) =
            (element(elements, "C3D6", ORIGIN)?, element(elements, "C3D8I", ORIGIN)?);
        self.check()?;
        let SectionCells { sectors, rings } = self.section;
        let layers = self.plan().layers()?;
        let in_section = 1 + rings * sectors;
        let node = |plane: usize, ring: usize, sector: usize| {
            plane * in_section
                + if ring == 0 { 0 } else { 1 + (ring - 1) * sectors + sector % sectors }
        };

        let rim = corner_radius(0.5 * self.diameter, sectors);
        let mut nodes = Vec::with_capacity(layers.planes.len() * in_section);
        for &z in &layers.planes {
            nodes.push([0.0, 0.0, z]);
            for ring in 1..=rings {
                let radius = rim * ring as f64 / rings as f64;
                let angle = |sector: usize| TAU * sector as f64 / sectors as f64;
                nodes.extend(
                    (0..sectors).map(|sector| {
                        [radius * angle(sector).cos(), radius * angle(sector).sin(), z]
                    }),
                );
            }
        }

        let (mut wedges, mut hexahedra) = (Vec::new(), Vec::new());
        for plane in 0..layers.planes.len() - 1 {
            for sector in 0..sectors {
                for ends in [plane, plane + 1] {
                    let corners = [(0, 0), (1, sector), (1, sector + 1)];
                    wedges.extend(corners.map(|(ring, sector)| node(ends, ring, sector)));
                }
                for ring in 1..rings {
                    for ends in [plane, plane + 1] {
                        let corners = [
                            (ring, sector),
                            (ring + 1, sector),
                            (ring + 1, sector + 1),
                            (ring, sector + 1),
                        ];
                        hexahedra.extend(corners.map(|(ring, sector)| node(ends, ring, sector)));
                    }
                }
            }
        }

        let mut node_sets = BTreeMap::new();
        for (k, &start) in layers.support_starts.iter().enumerate() {
            let half = self.layers_in_support / 2;
            for (name, plane) in [("LEFT", 0), ("MIDDLE", half), ("RIGHT", 2 * half)] {
                let set = vec![node(start + plane, 0, 0)];
                node_sets.insert(format!("JOURNAL{}_{name}", k + 1), set);
            }
        }
        for (k, &z) in self.loads.iter().enumerate() {
            let plane = layers.at(z).ok_or_else(|| {
                let nearest = layers.planes[layers.nearest(z)];
                let help = format!(
                    "move the load to {}, where the nearest layer ends, or change `layers_between`",
                    length(nearest)
                );
                let what = "has no node: no layer of cells ends there";
                wrong(&format!("loads[{k}]"), length(z), what, help)
            })?;
            node_sets.insert(format!("LOAD{}", k + 1), vec![node(plane, 0, 0)]);
        }
        node_sets.insert("DRIVE_TOP".to_owned(), vec![node(0, rings, 0)]);
        node_sets.insert("DRIVE_BOTTOM".to_owned(), vec![node(0, rings, sectors / 2)]);
        node_sets.insert("Nall".to_owned(), (0..nodes.len()).collect());

        let mut first_label = 1;
        let mut blocks = Vec::new();
        let mut element_sets = BTreeMap::new();
        for (name, element, connectivity) in
            [("Ewedge6", wedge, wedges), ("Ehex8", hexahedron, hexahedra)]
        {
            let block = from_abaqus(element, &connectivity, first_label);
            first_label += block.len() as u64;
            let cells = (0..block.len()).map(|cell| Cell { block: blocks.len(), cell });
            element_sets.insert(name.to_owned(), cells.collect());
            blocks.push(block);
        }
        Mesh::new(MeshParts {
            origin: ORIGIN.to_owned(),
            labels: (1..=nodes.len() as u64).collect(),
            nodes,
            blocks,
            materials: vec![self.material.clone()],
            node_sets,
            element_sets,
            matrices: None,
        })
    }

    fn check(&self) -> Result<(), Error> {
        positive(&[
            ("length", self.length),
            ("diameter", self.diameter),
            ("support_length", self.support_length),
        ])?;
        let SectionCells { sectors, rings } = self.section;
        if sectors < 4 || !sectors.is_multiple_of(2) {
            let help = "make it 4, 6, 8 or another even number";
            return Err(wrong("cells.sectors", sectors, "is not an even number from 4 on", help));
        }
        if rings < 2 {
            let help = "make it 2 at least: wedges around the centre, then hexahedra";
            return Err(wrong("cells.rings", rings, "leaves no hexahedra", help));
        }
        Ok(())
    }

    fn plan(&self) -> LayerPlan<'_> {
        LayerPlan {
            start: 0.0,
            length: self.length,
            supports: ("supports", &self.supports),
            support_length: ("support_length", self.support_length),
            layers_in_support: ("layers_in_support", self.layers_in_support),
            layers_between: ("layers_between", self.layers_between),
            longest: 0.25 * self.diameter,
            in_layer: self.section.sectors.saturating_mul(self.section.rings),
        }
    }
}

/// Cells whose nodes stand in the order of Abaqus.
pub(super) fn from_abaqus(element: &'static Element, nodes: &[usize], first_label: u64) -> Block {
    let mut connectivity = vec![0; nodes.len()];
    let cells = connectivity.chunks_exact_mut(element.nodes);
    for (own, listed) in cells.zip(nodes.chunks_exact(element.nodes)) {
        listed.iter().zip(element.abaqus_order).for_each(|(&node, &place)| own[place] = node);
    }
    let count = (nodes.len() / element.nodes) as u64;
    let labels = (first_label..first_label + count).collect();
    Block { element, material: 0, labels, connectivity }
}

/// Circumradius of the polygon with the radius of gyration of a circle of radius r.
///
/// About a diameter a polygon of n corners at a has (2 + cos 2π/n)/12 · a², a circle r²/4. The reference
/// model gives the octagon's coefficient to four digits, 0.2256; so does this, for every n, so that its
/// shaft is met to rounding.
pub(super) fn corner_radius(r: f64, corners: usize) -> f64 {
    let coefficient = (2.0 + (2.0 * PI / corners as f64).cos()) / 12.0;
    let coefficient = (1e4 * coefficient).round() / 1e4;
    r * (0.25 / coefficient).sqrt()
}

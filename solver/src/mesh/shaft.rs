//! A solid round shaft, made from a few dimensions.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use whirl_specs::Element;

use super::fineness::{Beam, linear_error};
use super::layers::{LayerPlan, Layers, element, length, positive, wrong};
use super::quadratic::{self, Middles, Round};
use super::{Block, Cell, Fineness, Material, Mesh, MeshParts};
use crate::error::Error;

const ORIGIN: &str = "the shaft made from its dimensions";
/// Part by which frequencies of bending may be off where a case leaves the layers open.
pub const FINE: f64 = 1e-3;
/// Planes nearer than this part of the diameter are one.
const SPLIT: f64 = 0.01;
/// κ of a round section (Cowper, J. Appl. Mech. 33 (1966) 335–340, at ν = 0.3).
pub(super) const ROUND: f64 = 0.886;

/// A round shaft along z from z = 0, turning in supports.
///
/// Each layer has wedges around the centre and hexahedra outside: linear ones, with incompatible modes, or quadratic ones,
/// whose edges around the axis are arcs. Node sets:
/// `JOURNALk_LEFT`, `_MIDDLE`, `_RIGHT` and `LOADk` on the centre line (k from 1), `DRIVE_TOP` and
/// `DRIVE_BOTTOM` at the rim of the section z = 0 along +x and −x, `Nall`. Element sets: `Ewedge6`, `Ehex8`; or `Ewedge15`, `Ehex20`.
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
    /// z of sections that carry something, m: layers of quadratic cells end there, outside of supports.
    pub sections: Vec<f64>,
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
    /// 1: linear cells, 2: quadratic ones.
    pub order: usize,
}

impl Default for SectionCells {
    fn default() -> Self {
        SectionCells { sectors: 8, rings: 3, order: 1 }
    }
}

impl SolidShaft {
    /// The mesh, with the elements of `elements` that Abaqus calls C3D6 and C3D8I, or C3D15 and C3D20.
    ///
    /// # Errors
    /// [`Error::Dimension`] naming the dimension that cannot be, [`Error::Mesh`] for a missing element.
    pub fn mesh(&self, elements: &[&'static Element]) -> Result<Mesh, Error> {
        self.check()?;
        let SectionCells { sectors, rings, order } = self.section;
        let layers = self.layers()?;
        let in_section = 1 + rings * sectors;
        let node = |plane: usize, ring: usize, sector: usize| {
            plane * in_section
                + if ring == 0 { 0 } else { 1 + (ring - 1) * sectors + sector % sectors }
        };

        let rim = self.section.corner_radius(0.5 * self.diameter);
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
        let rounds = [([0.0; 2], rim)];
        let (blocks, element_sets) =
            solids(elements, ORIGIN, &mut nodes, ([wedges, hexahedra], order), &rounds)?;
        node_sets.insert("Nall".to_owned(), (0..nodes.len()).collect());
        Mesh::new(MeshParts {
            origin: ORIGIN.to_owned(),
            labels: (1..=nodes.len() as u64).collect(),
            nodes,
            blocks,
            materials: vec![self.material.clone()],
            node_sets,
            element_sets,
            ties: Vec::new(),
            matrices: None,
        })
    }

    /// How fine its layers are; none where its dimensions cannot be.
    pub fn fineness(&self) -> Option<Fineness> {
        let planes = self.layers().ok()?.planes;
        let longest = planes.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        let SectionCells { rings, order, .. } = self.section;
        let error = match order {
            1 => linear_error(longest, 0.5 * self.diameter, rings, shear_ratio(&self.material)),
            _ => self.beam().quadratic_error(longest),
        };
        Some(Fineness { order, longest, error })
    }

    /// Layers in a support and between two of them with which frequencies of bending are right to this part, if cells are
    /// quadratic.
    pub fn layers_for(&self, tolerance: f64) -> [usize; 2] {
        let longest = self.beam().longest_layer(tolerance);
        let inside = layers(0.5 * self.support_length, longest).saturating_mul(2);
        let between = self.supports.windows(2).map(|pair| pair[1] - pair[0] - self.support_length);
        [inside, between.map(|span| layers(span, longest)).max().unwrap_or(1)]
    }

    fn beam(&self) -> Beam {
        let square = 0.25 * self.diameter * self.diameter;
        Beam {
            length: self.length,
            area_over_moment: 4.0 / square,
            shear: ROUND * shear_ratio(&self.material),
        }
    }

    fn check(&self) -> Result<(), Error> {
        self.section.check()?;
        positive(&[
            ("length", self.length),
            ("diameter", self.diameter),
            ("support_length", self.support_length),
        ])?;
        let SectionCells { sectors, rings, .. } = self.section;
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

    fn layers(&self) -> Result<Layers, Error> {
        let mut layers = self.plan().layers()?;
        if self.section.order > 1 {
            for &z in &self.sections {
                layers.split(z, self.layers_in_support, SPLIT * self.diameter);
            }
        }
        Ok(layers)
    }

    fn plan(&self) -> LayerPlan<'_> {
        LayerPlan {
            start: 0.0,
            length: self.length,
            supports: ("supports", &self.supports),
            support_length: ("support_length", self.support_length),
            layers_in_support: ("layers_in_support", self.layers_in_support),
            layers_between: ("layers_between", self.layers_between),
            longest: match self.section.order {
                1 => 0.25 * self.diameter,
                // Where there is no span, as where layers are chosen.
                _ => self.beam().longest_layer(FINE).max(0.25 * self.diameter),
            },
            in_layer: self.section.sectors.saturating_mul(self.section.rings),
        }
    }
}

impl SectionCells {
    pub(super) fn check(&self) -> Result<(), Error> {
        check_order(self.order)
    }

    /// Radius to the corners of the section that stands for a circle of radius r.
    pub(super) fn corner_radius(&self, r: f64) -> f64 {
        match self.order {
            1 => corner_radius(r, self.sectors),
            _ => quadratic::corner_radius(r, self.sectors),
        }
    }
}

/// Notes an order that no cells have.
pub(super) fn check_order(order: usize) -> Result<(), Error> {
    match order {
        1 | 2 => Ok(()),
        _ => {
            let help = "make it 2, or 1 for linear cells";
            Err(wrong("cells.order", order, "is no order of cells", help))
        }
    }
}

/// G/E of a material; that of steel where it does not say ν.
pub(super) fn shear_ratio(material: &Material) -> f64 {
    let nu = material.properties.get("nu").copied().unwrap_or(0.3);
    0.5 / (1.0 + nu)
}

/// Layers of at most this length in a range.
pub(super) fn layers(range: f64, longest: f64) -> usize {
    // A count that no mesh has is refused where the mesh is made.
    ((range / longest - 1e-9).ceil().max(1.0)) as usize
}

/// Blocks of wedges and of hexahedra, by the corners that Abaqus lists, with their element sets; quadratic ones get the
/// nodes in the middles of their edges.
#[allow(clippy::type_complexity, reason = "blocks and their sets")]
pub(super) fn solids(
    elements: &[&'static Element],
    origin: &str,
    nodes: &mut Vec<[f64; 3]>,
    (cells, order): ([Vec<usize>; 2], usize),
    rounds: &[Round],
) -> Result<(Vec<Block>, BTreeMap<String, Vec<Cell>>), Error> {
    let kinds = match order {
        1 => [("Ewedge6", "C3D6", 6), ("Ehex8", "C3D8I", 8)],
        _ => [("Ewedge15", "C3D15", 6), ("Ehex20", "C3D20", 8)],
    };
    let mut middles = Middles::default();
    let (mut first_label, mut blocks, mut sets) = (1, Vec::new(), BTreeMap::new());
    for ((set, name, corners), own) in kinds.into_iter().zip(cells) {
        let element = element(elements, name, origin)?;
        let connectivity =
            if order == 1 { own } else { middles.raise(nodes, &own, corners, rounds) };
        let block = from_abaqus(element, &connectivity, first_label);
        first_label += block.len() as u64;
        let cells = (0..block.len()).map(|cell| Cell { block: blocks.len(), cell });
        sets.insert(set.to_owned(), cells.collect());
        blocks.push(block);
    }
    Ok((blocks, sets))
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

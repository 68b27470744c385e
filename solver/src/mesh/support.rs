//! A beam above rings that are joined to it by pedestals, made from a few dimensions.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, TAU};

use whirl_specs::Element;

use super::fineness::Beam;
use super::layers::{LayerPlan, Layers, element, length, positive, wrong};
use super::quadratic::Middles;
use super::shaft::{FINE, check_order, from_abaqus, layers, shear_ratio};
use super::{Cell, Fineness, Material, Mesh, MeshParts};
use crate::error::Error;

const ORIGIN: &str = "the support made from its dimensions";
/// κ of a rectangle (Cowper, J. Appl. Mech. 33 (1966) 335–340, at ν = 0.3).
const RECTANGLE: f64 = 0.850;

/// A beam along z above rings around the z axis; a pedestal joins each ring's top to the beam.
///
/// All cells are hexahedra: linear ones with incompatible modes, or quadratic ones, whose edges around the axis are arcs. Node sets: `BOREk_LEFT`, `_MIDDLE`, `_RIGHT` around
/// each bore (k from 1), `MOUNTS` on the beam's top and `GROUND_SPRINGS` on its underside, half way
/// across, at both ends and in the middle; `Nall`. Element set: `Ehex8` or `Ehex20`.
#[derive(Debug, Clone, PartialEq)]
pub struct RingSupport {
    /// z of the beam's start, m.
    pub start: f64,
    /// Of the beam along z, m.
    pub length: f64,
    /// Of the beam along x, m.
    pub height: f64,
    /// Of the beam and the pedestals along y, m.
    pub width: f64,
    /// From a ring's top to the beam, m.
    pub pedestal_height: f64,
    /// z of the middle of each ring, ascending, m.
    pub rings: Vec<f64>,
    /// Of a ring along z, m.
    pub ring_length: f64,
    /// m.
    pub ring_thickness: f64,
    /// m.
    pub bore_radius: f64,
    /// Layers of cells in a ring along z; even.
    pub layers_in_ring: usize,
    /// Layers of cells of the beam between two rings.
    pub layers_between: usize,
    /// Cells of a section.
    pub section: SupportCells,
    /// Its material.
    pub material: Material,
}

/// Cells of a section through a ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SupportCells {
    /// Of the beam along x.
    pub height: usize,
    /// Of the beam, the pedestals and the ring's top along y; even.
    pub width: usize,
    /// Of the pedestals along x.
    pub pedestal: usize,
    /// Around a ring; those beside the pedestal share the rest of the angle equally.
    pub around: usize,
    /// Through a ring's thickness.
    pub radial: usize,
    /// 1: linear cells, 2: quadratic ones.
    pub order: usize,
}

impl Default for SupportCells {
    fn default() -> Self {
        SupportCells { height: 8, width: 4, pedestal: 6, around: 24, radial: 2, order: 1 }
    }
}

/// A node by its place in one of the parts; k counts planes, in a ring and its pedestal from its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum GridPlace {
    Beam { up: usize, across: usize, plane: usize },
    Ring { ring: usize, out: usize, around: usize, plane: usize },
    Pedestal { ring: usize, up: usize, across: usize, plane: usize },
}

impl RingSupport {
    /// The mesh, with the element of `elements` that Abaqus calls C3D8I, or C3D20.
    ///
    /// # Errors
    /// [`Error::Dimension`] naming the dimension that cannot be, [`Error::Mesh`] for a missing element.
    pub fn mesh(&self, elements: &[&'static Element]) -> Result<Mesh, Error> {
        self.check()?;
        let layers = self.plan().layers()?;
        let maker = MeshBuilder::new(self, &layers);
        let mut nodes = NodeGrid { maker: &maker, index: BTreeMap::new(), positions: Vec::new() };
        let mut cells = Vec::new();
        for corners in maker.beam().chain(maker.pedestals()).chain(maker.rings()) {
            cells.extend(corners.map(|place| nodes.index(place)));
        }
        let mut node_sets = maker.node_sets(&mut nodes);
        let mut nodes = nodes.positions;
        let (set, block) = match self.section.order {
            1 => ("Ehex8", from_abaqus(element(elements, "C3D8I", ORIGIN)?, &cells, 1)),
            _ => {
                let mut middles = Middles::default();
                let rounds = [([0.0; 2], self.outer_radius())];
                let cells = middles.raise(&mut nodes, &cells, 8, &rounds);
                for (_, ring) in node_sets.iter_mut().filter(|(name, _)| name.starts_with("BORE")) {
                    *ring = middles.around(ring);
                }
                node_sets.insert("Nall".to_owned(), (0..nodes.len()).collect());
                ("Ehex20", from_abaqus(element(elements, "C3D20", ORIGIN)?, &cells, 1))
            }
        };
        let all = (0..block.len()).map(|cell| Cell { block: 0, cell }).collect();
        Mesh::new(MeshParts {
            origin: ORIGIN.to_owned(),
            labels: (1..=nodes.len() as u64).collect(),
            nodes,
            blocks: vec![block],
            materials: vec![self.material.clone()],
            node_sets,
            element_sets: BTreeMap::from([(set.to_owned(), all)]),
            ties: Vec::new(),
            matrices: None,
        })
    }

    fn outer_radius(&self) -> f64 {
        self.bore_radius + self.ring_thickness
    }

    /// Layers in a ring and between two of them with which frequencies of bending of the beam, as a beam without rings, are
    /// right to this part, if cells are quadratic.
    pub fn layers_for(&self, tolerance: f64) -> [usize; 2] {
        let longest = self.beam().longest_layer(tolerance);
        let between = self.rings.windows(2).map(|pair| pair[1] - pair[0] - self.ring_length);
        [
            layers(0.5 * self.ring_length, longest).saturating_mul(2),
            between.map(|span| layers(span, longest)).max().unwrap_or(1),
        ]
    }

    /// How fine its layers are; none where its dimensions cannot be, and of linear cells, which have modes for bending.
    pub fn fineness(&self) -> Option<Fineness> {
        let planes = self.plan().layers().ok()?.planes;
        let longest = planes.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        let order = self.section.order;
        (order == 2).then(|| Fineness {
            order,
            longest,
            error: self.beam().quadratic_error(longest),
        })
    }

    fn beam(&self) -> Beam {
        // Bending across its lower side, in which it is softest.
        let side = self.height.min(self.width);
        Beam {
            length: self.length,
            area_over_moment: 12.0 / (side * side),
            shear: RECTANGLE * shear_ratio(&self.material),
        }
    }

    fn check(&self) -> Result<(), Error> {
        check_order(self.section.order)?;
        positive(&[
            ("length", self.length),
            ("height", self.height),
            ("width", self.width),
            ("pedestal_height", self.pedestal_height),
            ("ring_length", self.ring_length),
            ("ring_thickness", self.ring_thickness),
            ("bore_radius", self.bore_radius),
        ])?;
        if !self.start.is_finite() {
            return Err(wrong("start", self.start, "is not finite", "give a length"));
        }
        let cells = self.section;
        let counts = [
            ("cells.height", cells.height),
            ("cells.pedestal", cells.pedestal),
            ("cells.radial", cells.radial),
        ];
        if let Some((name, count)) = counts.into_iter().find(|&(_, count)| count == 0) {
            return Err(wrong(name, count, "leaves no cells", "make it 1 at least"));
        }
        if cells.width == 0 || !cells.width.is_multiple_of(2) {
            let help = "make it 2, 4 or another even number, so that nodes stand half way across";
            let what = "is not an even number above zero";
            return Err(wrong("cells.width", cells.width, what, help));
        }
        let outer = self.outer_radius();
        if self.width >= 2.0 * outer {
            let what = format!(
                "makes the pedestals as wide as the rings, whose outer diameter is {} (bore_radius + \
                 ring_thickness, twice)",
                length(2.0 * outer)
            );
            let help = "make `width` smaller than this diameter, or the rings larger";
            return Err(wrong("width", length(self.width), what, help));
        }
        let beside = TAU - 2.0 * (0.5 * self.width / outer).asin();
        let least = cells.width + (beside / FRAC_PI_2).ceil() as usize;
        if cells.around < least {
            let what = "makes cells of a right angle or more";
            return Err(wrong(
                "cells.around",
                cells.around,
                what,
                format!("make it {least} at least"),
            ));
        }
        Ok(())
    }

    fn plan(&self) -> LayerPlan<'_> {
        LayerPlan {
            start: self.start,
            length: self.length,
            supports: ("rings", &self.rings),
            support_length: ("ring_length", self.ring_length),
            layers_in_support: ("layers_in_ring", self.layers_in_ring),
            layers_between: ("layers_between", self.layers_between),
            longest: match self.section.order {
                1 => 0.5 * self.height,
                // Where there is no span, as where layers are chosen.
                _ => self.beam().longest_layer(FINE).max(0.5 * self.height),
            },
            in_layer: {
                let SupportCells { height, width, pedestal, around, radial, .. } = self.section;
                width
                    .saturating_mul(height.saturating_add(pedestal))
                    .saturating_add(around.saturating_mul(radial))
            },
        }
    }
}

/// Nodes numbered as they are first met; each stands in one place of the parts.
struct NodeGrid<'a> {
    maker: &'a MeshBuilder<'a>,
    index: BTreeMap<GridPlace, usize>,
    positions: Vec<[f64; 3]>,
}

impl NodeGrid<'_> {
    fn index(&mut self, place: GridPlace) -> usize {
        let place = self.maker.shared(place);
        *self.index.entry(place).or_insert_with(|| {
            self.positions.push(self.maker.position(place));
            self.positions.len() - 1
        })
    }
}

struct MeshBuilder<'a> {
    support: &'a RingSupport,
    layers: &'a Layers,
    /// Angles of the nodes around a ring; the first width + 1 carry the pedestal.
    angles: Vec<f64>,
}

impl<'a> MeshBuilder<'a> {
    fn new(support: &'a RingSupport, layers: &'a Layers) -> Self {
        let cells = support.section;
        let half = 0.5 * support.width;
        let across = |j: usize| -half + support.width * j as f64 / cells.width as f64;
        let mut angles: Vec<f64> =
            (0..=cells.width).map(|j| (across(j) / support.outer_radius()).asin()).collect();
        let edge = angles[cells.width];
        let beside = cells.around - cells.width;
        let step = (TAU - 2.0 * edge) / beside as f64;
        angles.extend((1..beside).map(|i| edge + step * i as f64));
        MeshBuilder { support, layers, angles }
    }

    /// The ring's top is the pedestal's foot, the pedestal's head is part of the beam's underside.
    fn shared(&self, place: GridPlace) -> GridPlace {
        let cells = self.support.section;
        match place {
            GridPlace::Ring { ring, out, around, plane } => {
                GridPlace::Ring { ring, out, around: around % cells.around, plane }
            }
            GridPlace::Pedestal { ring, up: 0, across, plane } => {
                GridPlace::Ring { ring, out: cells.radial, around: across, plane }
            }
            GridPlace::Pedestal { ring, up, across, plane } if up == cells.pedestal => {
                GridPlace::Beam { up: 0, across, plane: self.layers.support_starts[ring] + plane }
            }
            place => place,
        }
    }

    fn position(&self, place: GridPlace) -> [f64; 3] {
        let support = self.support;
        let cells = support.section;
        let part = |i: usize, of: usize| i as f64 / of as f64;
        let underside = support.outer_radius() + support.pedestal_height;
        let y = |across: usize| support.width * (part(across, cells.width) - 0.5);
        let plane_of = |ring: usize, plane: usize| {
            self.layers.planes[self.layers.support_starts[ring] + plane]
        };
        match place {
            GridPlace::Beam { up, across, plane } => [
                underside + support.height * part(up, cells.height),
                y(across),
                self.layers.planes[plane],
            ],
            GridPlace::Ring { ring, out, around, plane } => {
                let radius = support.bore_radius + support.ring_thickness * part(out, cells.radial);
                let angle = self.angles[around];
                [radius * angle.cos(), radius * angle.sin(), plane_of(ring, plane)]
            }
            GridPlace::Pedestal { ring, up, across, plane } => {
                let foot = support.outer_radius() * self.angles[across].cos();
                let x = foot + (underside - foot) * part(up, cells.pedestal);
                [x, y(across), plane_of(ring, plane)]
            }
        }
    }

    fn beam(&self) -> impl Iterator<Item = [GridPlace; 8]> {
        let cells = self.support.section;
        corners([cells.height, cells.width, self.layers.planes.len() - 1], |up, across, plane| {
            GridPlace::Beam { up, across, plane }
        })
    }

    fn pedestals(&self) -> impl Iterator<Item = [GridPlace; 8]> {
        let (cells, layers) = (self.support.section, self.support.layers_in_ring);
        (0..self.support.rings.len()).flat_map(move |ring| {
            corners([cells.pedestal, cells.width, layers], move |up, across, plane| {
                GridPlace::Pedestal { ring, up, across, plane }
            })
        })
    }

    fn rings(&self) -> impl Iterator<Item = [GridPlace; 8]> {
        let (cells, layers) = (self.support.section, self.support.layers_in_ring);
        (0..self.support.rings.len()).flat_map(move |ring| {
            corners([cells.radial, cells.around, layers], move |out, around, plane| {
                GridPlace::Ring { ring, out, around, plane }
            })
        })
    }

    fn node_sets(&self, nodes: &mut NodeGrid) -> BTreeMap<String, Vec<usize>> {
        let cells = self.support.section;
        let mut sets = BTreeMap::new();
        for ring in 0..self.support.rings.len() {
            let half = self.support.layers_in_ring / 2;
            for (name, plane) in [("LEFT", 0), ("MIDDLE", half), ("RIGHT", 2 * half)] {
                let place = |around: usize| GridPlace::Ring { ring, out: 0, around, plane };
                let bore = (0..cells.around).map(|around| nodes.index(place(around))).collect();
                sets.insert(format!("BORE{}_{name}", ring + 1), bore);
            }
        }
        let middle = self.layers.nearest(self.support.start + 0.5 * self.support.length);
        let stations = [0, middle, self.layers.planes.len() - 1];
        for (name, up) in [("MOUNTS", cells.height), ("GROUND_SPRINGS", 0)] {
            let across = cells.width / 2;
            let set = stations.map(|plane| nodes.index(GridPlace::Beam { up, across, plane }));
            sets.insert(name.to_owned(), set.to_vec());
        }
        sets.insert("Nall".to_owned(), (0..nodes.positions.len()).collect());
        sets
    }
}

/// Corners of the cells of a grid in the order of Abaqus: so many along each of three directions, the first the fastest.
fn corners(
    [first, second, third]: [usize; 3],
    place: impl Fn(usize, usize, usize) -> GridPlace + Copy,
) -> impl Iterator<Item = [GridPlace; 8]> {
    let cell = move |i, j, k| {
        let face = |k| [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(di, dj)| place(i + di, j + dj, k));
        let ([a, b, c, d], [e, f, g, h]) = (face(k), face(k + 1));
        [a, b, c, d, e, f, g, h]
    };
    let row = move |j, k| (0..first).map(move |i| cell(i, j, k));
    (0..third).flat_map(move |k| (0..second).flat_map(move |j| row(j, k)))
}

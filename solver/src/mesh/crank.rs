//! One throw of a crankshaft, made from a few dimensions.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use whirl_specs::Element;

use super::layers::{MOST_CELLS, length, positive, wrong};
use super::shaft::{SectionCells, layers, solids};
use super::{Material, Mesh, MeshParts};
use crate::error::Error;

const ORIGIN: &str = "the crank made from its dimensions";
/// Cells of a web from a journal or the pin to its edge.
const BAND: usize = 2;

/// A throw along z from z = 0: main journal, web, pin, web, main journal. The main journals stand on the axis, the pin at
/// x = `throw`; the webs are plates around both.
///
/// Node sets: `JOURNALk_LEFT`, `_MIDDLE`, `_RIGHT` (k = 1, 2) and `PIN_LEFT`, `_MIDDLE`, `_RIGHT` on the centre lines,
/// `DRIVE_TOP` and `DRIVE_BOTTOM` at the rim of the section z = 0 along +x and −x, `Nall`.
#[derive(Debug, Clone, PartialEq)]
pub struct CrankThrow {
    /// From the axis to the centre of the pin, m.
    pub throw: f64,
    /// Of the main journals, m.
    pub diameter: f64,
    /// Of each main journal along z, m.
    pub support_length: f64,
    /// Of the pin, m.
    pub pin_diameter: f64,
    /// Of the pin along z, m.
    pub pin_length: f64,
    /// Of the webs across the throw, m.
    pub web_width: f64,
    /// Of each web along z, m.
    pub web_thickness: f64,
    /// Layers of cells in each journal and in the pin; even.
    pub layers_in_support: usize,
    /// Layers of cells in a web.
    pub layers_between: usize,
    /// Cells of journals and pin; a multiple of 8 around.
    pub section: SectionCells,
    /// Its material.
    pub material: Material,
}

/// Cells of a plane, by nodes of the plane.
struct Plane {
    positions: Vec<[f64; 2]>,
    /// Of the main journals and of the pin.
    rounds: [Round; 2],
}

/// A round with the part of the web around it.
struct Round {
    centre: usize,
    wedges: Vec<[usize; 3]>,
    /// Inside the round.
    inner: Vec<[usize; 4]>,
    /// Of the web.
    outer: Vec<[usize; 4]>,
    /// On the rim along +x and −x.
    rim: [usize; 2],
}

impl CrankThrow {
    /// The mesh, with the elements of `elements` that Abaqus calls C3D6 and C3D8I, or C3D15 and C3D20.
    ///
    /// # Errors
    /// [`Error::Dimension`] naming the dimension that cannot be, [`Error::Mesh`] for a missing element.
    pub fn mesh(&self, elements: &[&'static Element]) -> Result<Mesh, Error> {
        self.check()?;
        let plane = self.plane();
        // Layers from the left: how many, how long, and which cells of the plane they have.
        let (inside, web) = (self.layers_in_support, self.layers_between);
        let parts = [
            (inside, self.support_length, [true, false], false),
            (web, self.web_thickness, [true, true], true),
            (inside, self.pin_length, [false, true], false),
            (web, self.web_thickness, [true, true], true),
            (inside, self.support_length, [true, false], false),
        ];
        let (mut z, mut first, mut layers, mut starts) = (vec![0.0], 0.0, Vec::new(), Vec::new());
        for (count, length, rounds, whole) in parts {
            starts.push(layers.len());
            z.extend((1..=count).map(|k| first + length * k as f64 / count as f64));
            first += length;
            layers.extend((0..count).map(|_| (rounds, whole)));
        }

        let mut known: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        let mut nodes = Vec::new();
        let mut node = |level: usize, place: usize| {
            *known.entry((level, place)).or_insert_with(|| {
                let [x, y] = plane.positions[place];
                nodes.push([x, y, z[level]]);
                nodes.len() - 1
            })
        };
        let (mut wedges, mut hexahedra) = (Vec::new(), Vec::new());
        for (layer, (rounds, whole)) in layers.iter().enumerate() {
            for (round, _) in plane.rounds.iter().zip(rounds).filter(|(_, there)| **there) {
                for corners in &round.wedges {
                    for level in [layer, layer + 1] {
                        wedges.extend(corners.map(|place| node(level, place)));
                    }
                }
                let web = round.outer.iter().filter(|_| *whole);
                for corners in round.inner.iter().chain(web) {
                    for level in [layer, layer + 1] {
                        hexahedra.extend(corners.map(|place| node(level, place)));
                    }
                }
            }
        }

        let mut node_sets = BTreeMap::new();
        for (name, part, round) in [("JOURNAL1", 0, 0), ("PIN", 2, 1), ("JOURNAL2", 4, 0)] {
            for (end, layers) in [("LEFT", 0), ("MIDDLE", inside / 2), ("RIGHT", inside)] {
                let centre = node(starts[part] + layers, plane.rounds[round].centre);
                node_sets.insert(format!("{name}_{end}"), vec![centre]);
            }
        }
        for (name, place) in ["DRIVE_TOP", "DRIVE_BOTTOM"].into_iter().zip(plane.rounds[0].rim) {
            node_sets.insert(name.to_owned(), vec![node(0, place)]);
        }
        let [journal, pin] = self.radii();
        let rounds = [([0.0; 2], journal), ([self.throw, 0.0], pin)];
        let order = self.section.order;
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

    /// Layers in journals and pin, and in a web, no longer than a radius: enough for quadratic cells, as nothing in a throw
    /// is slender.
    pub fn default_layers(&self) -> [usize; 2] {
        let radius = 0.5 * self.diameter.min(self.pin_diameter);
        let longest = self.support_length.max(self.pin_length);
        [layers(0.5 * longest, radius).saturating_mul(2), layers(self.web_thickness, radius)]
    }

    /// Radii of journals and pin to the corners of their polygons.
    fn radii(&self) -> [f64; 2] {
        [self.diameter, self.pin_diameter]
            .map(|diameter| self.section.corner_radius(0.5 * diameter))
    }

    fn plane(&self) -> Plane {
        let [journal, pin] = self.radii();
        // Both halves of the web meet in the middle between journal and pin.
        let middle = 0.5 * (journal + self.throw - pin);
        let half = 0.5 * self.web_width;
        let mut positions = Vec::new();
        let first = self.round(&mut positions, 0.0, journal, [-half, middle], None);
        let shared = positions.len();
        let second =
            self.round(&mut positions, self.throw, pin, [middle, self.throw + half], Some(shared));
        Plane { positions, rounds: [first, second] }
    }

    /// A round about x = `centre`, and the web around it between two x. `before`: number of nodes of the one at its left,
    /// whose last nodes are those of the web's edge, where both meet.
    fn round(
        &self,
        positions: &mut Vec<[f64; 2]>,
        centre: f64,
        radius: f64,
        [left, right]: [f64; 2],
        before: Option<usize>,
    ) -> Round {
        let SectionCells { sectors, rings, .. } = self.section;
        let (half, side) = (0.5 * self.web_width, sectors / 4);
        // The edge of the web, from the corner at the lower right on around it; as many cells at each side.
        let edge = |sector: usize| {
            let (part, along) = (sector / side, (sector % side) as f64 / side as f64);
            let (wide, high) = ((right - left) * along, 2.0 * half * along);
            match part {
                0 => [right, -half + high],
                1 => [right - wide, half],
                2 => [left, half - high],
                _ => [left + wide, -half],
            }
        };
        let angle = |sector: usize| TAU * (sector as f64 / sectors as f64 - 0.125);
        let start = positions.len();
        positions.push([centre, 0.0]);
        let mut lines = vec![vec![start; sectors]];
        for ring in 1..=rings + BAND {
            let line = (0..sectors).map(|sector| {
                let (sin, cos) = angle(sector).sin_cos();
                let inside = radius * (ring.min(rings) as f64 / rings as f64);
                let rim = [centre + inside * cos, inside * sin];
                let out = ring.saturating_sub(rings) as f64 / BAND as f64;
                let place = [0, 1].map(|i| rim[i] + out * (edge(sector)[i] - rim[i]));
                // The left edge is the right one of the round before, from its other end.
                if let (Some(before), true, 2) = (before, ring == rings + BAND, sector / side) {
                    return before - sectors + (side - sector % side);
                }
                if let (Some(before), true, 3) = (before, ring == rings + BAND, sector / side)
                    && sector % side == 0
                {
                    return before - sectors;
                }
                positions.push(place);
                positions.len() - 1
            });
            lines.push(line.collect::<Vec<usize>>());
        }
        let next = |sector: usize| (sector + 1) % sectors;
        let cells = |from: usize, to: usize| -> Vec<[usize; 4]> {
            let all = (from..to).flat_map(|ring| (0..sectors).map(move |sector| (ring, sector)));
            all.map(|(ring, sector)| {
                let (own, out) = (&lines[ring], &lines[ring + 1]);
                [own[sector], out[sector], out[next(sector)], own[next(sector)]]
            })
            .collect()
        };
        let wedge = |sector: usize| [start, lines[1][sector], lines[1][next(sector)]];
        Round {
            centre: start,
            wedges: (0..sectors).map(wedge).collect(),
            inner: cells(1, rings),
            outer: cells(rings, rings + BAND),
            rim: [sectors / 8, sectors / 8 + sectors / 2].map(|sector| lines[rings][sector]),
        }
    }

    fn check(&self) -> Result<(), Error> {
        positive(&[
            ("throw", self.throw),
            ("diameter", self.diameter),
            ("support_length", self.support_length),
            ("pin_diameter", self.pin_diameter),
            ("pin_length", self.pin_length),
            ("web_width", self.web_width),
            ("web_thickness", self.web_thickness),
        ])?;
        self.section.check()?;
        let SectionCells { sectors, rings, .. } = self.section;
        if sectors < 8 || !sectors.is_multiple_of(8) {
            let help = "make it 8, 16 or another multiple of 8";
            return Err(wrong(
                "cells.sectors",
                sectors,
                "is no multiple of 8, as cranks need",
                help,
            ));
        }
        if rings < 2 {
            let help = "make it 2 at least: wedges around the centre, then hexahedra";
            return Err(wrong("cells.rings", rings, "leaves no hexahedra", help));
        }
        let inside = self.layers_in_support;
        if inside == 0 || !inside.is_multiple_of(2) {
            let help = "make it 2, 4 or another even number, so that nodes stand in the middle";
            return Err(wrong(
                "layers_in_support",
                inside,
                "is not an even number above zero",
                help,
            ));
        }
        if self.layers_between == 0 {
            let help = "make it 1 at least";
            return Err(wrong("layers_between", 0, "leaves no layer of cells in the webs", help));
        }
        let radii = self.radii();
        if self.throw <= 1.02 * (radii[0] + radii[1]) {
            let least = 1.02 * (radii[0] + radii[1]);
            let what = "leaves no room between journal and pin, which must not overlap";
            let help = format!("make it more than {}, or journal and pin thinner", length(least));
            return Err(wrong("throw", length(self.throw), what, help));
        }
        let widest = 2.0 * radii[0].max(radii[1]);
        if self.web_width <= 1.02 * widest {
            let what = "is not wider than journal and pin";
            let help = format!("make it more than {}", length(1.02 * widest));
            return Err(wrong("web_width", length(self.web_width), what, help));
        }
        let layers = inside.saturating_mul(3).saturating_add(self.layers_between.saturating_mul(2));
        let in_layer = sectors.saturating_mul(2).saturating_mul(rings.saturating_add(BAND));
        if layers.saturating_mul(in_layer) > MOST_CELLS {
            let what = format!(
                "makes too many cells: {layers} layers of up to {in_layer} cells, where a mesh made \
                 from dimensions has at most {MOST_CELLS} cells"
            );
            let help = "make fewer layers, or fewer cells in each";
            return Err(wrong("layers_in_support", inside, what, help));
        }
        Ok(())
    }
}

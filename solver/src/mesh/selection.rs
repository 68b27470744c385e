//! Cylinders that a mesh has, and its faces as they are seen from an axis.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::f64::consts::TAU;

use super::regions::connected;
use super::surface::faces_within;
use super::surface_face::SurfaceFace;
use super::{Mesh, MeshParts};

/// A cylinder that a mesh has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// Mean radius (m).
    pub radius: f64,
    /// From where to where along z (m).
    pub z: [f64; 2],
    /// Whether the body is around it, as around a bore.
    pub hollow: bool,
}

/// A normal counts as radial, or as along z, where this part of it is.
pub(super) const ALONG: f64 = 0.7;
/// A face of a cylinder is seen from its axis under this angle at most (rad): a square bar is none, a pentagon may be.
const FACET: f64 = 75.0 / 180.0 * std::f64::consts::PI;
/// Faces look into so many directions at least on a cylinder, and into others by this angle (rad).
const DIRECTIONS: (usize, f64) = (3, 1e-3);
/// Faces are on one cylinder if their radii differ by at most this part.
const SAME: f64 = 0.01;

impl Mesh {
    /// The mesh with another node set, in place of one of the same name.
    pub fn with_node_set(self, name: &str, nodes: Vec<usize>) -> Mesh {
        let mut parts: MeshParts = self.parts;
        parts.node_sets.insert(name.to_owned(), nodes);
        Mesh { parts, places: self.places }
    }

    /// The cylinders about an axis parallel to z that are parts of the surface, by z and then by radius.
    pub fn cylinders(&self, centre: [f64; 2]) -> Vec<Cylinder> {
        self.cylinders_with_nodes(centre).into_iter().map(|(cylinder, _)| cylinder).collect()
    }

    /// Each with its nodes: faces that share nodes, are as far from the axis and look the same way.
    pub(super) fn cylinders_with_nodes(&self, centre: [f64; 2]) -> Vec<(Cylinder, Vec<usize>)> {
        let all = vec![true; self.nodes().len()];
        let faces = self.surface_within(&all);
        let faces = faces.iter().map(|face| (self.seen(face, centre), face));
        // All nodes of a face on a cylinder are as far from the axis.
        let round =
            |(own, _): &(SeenFace, &SurfaceFace)| own.is_round() && own.spread <= SAME * own.radius;
        let faces: Vec<(SeenFace, &SurfaceFace)> = faces.filter(round).collect();
        let mut known: HashMap<(usize, bool), Vec<usize>> = HashMap::new();
        let mut pairs = Vec::new();
        for (place, (own, face)) in faces.iter().enumerate() {
            for node in face.nodes() {
                let others = known.entry((node, own.radial < 0.0)).or_default();
                let same = |&&other: &&usize| {
                    (faces[other].0.radius - own.radius).abs() <= SAME * own.radius
                };
                pairs.extend(others.iter().find(same).map(|&other| (place, other)));
                others.push(place);
            }
        }
        type Part = (Cylinder, f64, BTreeSet<usize>, Vec<f64>);
        let mut found: BTreeMap<usize, Part> = BTreeMap::new();
        let parts = connected(faces.len(), pairs);
        for ((own, face), part) in faces.iter().zip(parts) {
            let (cylinder, count, nodes, directions) = found.entry(part).or_insert_with(|| {
                let hollow = own.radial < 0.0;
                (Cylinder { radius: 0.0, z: own.z, hollow }, 0.0, BTreeSet::new(), Vec::new())
            });
            let direction = own.normal[1].atan2(own.normal[0]);
            let (enough, apart) = DIRECTIONS;
            if directions.len() < enough
                && directions.iter().all(|known| turn(direction - known).abs() > apart)
            {
                directions.push(direction);
            }
            *count += 1.0;
            cylinder.radius += (own.radius - cylinder.radius) / *count;
            cylinder.z = [cylinder.z[0].min(own.z[0]), cylinder.z[1].max(own.z[1])];
            nodes.extend(face.nodes());
        }
        let mut found: Vec<_> = found
            .into_values()
            .filter(|(_, _, _, directions)| directions.len() >= DIRECTIONS.0)
            .map(|(own, _, nodes, _)| (own, nodes.into_iter().collect()))
            .collect();
        found.sort_by(|(a, _): &(Cylinder, Vec<usize>), (b, _)| {
            a.z[0].total_cmp(&b.z[0]).then(a.radius.total_cmp(&b.radius))
        });
        found
    }

    /// Faces of one cell only, all of whose nodes are inside.
    pub(super) fn surface_within(&self, inside: &[bool]) -> Vec<SurfaceFace> {
        faces_within(self, inside).into_iter().filter(|face| !face.shared).collect()
    }

    pub(super) fn seen(&self, face: &SurfaceFace, centre: [f64; 2]) -> SeenFace {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for [x, y, z] in places(face, self) {
            let seen = [(x - centre[0]).hypot(y - centre[1]), z];
            for k in 0..2 {
                low[k] = low[k].min(seen[k]);
                high[k] = high[k].max(seen[k]);
            }
        }
        let ([x, y, _], normal) = face.middle(self.nodes());
        let (x, y) = (x - centre[0], y - centre[1]);
        let away = x.hypot(y);
        let angle = y.atan2(x);
        let (mut first, mut last) = (0.0_f64, 0.0_f64);
        for [x, y, _] in places(face, self) {
            let turned = turn((y - centre[1]).atan2(x - centre[0]) - angle);
            (first, last) = (first.min(turned), last.max(turned));
        }
        let span = last - first;
        let radial = if away > 0.0 { (normal[0] * x + normal[1] * y) / away } else { 0.0 };
        SeenFace {
            radius: 0.5 * (low[0] + high[0]),
            spread: high[0] - low[0],
            z: [low[1], high[1]],
            normal,
            radial,
            span,
        }
    }
}

fn places(face: &SurfaceFace, mesh: &Mesh) -> impl Iterator<Item = [f64; 3]> {
    face.nodes().map(|node| mesh.nodes()[node])
}

/// An angle from −π to π.
fn turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

impl SeenFace {
    /// Whether it may be one of a cylinder about the axis.
    pub(super) fn is_round(&self) -> bool {
        self.radial.abs() >= ALONG && self.span <= FACET
    }
}

/// A face as seen from an axis.
pub(super) struct SeenFace {
    radius: f64,
    /// Largest less smallest distance of its nodes from the axis.
    spread: f64,
    pub(super) z: [f64; 2],
    /// Its outward unit normal, and the part of it along the radius.
    pub(super) normal: [f64; 3],
    pub(super) radial: f64,
    /// Angle under which it is seen from the axis (rad).
    span: f64,
}

//! Node sets by where they are: what a mesh file has no sets of.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::surface::{SurfaceFace, faces_within};
use super::{Mesh, MeshParts, connected};

/// Nodes by their place, in the coordinates of the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Selection {
    /// Of the faces on a cylinder about an axis parallel to z.
    Cylinder {
        /// x and y of the axis (m).
        centre: [f64; 2],
        /// m.
        radius: f64,
        /// How far nodes may be from it (m).
        within: f64,
        /// From where to where along z (m).
        z: [f64; 2],
    },
    /// Near a point.
    Point {
        /// The point (m).
        at: [f64; 3],
        /// How far from it (m).
        within: f64,
    },
    /// Of the faces in a plane across an axis.
    Plane {
        /// 0 x, 1 y, 2 z.
        across: usize,
        /// Where on it (m).
        at: f64,
        /// How far nodes may be from it (m).
        within: f64,
    },
}

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
const ALONG: f64 = 0.7;
/// Faces are on one cylinder if their radii differ by at most this part.
const SAME: f64 = 0.01;

impl Mesh {
    /// The nodes of a selection, ascending; faces count where they are on the surface of the mesh. Of a body of
    /// matrices, which has no faces, the nodes count.
    pub fn selected(&self, selection: &Selection) -> Vec<usize> {
        let near = |node: &[f64; 3]| match *selection {
            Selection::Cylinder { centre, radius, within, z } => {
                let away = (node[0] - centre[0]).hypot(node[1] - centre[1]) - radius;
                // Ends of a range are planes of nodes as often as not.
                let margin = 1e-6 * radius;
                away.abs() <= within && z[0] - margin <= node[2] && node[2] <= z[1] + margin
            }
            Selection::Point { at, within } => {
                let square: f64 = (0..3).map(|k| (node[k] - at[k]).powi(2)).sum();
                square <= within * within
            }
            Selection::Plane { across, at, within } => (node[across] - at).abs() <= within,
        };
        let placed = &self.nodes()[..self.placed()];
        let inside: Vec<bool> = placed.iter().map(near).collect();
        let fits = |face: &SeenFace| match *selection {
            Selection::Cylinder { .. } => face.radial.abs() >= ALONG,
            Selection::Plane { across, .. } => face.normal[across].abs() >= ALONG,
            Selection::Point { .. } => true,
        };
        let centre = match *selection {
            Selection::Cylinder { centre, .. } => centre,
            _ => [0.0; 2],
        };
        let chosen: BTreeSet<usize> = match selection {
            // Matrices have no faces.
            _ if self.matrices().is_some() => {
                (0..placed.len()).filter(|&node| inside[node]).collect()
            }
            Selection::Point { .. } => (0..inside.len()).filter(|&node| inside[node]).collect(),
            _ => {
                let faces = self.surface_within(&inside);
                let fit = faces.iter().filter(|face| fits(&self.seen(face, centre)));
                fit.flat_map(SurfaceFace::nodes).collect()
            }
        };
        chosen.into_iter().collect()
    }

    /// The mesh with another node set, in place of one of the same name.
    pub fn with_node_set(self, name: &str, nodes: Vec<usize>) -> Mesh {
        let mut parts: MeshParts = self.parts;
        parts.node_sets.insert(name.to_owned(), nodes);
        Mesh { parts }
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
        let round = |(own, _): &(SeenFace, &SurfaceFace)| {
            own.radial.abs() >= ALONG && own.spread <= SAME * own.radius
        };
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
        let mut found: BTreeMap<usize, (Cylinder, f64, BTreeSet<usize>)> = BTreeMap::new();
        let parts = connected(faces.len(), pairs);
        for ((own, face), part) in faces.iter().zip(parts) {
            let (cylinder, count, nodes) = found.entry(part).or_insert_with(|| {
                let hollow = own.radial < 0.0;
                (Cylinder { radius: 0.0, z: own.z, hollow }, 0.0, BTreeSet::new())
            });
            *count += 1.0;
            cylinder.radius += (own.radius - cylinder.radius) / *count;
            cylinder.z = [cylinder.z[0].min(own.z[0]), cylinder.z[1].max(own.z[1])];
            nodes.extend(face.nodes());
        }
        let mut found: Vec<_> =
            found.into_values().map(|(own, _, nodes)| (own, nodes.into_iter().collect())).collect();
        found.sort_by(|(a, _): &(Cylinder, Vec<usize>), (b, _)| {
            a.z[0].total_cmp(&b.z[0]).then(a.radius.total_cmp(&b.radius))
        });
        found
    }

    /// Faces of one cell only, all of whose nodes are inside.
    fn surface_within(&self, inside: &[bool]) -> Vec<SurfaceFace> {
        faces_within(self, inside).into_iter().filter(|face| !face.shared).collect()
    }

    fn seen(&self, face: &SurfaceFace, centre: [f64; 2]) -> SeenFace {
        let places = face.nodes().map(|node| self.nodes()[node]);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for [x, y, z] in places {
            let seen = [(x - centre[0]).hypot(y - centre[1]), z];
            for k in 0..2 {
                low[k] = low[k].min(seen[k]);
                high[k] = high[k].max(seen[k]);
            }
        }
        let ([x, y, _], normal) = face.middle(self.nodes());
        let (x, y) = (x - centre[0], y - centre[1]);
        let away = x.hypot(y);
        let radial = if away > 0.0 { (normal[0] * x + normal[1] * y) / away } else { 0.0 };
        SeenFace {
            radius: 0.5 * (low[0] + high[0]),
            spread: high[0] - low[0],
            z: [low[1], high[1]],
            normal,
            radial,
        }
    }
}

/// A face as seen from an axis.
struct SeenFace {
    radius: f64,
    /// Largest less smallest distance of its nodes from the axis.
    spread: f64,
    z: [f64; 2],
    /// Its outward unit normal, and the part of it along the radius.
    normal: [f64; 3],
    radial: f64,
}

//! Surfaces of a mesh: the faces of cells all of whose nodes are in a set, and points on them.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::Mesh;
use super::set_place::SetPlace;
use super::surface_face::{SurfaceFace, beyond};
use crate::error::Error;

/// The faces of cells all of whose nodes are `inside`, each once where two cells share it.
pub(crate) fn faces_within(mesh: &Mesh, inside: &[bool]) -> Vec<SurfaceFace> {
    let mut found: Vec<SurfaceFace> = Vec::new();
    let mut known: HashMap<Vec<usize>, usize> = HashMap::new();
    for block in mesh.blocks() {
        for cell in block.cells() {
            if cell.iter().filter(|&&node| inside[node]).count() < 3 {
                continue;
            }
            for face in block.element.faces {
                let mut nodes: Vec<usize> = face.nodes.iter().map(|&place| cell[place]).collect();
                if !nodes.iter().all(|&node| inside[node]) {
                    continue;
                }
                nodes.sort_unstable();
                match known.entry(nodes) {
                    Entry::Occupied(place) => found[*place.get()].shared = true,
                    Entry::Vacant(place) => {
                        place.insert(found.len());
                        let (element, cell) = (block.element, cell.to_vec());
                        found.push(SurfaceFace { element, face, cell, shared: false });
                    }
                }
            }
        }
    }
    found
}

/// How far beyond the edge of a face a point may be, in its coordinates s and t: edges of bores are not quite at the z that
/// a case says, and faces between nodes on a circle leave gaps at none.
const BEYOND: f64 = 0.02;
const ITERATIONS: usize = 30;

/// A surface around an axis parallel to z: of a journal or of a bore.
#[derive(Debug, Clone)]
pub struct Surface<'a> {
    mesh: &'a Mesh,
    /// x and y of the axis (m).
    axis: [f64; 2],
    faces: Vec<SurfaceFace>,
    /// From where to where along z faces count (m).
    band: [f64; 2],
}

/// A point of a body: Σ c u over nodes of the mesh is its displacement.
pub type SurfacePoint = Vec<(usize, f64)>;

impl<'a> Surface<'a> {
    /// The faces all of whose nodes are in a set; there may be none.
    ///
    /// # Panics
    /// If a node is none of the mesh.
    pub fn new(mesh: &'a Mesh, nodes: &[usize], axis: [f64; 2]) -> Surface<'a> {
        let mut inside = vec![false; mesh.nodes().len()];
        nodes.iter().for_each(|&node| inside[node] = true);
        let band = [f64::NEG_INFINITY, f64::INFINITY];
        Surface { mesh, axis, faces: faces_within(mesh, &inside), band }
    }

    /// The faces of a set by its name; of one by place whose faces are cut, as far as they count.
    ///
    /// # Errors
    /// The set is not there.
    pub fn of_set(mesh: &'a Mesh, name: &str, axis: [f64; 2]) -> Result<Surface<'a>, Error> {
        match mesh.place_of(name).map(SetPlace::faces) {
            Some((faces, Some(band))) => Ok(Surface { mesh, axis, faces: faces.to_vec(), band }),
            _ => Ok(Surface::new(mesh, mesh.node_set(name)?, axis)),
        }
    }

    /// Whether there are no faces.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// z of both ends (m); infinite without faces.
    pub fn ends(&self) -> [f64; 2] {
        let nodes = self.faces.iter().flat_map(SurfaceFace::nodes);
        let z = nodes.map(|node| self.mesh.nodes()[node][2]);
        let [low, high] =
            z.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)]);
        [low.max(self.band[0]), high.min(self.band[1])]
    }

    /// Where the half-plane at `angle` (rad) about the axis meets the surface at `z` (m), by the face's own shape
    /// functions; none where there is no face.
    pub fn at(&self, angle: f64, z: f64) -> Option<SurfacePoint> {
        let near = self.faces.iter().filter(|face| self.may_be_at(face, angle, z));
        let found = near.filter_map(|face| self.on(face, angle, z));
        // Of points beyond edges, the one that is least so.
        let (beyond, point) = found.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (beyond <= BEYOND).then_some(point)
    }

    /// x and y from the axis, along an angle and across it, and z.
    fn seen(&self, node: usize, angle: f64) -> [f64; 3] {
        let ([x, y, z], (sin, cos)) = (self.mesh.nodes()[node], angle.sin_cos());
        let (x, y) = (x - self.axis[0], y - self.axis[1]);
        [cos * x + sin * y, cos * y - sin * x, z]
    }

    /// Whether a face may meet the half-plane there: its nodes are not all on one side, with a margin for curvature.
    fn may_be_at(&self, face: &SurfaceFace, angle: f64, z: f64) -> bool {
        let nodes: Vec<[f64; 3]> = face.nodes().map(|node| self.seen(node, angle)).collect();
        let ends = |axis: usize, at: f64| {
            let all = nodes.iter().map(|x| x[axis]);
            let low = all.clone().fold(f64::INFINITY, f64::min);
            let high = all.fold(f64::NEG_INFINITY, f64::max);
            let margin = 0.25 * (high - low);
            low - margin <= at && at <= high + margin
        };
        nodes.iter().any(|x| x[0] > 0.0) && ends(1, 0.0) && ends(2, z)
    }

    /// The point of a face, or of what goes on beyond its edges, and how far beyond it is.
    fn on(&self, own: &SurfaceFace, angle: f64, z: f64) -> Option<(f64, SurfacePoint)> {
        let SurfaceFace { element, face, cell, .. } = own;
        let centre = if face.corners == 3 { 1.0 / 3.0 } else { 0.0 };
        let (mut values, mut slopes) = (vec![0.0; element.nodes], vec![[0.0; 3]; element.nodes]);
        let mut at = [centre; 2];
        for _ in 0..ITERATIONS {
            let cell_at = [0, 1, 2]
                .map(|k| face.origin[k] + at[0] * face.along[0][k] + at[1] * face.along[1][k]);
            (element.shape)(cell_at, &mut values, &mut slopes);
            let mut residual = [0.0, -z];
            let mut along = 0.0;
            // ∂(across, z)/∂(s, t).
            let mut by = [[0.0; 2]; 2];
            for &place in face.nodes {
                let [radial, across, height] = self.seen(cell[place], angle);
                along += values[place] * radial;
                for (row, x) in [across, height].into_iter().enumerate() {
                    residual[row] += values[place] * x;
                    for (column, along) in face.along.iter().enumerate() {
                        let slope: f64 = (0..3).map(|k| slopes[place][k] * along[k]).sum();
                        by[row][column] += slope * x;
                    }
                }
            }
            let [[a, b], [c, d]] = by;
            let det = a * d - b * c;
            let step = [
                (d * residual[0] - b * residual[1]) / det,
                (a * residual[1] - c * residual[0]) / det,
            ];
            if !step[0].is_finite() || !step[1].is_finite() {
                return None;
            }
            if step[0].abs().max(step[1].abs()) < 1e-12 {
                let weights = face.nodes.iter().map(|&place| (cell[place], values[place]));
                return (along > 0.0).then(|| (beyond(face, at), weights.collect()));
            }
            // Curved faces are followed step by step.
            let most = 1.0 / step[0].abs().max(step[1].abs()).max(1.0);
            at = [at[0] - most * step[0], at[1] - most * step[1]];
        }
        None
    }
}

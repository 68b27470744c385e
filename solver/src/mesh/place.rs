//! What a node set by its place has caught: nodes, and faces, which are cut where a band along z ends within them.

use std::f64::consts::TAU;

use super::Mesh;
use super::cut::Sample;
use super::mean::NodeSetMean;
use super::selection::{ALONG, Cylinder};
use super::set_place::{Selection, SetPlace, nodes_of};
use super::surface::faces_within;
use super::surface_face::SurfaceFace;
use crate::error::Error;

/// Ends of a band are planes of nodes as often as not: to this part of the radius.
const MARGIN: f64 = 1e-6;

/// What a node set of a mesh has, for people.
#[derive(Debug, Clone, PartialEq)]
pub struct Caught {
    /// Number of nodes.
    pub nodes: usize,
    /// Number of faces between them, in part or as wholes.
    pub faces: usize,
    /// How many of the faces are cut.
    pub cut: usize,
    /// m²; none without faces.
    pub area: Option<f64>,
    /// The mean point (m).
    pub centre: [f64; 3],
    /// Of a cylinder: which part of the full band about its axis the faces cover, as angle times length.
    pub share: Option<f64>,
    /// Of a cylinder: from its axis to the mean point (m).
    pub off_axis: Option<f64>,
}

impl SetPlace {
    /// Whether a face reaches out of the band, by more than coordinates are off by their digits.
    fn cuts(&self, mesh: &Mesh, face: &SurfaceFace) -> bool {
        let (Some([from, to]), Selection::Cylinder { radius, .. }) = (self.band, self.selection)
        else {
            return false;
        };
        let margin = MARGIN * radius;
        let mut heights = face.nodes().map(|node| mesh.nodes()[node][2]);
        heights.any(|z| z < from - margin || to + margin < z)
    }

    /// Points over all that counts.
    pub(super) fn each_point(&self, mesh: &Mesh, mut visit: impl FnMut(&Sample)) {
        for face in &self.faces {
            match self.band.filter(|_| self.cuts(mesh, face)) {
                Some(band) => face.each_point_within(mesh.nodes(), band, &mut visit),
                None => face.each_point(mesh.nodes(), &mut visit),
            }
        }
    }

    /// Outer faces and faces of a hole, where a cylinder has caught both: from and up to which distance from its radius
    /// nodes of each are (m).
    pub fn two_sides(&self, mesh: &Mesh) -> Option<[[f64; 2]; 2]> {
        let Selection::Cylinder { centre, radius, .. } = self.selection else { return None };
        let mut sides = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for face in &self.faces {
            let side = &mut sides[usize::from(mesh.seen(face, centre).radial < 0.0)];
            for [x, y, _] in face.nodes().map(|node| mesh.nodes()[node]) {
                let away = ((x - centre[0]).hypot(y - centre[1]) - radius).abs();
                *side = [side[0].min(away), side[1].max(away)];
            }
        }
        sides.iter().all(|side| side[0].is_finite()).then_some(sides)
    }
}

impl Mesh {
    /// The nodes of a selection, ascending: see [`Mesh::select`].
    pub fn selected(&self, selection: &Selection) -> Vec<usize> {
        self.select(selection).nodes
    }

    /// The nodes and faces of a selection; faces count where they are on the surface of the mesh, and those of a cylinder
    /// as far as they are within its band along z. Of a body of matrices, which has no faces, the nodes count.
    pub fn select(&self, selection: &Selection) -> SetPlace {
        let found =
            |nodes: Vec<usize>, faces, band| SetPlace { selection: *selection, nodes, faces, band };
        let placed = &self.nodes()[..self.placed()];
        let all = |near: &dyn Fn(&[f64; 3]) -> bool| -> Vec<usize> {
            (0..placed.len()).filter(|&node| near(&placed[node])).collect()
        };
        match *selection {
            Selection::Cylinder { centre, radius, within, z } => {
                let margin = MARGIN * radius;
                let on = |node: &[f64; 3]| {
                    ((node[0] - centre[0]).hypot(node[1] - centre[1]) - radius).abs() <= within
                };
                let between = |x: f64| z[0] - margin <= x && x <= z[1] + margin;
                if self.matrices().is_some() {
                    return found(all(&|node| on(node) && between(node[2])), Vec::new(), None);
                }
                let inside: Vec<bool> = placed.iter().map(on).collect();
                let mut faces = self.surface_within(&inside);
                let (mut cut, mut kept) = (false, Vec::with_capacity(faces.len()));
                for face in &faces {
                    let own = self.seen(face, centre);
                    let whole = own.z.iter().all(|&end| between(end));
                    let beside = own.z[1] <= z[0] + margin || z[1] - margin <= own.z[0];
                    kept.push(own.is_round() && (whole || !beside));
                    cut |= own.is_round() && !whole && !beside;
                }
                let mut kept = kept.into_iter();
                faces.retain(|_| kept.next().unwrap_or(false));
                let of_faces = nodes_of(&faces);
                let within: Vec<usize> = of_faces
                    .iter()
                    .copied()
                    .filter(|&node| !cut || between(self.nodes()[node][2]))
                    .collect();
                let nodes = if within.is_empty() { of_faces } else { within };
                found(nodes, faces, cut.then_some(z))
            }
            Selection::Point { at, within } => {
                let near = |node: &[f64; 3]| {
                    let square: f64 = (0..3).map(|k| (node[k] - at[k]).powi(2)).sum();
                    square <= within * within
                };
                found(all(&near), Vec::new(), None)
            }
            Selection::Section { at, within, innermost } => {
                let there = |node: &[f64; 3]| (node[2] - at).abs() <= within;
                let reach = |node: &[f64; 3]| node[0].hypot(node[1]);
                let least = match innermost {
                    true => placed.iter().filter(|node| there(node)).map(reach).reduce(f64::min),
                    false => None,
                };
                let near = |node: &[f64; 3]| {
                    there(node) && least.is_none_or(|least| reach(node) <= (1.0 + MARGIN) * least)
                };
                found(all(&near), Vec::new(), None)
            }
            Selection::Plane { across, at, within } => {
                let near = |node: &[f64; 3]| (node[across] - at).abs() <= within;
                if self.matrices().is_some() {
                    return found(all(&near), Vec::new(), None);
                }
                let inside: Vec<bool> = placed.iter().map(near).collect();
                let mut faces = self.surface_within(&inside);
                faces.retain(|face| self.seen(face, [0.0; 2]).normal[across].abs() >= ALONG);
                found(nodes_of(&faces), faces, None)
            }
        }
    }

    /// The mesh with what a selection has caught as a node set, in place of one of the same name.
    pub fn with_place(self, name: &str, place: SetPlace) -> Mesh {
        let mut mesh = self.with_node_set(name, place.nodes.clone());
        mesh.places.insert(name.to_owned(), place);
        mesh
    }

    /// Where a node set is that is chosen by its place; names are compared without regard to case.
    pub fn place_of(&self, name: &str) -> Option<&SetPlace> {
        let mut all = self.places.iter();
        self.places
            .get(name)
            .or_else(|| all.find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, place)| place))
    }

    /// Whether some faces of a set count in part only, so that its nodes do not say what it is.
    pub fn is_cut(&self, name: &str) -> bool {
        self.place_of(name).is_some_and(SetPlace::is_cut)
    }

    /// What a node set has.
    ///
    /// # Errors
    /// As [`NodeSetMean::of_sets`].
    pub fn caught(&self, name: &str) -> Result<Caught, Error> {
        let mean = NodeSetMean::of_sets(self, &[name])?;
        let nodes = self.node_set(name)?;
        let place = self.place_of(name);
        let (faces, cut) = match place {
            Some(own) => {
                let cut = own.faces.iter().filter(|face| own.cuts(self, face)).count();
                (own.faces.len(), cut)
            }
            None => {
                let mut inside = vec![false; self.nodes().len()];
                nodes.iter().for_each(|&node| inside[node] = true);
                (faces_within(self, &inside).len(), 0)
            }
        };
        let about = place.and_then(|own| match own.selection {
            Selection::Cylinder { centre, z, .. } if !own.faces.is_empty() => {
                Some((own, centre, z))
            }
            _ => None,
        });
        let [x, y, _] = mean.centre();
        Ok(Caught {
            nodes: nodes.len(),
            faces,
            cut,
            area: mean.area(),
            centre: mean.centre(),
            share: about.map(|(own, centre, z)| self.share(own, centre, z)),
            off_axis: about.map(|(_, centre, _)| (x - centre[0]).hypot(y - centre[1])),
        })
    }

    /// Which part of a full band about an axis faces cover.
    fn share(&self, place: &SetPlace, centre: [f64; 2], z: [f64; 2]) -> f64 {
        let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
        for node in place.faces.iter().flat_map(SurfaceFace::nodes) {
            let z = self.nodes()[node][2];
            ends = [ends[0].min(z), ends[1].max(z)];
        }
        for (end, given) in ends.iter_mut().zip(z) {
            *end = if given.is_finite() { given } else { *end };
        }
        let mut covered = 0.0;
        place.each_point(self, |own| {
            // dφ dz of a surface whose part of an area is dS: dS · r / r².
            let (x, y) = (own.at[0] - centre[0], own.at[1] - centre[1]);
            covered += ((own.area[0] * x + own.area[1] * y) / (x * x + y * y)).abs();
        });
        covered / (TAU * (ends[1] - ends[0]))
    }

    /// The cylinder of the surface that is nearest to a radius and to a band along z (m).
    pub fn nearest_cylinder(&self, centre: [f64; 2], radius: f64, z: [f64; 2]) -> Option<Cylinder> {
        let beside = |own: &[f64; 2]| (z[0] - own[1]).max(own[0] - z[1]).clamp(0.0, 1e3);
        let away = |own: &Cylinder| (own.radius - radius).abs() + beside(&own.z);
        self.cylinders(centre).into_iter().min_by(|a, b| away(a).total_cmp(&away(b)))
    }
}

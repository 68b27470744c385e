//! Where a node set is that is chosen by its place: what a mesh file has no sets of.

use std::collections::BTreeSet;

use super::surface_face::SurfaceFace;

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
    /// All nodes at a z, those inside of the body, too.
    Section {
        /// Where (m).
        at: f64,
        /// How far nodes may be from it (m).
        within: f64,
        /// Only those nearest to the axis of the mesh, x = y = 0: the bore there.
        innermost: bool,
    },
}

impl Selection {
    /// The finite z (m) at which it begins, ends or stands.
    pub fn planes(&self) -> Vec<f64> {
        let all = match *self {
            Selection::Cylinder { z, .. } => z.to_vec(),
            Selection::Plane { across: 2, at, .. } | Selection::Section { at, .. } => vec![at],
            Selection::Point { at, .. } => vec![at[2]],
            Selection::Plane { .. } => Vec::new(),
        };
        all.into_iter().filter(|z| z.is_finite()).collect()
    }

    /// The place goes with a mesh that moves along x and y (m).
    pub(super) fn moves(&mut self, by: [f64; 2]) {
        match self {
            Selection::Cylinder { centre, .. } => (0..2).for_each(|k| centre[k] += by[k]),
            Selection::Point { at, .. } => (0..2).for_each(|k| at[k] += by[k]),
            Selection::Plane { across, at, .. } => *at += by.get(*across).unwrap_or(&0.0),
            Selection::Section { .. } => {}
        }
    }
}

/// The nodes and faces of a selection.
#[derive(Debug, Clone)]
pub struct SetPlace {
    /// What was asked for.
    pub selection: Selection,
    /// Nodes, ascending: of the faces that are not cut; where some are, those within the band, or all of the cut faces if
    /// none are.
    pub nodes: Vec<usize>,
    /// Faces that count, in part or as wholes; none of nodes near a point.
    pub(super) faces: Vec<SurfaceFace>,
    /// From where to where along z they count, where that is within some of them (m).
    pub(super) band: Option<[f64; 2]>,
}

impl SetPlace {
    /// Whether some of its faces count in part only.
    pub(super) fn is_cut(&self) -> bool {
        self.band.is_some()
    }

    /// All nodes of its faces, ascending, those of cut ones beside the band, too.
    pub fn face_nodes(&self) -> Vec<usize> {
        nodes_of(&self.faces)
    }

    /// The faces, and from where to where along z they count if some are cut (m).
    pub(super) fn faces(&self) -> (&[SurfaceFace], Option<[f64; 2]>) {
        (&self.faces, self.band)
    }
}

/// The nodes of faces, ascending.
pub(super) fn nodes_of(faces: &[SurfaceFace]) -> Vec<usize> {
    let all: BTreeSet<usize> = faces.iter().flat_map(SurfaceFace::nodes).collect();
    all.into_iter().collect()
}

//! What a case from meshes says, before it is written.

use whirl_solver::mesh::Mesh;

use super::bearings::Meeting;
use crate::mesh_file::Opened;

/// A body of the case.
pub(super) struct Part {
    pub(super) opened: Opened,
    /// As the case calls it.
    pub(super) name: String,
    /// The mesh file, as the case names it.
    pub(super) path: String,
}

impl Part {
    pub(super) fn mesh(&self) -> &Mesh {
        &self.opened.mesh
    }

    /// Whether some cells have no material.
    pub(super) fn lacks_material(&self) -> bool {
        let mesh = self.mesh();
        mesh.blocks().iter().any(|own| mesh.materials()[own.material].properties.is_empty())
    }
}

/// How the support is held.
pub(super) enum Held {
    /// By a node set of its mesh.
    Set(String),
    /// By its faces in a plane across x (0) or z (2), at this place (m).
    Plane(usize, f64),
}

/// What a case says, before it is written.
pub(super) struct Draft {
    pub(super) shaft: Part,
    pub(super) support: Part,
    /// x and y of the axis (m).
    pub(super) axis: [f64; 2],
    pub(super) meetings: Vec<Meeting>,
    /// The bores in which no journal runs, with the reason.
    pub(super) left: Vec<String>,
    pub(super) held: Option<Held>,
    /// Whether the units of the meshes are guessed.
    pub(super) units_guessed: bool,
}

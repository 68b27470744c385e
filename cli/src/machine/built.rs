//! A machine that is built, and facts about its bodies.

use serde::Serialize;
use whirl_solver::cache::Key;
use whirl_solver::dynamics::BodyStart;
use whirl_solver::history::{Column, History};
use whirl_solver::machine::Machine;
use whirl_solver::mesh::Mesh;

use crate::case::LawSource;

/// A machine with what results say about how it came about.
pub struct Built {
    /// The machine.
    pub(crate) machine: Machine,
    /// How the bodies begin.
    pub(crate) initial: Vec<BodyStart>,
    /// Radial clearance of each bearing, m.
    pub(crate) clearances: Vec<f64>,
    /// The laws with the values with which they are used, in the order in which the case first names them.
    pub(crate) laws: Vec<LawSource>,
    /// Names of the laws, and hashes of what they were made from.
    pub(crate) law_hashes: Vec<(String, String)>,
    /// The bodies, where they were reduced from meshes.
    pub(crate) bodies: Option<BodyFacts>,
    /// The meshes of bodies that are written as wholes, in the order of the machine's fields.
    pub(crate) fields: Vec<FieldMesh>,
}

impl Built {
    /// The machine.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The columns of its history.
    pub fn columns(&self) -> Vec<Column> {
        History::columns_of(&self.machine)
    }
}

/// A mesh whose motion is written.
pub(crate) struct FieldMesh {
    /// The mesh.
    pub(crate) mesh: Mesh,
    /// x and y in space of the axis from which its coordinates count (m).
    pub(crate) axis: [f64; 2],
    /// Whether it deforms.
    pub(crate) flexible: bool,
}

/// Facts about the reduced bodies.
pub(crate) struct BodyFacts {
    /// Each of them.
    pub(crate) bodies: Vec<BodyFact>,
    /// Wall time of reading, assembling and reducing, s.
    pub(crate) wall: f64,
    /// Whether the reduced bodies were found in the cache.
    pub(crate) cached: bool,
}

/// Facts about a reduced body.
pub(crate) struct BodyFact {
    /// Its name.
    pub(crate) name: String,
    /// Its sizes.
    pub(crate) counts: Counts,
    /// Fixed-interface frequencies, Hz.
    pub(crate) hertz: Vec<f64>,
    /// A hash of what it and its output nodes depend on.
    pub(crate) content: Key,
}

/// Sizes of a body, as in the paper's Table 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub(crate) struct Counts {
    /// Cells.
    pub(crate) elements: usize,
    /// Nodes.
    pub(crate) nodes: usize,
    /// Three a node.
    pub(crate) physical_dofs: usize,
    /// Physical dofs that are not retained.
    pub(crate) internal_dofs: usize,
    /// Dofs kept as they are.
    pub(crate) retained_dofs: usize,
    /// Fixed-interface modes kept.
    pub(crate) modes: usize,
    /// Modes and retained dofs.
    pub(crate) craig_bampton_dofs: usize,
}

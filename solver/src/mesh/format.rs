//! Which format a file of a mesh has, and what all readers are given and give.

use whirl_specs::Element;

use super::Mesh;
use crate::error::InputError;

/// A mesh with what was left out of the file.
#[derive(Debug, Clone)]
pub struct ReadMesh {
    /// The mesh.
    pub mesh: Mesh,
    /// What was skipped or looks odd, in the order of the lines.
    pub warnings: Vec<InputError>,
}

/// What a reader must know beside the file.
#[derive(Debug, Clone, Copy)]
pub struct ReadOptions<'a> {
    /// The elements that a cell may have.
    pub elements: &'a [&'static Element],
    /// Whether cells without a material are no error: they get one without name and properties, for which
    /// another is to be put.
    pub open: bool,
}

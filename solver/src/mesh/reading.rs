//! What all readers of meshes are given, and what they give.

use whirl_specs::Element;

use super::Mesh;
use super::units::MeshUnits;
use crate::error::InputError;

/// A mesh with what was left out of the file.
#[derive(Debug, Clone)]
pub struct ReadMesh {
    /// The mesh.
    pub mesh: Mesh,
    /// Masses that the file gives to nodes beside the cells: no part of the mesh.
    pub masses: Vec<AddedMass>,
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
    /// Units of the file.
    pub units: MeshUnits,
    /// Whether these count where the file itself says others.
    pub units_given: bool,
    /// Nodes that are at most so far apart (m) become one.
    pub merge: Option<f64>,
}

impl<'a> ReadOptions<'a> {
    /// Every cell must have a material, and the file is in SI units.
    pub fn new(elements: &'a [&'static Element]) -> ReadOptions<'a> {
        let units = MeshUnits::default();
        ReadOptions { elements, open: false, units, units_given: false, merge: None }
    }
}

/// A mass that a file gives to a node beside the cells.
#[derive(Debug, Clone, PartialEq)]
pub struct AddedMass {
    /// Its name, such as `CONM2_12`.
    pub name: String,
    /// Mass.
    pub mass: f64,
    /// Its centre.
    pub at: [f64; 3],
    /// Moments of inertia about its centre, along x, y and z.
    pub inertia: [[f64; 3]; 3],
    /// Sets of the nodes that carry it; none where it stands on no node of the mesh.
    pub sets: Vec<String>,
}

impl AddedMass {
    /// In SI units.
    pub(super) fn convert(&mut self, units: &MeshUnits) {
        self.mass *= units.mass;
        self.at = self.at.map(|x| units.length(x));
        let inertia = units.mass * units.length * units.length;
        self.inertia.iter_mut().flatten().for_each(|value| *value *= inertia);
    }
}

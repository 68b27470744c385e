//! What bodies, bearings and drives are made of, in every form of case.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use whirl_codegen::diagnostic::Located;
use whirl_codegen::units::Dimension;
use whirl_solver::loads::Release;
use whirl_solver::mesh::Material;
use whirl_solver::mesh::format::MeshUnits;
use whirl_solver::mesh::matrices::Request;

use super::columns::{Columns, farther};
use super::dimensions::Dimensions;
use super::law::NamedLaw;
use super::parameters::{BearingFacts, SetParameter};
use super::selections::NamedSelection;

impl Drive {
    /// The speed at which it ends, or the fastest in its table (rad/s), with its sign; 0 of a table over time.
    pub(super) fn fastest(&self) -> f64 {
        let over_speed = |own: &&Arc<Columns>| own.measures[0] == Dimension::ANGULAR_SPEED;
        match self.table.as_ref().filter(over_speed) {
            Some(columns) => columns.rows.iter().fold(0.0, |most: f64, row| farther(most, row[0])),
            None => self.target_speed,
        }
    }

    /// What it is, for people; speeds in rpm.
    pub(crate) fn described(&self) -> String {
        match &self.table {
            Some(columns) => {
                let over = if columns.measures[0] == Dimension::TIME { "time" } else { "speed" };
                format!("table `{}` over {over}", columns.name.text())
            }
            None => {
                let rpm = whirl_text::rounded(self.target_speed * 60.0 / std::f64::consts::TAU, 10);
                format!("{} N m until {rpm} rpm", self.torque)
            }
        }
    }
}

/// Where a mesh comes from.
#[derive(Debug, Clone)]
pub(crate) enum Mesh {
    /// A file of a mesh.
    File(MeshFile),
    /// Made from a few dimensions.
    Generated(Box<GeneratedMesh>),
    /// Matrices in place of one.
    Matrices(Box<MatrixFiles>),
}

impl Mesh {
    /// Where the case says it.
    pub(crate) fn place(&self) -> Located {
        match self {
            Mesh::File(file) => file.name.clone(),
            Mesh::Generated(generated) => generated.table.clone(),
            Mesh::Matrices(files) => files.place.clone(),
        }
    }
}

/// A mesh made from dimensions, and where the case says them.
#[derive(Debug, Clone)]
pub(crate) struct GeneratedMesh {
    /// The dimensions with the material.
    pub(crate) dimensions: Dimensions,
    /// The table of the dimensions.
    pub(crate) table: Located,
    /// The dimensions by their names in the case, such as `length`, `cells.sectors` and `loads[0]`.
    pub(crate) places: BTreeMap<String, Located>,
}

/// A mesh file named by a case.
#[derive(Debug, Clone)]
pub(crate) struct MeshFile {
    /// Resolved path.
    pub(crate) path: PathBuf,
    /// The name as written.
    pub(crate) name: Located,
    /// Units of its numbers.
    pub(crate) units: MeshUnits,
    /// Whether the case says them.
    pub(crate) units_given: bool,
    /// Nodes that are at most so far apart (m) become one.
    pub(crate) merge: Option<f64>,
}

/// Matrices of a body that a case names, in place of a mesh.
#[derive(Debug, Clone)]
pub(crate) struct MatrixFiles {
    /// Resolved paths.
    pub(crate) request: Request,
    /// The table of the case.
    pub(crate) place: Located,
    /// Whether the case leaves out how many modes are kept.
    pub(crate) all_modes: bool,
}

/// What a case says of a body with a mesh.
#[derive(Debug, Clone)]
pub(crate) struct Body {
    /// Mesh.
    pub(crate) mesh: Mesh,
    /// Material of the cells to which the mesh gives none.
    pub(crate) material: Option<Material>,
    /// Materials of parts of the mesh, in place of its own.
    pub(crate) regions: Vec<Region>,
    /// Node sets beside those of the mesh.
    pub(crate) selections: Vec<NamedSelection>,
    /// Fixed-interface modes kept.
    pub(crate) modes: usize,
    /// C = damping · K, in s; K with the ground springs.
    pub(crate) damping: f64,
    /// C = mass_damping · M beside it, in 1/s; of a body that stands.
    pub(crate) mass_damping: f64,
    /// Which static answers are kept beside the modes.
    pub(crate) static_correction: StaticCorrection,
}

/// Static answers of a body that are kept beside its modes.
#[derive(Debug, Clone)]
pub(crate) struct StaticCorrection {
    /// To the loads of the case.
    pub(crate) loads: bool,
    /// To unit forces at the points whose motion the case asks for, along the components that it asks for.
    pub(crate) outputs: bool,
    /// To the pressure of films under which its bores give way.
    pub(crate) pressure: bool,
    /// Where a list of the case names that.
    pub(crate) pressure_named: Option<Located>,
    /// To loads on its bores; where the case says so, if it does.
    pub(crate) bores: Option<Located>,
}

impl Default for StaticCorrection {
    /// What holds where a case says nothing.
    fn default() -> Self {
        StaticCorrection {
            loads: true,
            outputs: false,
            pressure: true,
            pressure_named: None,
            bores: None,
        }
    }
}

/// A material of part of a mesh.
#[derive(Debug, Clone)]
pub(crate) struct Region {
    /// An element set.
    pub(crate) set: Located,
    /// What its cells are made of.
    pub(crate) material: Material,
}

/// A spring from every node of a set to the ground.
#[derive(Debug, Clone)]
pub(crate) struct GroundSpring {
    /// Set of the support's mesh.
    pub(crate) set: Located,
    /// 0, 1, 2 for x, y, z.
    pub(crate) direction: usize,
    /// N/m each.
    pub(crate) stiffness: f64,
}

/// One place where the shaft runs in the support.
#[derive(Debug, Clone)]
pub(crate) struct Bearing {
    /// Sets of one node each on the shaft's centre line: left, middle, right.
    pub(crate) journal: Vec<Located>,
    /// Sets of nodes around the bore: left, middle, right.
    pub(crate) bore: Vec<Located>,
    /// Springs in a ring.
    pub(crate) springs: usize,
    /// z of the rings of springs, m; none means one ring each at left, middle and right.
    pub(crate) stations: Vec<f64>,
    /// Radial clearance c in m.
    pub(crate) radial_clearance: f64,
    /// Radius of the journal in m, if the case says it.
    pub(crate) journal_radius: Option<f64>,
    /// The law of one spring, or of a whole ring.
    pub(crate) law: NamedLaw,
    /// Parameters of the law that the case sets.
    pub(crate) parameters: Vec<SetParameter>,
    /// What the case says of the bearing that laws can take.
    pub(crate) facts: BearingFacts,
    /// The table of the bearing.
    pub(crate) table: Located,
    /// What the bearing and `[springs]` say, by key, such as `radial_clearance` and `stations[0]`.
    pub(crate) places: BTreeMap<String, Located>,
}

impl Bearing {
    /// Rings of springs.
    pub(crate) fn rings(&self) -> usize {
        if self.stations.is_empty() { 3 } else { self.stations.len() }
    }
}

/// A couple that turns the shaft: until a speed is reached, or over time or speed as a table has it.
#[derive(Debug, Clone)]
pub(crate) struct Drive {
    /// The section on which it acts: the set of nodes on whose mean rotation it does; or two sets of one node at opposite ends of
    /// a diameter, as forces +y and −y. None of a rigid body.
    pub(crate) section: Vec<Located>,
    /// N·m about +z; 0 of a table.
    pub(crate) torque: f64,
    /// rad/s; 0 of a table.
    pub(crate) target_speed: f64,
    /// When it ends.
    pub(crate) release: Release,
    /// N·m over s or rad/s.
    pub(crate) table: Option<Arc<Columns>>,
    /// Whether the couple acts; without it the nodes still tie the flexible shaft to its frame.
    pub(crate) acts: bool,
}

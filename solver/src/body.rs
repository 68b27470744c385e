//! What the reduced shaft and the reduced support have in common: from a mesh to active coordinates.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::assembly::assemble;
use crate::constraints::{Constraints, Elimination, GroundSpring, add_ground_springs};
use crate::error::Error;
use crate::linalg::{Matrix, multiply};
use crate::mesh::Mesh;
use crate::reduction::{CraigBampton, Solid};
use crate::sparse::SparseMatrix;

/// Rayleigh damping C = αM + βK.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Rayleigh {
    /// α (1/s).
    pub alpha: f64,
    /// β (s).
    pub beta: f64,
}

impl Rayleigh {
    /// αM + βK.
    pub(crate) fn matrix(&self, mass: &Matrix, stiffness: &Matrix) -> Matrix {
        Matrix::from_fn(mass.rows, mass.cols, |i, j| {
            self.alpha * mass[(i, j)] + self.beta * stiffness[(i, j)]
        })
    }
}

/// A dof that stays a coordinate of the reduced body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Retained {
    /// 3·node + component.
    pub dof: usize,
    /// What it is called, such as `JOURNAL1_LEFT x`.
    pub name: String,
}

/// How a mesh is reduced to a body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySpec {
    /// Dofs retained, in the order of their coordinates.
    pub retained: Vec<Retained>,
    /// Number of fixed-interface modes.
    pub modes: usize,
    /// Constraints on the retained dofs, by their place in `retained`.
    pub constraints: Constraints,
    /// Springs to ground; they belong to the body's stiffness, also in its damping.
    pub springs: Vec<GroundSpring>,
    /// Damping.
    pub damping: Rayleigh,
    /// Nodes whose motion is wanted, by index.
    pub nodes: Vec<usize>,
    /// Whether the centrifugal load stiffens the body against its deformation, if it turns.
    pub stiffening: bool,
    /// Bytes that a factor of K may take.
    pub memory: usize,
}

/// K with the springs to ground, and M; 3·nodes.
pub(crate) struct Assembled {
    pub(crate) stiffness: SparseMatrix,
    pub(crate) mass: SparseMatrix,
}

impl Assembled {
    /// The body to be reduced.
    pub(crate) fn solid<'a>(&'a self, mesh: &'a Mesh, memory: usize) -> Solid<'a> {
        let Assembled { stiffness, mass } = self;
        Solid { stiffness, mass, coordinates: mesh.nodes(), memory }
    }
}

impl BodySpec {
    /// The matrices of a mesh.
    ///
    /// # Errors
    /// As [`assemble`]; a dof retained twice.
    pub(crate) fn assemble(&self, mesh: &Mesh) -> Result<Assembled, Error> {
        self.check(mesh)?;
        let stiffness = add_ground_springs(&assemble(mesh, "stiffness")?, &self.springs)?;
        Ok(Assembled { stiffness, mass: assemble(mesh, "mass")? })
    }

    /// Reduces a mesh with its matrices.
    ///
    /// # Errors
    /// As [`Solid::craig_bampton`].
    pub(crate) fn reduce(&self, mesh: &Mesh, body: &Assembled) -> Result<CraigBampton, Error> {
        let solid = body.solid(mesh, self.memory);
        let dofs: Vec<usize> = self.retained.iter().map(|retained| retained.dof).collect();
        Ok(solid.craig_bampton(&dofs, self.modes).map_err(|error| error.with_labels(mesh))?)
    }

    /// The coordinates of a reduction that the constraints leave.
    ///
    /// # Errors
    /// As [`Constraints::eliminate`].
    pub fn active(&self, reduction: &CraigBampton) -> Result<Coordinates, Error> {
        let elimination = self.constraints.eliminate(self.retained.len())?;
        let names: Vec<String> =
            self.retained.iter().map(|retained| retained.name.clone()).collect();
        Ok(Coordinates::new(reduction, &elimination, &names))
    }

    fn check(&self, mesh: &Mesh) -> Result<(), Error> {
        let wrong = |what| Err(Error::Mesh { origin: mesh.origin().to_owned(), what });
        let mut seen: BTreeMap<usize, &str> = BTreeMap::new();
        for Retained { dof, name } in &self.retained {
            if *dof >= mesh.dof_count() {
                return wrong(format!("the retained dof {name} is not a dof of the mesh"));
            }
            if let Some(first) = seen.insert(*dof, name) {
                return wrong(match first == name {
                    true => format!("{name} is retained twice: take one of them out"),
                    false => {
                        format!("{name} is retained already, as {first}: take one of them out")
                    }
                });
            }
        }
        Ok(())
    }
}

/// Active coordinates: those left of a body's Craig–Bampton coordinates by its constraints.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinates {
    /// T: Craig–Bampton coordinates = T · active coordinates.
    pub(crate) transform: Matrix,
    /// What each active coordinate is.
    pub(crate) names: Vec<String>,
}

impl Coordinates {
    /// The active coordinates of a reduction: all its modes, and the retained dofs that `elimination`
    /// leaves free.
    ///
    /// `retained_names`: one for each retained dof, such as `JOURNAL1_LEFT x`.
    pub fn new(
        reduction: &CraigBampton,
        elimination: &Elimination,
        retained_names: &[String],
    ) -> Self {
        let modes = reduction.modes();
        let free = &elimination.free;
        let mut transform = Matrix::zeros(reduction.coordinates(), modes + free.len());
        for i in 0..modes {
            transform[(i, i)] = 1.0;
        }
        for j in 0..free.len() {
            for (i, value) in elimination.transform.column(j) {
                transform[(modes + i, modes + j)] = value;
            }
        }
        let mut names = mode_names(&reduction.hertz);
        names.extend(free.iter().map(|&dof| retained_names[dof].clone()));
        Coordinates { transform, names }
    }
}

/// `mode 1 (527.1 Hz)` and so on.
pub(crate) fn mode_names(hertz: &[f64]) -> Vec<String> {
    hertz.iter().enumerate().map(|(i, f)| format!("mode {} ({f:.1} Hz)", i + 1)).collect()
}

/// A node of a body and how it moves with the body's coordinates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyNode {
    /// Undeformed position x0 (m).
    pub position: [f64; 3],
    /// Displacement along x, y, z by a unit of each active coordinate: 3 × n.
    pub shapes: Matrix,
}

impl BodyNode {
    pub(crate) fn new(
        reduction: &CraigBampton,
        active: &Coordinates,
        positions: &[[f64; 3]],
        node: usize,
    ) -> Self {
        BodyNode {
            position: positions[node],
            shapes: multiply(reduction.node(node).view(), active.transform.view()),
        }
    }
}

//! What the reduced shaft and the reduced support have in common: from a mesh to active coordinates.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::assembly::assemble;
use crate::constraints::{Constraints, Elimination, GroundSpring, add_ground_springs};
use crate::error::Error;
use crate::error::ReductionError;
use crate::linalg::{Matrix, multiply};
use crate::mesh::{MeanComponent, Mesh, NodeSetMean};
use crate::reduction::{CraigBampton, FixedInterface, Interface, Row, Solid};
use crate::sparse::SparseMatrix;
use crate::together::both;

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

/// A motion that stays a coordinate of the reduced body: a dof, or a mean of dofs.
#[derive(Debug, Clone, PartialEq)]
pub struct Retained {
    /// Σ cᵢ uᵢ over dofs i = 3·node + component, as (i, cᵢ).
    pub terms: Row,
    /// What it is called, such as `JOURNAL1_LEFT x`.
    pub name: String,
}

impl Retained {
    /// A dof, 3·node + component.
    pub fn dof(dof: usize, name: impl Into<String>) -> Retained {
        Retained { terms: vec![(dof, 1.0)], name: name.into() }
    }

    /// A component of the mean motion of a node set.
    pub fn mean(mean: &NodeSetMean, motion: MeanComponent, name: impl Into<String>) -> Retained {
        Retained { terms: mean.row(motion), name: name.into() }
    }

    /// The dof that this is; `None` of a mean.
    pub fn single(&self) -> Option<usize> {
        match self.terms[..] {
            [(dof, 1.0)] => Some(dof),
            _ => None,
        }
    }
}

/// How a mesh is reduced to a body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySpec {
    /// Dofs and means retained, in the order of their coordinates.
    pub retained: Vec<Retained>,
    /// Dofs that do not move, 3·node + component: they are no coordinates, and cost nothing.
    pub held: Vec<usize>,
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
    /// Node sets whose mean motion is wanted.
    pub means: Vec<NodeSetMean>,
    /// Loads on dofs whose static answers are kept beside the modes.
    pub corrections: Vec<Row>,
    /// z (m) near which sections are wanted, with what passes them.
    pub sections: Vec<f64>,
    /// Bytes that may be in use while it is reduced.
    pub memory: usize,
}

/// K with the springs to ground, and M; 3·nodes.
pub(crate) struct Assembled {
    pub(crate) stiffness: SparseMatrix,
    pub(crate) mass: SparseMatrix,
    /// Equations between dofs.
    ties: Vec<Row>,
}

impl Assembled {
    /// The body to be reduced.
    pub(crate) fn solid<'a>(&'a self, mesh: &'a Mesh, memory: usize) -> Solid<'a> {
        let Assembled { stiffness, mass, ties } = self;
        Solid { stiffness, mass, coordinates: mesh.nodes(), slots: mesh.slots(), ties, memory }
    }
}

impl BodySpec {
    /// The matrices of a mesh.
    ///
    /// # Errors
    /// As [`assemble`]; a dof retained twice, or retained and held.
    pub(crate) fn assemble(&self, mesh: &Mesh) -> Result<Assembled, Error> {
        self.check(mesh)?;
        let (stiffness, mass) = both(|| assemble(mesh, "stiffness"), || assemble(mesh, "mass"));
        let stiffness = add_ground_springs(stiffness?, &self.springs)?;
        Ok(Assembled { stiffness, mass: mass?, ties: mesh.tie_rows() })
    }

    /// A mesh with its matrices, its interface fixed, and its modes so.
    ///
    /// # Errors
    /// As [`Solid::fixed_interface`].
    pub(crate) fn fixed_interface<'a>(
        &self,
        mesh: &'a Mesh,
        body: &'a Assembled,
    ) -> Result<FixedInterface<'a>, Error> {
        let rows = self.rows();
        let solid = body.solid(mesh, self.memory);
        let found = solid.fixed_interface(&self.interface(&rows), self.modes);
        found.map_err(|error| self.named(error, mesh))
    }

    /// An error of the reduction, with the names of what is retained and the labels of nodes.
    pub(crate) fn named(&self, error: ReductionError, mesh: &Mesh) -> Error {
        match error {
            ReductionError::Follows { place, same } => {
                let name = &self.retained[place].name;
                let of = match same {
                    Some(same) => {
                        format!("is {} by the ties of the mesh", self.retained[same].name)
                    }
                    None => "follows from what else is retained or held".to_owned(),
                };
                let what = format!("{name} {of}: take one of them out");
                Error::Mesh { origin: mesh.origin().to_owned(), what }
            }
            error => error.with_labels(mesh).into(),
        }
    }

    /// The displacement under each of these loads in its own direction, with what is retained and held at zero (m/N, of a
    /// load in N); zero of a load on what is retained or held.
    ///
    /// # Errors
    /// As [`Solid::factored`].
    pub(crate) fn compliances(&self, mesh: &Mesh, loads: &[Row]) -> Result<Vec<f64>, Error> {
        /// A displacement below this part of that of its dofs alone is rounding.
        const ROUNDING: f64 = 1e-9;
        let body = self.assemble(mesh)?;
        let rows = self.rows();
        let solid = body.solid(mesh, self.memory);
        let factored = solid.factored(&self.interface(&rows));
        let found = factored.map_err(|error| self.named(error, mesh))?.compliances(loads);
        let Some(diagonal) = body.stiffness.lower().map(|lower| lower.diagonal()) else {
            return Ok(found);
        };
        // Infinite at nodes without cells, which others carry.
        let alone = |load: &Row| -> f64 {
            load.iter().map(|&(dof, value)| value.powi(2) / diagonal[dof]).sum()
        };
        let moves = |(own, load): (f64, &Row)| match alone(load) {
            alone if alone.is_finite() && own <= ROUNDING * alone => 0.0,
            _ => own,
        };
        Ok(found.into_iter().zip(loads).map(moves).collect())
    }

    /// The retained motions, as rows over dofs.
    pub(crate) fn rows(&self) -> Vec<Row> {
        self.retained.iter().map(|retained| retained.terms.clone()).collect()
    }

    /// What is retained, as [`BodySpec::rows`] gives it, and what is held.
    pub(crate) fn interface<'a>(&'a self, rows: &'a [Row]) -> Interface<'a> {
        Interface { retained: rows, held: &self.held, corrections: &self.corrections }
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
        let held: BTreeSet<usize> = self.held.iter().copied().collect();
        if held.last().is_some_and(|&dof| dof >= mesh.dof_count()) {
            return wrong("a held dof is not a dof of the mesh".to_owned());
        }
        let mut seen: BTreeMap<usize, &str> = BTreeMap::new();
        for retained in &self.retained {
            let name = &retained.name;
            if retained.terms.iter().any(|(dof, _)| *dof >= mesh.dof_count()) {
                return wrong(format!("the retained dof {name} is not a dof of the mesh"));
            }
            if retained.terms.is_empty() {
                return wrong(format!("{name} cannot be retained: its nodes are on the axis"));
            }
            let Some(dof) = retained.single() else { continue };
            if held.contains(&dof) {
                return wrong(format!("{name} is retained and held: take one of them out"));
            }
            if let Some(first) = seen.insert(dof, name) {
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

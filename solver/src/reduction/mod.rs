//! Reduction of a body's mesh matrices to a few coordinates: its lowest modes and its retained dofs.

mod convention;
mod craig_bampton;
mod lanczos;
mod modes;
mod rigid;
mod sturm;

pub use craig_bampton::{CraigBampton, Solid};
pub use modes::{Modes, Pencil, hertz};
pub use rigid::FreeMotion;
pub(crate) use rigid::{Row, free_motions};

use crate::linalg::LinearAlgebraError;
use crate::mesh::Mesh;

/// Why a body could not be reduced.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReductionError {
    /// The linear algebra failed.
    #[error(transparent)]
    LinearAlgebra(#[from] LinearAlgebraError),
    /// A matrix that must be symmetric is not known to be.
    #[error(
        "the {matrix} matrix is not symmetric by its structure; is its form symmetric in u and v?"
    )]
    NotSymmetric {
        /// `stiffness` or `mass`.
        matrix: &'static str,
    },
    /// More modes asked for than there are dofs that can move.
    #[error(
        "{asked} modes asked for, but only {available} dofs can move once the retained ones are held; ask for fewer modes"
    )]
    TooManyModes {
        /// Modes asked for.
        asked: usize,
        /// Dofs left.
        available: usize,
    },
    /// A retained dof does not exist or is listed twice.
    #[error(
        "retained dof {dof} (node {node}, component {component}) is listed twice or is not one of the {dofs} dofs of the body"
    )]
    Retained {
        /// The dof, 3·node + component, from 0.
        dof: usize,
        /// Its node, from 0.
        node: usize,
        /// Its component: 0 x, 1 y, 2 z.
        component: usize,
        /// Dofs of the body.
        dofs: usize,
    },
    /// With the retained dofs held the body can still move without being strained.
    #[error(
        "with its retained dofs held the body can still move freely: {}; hold or retain a dof, or add a spring, against each of these motions",
        list(motions)
    )]
    Mechanism {
        /// The free motions.
        motions: Vec<FreeMotion>,
    },
    /// Rounding of the stiffest dof hides all lower modes.
    #[error(
        "node {node} is so stiff along {} against its mass (at {stiffest:.1e} Hz) that rounding hides the modes, \
         which lie at {modes:.1e} Hz", ["x", "y", "z"][*component]
    )]
    Hidden {
        /// The stiffest node: its label in a mesh, its index where there are matrices only.
        node: u64,
        /// Its component: 0 x, 1 y, 2 z.
        component: usize,
        /// √(K_ii/M_ii)/2π of this dof (Hz).
        stiffest: f64,
        /// The highest of the modes wanted (Hz).
        modes: f64,
    },
    /// The block Lanczos iteration stopped before all modes had converged.
    #[error("only {converged} of {asked} modes converged after {restarts} restarts")]
    NotConverged {
        /// Modes that converged.
        converged: usize,
        /// Modes wanted.
        asked: usize,
        /// Restarts made.
        restarts: usize,
    },
    /// The modes found below a frequency are not as many as the Sturm count says.
    #[error("{found} modes were found below {hertz} Hz, but the Sturm count says {counted}")]
    Miscounted {
        /// Modes found.
        found: usize,
        /// Modes there are.
        counted: usize,
        /// Frequency (Hz) below which they were counted.
        hertz: f64,
    },
}

impl ReductionError {
    /// The same error with labels of the mesh in place of node indices.
    pub fn with_labels(mut self, mesh: &Mesh) -> Self {
        match &mut self {
            ReductionError::Mechanism { motions } => {
                for motion in motions {
                    if let FreeMotion::Part { node } = motion {
                        *node = mesh.labels()[*node as usize];
                    }
                }
            }
            ReductionError::Hidden { node, .. } => *node = mesh.labels()[*node as usize],
            _ => {}
        }
        self
    }
}

fn list(motions: &[FreeMotion]) -> String {
    motions.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

//! Reduction of a body's mesh matrices to a few coordinates: its lowest modes and its retained dofs.

mod constrained;
mod convention;
mod correction;
mod craig_bampton;
mod fixed_interface;
mod lanczos;
mod modes;
mod partition;
mod pencil;
mod rigid;
mod slices;
mod solid;
mod sturm;
mod ties;

pub use crate::sparse::Row;
pub use constrained::{ConstrainedCholesky, Constraints};
pub use craig_bampton::CraigBampton;
pub(crate) use fixed_interface::{Factored, FixedInterface};
pub use partition::Interface;
pub use pencil::{Modes, Pencil, hertz};
pub(crate) use rigid::{free_motions, free_shapes};
pub use solid::Solid;
pub(crate) use ties::Tied;

use crate::error::{FreeMotion, ReductionError};
use crate::linalg::LinearAlgebraError;
use crate::mesh::Mesh;

impl ReductionError {
    /// Whether the memory allowed is too little.
    pub(crate) fn is_of_memory(&self) -> bool {
        matches!(self, ReductionError::LinearAlgebra(LinearAlgebraError::TooLarge { .. }))
    }

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

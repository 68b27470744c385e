//! Reduction of a body's mesh matrices to a few coordinates: its lowest modes and its retained dofs.

mod constrained;
mod convention;
mod correction;
mod craig_bampton;
mod lanczos;
mod modes;
mod partition;
mod rigid;
mod sturm;

pub use constrained::{ConstrainedCholesky, Constraints};
pub use craig_bampton::{CraigBampton, Solid};
pub use modes::{Modes, Pencil, hertz};
pub use partition::Interface;
pub use rigid::Row;
pub(crate) use rigid::{free_motions, free_shapes};

use crate::error::{FreeMotion, ReductionError};
use crate::mesh::Mesh;

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

//! A body's mesh matrices, as all that reduces it takes them.

use std::borrow::Cow;

use super::ties::Tied;
use crate::error::ReductionError;
use crate::linalg::LowerTriangle;
use crate::mesh::matrices::Slot;
use crate::sparse::{Row, SparseMatrix};

/// A body's mesh matrices. Dof 3a + i is the translation of node a along x, y, z (i = 0, 1, 2).
#[derive(Debug, Clone, Copy)]
pub struct Solid<'a> {
    /// K (N/m), 3·nodes, symmetric.
    pub stiffness: &'a SparseMatrix,
    /// M (kg), 3·nodes, symmetric.
    pub mass: &'a SparseMatrix,
    /// Node coordinates (m).
    pub coordinates: &'a [[f64; 3]],
    /// What each dof is; empty where all are translations of the nodes.
    pub slots: &'a [Slot],
    /// Equations Σ cᵢ uᵢ = 0 between its dofs.
    pub ties: &'a [Row],
    /// Bytes that may be in use while it is reduced.
    pub memory: usize,
}

impl Solid<'_> {
    /// The equations between dofs, solved; `None` of a body without.
    pub(super) fn tied(&self, held: &[usize]) -> Option<Tied> {
        Tied::new(self.mass.size(), self.ties, held)
    }

    /// K and M of what the equations leave free.
    pub(super) fn tied_matrices(
        &self,
        tied: &Tied,
    ) -> Result<(SparseMatrix, SparseMatrix), ReductionError> {
        let own = |matrix, name| -> Result<SparseMatrix, ReductionError> {
            Ok(SparseMatrix::Symmetric(tied.matrix(&*lower(matrix, name)?, self.memory)?))
        };
        Ok((own(self.stiffness, "stiffness")?, own(self.mass, "mass")?))
    }
}

/// A matrix that is symmetric as its lower triangle.
///
/// # Errors
/// One that is not.
pub(super) fn lower<'a>(
    matrix: &'a SparseMatrix,
    name: &'static str,
) -> Result<Cow<'a, LowerTriangle>, ReductionError> {
    matrix.lower().ok_or(ReductionError::NotSymmetric { matrix: name })
}

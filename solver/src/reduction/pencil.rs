//! Stiffness and mass of a body, and the modes that they have.

use super::constrained::Constraints;
use crate::error::ReductionError;
use crate::linalg::{LowerTriangle, Matrix};

/// Modes found beyond those asked for, so that there is a gap to cut in after the last one.
pub(super) const GUARD: usize = 4;

/// Natural modes of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// ω² (rad²/s²), ascending. Rigid motions have values near 0 of either sign.
    pub eigenvalues: Vec<f64>,
    /// Mode shapes as columns, xᵀMx = 1.
    pub vectors: Matrix,
}

impl Modes {
    /// Frequencies in Hz.
    pub fn hertz(&self) -> Vec<f64> {
        self.eigenvalues.iter().map(|&value| hertz(value)).collect()
    }
}

/// The frequency (Hz) of ω² (rad²/s²); 0 for a negative value, which a rigid motion may have by rounding.
pub fn hertz(omega_squared: f64) -> f64 {
    omega_squared.max(0.0).sqrt() / std::f64::consts::TAU
}

/// Stiffness and mass of a body with what it takes to factor them.
#[derive(Debug, Clone, Copy)]
pub struct Pencil<'a> {
    /// K (N/m).
    pub stiffness: &'a LowerTriangle,
    /// M (kg).
    pub mass: &'a LowerTriangle,
    /// Order of elimination.
    pub order: &'a [usize],
    /// On what they leave to move.
    pub constraints: Constraints<'a>,
    /// Direction of each dof: 0 x, 1 y, 2 z.
    pub components: &'a [usize],
    /// Bytes that may be in use while its modes are found.
    pub memory: usize,
    /// Columns as long as the matrices that are solved for by the factor afterwards.
    pub columns: usize,
}

impl Pencil<'_> {
    /// The size of the largest ω² of the mesh (rad²/s²), by its diagonals; dofs without mass have none.
    pub(super) fn highest(&self) -> f64 {
        let (k, m) = (self.stiffness.diagonal(), self.mass.diagonal());
        let heavy = k.iter().zip(&m).filter(|(_, m)| **m > 0.0);
        heavy.map(|(k, m)| k / m).fold(0.0, f64::max)
    }

    /// How far rounding moves an ω² (rad²/s²): K is only known to ε of its largest entries.
    pub(super) fn blur(&self) -> f64 {
        16.0 * f64::EPSILON * self.highest()
    }

    /// The error for modes that rounding hides, of these eigenvalues, with the place of the stiffest dof in this pencil for its
    /// node.
    pub(super) fn hidden(&self, eigenvalues: &[f64]) -> ReductionError {
        let (k, m) = (self.stiffness.diagonal(), self.mass.diagonal());
        let row = (0..k.len())
            .filter(|&a| m[a] > 0.0)
            .max_by(|&a, &b| (k[a] / m[a]).total_cmp(&(k[b] / m[b])))
            .unwrap_or(0);
        ReductionError::Hidden {
            node: row as u64,
            component: self.components[row],
            stiffest: hertz(self.highest()),
            modes: hertz(eigenvalues.last().copied().unwrap_or(0.0)),
        }
    }
}

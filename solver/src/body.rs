//! What the reduced shaft and the reduced support have in common.

use serde::{Deserialize, Serialize};

use crate::constraints::Elimination;
use crate::linalg::{Matrix, multiply};
use crate::reduction::CraigBampton;

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
    pub fn matrix(&self, mass: &Matrix, stiffness: &Matrix) -> Matrix {
        Matrix::from_fn(mass.rows, mass.cols, |i, j| {
            self.alpha * mass[(i, j)] + self.beta * stiffness[(i, j)]
        })
    }
}

/// Active coordinates: those left of a body's Craig–Bampton coordinates by its constraints.
#[derive(Debug, Clone, PartialEq)]
pub struct Coordinates {
    /// T: Craig–Bampton coordinates = T · active coordinates.
    pub transform: Matrix,
    /// What each active coordinate is.
    pub names: Vec<String>,
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

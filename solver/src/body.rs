//! What the reduced shaft and the reduced support have in common.

use serde::{Deserialize, Serialize};

use crate::linalg::{Matrix, multiply};
use crate::reduction::CraigBampton;
use crate::sparse::SparseColumns;

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
    /// The active coordinates of a reduction: all its modes, and what `elimination` (retained dofs × free
    /// ones) leaves of its retained dofs.
    ///
    /// `retained_names`: one for each retained dof, such as `JOURNAL1_LEFT x`. A free dof has the name of
    /// the retained dof that follows it most.
    pub fn new(
        reduction: &CraigBampton,
        elimination: &SparseColumns,
        retained_names: &[String],
    ) -> Self {
        let modes = reduction.modes();
        let mut transform = Matrix::zeros(reduction.coordinates(), modes + elimination.width());
        let mut names = mode_names(&reduction.hertz);
        for i in 0..modes {
            transform[(i, i)] = 1.0;
        }
        for j in 0..elimination.width() {
            let mut most: Option<(usize, f64)> = None;
            for (i, value) in elimination.column(j) {
                transform[(modes + i, modes + j)] = value;
                if most.is_none_or(|(_, largest)| value.abs() > largest) {
                    most = Some((i, value.abs()));
                }
            }
            names.push(most.map_or_else(String::new, |(i, _)| retained_names[i].clone()));
        }
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

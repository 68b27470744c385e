//! How many modes a body of matrices has.

use super::super::body_matrices::BodyMatrices;
use crate::linalg::{Matrix, symmetric_eigen};

/// Dofs up to which the rank of M is found; with more of them modes are few beside dofs.
const DENSE: usize = 600;
/// Eigenvalues of M, each row and column divided by the root of its diagonal, below this are zero: single precision keeps
/// no more.
const RANK: f64 = 1e-7;

impl BodyMatrices {
    /// Dofs of the matrices but for those that are `taken`, ascending.
    pub fn inner(&self, taken: &[usize]) -> Vec<usize> {
        let mut free: Vec<bool> = (0..self.slots.len()).map(|dof| self.has(dof)).collect();
        taken.iter().for_each(|&dof| free[dof] = false);
        (0..free.len()).filter(|&dof| free[dof]).collect()
    }

    /// How many modes these dofs have, all others held: as many as M has eigenvalues that are not zero. Turns that have no
    /// mass, as in lumped models, have no modes.
    pub fn modes(&self, inner: &[usize]) -> usize {
        let Some(mass) = self.mass.lower() else { return 0 };
        let diagonal = mass.diagonal();
        let heavy: Vec<usize> = inner.iter().copied().filter(|&dof| diagonal[dof] > 0.0).collect();
        if heavy.len() > DENSE {
            return heavy.len();
        }
        let mut place = vec![usize::MAX; diagonal.len()];
        heavy.iter().enumerate().for_each(|(index, &dof)| place[dof] = index);
        let mut scaled = Matrix::zeros(heavy.len(), heavy.len());
        for &column in &heavy {
            for (row, value) in mass.column(column).filter(|(row, _)| place[*row] != usize::MAX) {
                let value = value / (diagonal[row] * diagonal[column]).sqrt();
                scaled[(place[row], place[column])] = value;
                scaled[(place[column], place[row])] = value;
            }
        }
        match symmetric_eigen(&scaled) {
            Ok(eigen) => eigen.values.iter().filter(|&&value| value > RANK).count(),
            Err(_) => heavy.len(),
        }
    }
}

//! Y and H of a body that turns, where they follow from M: it is m ⊗ 1, the same along x, y and z.

use std::collections::BTreeMap;

use super::super::body_matrices::{Slot, Spin};
use crate::linalg::LowerTriangle;
use crate::sparse::SparseMatrix;

/// M is the same along x, y and z if its entries agree to this part of √(M_ii M_jj): single precision keeps no more.
const ALIKE: f64 = 1e-6;

/// diag(1, 1, 0): what turns about z.
const ACROSS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]];
/// A_θᵀA.
const COUPLING: [[f64; 3]; 3] = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0; 3]];

/// Y and H by a mass matrix that is m ⊗ 1, and this mass matrix without the rounding of its text; none of another one.
pub(super) fn of_mass(slots: &[Slot], mass: &LowerTriangle) -> Option<(Spin, SparseMatrix)> {
    let plain = |(dof, slot): (usize, &Slot)| *slot == Slot::Translation(dof % 3);
    if !slots.iter().enumerate().all(plain) {
        return None;
    }
    let diagonal = mass.diagonal();
    let mut blocks: BTreeMap<(usize, usize), [f64; 3]> = BTreeMap::new();
    for column in 0..mass.size {
        for (row, value) in mass.column(column) {
            if row % 3 == column % 3 {
                blocks.entry((column / 3, row / 3)).or_default()[row % 3] = value;
            } else if value.abs() > ALIKE * (diagonal[row] * diagonal[column]).sqrt() {
                return None;
            }
        }
    }
    let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); mass.size / 3];
    for ((column, row), values) in blocks {
        let scale = (diagonal[3 * row] * diagonal[3 * column]).sqrt();
        if values.iter().any(|value| (value - values[0]).abs() > ALIKE * scale) {
            return None;
        }
        columns[column].push((row, values.iter().sum::<f64>() / 3.0));
    }
    let scalar = LowerTriangle::from_columns(columns.len(), |j| columns[j].iter().copied());
    let kronecker = |pattern| SparseMatrix::Kronecker { scalar: scalar.clone(), pattern };
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let spin = Spin { inertia: kronecker(ACROSS), coupling: kronecker(COUPLING), load: None };
    Some((spin, kronecker(unit)))
}

//! Signs, and bases of multiple eigenvalues: the choice that makes modes reproducible.

use crate::linalg::{LinearAlgebraError, Matrix, congruence_diagonal, multiply, symmetric_eigen};

/// Eigenvalues closer than this, relatively, count as one multiple eigenvalue.
const CLUSTER: f64 = 1e-9;
/// Components within this part of the largest count as largest: a symmetric mode has several, which
/// differ by rounding.
const TIE: f64 = 1e-6;
/// Part of the weights that depends on the dof, so that no symmetry of the body leaves a choice.
const GENERIC: f64 = 1e-6;

/// Fixes the vectors of `eigenvalues` (ascending): the basis of each multiple eigenvalue is that which
/// has extreme motion along x (so that of a pair of bending modes the first moves along x, the other along
/// y), and the first of the largest components of each vector is positive.
///
/// `blur`: rounding of the eigenvalues. `components`: for each row its direction, 0 x, 1 y, 2 z.
pub(super) fn settle(
    eigenvalues: &[f64],
    blur: f64,
    vectors: &mut Matrix,
    components: &[usize],
) -> Result<(), LinearAlgebraError> {
    let weights: Vec<f64> = components
        .iter()
        .enumerate()
        .map(|(row, &component)| {
            let along_x = if component == 0 { 1.0 } else { 0.0 };
            along_x + GENERIC * ((row + 1) as f64 * 0.618_033_988_749_895).fract()
        })
        .collect();
    let mut first = 0;
    while first < eigenvalues.len() {
        let mut end = first + 1;
        while end < eigenvalues.len()
            && eigenvalues[end] - eigenvalues[end - 1] <= CLUSTER * eigenvalues[end].abs() + blur
        {
            end += 1;
        }
        if end - first > 1 {
            let motion = congruence_diagonal(vectors.columns(first..end), &weights);
            let eigen = symmetric_eigen(&motion)?;
            let all: Vec<usize> = (0..end - first).collect();
            let descending: Vec<usize> = all.iter().rev().copied().collect();
            let turn = eigen.vectors.select(&all, &descending);
            let turned = multiply(vectors.columns(first..end), turn.view());
            vectors.data[first * vectors.rows..end * vectors.rows].copy_from_slice(&turned.data);
        }
        first = end;
    }
    for j in 0..vectors.cols {
        let column = vectors.col_mut(j);
        let largest = column.iter().fold(0.0, |max: f64, value| max.max(value.abs()));
        let leading = column.iter().find(|value| value.abs() >= (1.0 - TIE) * largest);
        if leading.is_some_and(|&value| value < 0.0) {
            column.iter_mut().for_each(|value| *value = -*value);
        }
    }
    Ok(())
}

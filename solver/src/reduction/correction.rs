//! Static correction: the answers of a body to given loads as further shapes beside its modes.
//!
//! What is left of the answers without their part in the modes is orthogonal to these in M and in K, and becomes shapes of
//! its own by a decomposition of K among them (Rayleigh, Ritz). With them the loads move the reduced body as the full one.

use crate::error::ReductionError;
use crate::linalg::{
    Matrix, generalised_symmetric_eigen, multiply, symmetric_eigen, transpose_multiply,
};

use super::constrained::ConstrainedCholesky;
use super::pencil::{Modes, Pencil};

/// A shape of which less than this part, in energy of motion, is its own follows from the others.
const FOLLOWS: f64 = 1e-10;

/// Of a load, the part that the retained means do not carry counts from here on. Below it the answer is the rounding of the
/// solution, a shape that need not leave the means alone; and it would move the body less than that part.
const CARRIED: f64 = 1e-6;

/// The modes, and behind them the shapes by which the loads (columns over the dofs of the pencil) are answered.
pub(super) fn corrected(
    modes: Modes,
    pencil: &Pencil,
    factor: &ConstrainedCholesky,
    loads: Matrix,
) -> Result<Modes, ReductionError> {
    if loads.cols == 0 {
        return Ok(modes);
    }
    let mut shapes = answers(pencil, factor, loads);
    if shapes.cols == 0 {
        return Ok(modes);
    }
    let product = |matrix: &crate::linalg::LowerTriangle, shapes: &Matrix| {
        let mut product = Matrix::zeros(shapes.rows, shapes.cols);
        matrix.multiply(&shapes.data, &mut product.data);
        product
    };
    let unit = |shapes: &mut Matrix| -> Vec<f64> {
        let weighed = product(pencil.mass, shapes);
        let gram = transpose_multiply(shapes.view(), weighed.view());
        let squares: Vec<f64> = (0..gram.cols).map(|j| gram[(j, j)].max(0.0)).collect();
        for (j, square) in squares.iter().enumerate().filter(|(_, square)| **square > 0.0) {
            shapes.col_mut(j).iter_mut().for_each(|value| *value /= square.sqrt());
        }
        squares
    };
    unit(&mut shapes);
    // Once is not enough where modes have nearly all of an answer, twice is.
    for _ in 0..2 {
        let weighed = product(pencil.mass, &shapes);
        let part = transpose_multiply(modes.vectors.view(), weighed.view());
        let known = multiply(modes.vectors.view(), part.view());
        shapes.data.iter_mut().zip(&known.data).for_each(|(value, known)| *value -= known);
    }
    let squares = unit(&mut shapes);
    let all: Vec<usize> = (0..shapes.rows).collect();
    let own: Vec<usize> = (0..shapes.cols).filter(|&j| squares[j] > FOLLOWS).collect();
    if own.is_empty() {
        return Ok(modes);
    }
    let shapes = shapes.select(&all, &own);
    let gram = transpose_multiply(shapes.view(), product(pencil.mass, &shapes).view());
    let eigen = symmetric_eigen(&gram.symmetric_part())?;
    let own: Vec<usize> = (0..gram.cols).filter(|&j| eigen.values[j] > FOLLOWS).collect();
    let rows: Vec<usize> = (0..gram.rows).collect();
    let shapes = multiply(shapes.view(), eigen.vectors.select(&rows, &own).view());
    let mass = transpose_multiply(shapes.view(), product(pencil.mass, &shapes).view());
    let stiffness = transpose_multiply(shapes.view(), product(pencil.stiffness, &shapes).view());
    let ritz = generalised_symmetric_eigen(&stiffness.symmetric_part(), &mass.symmetric_part())?;
    let shapes = multiply(shapes.view(), ritz.vectors.view());
    let Modes { mut eigenvalues, mut vectors } = modes;
    eigenvalues.extend(ritz.values);
    vectors.cols += shapes.cols;
    vectors.data.extend(shapes.data);
    Ok(Modes { eigenvalues, vectors })
}

/// The answers to loads with the means at zero, of loads that these do not carry by themselves.
fn answers(pencil: &Pencil, factor: &ConstrainedCholesky, loads: Matrix) -> Matrix {
    let means = pencil.constraints.rows;
    let mut shapes = loads.clone();
    if means.is_empty() {
        factor.solve_in_place(&mut shapes.data);
        return shapes;
    }
    // A u = b + Cᵀλ.
    let none = Matrix::zeros(means.len(), loads.cols);
    let multipliers = factor.solve_with(&mut shapes.data, &none);
    let square = |load: &[f64]| -> f64 { load.iter().map(|value| value * value).sum() };
    let counts = |&j: &usize| {
        let mut left = loads.col(j).to_vec();
        for (mean, lambda) in means.iter().zip(multipliers.col(j)) {
            mean.iter().for_each(|&(dof, c)| left[dof] += lambda * c);
        }
        square(&left) > CARRIED * CARRIED * square(loads.col(j))
    };
    let (rows, own): (Vec<usize>, Vec<usize>) =
        ((0..shapes.rows).collect(), (0..shapes.cols).filter(counts).collect());
    shapes.select(&rows, &own)
}

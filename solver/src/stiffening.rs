//! Stiffening by rotation: G = ∫ σ⁰_ij ∂_i u · ∂_j v dV, with σ⁰ the stress under the centrifugal load of θ̇ = 1.

use crate::body::{Assembled, BodySpec};
use crate::error::{Error, ReductionError};
use crate::linalg::{
    Cholesky, LinearAlgebraError, Matrix, congruence, dot, multiply, symmetric_eigen,
    transpose_multiply,
};
use crate::mesh::Mesh;
use crate::reduction::{CraigBampton, Factored, Row, Solid, free_shapes};

/// K u⁰ = load, with the constraints of the spec; m per (rad/s)². Under it G is [`crate::assembly::assemble_under`].
///
/// `load`: Y x0 (N per (rad/s)²), 3·nodes.
///
/// A motion that nothing stops is free of load: what the load does on it is taken off as the inertia of that motion,
/// which strains nothing where all of the body is off the axis alike. A load in balance is left as it is. Then the motion
/// itself is chosen to be none, which makes no stress.
///
/// # Errors
/// Constraints that contradict each other; a body of which a part is loose.
pub(crate) fn displacement(
    mesh: &Mesh,
    spec: &BodySpec,
    body: &Assembled,
    (reduction, factored): (&CraigBampton, &Factored),
    load: &[f64],
) -> Result<Vec<f64>, Error> {
    let modes = reduction.modes();
    let retained = &reduction.retained;
    let solid = body.solid(mesh, spec.memory);
    let free = free_motions(&solid, spec)?;
    let load = balanced(load, &free, body)?;

    // Equations of the retained dofs alone, which the constraints are on.
    let transform = spec.active(reduction)?.transform;
    let transform = Matrix::from_fn(retained.len(), transform.cols - modes, |i, j| {
        transform[(modes + i, modes + j)]
    });
    let condensed = Matrix::from_fn(retained.len(), retained.len(), |i, j| {
        reduction.stiffness[(modes + i, modes + j)]
    });
    let forces = &reduction.shapes.apply_transpose(&load)[modes..];
    let mut active = transform.apply_transpose(forces);
    let mut stiffness = congruence(&condensed, &transform).symmetric_part();
    support(&mut stiffness, (&transform, &free), retained, stiffness_of_a_dof(body))?;
    if !active.is_empty() {
        let mut factor = Cholesky::new(active.len());
        factor.factor(&stiffness.data).map_err(failed)?;
        factor.solve_in_place(&mut active);
    }

    let mut shifts = vec![0.0; modes];
    shifts.extend(transform.apply(&active));
    let inner = factored.displacement(&load);
    let follows = reduction.shapes.apply(&shifts);
    Ok(follows.iter().zip(&inner).map(|(a, b)| a + b).collect())
}

/// Orthonormal rigid motions that nothing stops: 3·nodes × as many.
fn free_motions(solid: &Solid, spec: &BodySpec) -> Result<Matrix, Error> {
    let term = |&(place, factor): &(usize, f64)| {
        spec.retained[place].terms.iter().map(move |&(dof, c)| (dof, factor * c))
    };
    let equations = spec.constraints.equations().iter();
    let constrained = equations.map(|equation| equation.terms.iter().flat_map(term).collect());
    let held = spec.held.iter().map(|&dof| vec![(dof, 1.0)]);
    let rows: Vec<Row> = constrained.chain(held).collect();
    let motions = free_shapes(solid, &rows)?;
    let gram = transpose_multiply(motions.view(), motions.view()).symmetric_part();
    let eigen = symmetric_eigen(&gram).map_err(failed)?;
    let scaled = Matrix::from_fn(gram.rows, gram.cols, |i, j| {
        eigen.vectors[(i, j)] / eigen.values[j].sqrt()
    });
    Ok(multiply(motions.view(), scaled.view()))
}

/// The load less the inertia of the free motions that does the same work on them.
fn balanced(load: &[f64], free: &Matrix, body: &Assembled) -> Result<Vec<f64>, Error> {
    let mut balanced = load.to_vec();
    if free.cols == 0 {
        return Ok(balanced);
    }
    let mut inertia = Matrix::zeros(free.rows, free.cols);
    body.mass.multiply(&free.data, &mut inertia.data);
    let mass = transpose_multiply(free.view(), inertia.view()).symmetric_part();
    let mut acceleration = free.apply_transpose(load);
    let mut factor = Cholesky::new(free.cols);
    factor.factor(&mass.data).map_err(failed)?;
    factor.solve_in_place(&mut acceleration);
    for (value, taken) in balanced.iter_mut().zip(inertia.apply(&acceleration)) {
        *value -= taken;
    }
    Ok(balanced)
}

/// The mean stiffness of a dof with all others held (N/m).
fn stiffness_of_a_dof(body: &Assembled) -> f64 {
    let diagonal = body.stiffness.lower().map(|lower| lower.diagonal()).unwrap_or_default();
    diagonal.iter().sum::<f64>() / diagonal.len().max(1) as f64
}

/// Adds stiffness against the free motions, `own` as that of a dof: of a load in balance they carry nothing. What the
/// retained dofs have themselves may be rounding, where they hold the body as a table stands on three legs.
fn support(
    stiffness: &mut Matrix,
    (transform, free): (&Matrix, &Matrix),
    retained: &[Row],
    own: f64,
) -> Result<(), Error> {
    if free.cols == 0 || stiffness.rows == 0 {
        return Ok(());
    }
    let moves = Matrix::from_fn(retained.len(), free.cols, |i, j| {
        retained[i].iter().map(|&(dof, c)| c * free[(dof, j)]).sum()
    });
    // Motions that the constraints leave have coordinates: the least squares of T a = moves.
    let mut coordinates = transpose_multiply(transform.view(), moves.view());
    let gram = transpose_multiply(transform.view(), transform.view());
    let mut factor = Cholesky::new(gram.rows);
    factor.factor(&gram.data).map_err(failed)?;
    factor.solve_in_place(&mut coordinates.data);
    let n = stiffness.rows;
    for motion in coordinates.data.chunks_exact(n) {
        let scale = own / dot(motion, motion);
        for j in 0..n {
            for i in 0..n {
                stiffness[(i, j)] += scale * motion[i] * motion[j];
            }
        }
    }
    Ok(())
}

fn failed(error: LinearAlgebraError) -> Error {
    Error::Reduction(ReductionError::LinearAlgebra(error))
}

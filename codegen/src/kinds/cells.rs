//! Operations of the functions that kernels of cells share, `cells` in the crate of the kernels: those that lead to what
//! a kernel writes, a multiplication with the addition behind it counted as two.

/// A factor times all cofactors.
pub(super) const MAP: usize = 9;
/// A gradient by such a map.
pub(super) const GRADIENT: usize = 15;
/// a ⊗ b.
pub(super) const OUTER: usize = 9;

/// Of the Jacobian from three tangents what is used: det J, for which those of the first serve, and the cofactors of
/// tangents.
pub(super) fn jacobian(det: bool, cofactors: impl Fn(usize) -> bool) -> usize {
    let columns = (0..3).filter(|k| det && *k == 0 || cofactors(*k)).count();
    9 * columns + if det { 5 } else { 0 }
}

/// Sums over the nodes for rows of coefficients.
pub(super) fn tangents(nodes: usize, rows: usize) -> usize {
    6 * nodes * rows
}

/// √(w det J), its quotient by det J and the map.
pub(super) fn maps(points: usize) -> usize {
    points * (jacobian(true, |_| true) + 3 + MAP)
}

/// w det J and its product with a factor.
pub(super) fn determinants(points: usize) -> usize {
    points * (jacobian(true, |_| false) + 2)
}

pub(super) fn gradients(points: usize, functions: usize, with_values: bool) -> usize {
    points * functions * (GRADIENT + usize::from(with_values))
}

/// Values of every node times weights, and their products with those of the nodes from it on.
pub(super) fn products(nodes: usize, points: usize) -> usize {
    nodes * points + nodes * (nodes + 1) * points
}

/// What modes that lie along vectors have in common with a function.
pub(super) fn along_modes(points: usize, modes: usize) -> usize {
    6 * points * modes
}

/// The same of two modes, times a vector.
pub(super) fn between_modes(points: usize) -> usize {
    2 * points + 3
}

/// The factor of a symmetric matrix, with the inverses of its diagonal.
fn factor(size: usize) -> usize {
    (0..size).map(|p| 2 * p * (size - p) + 2 + (size - p - 1)).sum()
}

/// K_uu − K_ua K_aa⁻¹ K_au for so many of u and α.
pub(super) fn take_off(kept: usize, parameters: usize) -> usize {
    factor(parameters) + kept * parameters * parameters + kept * (kept + 1) * parameters
}

/// K_aa α = −K_au u: right side, factor, forward and back.
pub(super) fn follow(nodal: usize, parameters: usize) -> usize {
    2 * nodal * parameters + factor(parameters) + 2 * parameters * parameters
}

/// So many products of parts of functions, summed over the points.
pub(super) fn sums(products: usize, points: usize) -> usize {
    2 * products * points
}

/// Slopes of the displacements of functions at a point.
pub(super) fn slopes(functions: usize) -> usize {
    18 * functions + 10
}

/// Coefficients at the points times the gradients of the nodes, and their sums for pairs of nodes.
pub(super) fn weighted_sums(nodes: usize, points: usize) -> usize {
    18 * nodes * points + 6 * points * nodes * (nodes + 1) / 2
}

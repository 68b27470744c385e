//! How many eigenvalues lie below a value: the check that no mode was missed.

use crate::linalg::{LinearAlgebraError, LowerTriangle, inertia};

/// A cut is put into a gap at least this wide, relative to the eigenvalues. The pivots of LDLᵀ are those
/// of a matrix that differs by rounding, ε·λ_max of the mesh; λ_max/λ of the modes in question is
/// below 1e8 for meshes that resolve them, so a cut in the middle of this gap is on the right side.
const GAP: f64 = 1e-6;

/// The number of eigenvalues of K x = λ M x below `cut`.
pub(super) fn count_below(
    stiffness: &LowerTriangle,
    mass: &LowerTriangle,
    order: &[usize],
    cut: f64,
    limit: usize,
) -> Result<Option<usize>, LinearAlgebraError> {
    let shifted = stiffness.plus(-cut, mass);
    Ok(inertia(&shifted, order, limit)?.map(|inertia| inertia.negative))
}

/// Places for a cut between consecutive ascending eigenvalues: (how many are below, λ of the cut). Only
/// gaps wide enough to cut in safely, at or after `from` eigenvalues.
///
/// `shift` > −λ₁ makes the gaps relative to λ + shift, where rigid motions have λ ≈ 0.
pub(super) fn cuts(
    eigenvalues: &[f64],
    shift: f64,
    from: usize,
) -> impl Iterator<Item = (usize, f64)> + '_ {
    (from.max(1)..eigenvalues.len()).filter_map(move |below| {
        let (low, high) = (eigenvalues[below - 1], eigenvalues[below]);
        (high - low > GAP * (high + shift).abs()).then_some((below, 0.5 * (low + high)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cuts_between_pairs_only() {
        let values = [1.0, 1.0, 2.0, 2.0 + 1e-12, 3.0];
        let found: Vec<_> = cuts(&values, 0.0, 1).collect();
        assert_eq!(found.len(), 2);
        assert_eq!(found[0], (2, 1.5));
        assert_eq!(found[1].0, 4);
        assert_eq!(cuts(&values, 0.0, 3).next().map(|cut| cut.0), Some(4));
    }
}

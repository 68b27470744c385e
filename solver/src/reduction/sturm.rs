//! How many eigenvalues lie below a value: the check that no mode was missed.

use crate::linalg::{LinearAlgebraError, LowerTriangle};

use super::constrained::{ConstrainedCholesky, negative};
use super::pencil::Pencil;

/// A cut is put into a gap at least this wide, relative to the eigenvalues: much wider than a multiple
/// eigenvalue is spread by the mesh's own digits.
const GAP: f64 = 1e-6;
/// Pivots of LDLᵀ are those of a matrix that differs by rounding; a gap must exceed it this many times.
const SAFETY: f64 = 1e3;

/// A matrix of a pencil, and its factor, whose order a count takes over.
pub(super) type Known<'a> = (&'a LowerTriangle, &'a ConstrainedCholesky);

/// The number of eigenvalues of K x = λ M x below `cut`.
pub(super) fn count_below(
    pencil: &Pencil,
    cut: f64,
    known: Option<Known>,
) -> Result<Option<usize>, LinearAlgebraError> {
    let shifted = pencil.stiffness.plus(-cut, pencil.mass);
    let alike = known.filter(|(other, _)| other.has_entries_of(&shifted)).map(|own| own.1);
    negative(&shifted, pencil.order, pencil.constraints, pencil.memory, alike)
}

impl Pencil<'_> {
    /// The first safe cut after `count` modes: (modes found below, λ of the cut, modes there are below).
    pub(super) fn count(
        &self,
        eigenvalues: &[f64],
        count: usize,
        known: Option<Known>,
    ) -> Result<Option<(usize, f64, usize)>, LinearAlgebraError> {
        for (below, cut) in cuts(eigenvalues, self.blur(), count) {
            if let Some(counted) = count_below(self, cut, known)? {
                return Ok(Some((below, cut, counted)));
            }
        }
        Ok(None)
    }
}

/// Places for a cut between consecutive ascending eigenvalues: (how many are below, λ of the cut). Only
/// gaps wide enough to cut in safely, at or after `from` eigenvalues.
///
/// `blur`: rounding of the eigenvalues.
pub(super) fn cuts(
    eigenvalues: &[f64],
    blur: f64,
    from: usize,
) -> impl Iterator<Item = (usize, f64)> + '_ {
    (from.max(1)..eigenvalues.len()).filter_map(move |below| {
        let (low, high) = (eigenvalues[below - 1], eigenvalues[below]);
        (high - low > least_gap(high, blur)).then_some((below, 0.5 * (low + high)))
    })
}

/// The narrowest gap below the eigenvalue `high` that can be cut in.
pub(super) fn least_gap(high: f64, blur: f64) -> f64 {
    GAP * high.abs() + SAFETY * blur
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

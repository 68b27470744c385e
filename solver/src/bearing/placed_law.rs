//! A law where it stands: in all its planes in the bores of one body.

use std::ops::Range;

use super::law::BoundLaw;
use crate::film::Shapes;

/// A law in all its planes in the bores of one body; their springs lie side by side in every row.
pub(crate) struct PlacedLaw {
    pub(crate) bound: BoundLaw,
    /// Its planes among all.
    pub(crate) planes: Range<usize>,
    /// Springs of all its planes.
    pub(crate) springs: usize,
    /// What the kernels of its kind keep of every spring.
    pub(super) table: Vec<f64>,
    /// The body of its bores, by its place in [`Springs::bores`](super::Springs).
    pub(crate) bores: usize,
    /// For every motion of the bore its first row in [`Bores::rows`](super::Bores); none if the law does not need it. Then those of
    /// the shapes of a bore with a film.
    pub(crate) motions: Vec<Option<usize>>,
    /// How the bore gives way under a film.
    pub(crate) shapes: Option<Shapes>,
}

impl PlacedLaw {
    /// For every motion of the bore that the law needs its row in the law's own rows, and those of T_b.
    pub(super) fn bore_rows(&self) -> impl Iterator<Item = (Range<usize>, Range<usize>)> {
        let n = self.springs;
        let motions = self.motions.iter().enumerate();
        motions.filter_map(move |(motion, first)| {
            first.map(|first| (motion * n..(motion + 1) * n, first..first + n))
        })
    }
}

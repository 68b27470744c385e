//! Motions in the plane as rows over the coordinates of bodies.

use std::ops::Range;

use crate::linalg::dot;

/// How a point moves, or a journal in its bore: by body, of those that take part, rows along x and y of its frame; the motion is
/// their sum in space.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlaneRows(pub(crate) Vec<(usize, [Vec<f64>; 2])>);

impl PlaneRows {
    /// Over `size` coordinates in space, those of a body at its `block`. An angle among them turns the displacement in which its
    /// body stands: `turned` has its place and the coordinates of the body.
    pub(crate) fn over(
        &self,
        size: usize,
        block: impl Fn(usize) -> Range<usize>,
        turned: impl Fn(usize) -> Option<(usize, Vec<f64>)>,
    ) -> [Vec<f64>; 2] {
        let mut all = [0, 1].map(|_| vec![0.0; size]);
        for (body, rows) in &self.0 {
            for (all, row) in all.iter_mut().zip(rows) {
                all[block(*body)].iter_mut().zip(row).for_each(|(sum, own)| *sum += own);
            }
            if let Some((angle, stands)) = turned(*body) {
                let [x, y] = rows.each_ref().map(|row| dot(row, &stands));
                all[0][angle] -= y;
                all[1][angle] += x;
            }
        }
        all
    }
}

//! Joints whose stiffness and damping depend on the frequency of small motions.
//!
//! The equations are those of what stands still; such a joint adds to them Pᵀ (K(ν) − K(0)) P and Pᵀ (C(ν) − C(0)) P at the
//! frequency ν, P its displacement along x and y of space.

use crate::bearing::{Coefficients, OverFrequency};
use crate::linalg::Matrix;

/// A joint whose coefficients depend on the frequency.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Dependent {
    /// Its place among the joints.
    pub(super) joint: usize,
    /// Displacement of the journal along x and y of space by a unit of each coordinate.
    pub(super) rows: [Vec<f64>; 2],
    /// Its coefficients at the speed of the state.
    pub(super) over: OverFrequency,
}

impl Dependent {
    /// Adds what it does at a frequency beside what it does at rest to C′ and K′.
    pub(super) fn add(&self, frequency: f64, damping: &mut Matrix, stiffness: &mut Matrix) {
        let (own, still) = (self.over.at(frequency), self.over.still());
        let more: Coefficients = std::array::from_fn(|place| own[place] - still[place]);
        for (first, matrix) in [(0, stiffness), (4, damping)] {
            let [xx, xy, yx, yy] = [0, 1, 2, 3].map(|place| more[first + place]);
            let [x, y] = &self.rows;
            for j in 0..x.len() {
                let along = [xx * x[j] + xy * y[j], yx * x[j] + yy * y[j]];
                if along == [0.0; 2] {
                    continue;
                }
                let column = matrix.col_mut(j).iter_mut().zip(x.iter().zip(y));
                column.for_each(|(sum, (x, y))| *sum += along[0] * x + along[1] * y);
            }
        }
    }
}

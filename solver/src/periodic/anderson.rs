//! Anderson's acceleration of a map: of the last states and what the map made of them, the combination for which the residual
//! would be least if the map were linear (Walker and Ni, SIAM J. Numer. Anal. 49, 2011, 1715-1735).

use super::metric::norm;
use crate::linalg::dot;

/// States that are remembered.
const MOST: usize = 30;
/// Part of a difference of residuals outside of those after it, below which it says nothing of its own.
const DEPENDENT: f64 = 1e-9;
/// How many times the least residual so far is a sign that what is remembered misleads.
const GROWN: f64 = 10.0;

/// What is remembered of the states before, in coordinates whose plain norm counts.
#[derive(Default)]
pub(super) struct Anderson {
    last: Option<(Vec<f64>, Vec<f64>)>,
    /// Differences of residuals, and of what the map made of the states, the latest last.
    residuals: Vec<Vec<f64>>,
    images: Vec<Vec<f64>>,
    least: f64,
}

impl Anderson {
    pub(super) fn new() -> Self {
        Anderson { least: f64::INFINITY, ..Anderson::default() }
    }

    /// The next state, from the last one and what the map has made of it.
    pub(super) fn next(&mut self, state: &[f64], image: &[f64]) -> Vec<f64> {
        let residual: Vec<f64> = image.iter().zip(state).map(|(a, b)| a - b).collect();
        let size = norm(&residual);
        if size > GROWN * self.least {
            *self = Anderson { least: self.least, ..Anderson::new() };
        }
        self.least = self.least.min(size);
        if let Some((before, made)) = self.last.take() {
            if self.residuals.len() == MOST {
                self.residuals.remove(0);
                self.images.remove(0);
            }
            self.residuals.push(residual.iter().zip(&before).map(|(a, b)| a - b).collect());
            self.images.push(image.iter().zip(&made).map(|(a, b)| a - b).collect());
        }
        let shares = self.shares(&residual);
        let mut next = image.to_vec();
        for (own, share) in self.images.iter().zip(&shares) {
            next.iter_mut().zip(own).for_each(|(next, own)| *next -= share * own);
        }
        self.last = Some((residual, image.to_vec()));
        next
    }

    /// By which the differences of residuals add up to the residual as nearly as they can. The latest come first, so that of
    /// those that say nothing new the oldest are left out.
    fn shares(&self, residual: &[f64]) -> Vec<f64> {
        let count = self.residuals.len();
        let (mut basis, mut kept): (Vec<Vec<f64>>, Vec<usize>) = (Vec::new(), Vec::new());
        let mut upper: Vec<Vec<f64>> = Vec::new();
        for place in (0..count).rev() {
            let mut own = self.residuals[place].clone();
            let size = norm(&own);
            let mut column = vec![0.0; basis.len()];
            // Twice, as once leaves rounding of what is taken away.
            for _ in 0..2 {
                for (share, unit) in column.iter_mut().zip(&basis) {
                    let part = dot(unit, &own);
                    *share += part;
                    own.iter_mut().zip(unit).for_each(|(own, unit)| *own -= part * unit);
                }
            }
            let left = norm(&own);
            if !(left > DEPENDENT * size) {
                continue;
            }
            own.iter_mut().for_each(|own| *own /= left);
            column.push(left);
            basis.push(own);
            upper.push(column);
            kept.push(place);
        }
        let mut solved: Vec<f64> = basis.iter().map(|unit| dot(unit, residual)).collect();
        for j in (0..basis.len()).rev() {
            solved[j] /= upper[j][j];
            for i in 0..j {
                solved[i] -= upper[j][i] * solved[j];
            }
        }
        let mut shares = vec![0.0; count];
        kept.iter().zip(solved).for_each(|(&place, share)| shares[place] = share);
        shares
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A linear map of n values is solved by n + 1 states, whether it contracts or not.
    #[test]
    fn a_linear_map_is_solved_by_one_more_state_than_it_has_values() {
        let factors = [0.97, -0.9, 0.5, 1.4, 0.0];
        let map = |x: &[f64]| -> Vec<f64> {
            (0..5).map(|i| factors[i] * x[i] + 1.0 + 0.1 * x[(i + 1) % 5]).collect()
        };
        let (mut own, mut x) = (Anderson::new(), vec![0.0; 5]);
        for _ in 0..6 {
            let image = map(&x);
            x = own.next(&x, &image);
        }
        let miss = map(&x).iter().zip(&x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(miss < 1e-9 * norm(&x), "{miss:e} of {x:?}");
    }
}

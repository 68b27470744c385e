//! Natural frequencies of a body that turns at a constant speed, in the frame that turns with it.

use crate::linalg::{
    LinearAlgebraError, Matrix, congruence, eigenvalues, generalised_symmetric_eigen,
    symmetric_eigen, transpose_multiply,
};
use crate::reduction::hertz;
use crate::shaft::Shaft;

impl Shaft {
    /// The natural frequencies (Hz), ascending, of the body with its retained motions held, turning at `speed` (rad/s):
    /// those of M η̈ − 2θ̇ H η̇ + (K − θ̇² W) η = 0 over its fixed-interface modes. None where a motion grows.
    ///
    /// # Errors
    /// Values that are not finite.
    pub fn frequencies_at(&self, speed: f64) -> Result<Option<Vec<f64>>, LinearAlgebraError> {
        let n = self.hertz.len();
        let block = |matrix: &Matrix| Matrix::from_fn(n, n, |i, j| matrix[(i, j)]);
        let (mass, net) = (block(&self.mass), block(&self.spin_net));
        let stiffness = block(&self.stiffness);
        let stiffness =
            Matrix::from_fn(n, n, |i, j| stiffness[(i, j)] - speed * speed * net[(i, j)]);
        // In modes of K − θ̇² W with mass 1 the equations are ẍ − G ẋ + ω² x = 0, G skew.
        let eigen = generalised_symmetric_eigen(&stiffness, &mass)?;
        let coupling = congruence(&block(&self.spin_coupling), &eigen.vectors);
        if eigen.values.first().is_some_and(|lowest| *lowest <= 0.0) {
            return above_critical(speed, &eigen.values, &coupling);
        }
        let omega: Vec<f64> = eigen.values.iter().map(|square| square.sqrt()).collect();
        // With y = ω x the rates of (ẋ, y) are S (ẋ, y), S = [G −ω; ω 0] skew: SᵀS has each square of a frequency twice.
        let skew =
            Matrix::from_fn(2 * n, 2 * n, |i, j| match (i.checked_sub(n), j.checked_sub(n)) {
                (None, None) => 2.0 * speed * coupling[(i, j)],
                (None, Some(k)) if i == k => -omega[i],
                (Some(k), None) if k == j => omega[j],
                _ => 0.0,
            });
        let squares = symmetric_eigen(&transpose_multiply(skew.view(), skew.view()))?;
        Ok(Some(squares.values.iter().skip(1).step_by(2).map(|square| hertz(*square)).collect()))
    }
}

/// Of ẍ − 2θ̇ H ẋ + λ x = 0 with negative λ, above a critical speed, where H may keep the motion bounded.
fn above_critical(
    speed: f64,
    squares: &[f64],
    coupling: &Matrix,
) -> Result<Option<Vec<f64>>, LinearAlgebraError> {
    /// Real parts that are rounding, as a part of the largest eigenvalue.
    const ROUNDING: f64 = 1e-9;
    let n = squares.len();
    // In a unit of time in which all entries are of order one.
    let scale = squares.iter().fold(1.0, |most: f64, square| most.max(square.abs())).sqrt();
    let first_order =
        Matrix::from_fn(2 * n, 2 * n, |i, j| match (i.checked_sub(n), j.checked_sub(n)) {
            (None, Some(k)) if i == k => 1.0,
            (Some(k), None) if k == j => -squares[k] / (scale * scale),
            (Some(k), Some(l)) => 2.0 * speed * coupling[(k, l)] / scale,
            _ => 0.0,
        });
    let values = eigenvalues(&first_order)?;
    let largest = values.iter().fold(0.0, |most: f64, [_, im]| most.max(im.abs()));
    if values.iter().any(|[re, _]| *re > ROUNDING * largest) {
        return Ok(None);
    }
    let mut positive: Vec<f64> = values
        .iter()
        .filter(|[_, im]| *im > 0.0)
        .map(|[_, im]| hertz((scale * im).powi(2)))
        .collect();
    positive.sort_by(f64::total_cmp);
    Ok(Some(positive))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// A point on springs alike along x and y: seen from a frame that turns its circles are faster or slower by θ̇.
    #[test]
    fn circles_of_a_point_are_faster_or_slower_by_the_speed_of_the_frame() {
        let omega: f64 = 300.0;
        let mut point = Shaft::lumped(2.0, [2.0 * omega * omega; 2], [0.0; 2], 0.0);
        point.hertz = vec![omega / TAU; 2];
        for speed in [0.0, 100.0, -250.0, 450.0] {
            let found = point.frequencies_at(speed).unwrap().expect("circles do not grow");
            let exact = [(omega - f64::abs(speed)).abs(), omega + f64::abs(speed)];
            let exact = exact.map(|own| own / TAU);
            for (found, exact) in found.iter().zip(exact) {
                assert!((found / exact - 1.0).abs() < 1e-12, "{speed}: {found} {exact}");
            }
        }
        // Softer along y, between both critical speeds it grows.
        point.stiffness[(1, 1)] *= 0.8;
        assert_eq!(point.frequencies_at(285.0).unwrap(), None);
    }
}

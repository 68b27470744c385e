//! Motions under forces that repeat.

use num_complex::Complex64;

use super::blocks::Blocks;
use super::equations::Periodic;
use crate::linalg::LinearAlgebraError;

impl Periodic {
    /// z_k of the motion Σ z_k e^{i(ν + kΩ)t} under forces Σ f_k e^{i(ν + kΩ)t}, harmonics up to ±hs.
    ///
    /// # Errors
    /// A singular matrix.
    pub(crate) fn forced(
        &self,
        count: i32,
        frequency: f64,
        force: &dyn Fn(i32) -> Option<Vec<Complex64>>,
    ) -> Result<Vec<(i32, Vec<Complex64>)>, LinearAlgebraError> {
        let (n, step) = (self.means[0].rows, self.step());
        let orders: Vec<i32> = (-count..=count).map(|k| k * step).collect();
        let right = orders.iter().map(|&k| force(k).unwrap_or(vec![Complex64::ZERO; n]));
        let factors = Blocks::new(self, count).factors(Complex64::new(0.0, frequency))?;
        Ok(orders.iter().copied().zip(factors.solve(&right.collect())).collect())
    }
}

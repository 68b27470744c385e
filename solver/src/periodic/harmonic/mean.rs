//! The machine with the means of its tangents over the cycle: harmonic by harmonic a small system, near to the whole one.

use num_complex::Complex64;

use super::series::Series;
use crate::linalg::{ComplexLu, LinearAlgebraError, Matrix};

/// The factors of K̄ + iω_k C̄ − ω_k² M̄, from k = 0 on.
pub(super) struct Mean {
    factors: Vec<ComplexLu>,
}

impl Mean {
    /// # Errors
    /// A harmonic at which the mean machine resonates without damping.
    pub(super) fn new(
        series: &Series,
        [mass, damping, stiffness]: &[Matrix; 3],
    ) -> Result<Mean, LinearAlgebraError> {
        let factors = (0..=series.harmonics()).map(|k| {
            let frequency = series.frequency(k);
            let square = frequency * frequency;
            let entries = mass.data.iter().zip(&damping.data).zip(&stiffness.data);
            let matrix: Vec<Complex64> =
                entries.map(|((m, c), k)| Complex64::new(k - square * m, frequency * c)).collect();
            ComplexLu::new(mass.rows, &matrix)
        });
        Ok(Mean { factors: factors.collect::<Result<_, _>>()? })
    }

    /// The motion by forces, both as coefficients.
    pub(super) fn moved_by(&self, forces: &Matrix) -> Matrix {
        let n = forces.rows;
        let mut moved = Matrix::zeros(n, forces.cols);
        for (k, factor) in self.factors.iter().enumerate() {
            // Re((a − ib) e^{iφ}) = a cos φ + b sin φ.
            let [cosine, sine] = [(2 * k).saturating_sub(1), 2 * k];
            let part = |i: usize| if k == 0 { 0.0 } else { -forces[(i, sine)] };
            let mut own: Vec<Complex64> =
                (0..n).map(|i| Complex64::new(forces[(i, cosine)], part(i))).collect();
            factor.solve_in_place(&mut own);
            for (i, value) in own.iter().enumerate() {
                moved[(i, cosine)] = value.re;
                if k > 0 {
                    moved[(i, sine)] = -value.im;
                }
            }
        }
        moved
    }
}

//! An inverse in single precision: half the memory that a solution reads, for directions that are judged by where they lead.

use whirl_specs::columns::add_matrix;

use super::Lu;

/// A⁻¹ of an n × n matrix, scaled so that single precision holds it.
#[derive(Debug)]
pub(crate) struct RoughInverse {
    size: usize,
    /// A⁻¹ as it is computed.
    inverse: Vec<f64>,
    /// Σ⁻¹A⁻¹Σ⁻¹, column after column.
    scaled: Vec<f32>,
    /// Σ.
    scale: Vec<f64>,
    given: Vec<f32>,
    found: Vec<f32>,
}

impl RoughInverse {
    /// Memory for matrices of n rows.
    pub(crate) fn new(n: usize) -> Self {
        RoughInverse {
            size: n,
            inverse: vec![0.0; n * n],
            scaled: vec![0.0; n * n],
            scale: vec![1.0; n],
            given: vec![0.0; n],
            found: vec![0.0; n],
        }
    }

    /// Takes the inverse of the matrix that was factored. `weights`: 1/s_i, where the entries of A are about √(s_i s_j).
    /// Whether single precision holds it.
    pub(crate) fn invert(&mut self, lu: &mut Lu, weights: &[f64]) -> bool {
        let n = self.size;
        self.exact(lu);
        self.scale.iter_mut().zip(weights).for_each(|(own, weight)| *own = weight.sqrt());
        let (scale, inverse) = (&self.scale, &self.inverse);
        for (place, entry) in self.scaled.iter_mut().enumerate() {
            *entry = (inverse[place] / (scale[place % n] * scale[place / n])) as f32;
        }
        self.scaled.iter().all(|entry| entry.is_finite())
    }

    /// The inverse of the matrix that was factored in double precision, column after column.
    pub(crate) fn exact(&mut self, lu: &mut Lu) -> &[f64] {
        self.inverse.fill(0.0);
        self.inverse.iter_mut().step_by(self.size + 1).for_each(|entry| *entry = 1.0);
        lu.solve_in_place(&mut self.inverse);
        &self.inverse
    }

    /// Replaces b by A⁻¹b, to about six digits of its largest scaled value.
    pub(crate) fn apply(&mut self, b: &mut [f64]) {
        let RoughInverse { scaled, scale, given, found, .. } = self;
        let weighed = b.iter().zip(scale.iter()).map(|(b, scale)| b * scale);
        let largest = weighed.clone().fold(0.0, |most: f64, own| most.max(own.abs()));
        if largest == 0.0 {
            return;
        }
        given.iter_mut().zip(weighed).for_each(|(own, value)| *own = (value / largest) as f32);
        found.fill(0.0);
        add_matrix(found, scaled, given);
        let parts = found.iter().zip(scale.iter());
        b.iter_mut().zip(parts).for_each(|(b, (own, s))| *b = largest * s * f64::from(*own));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::Matrix;

    /// Rows of very different sizes, as of angles and modes.
    fn matrix(n: usize) -> (Matrix, Vec<f64>) {
        let size = |i: usize| 10_f64.powi((i % 7) as i32 * 4 - 12);
        let entry = |i: usize, j: usize| {
            let own = if i == j { 2.0 } else { 0.5 * ((3 * i + 7 * j) as f64).sin() / n as f64 };
            own * (size(i) * size(j)).sqrt()
        };
        (Matrix::from_fn(n, n, entry), (0..n).map(|i| 1.0 / size(i)).collect())
    }

    #[test]
    fn it_solves_to_single_precision() {
        for n in [1, 5, 8, 23, 226] {
            let (matrix, weights) = matrix(n);
            let mut lu = Lu::new(n);
            lu.factor(&matrix.data).unwrap();
            let mut rough = RoughInverse::new(n);
            assert!(rough.invert(&mut lu, &weights));
            for size in [1e-200, 1.0, 1e200] {
                let known: Vec<f64> =
                    (0..n).map(|i| size * (1.0 + i as f64).sin() * weights[i].sqrt()).collect();
                let mut found = matrix.apply(&known);
                rough.apply(&mut found);
                for (i, (found, known)) in found.iter().zip(&known).enumerate() {
                    let error = (found - known).abs() / (size * weights[i].sqrt());
                    assert!(error < 1e-5, "{n} {size}: {i}: {found} {known}");
                }
            }
        }
    }

    #[test]
    fn of_nothing_it_makes_nothing() {
        let mut rough = RoughInverse::new(3);
        assert!(rough.invert(&mut Lu::new(3), &[1.0; 3]));
        let mut none = [0.0; 3];
        rough.apply(&mut none);
        assert_eq!(none, [0.0; 3]);
        assert!(
            !rough.invert(&mut Lu::new(3), &[1e90; 3])
                || !rough.invert(&mut Lu::new(3), &[1e-90; 3])
        );
    }
}

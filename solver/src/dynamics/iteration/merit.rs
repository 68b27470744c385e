//! The merit of an iterate, φ = ½ Σ r_i²/s_i, where s is the diagonal of the constant part a2 M + a1 C + K.

use super::newmark::Coefficients;
use crate::equations::Equations;
use crate::linalg::sum_over;

/// The weights of φ, for the coordinates that are unknown: all from `first` on.
pub(super) struct Merit {
    first: usize,
    /// 1/s, and the step length (s) that they are of.
    weights: Vec<f64>,
    dt: f64,
}

impl Merit {
    pub(super) fn new(first: usize, unknowns: usize) -> Self {
        Merit { first, weights: vec![1.0; unknowns], dt: 0.0 }
    }

    /// Makes the weights for a step length.
    pub(super) fn weigh(&mut self, equations: &Equations, step: &Coefficients) {
        if self.dt == step.dt {
            return;
        }
        let diagonal = equations.diagonal(step.weights());
        let own = self.weights.iter_mut().zip(&diagonal[self.first..]);
        own.for_each(|(weight, s)| *weight = 1.0 / s);
        self.dt = step.dt;
    }

    /// 1/s.
    pub(super) fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// √(2φ) = √(Σ r_i²/s_i) of the state that was last evaluated.
    pub(super) fn norm(&self, equations: &Equations) -> f64 {
        let residual = &equations.residual[self.first..];
        sum_over([residual, &self.weights], |[r, weight]| r * r * weight).sqrt()
    }

    /// √(Σ s_i Δq_i²).
    pub(super) fn length(&self, moved: &[f64]) -> f64 {
        sum_over([moved, &self.weights], |[moved, weight]| moved * moved / weight).sqrt()
    }

    /// The coordinate that contributes most to φ.
    pub(super) fn worst(&self, residual: &[f64]) -> usize {
        let terms = residual[self.first..].iter().zip(&self.weights).map(|(x, w)| x * x * w);
        let worst = terms.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        self.first + worst.map_or(0, |(place, _)| place)
    }
}

#[cfg(test)]
mod tests {
    use super::super::newmark::Newmark;
    use super::*;
    use crate::dynamics::small::machine;
    use crate::machine::Rotation;

    /// a2 M + a1 C + K on the diagonal of the small machine.
    fn diagonal(step: &Coefficients) -> [f64; 5] {
        let (a1, a2) = (step.a1, step.a2);
        [
            a2 * 7.0,
            a2 * 2.0 + a1 * 13.0 + 900.0,
            a2 * 3.0 + a1 * 17.0 + 1700.0,
            a2 + a1 * 5.0 + 125.0,
            a2 + a1 * 7.0 + 200.0,
        ]
    }

    #[test]
    fn norms_weigh_rows_by_the_diagonal() {
        for (rotation, first) in [(Rotation::Free, 0), (Rotation::Held, 1)] {
            let machine = machine(rotation.clone());
            let mut equations = Equations::new(&machine);
            let mut merit = Merit::new(first, 5 - first);
            let r = [3.0, -70.0, 20.0, 50.0, -11.0];
            equations.residual.copy_from_slice(&r);
            // Anew for every step length.
            for dt in [0.3, 0.1] {
                let step = Coefficients::new(Newmark::default(), dt);
                merit.weigh(&equations, &step);
                let s = &diagonal(&step)[first..];
                let pairs = || r[first..].iter().zip(s);
                let norm = pairs().map(|(r, s)| r * r / s).sum::<f64>().sqrt();
                let length = pairs().map(|(x, s)| x * x * s).sum::<f64>().sqrt();
                assert!((merit.norm(&equations) / norm - 1.0).abs() < 1e-14, "{rotation:?} {dt}");
                assert!(
                    (merit.length(&r[first..]) / length - 1.0).abs() < 1e-14,
                    "{rotation:?} {dt}"
                );
            }
        }
    }

    #[test]
    fn the_worst_coordinate_has_the_largest_part_of_the_merit() {
        let machine = machine(Rotation::Held);
        let equations = Equations::new(&machine);
        let mut merit = Merit::new(1, 4);
        // Without inertia 1/s is 1/900, 1/1700, 1/125 and 1/200.
        let mut step = Coefficients::new(Newmark::default(), 1.0);
        (step.a1, step.a2) = (0.0, 1e-9);
        merit.weigh(&equations, &step);
        assert_eq!(merit.worst(&[1e9, 1.0, 1.0, 1.0, 1.0]), 3);
        // The largest row is not the worst, nor is that with the least s.
        assert_eq!(merit.worst(&[0.0, -30.0, 40.0, 3.0, 1.0]), 1);
        assert_eq!(merit.worst(&[0.0, -30.0, 40.0, 3.0, -20.0]), 4);
    }
}

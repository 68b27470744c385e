//! Equations whose matrices vary with an angle, and their motions.

use num_complex::Complex64;

use crate::linalg::{Matrix, congruence};

/// A harmonic of M, C and K: real and imaginary parts of X_k, k > 0.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Harmonic {
    /// k.
    pub(crate) order: i32,
    /// M_k, C_k and K_k.
    pub(crate) parts: [[Matrix; 2]; 3],
}

/// Equations whose matrices vary.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Periodic {
    /// M_0, C_0 and K_0; M_0 symmetric.
    pub(crate) means: [Matrix; 3],
    /// By rising orders.
    pub(crate) harmonics: Vec<Harmonic>,
    /// Ω (rad/s).
    pub(crate) speed: f64,
}

/// A motion e^{λt} Σ z_k e^{ikΩt}.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PeriodicPair {
    /// λ (1/s).
    pub(crate) value: Complex64,
    /// k with z_k.
    pub(crate) parts: Vec<(i32, Vec<Complex64>)>,
}

impl Periodic {
    /// The step of the harmonics: 2 where only even ones are there.
    pub(crate) fn step(&self) -> i32 {
        if self.harmonics.iter().all(|own| own.order % 2 == 0) { 2 } else { 1 }
    }

    /// The same equations in coordinates V of which z = V u.
    pub(crate) fn in_basis(&self, basis: &Matrix) -> Periodic {
        let of = |own: &Matrix| congruence(own, basis);
        let harmonics = self.harmonics.iter().map(|own| Harmonic {
            order: own.order,
            parts: own.parts.each_ref().map(|parts| parts.each_ref().map(of)),
        });
        Periodic {
            means: self.means.each_ref().map(of),
            harmonics: harmonics.collect(),
            speed: self.speed,
        }
    }
}

//! Motions that grow, listed among the modes or not.

use num_complex::Complex64;

use super::linearised::Linearised;
use super::motions::{Motion, growth};
use super::round::LinearMachine;
use super::shapes::{apply, inner};

/// A motion that grows.
#[derive(Debug, Clone, PartialEq)]
pub struct Growing {
    /// λ (1/s), Im λ ≥ 0; real if it does not oscillate.
    pub value: Complex64,
    /// Shares of xᴴM′x by body, in their order.
    pub shares: Vec<f64>,
}

impl LinearMachine {
    /// Those of all motions that grow, fastest first.
    pub(super) fn growing(&self, equations: &Linearised, motions: &[Motion]) -> Vec<Growing> {
        let grows = motions.iter().filter(|own| growth(own.value) > 0.0);
        let mut all: Vec<Growing> = grows
            .map(|own| Growing { value: own.value, shares: self.shares(equations, &own.shape) })
            .collect();
        all.sort_by(|a, b| b.value.re.total_cmp(&a.value.re));
        all
    }

    /// Shares of xᴴM′x of a shape by body.
    pub(super) fn shares(&self, equations: &Linearised, shape: &[Complex64]) -> Vec<f64> {
        let Linearised { turning, mass, .. } = equations;
        let moved = apply(mass, shape);
        let whole = inner(shape, &moved).re;
        let share = |body: usize| {
            let block = self.block(turning.len(), body);
            let angle = turning.iter().position(|own| *own == body);
            let angle = angle.map_or(0.0, |place| (shape[place].conj() * moved[place]).re);
            (angle + inner(&shape[block.clone()], &moved[block]).re) / whole
        };
        (0..self.machine.bodies.len()).map(share).collect()
    }
}

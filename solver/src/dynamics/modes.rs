//! The modes of a machine, and what of a motion is in some of them.

use super::newmark::{Coefficients, State};
use super::system::System;
use crate::error::Error;
use crate::linalg::{Matrix, add_columns, generalised_symmetric_eigen};

/// The modes of the machine at rest, springs as they are at the start. Every θ takes part: it and its flexible body
/// accelerate against each other. Motions of more than 6000 steps a period are left out, so that a body that
/// turns is not measured by its angle.
pub(super) struct MachineModes {
    /// ωΔt < 1.
    pub(super) resolved: Projection,
    pub(super) unresolved: Projection,
    /// ω of the fastest, if the step does not resolve it (rad/s).
    pub(super) fastest: Option<f64>,
}

impl MachineModes {
    /// At a state that was just evaluated.
    pub(super) fn new(system: &mut System, dt: f64, state: &State) -> Result<Self, Error> {
        let machine = system.machine;
        let (size, first) = (machine.size(), machine.first_unknown());
        let mut tangent = vec![0.0; size * size];
        system.tangent(system.time, state, &Coefficients::at_rest(), &mut tangent);
        let unknowns: Vec<usize> = (first..size).collect();
        let whole = Matrix { rows: size, cols: size, data: tangent };
        let stiffness = whole.select(&unknowns, &unknowns).symmetric_part();
        let mass = system.mass(state).select(&unknowns, &unknowns);
        let eigen = generalised_symmetric_eigen(&stiffness, &mass)?;
        let all: Vec<usize> = (0..size - first).collect();
        let project = |within: &dyn Fn(f64) -> bool| {
            let modes = all.iter().filter(|&&i| within(eigen.values[i] * dt * dt));
            let modes: Vec<usize> = modes.copied().collect();
            let vectors = eigen.vectors.select(&all, &modes);
            let rows = crate::linalg::multiply(mass.view(), vectors.view());
            Projection { rows, vectors }
        };
        let fastest = eigen.values.iter().copied().fold(0.0, f64::max);
        Ok(MachineModes {
            resolved: project(&|square| (1e-6..1.0).contains(&square)),
            unresolved: project(&|square| square >= 1.0),
            fastest: (fastest * dt * dt >= 1.0).then(|| fastest.sqrt()),
        })
    }
}

/// Some modes Φ, and MΦ: unknowns × modes.
pub(super) struct Projection {
    rows: Matrix,
    vectors: Matrix,
}

impl Projection {
    /// Writes what of a motion of the unknowns is in the modes, ΦΦᵀM x.
    pub(super) fn part(&self, x: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        let modes = 0..self.rows.cols;
        let amplitudes = modes.map(|k| whirl_specs::vector::dot(self.rows.col(k), x));
        add_columns(out, amplitudes.enumerate().map(|(k, own)| (self.vectors.col(k), own)));
    }
}

//! The modes of a machine, and what of a motion is in some of them.

use std::ops::Range;

use super::newmark::{Coefficients, State};
use super::system::System;
use crate::error::Error;
use crate::linalg::{Matrix, add_columns, generalised_symmetric_eigen, multiply};

/// The modes of the machine at rest, springs as they are at the start. Every θ takes part: it and its flexible body
/// accelerate against each other.
pub(super) struct MachineModes {
    /// ω², ascending ((rad/s)²).
    squares: Vec<f64>,
    /// MΦ and Φ: unknowns × modes.
    rows: Matrix,
    vectors: Matrix,
}

impl MachineModes {
    /// At a state that was just evaluated.
    pub(super) fn new(system: &mut System, state: &State) -> Result<Self, Error> {
        let machine = system.machine;
        let (size, first) = (machine.size(), machine.first_unknown());
        let mut tangent = vec![0.0; size * size];
        system.tangent(system.time, state, &Coefficients::at_rest(), &mut tangent);
        let unknowns: Vec<usize> = (first..size).collect();
        let whole = Matrix { rows: size, cols: size, data: tangent };
        let stiffness = whole.select(&unknowns, &unknowns).symmetric_part();
        let mass = system.mass(state).select(&unknowns, &unknowns);
        let eigen = generalised_symmetric_eigen(&stiffness, &mass)?;
        let rows = multiply(mass.view(), eigen.vectors.view());
        Ok(MachineModes { squares: eigen.values, rows, vectors: eigen.vectors })
    }

    /// The modes whose ω² is in a range, as a range of their places.
    pub(super) fn within(&self, squares: Range<f64>) -> Range<usize> {
        let below = |limit: f64| self.squares.partition_point(|square| *square < limit);
        below(squares.start)..below(squares.end)
    }

    /// ω of the fastest mode (rad/s).
    pub(super) fn fastest(&self) -> f64 {
        self.squares.last().copied().unwrap_or(0.0).max(0.0).sqrt()
    }

    /// Writes what of a motion of the unknowns is in the modes at some places, ΦΦᵀM x.
    pub(super) fn part(&self, modes: Range<usize>, x: &[f64], out: &mut [f64]) {
        self.weighted(modes, |_| 1.0, x, out);
    }

    /// Writes ΦWΦᵀM x, W the weights by ω² of the modes at some places.
    pub(super) fn weighted(
        &self,
        modes: Range<usize>,
        weight: impl Fn(f64) -> f64,
        x: &[f64],
        out: &mut [f64],
    ) {
        out.fill(0.0);
        let amplitudes = modes.map(|k| {
            let own = whirl_specs::vector::dot(self.rows.col(k), x);
            (self.vectors.col(k), weight(self.squares[k]) * own)
        });
        add_columns(out, amplitudes);
    }
}

//! The modes of a machine, and what of a motion is in some of them.

use std::ops::Range;

use crate::equations::{Equations, State, Weights};
use crate::error::Error;
use crate::linalg::{
    Matrix, add_columns, add_product, generalised_symmetric_eigen, multiply, symmetric_eigen,
    transpose_multiply,
};

/// The modes of the machine by its stiffness at a state. Every θ takes part: it and its flexible body
/// accelerate against each other.
pub(in crate::dynamics) struct MachineModes {
    /// ω², ascending ((rad/s)²); −∞ of motions on which nothing acts, where those are told apart.
    squares: Vec<f64>,
    /// MΦ and Φ: unknowns × modes.
    rows: Matrix,
    vectors: Matrix,
    /// The symmetric part of the stiffness of the unknowns.
    stiffness: Matrix,
}

impl MachineModes {
    /// At a state that was just evaluated.
    pub(in crate::dynamics) fn new(
        equations: &mut Equations,
        state: &State,
    ) -> Result<Self, Error> {
        let stiffness = unknown_tangent(equations, state, Weights::POSITION).symmetric_part();
        let first = equations.machine.first_unknown();
        let unknowns: Vec<usize> = (first..equations.machine.size()).collect();
        let mass = equations.mass(state).select(&unknowns, &unknowns);
        let eigen = generalised_symmetric_eigen(&stiffness, &mass)?;
        let rows = multiply(mass.view(), eigen.vectors.view());
        Ok(MachineModes { squares: eigen.values, rows, vectors: eigen.vectors, stiffness })
    }

    /// The same, with motions on which nothing acts before all others: neither stiffness, symmetric or not, nor damping, nor
    /// turning, by as much as would change ω² by `slow` in steps of `length` s. Those alone are integrated exactly.
    pub(super) fn told_apart(
        equations: &mut Equations,
        state: &State,
        (slow, length): (f64, f64),
    ) -> Result<Self, Error> {
        let mut modes = MachineModes::new(equations, state)?;
        let still = modes.within(-slow..slow);
        if still.is_empty() {
            return Ok(modes);
        }
        let weights = Weights { rate: 1.0 / length, ..Weights::POSITION };
        let tangent = unknown_tangent(equations, state, weights);
        let forces = multiply(tangent.view(), modes.vectors.columns(still.clone()));
        let acting = transpose_multiply(modes.vectors.view(), forces.view());
        let own = symmetric_eigen(&transpose_multiply(acting.view(), acting.view()))?;
        let free = own.values.partition_point(|square| square.max(0.0).sqrt() < slow);
        let n = modes.squares.len();
        for matrix in [&mut modes.rows, &mut modes.vectors] {
            let turned = multiply(matrix.columns(still.clone()), own.vectors.view());
            matrix.data[still.start * n..still.end * n].copy_from_slice(&turned.data);
            matrix.data[..(still.start + free) * n].rotate_right(free * n);
        }
        let squares = &mut modes.squares;
        squares[still.clone()].fill(0.0);
        squares[..still.start + free].rotate_right(free);
        squares[..free].fill(f64::NEG_INFINITY);
        Ok(modes)
    }

    /// Places of motions on which nothing acts.
    pub(super) fn free(&self) -> Range<usize> {
        0..self.squares.partition_point(|square| *square == f64::NEG_INFINITY)
    }

    /// Places of modes of which something acts, with ω² below a limit, and of those beyond it.
    pub(super) fn acted(&self, limit: f64) -> [Range<usize>; 2] {
        let fast = self.squares.partition_point(|square| *square < limit);
        [self.free().end..fast, fast..self.squares.len()]
    }

    /// The modes whose ω² is in a range, as a range of their places.
    pub(in crate::dynamics) fn within(&self, squares: Range<f64>) -> Range<usize> {
        let below = |limit: f64| self.squares.partition_point(|square| *square < limit);
        below(squares.start)..below(squares.end)
    }

    /// ω² of a mode.
    pub(super) fn square(&self, mode: usize) -> f64 {
        self.squares[mode]
    }

    /// ω of the fastest mode (rad/s).
    pub(super) fn fastest(&self) -> f64 {
        self.squares.last().copied().unwrap_or(0.0).max(0.0).sqrt()
    }

    /// The share that the coordinates at some places have in the kinetic energy of a mode.
    pub(super) fn share(&self, mode: usize, places: Range<usize>) -> f64 {
        let [rows, vectors] = [&self.rows, &self.vectors].map(|own| &own.col(mode)[places.clone()]);
        rows.iter().zip(vectors).map(|(a, b)| a * b).sum()
    }

    /// Writes K x.
    pub(super) fn pull(&self, x: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        add_product(out, &self.stiffness, x);
    }

    /// Writes what of a motion of the unknowns is in the modes at some places, ΦΦᵀM x. Of most modes it is what the others leave.
    pub(super) fn part(&self, modes: Range<usize>, x: &[f64], out: &mut [f64]) {
        let all = self.squares.len();
        if 2 * modes.len() <= all {
            return self.weighted(modes, |_| 1.0, x, out);
        }
        out.copy_from_slice(x);
        let others = (0..modes.start).chain(modes.end..all);
        add_columns(out, others.map(|k| (self.vectors.col(k), -self.amplitude(k, x))));
    }

    /// Writes ΦΦᵀf, the acceleration by a force in the modes at some places.
    pub(super) fn driven(&self, modes: Range<usize>, force: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        let along = |mode: usize| whirl_specs::vector::dot(self.vectors.col(mode), force);
        add_columns(out, modes.map(|k| (self.vectors.col(k), along(k))));
    }

    /// That of a mode in a motion of the unknowns.
    fn amplitude(&self, mode: usize, x: &[f64]) -> f64 {
        whirl_specs::vector::dot(self.rows.col(mode), x)
    }

    /// Writes ΦWΦᵀM x, W the weights by ω² of the modes at some places.
    pub(in crate::dynamics) fn weighted(
        &self,
        modes: Range<usize>,
        weight: impl Fn(f64) -> f64,
        x: &[f64],
        out: &mut [f64],
    ) {
        out.fill(0.0);
        let amplitudes =
            modes.map(|k| (self.vectors.col(k), weight(self.squares[k]) * self.amplitude(k, x)));
        add_columns(out, amplitudes);
    }
}

/// The tangent of the unknowns at a state that was just evaluated.
fn unknown_tangent(equations: &mut Equations, state: &State, weights: Weights) -> Matrix {
    let (size, first) = (equations.machine.size(), equations.machine.first_unknown());
    let mut data = vec![0.0; size * size];
    equations.tangent(equations.time, state, weights, &mut data);
    let unknowns: Vec<usize> = (first..size).collect();
    Matrix { rows: size, cols: size, data }.select(&unknowns, &unknowns)
}

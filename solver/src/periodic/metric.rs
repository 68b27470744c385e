//! The energy norm, in which positions and rates of all bodies are of one kind: ½ q̇ᵀM q̇ + ½ qᵀ(K + ω²M) q without joints, with
//! ω of the cycle, so that a body that nothing elastic holds counts as well. What laws and films remember counts by its size over a
//! cycle: as much as the motion, each group of alike values for itself.

use std::f64::consts::TAU;

use super::map::CycleMap;
use crate::equations::Equations;
use crate::error::Error;
use crate::linalg::{Cholesky, Matrix};
use crate::machine::Body;

/// Changes states into others whose plain norm is that of energy, and back.
pub(super) struct Metric {
    position: Cholesky,
    rate: Cholesky,
    unknowns: usize,
    /// Of what laws and films remember: factors of values above zero, and below.
    memory: Vec<[f64; 2]>,
}

impl Metric {
    /// Of a machine at a state; where laws remember, a cycle is marched from there.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub(super) fn new(map: &mut CycleMap, x: &[f64]) -> Result<Self, Error> {
        let (machine, state) = (map.machine(), map.state(x));
        let (first, n) = (machine.first_unknown(), map.unknowns());
        let unknown: Vec<usize> = (first..machine.size()).collect();
        let mass = Equations::new(machine).mass(&state).select(&unknown, &unknown);
        let square = (TAU / map.cycle().period).powi(2);
        let mut stiffness =
            Matrix { data: mass.data.iter().map(|m| square * m).collect(), ..mass.clone() };
        for (body, place) in machine.bodies.iter().zip(machine.places()) {
            let own = place.flexible.start - first;
            match body {
                Body::Turning { shaft, .. } => {
                    for j in 0..shaft.size() {
                        for i in 0..shaft.size() {
                            stiffness[(own + i, own + j)] += shaft.stiffness[(i, j)];
                        }
                    }
                }
                Body::Standing { support, .. } => {
                    let stiff = support.stiffness.iter().enumerate();
                    stiff.for_each(|(i, k)| stiffness[(own + i, own + i)] += k);
                }
            }
        }
        let (mut position, mut rate) = (Cholesky::new(n), Cholesky::new(n));
        position.factor(&stiffness.data)?;
        rate.factor(&mass.data)?;
        let mut metric =
            Metric { position, rate, unknowns: n, memory: vec![[1.0; 2]; map.memory()] };
        if map.memory() > 0 {
            metric.weigh_memory(map, x)?;
        }
        Ok(metric)
    }

    fn weigh_memory(&mut self, map: &mut CycleMap, x: &[f64]) -> Result<(), Error> {
        let mut end = x.to_vec();
        let largest = map.reach(&mut end)?;
        let moved = 2 * self.unknowns;
        let size = [x, &end].map(|own| norm(&self.weighed(own)[..moved])).into_iter();
        let size = size.filter(|own| own.is_finite()).fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        for group in map.remembered() {
            let place = group.place.clone();
            let mut sizes = group.least;
            for own in &largest[place.clone()] {
                sizes = [0, 1].map(|side| sizes[side].max(own[side]));
            }
            if group.is_one_quantity() {
                sizes = [sizes[0].max(sizes[1]); 2];
            }
            let weights = sizes.map(|own| size / (own * (place.len() as f64).sqrt()));
            self.memory[place].fill(weights);
        }
        Ok(())
    }

    /// (Lᵀq, Lᵀq̇) of a state, and what laws remember.
    pub(super) fn weighed(&self, x: &[f64]) -> Vec<f64> {
        let n = self.unknowns;
        let (q, v, memory) = (&x[..n], &x[n..2 * n], &x[2 * n..]);
        let of = |factor: &Cholesky, x: &[f64], j: usize| -> f64 {
            (j..n).map(|i| factor.lower(i, j) * x[i]).sum()
        };
        let rates = (0..n).map(|j| of(&self.rate, v, j));
        let memory = memory.iter().zip(&self.memory);
        let memory = memory.map(|(value, weights)| value * weights[side(*value)]);
        (0..n).map(|j| of(&self.position, q, j)).chain(rates).chain(memory).collect()
    }

    /// Lᵀq of positions alone.
    pub(super) fn weighed_positions(&self, q: &[f64]) -> Vec<f64> {
        let n = self.unknowns;
        let of = |j: usize| (j..n).map(|i| self.position.lower(i, j) * q[i]).sum();
        (0..n).map(of).collect()
    }

    /// The positions of which they were made, in their place.
    pub(super) fn positions(&self, weighed: &mut [f64]) {
        if self.unknowns > 0 {
            self.position.solve_upper_in_place(weighed);
        }
    }

    /// Lᵀ of positions, column after column.
    pub(super) fn weighed_columns(&self, positions: &Matrix) -> Vec<f64> {
        (0..positions.cols).flat_map(|j| self.weighed_positions(positions.col(j))).collect()
    }

    /// The columns of which they were made.
    pub(super) fn columns(&self, mut weighed: Matrix) -> Matrix {
        (0..weighed.cols).for_each(|j| self.positions(weighed.col_mut(j)));
        weighed
    }

    /// The state of which it was made.
    pub(super) fn state(&self, weighed: &[f64]) -> Vec<f64> {
        let mut x = weighed.to_vec();
        let (moved, memory) = x.split_at_mut(2 * self.unknowns);
        memory.iter_mut().zip(&self.memory).for_each(|(value, weights)| {
            *value /= weights[side(*value)];
        });
        let (q, v) = moved.split_at_mut(self.unknowns);
        if self.unknowns > 0 {
            self.position.solve_upper_in_place(q);
            self.rate.solve_upper_in_place(v);
        }
        x
    }
}

/// Which of the factors a value has.
fn side(value: f64) -> usize {
    usize::from(value.is_sign_negative())
}

/// The plain norm.
pub(super) fn norm(x: &[f64]) -> f64 {
    x.iter().map(|own| own * own).sum::<f64>().sqrt()
}

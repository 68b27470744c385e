//! Motions that nothing holds: the stiffness that they seem to have is rounding, as much as rigid motions show.

use super::linearised::{Linearised, Standstill};
use super::round::LinearMachine;
use crate::error::Error;
use crate::linalg::{Matrix, dot, generalised_symmetric_eigen, multiply, transpose_multiply};

/// Where bodies turn and are joined, as much rounding comes beside that of each as it has itself in C and K.
const BESIDE: f64 = 4.0;
/// Share of a motion's inertia from which on a body takes part in it.
const TAKES_PART: f64 = 0.2;
/// A frequency that is slower than another one, as a share of it.
const SLOWER: f64 = 1e-4;
/// Share of that of a body by which it moves across.
const ACROSS: f64 = 0.5;

impl LinearMachine {
    /// |λ|² up to which a motion of so many coordinates is one that nothing holds, beside the largest ω² of K.
    pub(super) fn unheld_below(&self, coordinates: usize, largest: f64) -> f64 {
        coordinates as f64 * f64::EPSILON * largest + BESIDE * self.rounding
    }

    /// The bodies that nothing holds about a state, with how they move, in words; of those whose speed is not given their turning
    /// is left out.
    ///
    /// # Errors
    /// Values that are not finite.
    pub(super) fn unheld(
        &self,
        at: &Standstill,
        equations: &Linearised,
    ) -> Result<Vec<String>, Error> {
        if equations.mass.rows == 0 {
            return Ok(Vec::new());
        }
        let mass = &equations.mass;
        let eigen = generalised_symmetric_eigen(&equations.stiffness.symmetric_part(), mass)?;
        let largest = eigen.values.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        // With states that have come to rest: what creeps holds nothing.
        let eigen = match equations.remembered.is_some() {
            true => {
                let standing = equations.at_frequency(0.0).stiffness.symmetric_part();
                generalised_symmetric_eigen(&standing, mass)?
            }
            false => eigen,
        };
        let least = self.unheld_below(mass.rows, largest);
        let slow: Vec<usize> = (0..mass.rows).filter(|&k| eigen.values[k].abs() <= least).collect();
        if slow.is_empty() {
            return Ok(Vec::new());
        }
        // What acts without being symmetric, and by states of laws as slowly as rounding lets be seen: those that integrate hold,
        // the more the slower; those that creep only brake.
        let frequency = least.sqrt();
        let all: Vec<Vec<f64>> = slow.iter().map(|&k| eigen.vectors.col(k).to_vec()).collect();
        let shapes = Matrix { rows: mass.rows, cols: all.len(), data: all.concat() };
        let acting = |matrix: &Matrix| {
            transpose_multiply(shapes.view(), multiply(matrix.view(), shapes.view()).view())
        };
        let by_states = |frequency: f64| -> Matrix {
            let all = equations.at_frequency(frequency);
            let data = all.damping.data.iter().zip(&equations.damping.data);
            let data = data.map(|(all, own)| frequency * (all - own)).collect();
            acting(&Matrix { data, ..all.damping.clone() })
        };
        let stiffness = acting(&equations.at_frequency(SLOWER * frequency).stiffness);
        let states = [frequency, SLOWER * frequency].map(by_states);
        let is_held = |k: usize| {
            (0..all.len()).any(|j| {
                let [own, slower] = states.each_ref().map(|own| own[(j, k)].abs());
                stiffness[(j, k)].abs() > least || own > least && slower > own
            })
        };
        let mut words = Vec::new();
        for (k, shape) in all.iter().enumerate() {
            if is_held(k) {
                continue;
            }
            let moved = mass.apply(shape);
            for body in 0..self.machine.bodies.len() {
                let block = self.block(at.angles.len(), body);
                let share = dot(&shape[block.clone()], &moved[block.clone()]);
                if share < TAKES_PART {
                    continue;
                }
                let generator = self.generators[body].as_ref().or(self.senses[body].as_ref());
                let across = generator.map_or(share, |[_, square]| {
                    let turned = square.apply(&shape[block.clone()]);
                    -dot(&turned, &moved[block])
                });
                let name = self.machine.bodies[body].name();
                let own = match across > ACROSS * share {
                    true => name.to_owned(),
                    false => format!("{name} along or about its axis"),
                };
                if !words.contains(&own) {
                    words.push(own);
                }
            }
        }
        Ok(words)
    }
}

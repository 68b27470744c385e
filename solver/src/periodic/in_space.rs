//! Coordinates of bodies that turn, as space sees them: q = e^{−αS} z with the angle α = Ωt and the generator S of a turn
//! ([`crate::roundness`]).
//!
//! What stands in space has a constant z, and joints between a body that turns and one that stands couple equal harmonics of both. With
//! S³ = −S, e^{αS} = 1 + S sin α + S² (1 − cos α).

use std::ops::Range;

use crate::error::Error;
use crate::linalg::{Matrix, multiply, transpose_multiply};
use crate::machine::Machine;

/// Bodies that turn at constant speeds.
#[derive(Debug, Clone)]
pub(super) struct InSpace {
    bodies: Vec<Turned>,
}

#[derive(Debug, Clone)]
struct Turned {
    /// Its coordinates, by their places among the unknowns.
    place: Range<usize>,
    /// Ω (rad/s).
    speed: f64,
    /// S and S².
    once: Matrix,
    twice: Matrix,
}

impl InSpace {
    /// Of the bodies of a machine, with their speeds (rad/s).
    ///
    /// # Errors
    /// A mass that is not positive definite.
    pub(super) fn new(machine: &Machine, speeds: &[f64]) -> Result<InSpace, Error> {
        let mut bodies = Vec::new();
        for (number, (body, &speed)) in machine.bodies.iter().zip(speeds).enumerate() {
            // A frame that stands still is that of space.
            let turns = speed != 0.0 && !machine.spins(number);
            let Some(shaft) = body.shaft().filter(|own| turns && own.size() > 0) else {
                continue;
            };
            let place = &machine.places()[number];
            let once = shaft.roundness()?.generator;
            let twice = multiply(once.view(), once.view());
            let first = machine.first_unknown();
            let place = place.flexible.start - first..place.flexible.end - first;
            bodies.push(Turned { place, speed, once, twice });
        }
        Ok(InSpace { bodies })
    }

    /// Every body in its own frame.
    #[cfg(test)]
    pub(super) fn none() -> InSpace {
        InSpace { bodies: Vec::new() }
    }

    /// q, q̇ and q̈ of z and its rates, in their places, after a time (s).
    pub(super) fn to_bodies(&self, [z, rate, acceleration]: [&mut [f64]; 3], time: f64) {
        for own in &self.bodies {
            let [z, rate, acceleration] =
                [&mut *z, &mut *rate, &mut *acceleration].map(|all| &mut all[own.place.clone()]);
            // In the frame, at α = 0: ż − ΩSz and z̈ − 2ΩSż + Ω²S²z.
            let speed = own.speed;
            add(acceleration, -2.0 * speed, &own.once, rate);
            add(acceleration, speed * speed, &own.twice, z);
            add(rate, -speed, &own.once, z);
            for all in [z, rate, acceleration] {
                own.turn_by(-own.speed * time, all);
            }
        }
    }

    /// z of q after a time (s).
    pub(super) fn positions(&self, q: &mut [f64], time: f64) {
        for own in &self.bodies {
            own.turn_by(own.speed * time, &mut q[own.place.clone()]);
        }
    }

    /// What forces on q are on z: Eᵀ f with E = e^{−αS}.
    pub(super) fn forces(&self, force: &mut [f64], time: f64) {
        for own in &self.bodies {
            let force = &mut force[own.place.clone()];
            let (sin, cos) = (-own.speed * time).sin_cos();
            let [once, twice] = [&own.once, &own.twice].map(|own| own.apply_transpose(force));
            for (force, (once, twice)) in force.iter_mut().zip(once.iter().zip(&twice)) {
                *force += sin * once + (1.0 - cos) * twice;
            }
        }
    }

    /// −∂r/∂q̈, −∂r/∂q̇ and −∂r/∂q as those by z̈, ż and z.
    pub(super) fn tangents(&self, all: [Matrix; 3], time: f64) -> [Matrix; 3] {
        let [mut mass, mut damping, mut stiffness] = all;
        for own in &self.bodies {
            let n = own.place.len();
            let (sin, cos) = (-own.speed * time).sin_cos();
            let turned = Matrix::from_fn(n, n, |i, j| {
                let unit = f64::from(u8::from(i == j));
                unit + sin * own.once[(i, j)] + (1.0 - cos) * own.twice[(i, j)]
            });
            for matrix in [&mut mass, &mut damping, &mut stiffness] {
                // Columns, then rows.
                let columns = multiply(matrix.columns(own.place.clone()), turned.view());
                for (column, j) in own.place.clone().enumerate() {
                    matrix.col_mut(j).copy_from_slice(columns.col(column));
                }
                let rows = Matrix::from_fn(n, matrix.cols, |i, j| matrix[(own.place.start + i, j)]);
                let rows = transpose_multiply(turned.view(), rows.view());
                for j in 0..matrix.cols {
                    matrix.col_mut(j)[own.place.clone()].copy_from_slice(rows.col(j));
                }
            }
            // S commutes with E, so that the rates of z go in behind it.
            let speed = own.speed;
            let of = |matrix: &Matrix, generator: &Matrix| {
                multiply(matrix.columns(own.place.clone()), generator.view())
            };
            let by_rate = of(&damping, &own.once);
            let [by_turn, by_turns] = [&own.once, &own.twice].map(|own| of(&mass, own));
            for (column, j) in own.place.clone().enumerate() {
                let own = stiffness.col_mut(j).iter_mut().zip(by_rate.col(column));
                for ((own, rate), turns) in own.zip(by_turns.col(column)) {
                    *own += speed * speed * turns - speed * rate;
                }
                let own = damping.col_mut(j).iter_mut().zip(by_turn.col(column));
                own.for_each(|(own, turn)| *own -= 2.0 * speed * turn);
            }
        }
        [mass, damping, stiffness]
    }
}

/// y += f A x.
fn add(y: &mut [f64], factor: f64, matrix: &Matrix, x: &[f64]) {
    y.iter_mut().zip(matrix.apply(x)).for_each(|(y, own)| *y += factor * own);
}

impl Turned {
    /// e^{αS} of coordinates, in their places.
    fn turn_by(&self, angle: f64, own: &mut [f64]) {
        let (sin, cos) = angle.sin_cos();
        let [once, twice] = [&self.once, &self.twice].map(|matrix| matrix.apply(own));
        for (own, (once, twice)) in own.iter_mut().zip(once.iter().zip(&twice)) {
            *own += sin * once + (1.0 - cos) * twice;
        }
    }
}

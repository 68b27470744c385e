//! What is applied to a machine beside its own: unbalance at points of a body, and stiffness across.

use num_complex::Complex64;

use super::linearised::{Linearised, Standstill};
use super::modes::Mode;
use super::response::{Point, Vibration};
use super::round::LinearMachine;
use crate::error::Error;

/// Unbalance in the plane of a point of a body that turns.
#[derive(Debug, Clone, Copy)]
pub struct AppliedUnbalance<'a> {
    /// The point.
    pub point: &'a Point,
    /// Mass times eccentricity (kg·m).
    pub moment: f64,
    /// Its angle from x of the body, in the sense of its rotation if the body turns from x to y (rad).
    pub angle: f64,
}

impl LinearMachine {
    /// How points move by unbalance that a body has beside its own, which is left out: Re(w e^{iΩt}), the phase counted from the
    /// angle θ = 0 of the body.
    ///
    /// # Errors
    /// A matrix that is singular: a critical speed without damping.
    ///
    /// # Panics
    /// If the equations are not constant in space.
    pub fn response_to(
        &self,
        (at, equations): (&Standstill, &Linearised),
        body: usize,
        unbalance: &[AppliedUnbalance],
        points: &[Point],
    ) -> Result<Vec<Vibration>, Error> {
        assert!(equations.stands_in_space(), "the equations are constant in space");
        let speed = at.speeds[body];
        let mut force = vec![Complex64::ZERO; equations.mass.rows];
        for own in unbalance {
            // (cos, sin)(Ωt + φ) is Re((1, −i) e^{iφ} e^{iΩt}).
            let along = Complex64::from_polar(own.moment * speed * speed, own.angle);
            let parts = [along, -Complex64::i() * along];
            for (row, part) in self.rows(at, own.point).iter().zip(parts) {
                force.iter_mut().zip(row).for_each(|(sum, own)| *sum += part * own);
            }
        }
        let moved = equations.moved_by(speed, &force)?;
        Ok(points.iter().map(|point| self.vibration(at, point, &moved)).collect())
    }

    /// How a point moves in a mode, in the measure of its shape.
    pub fn motion_in(&self, at: &Standstill, point: &Point, mode: &Mode) -> Vibration {
        self.vibration(at, point, &mode.shape)
    }

    pub(super) fn vibration(
        &self,
        at: &Standstill,
        point: &Point,
        moved: &[Complex64],
    ) -> Vibration {
        let amplitudes = self
            .rows(at, point)
            .map(|row| row.iter().zip(moved).map(|(row, own)| row * own).sum::<Complex64>());
        Vibration { amplitudes }
    }

    /// The equations with stiffness across at points of a body that turns: the force −Q y along x and Q x along y (N/m), or the
    /// other way round if the body turns from y to x, so that Q > 0 drives its forward whirl.
    pub fn with_stiffness_across(
        &self,
        (at, equations): (&Standstill, &Linearised),
        body: usize,
        across: &[(&Point, f64)],
    ) -> Linearised {
        let mut own = equations.clone();
        let sense = if at.speeds[body] < 0.0 { -1.0 } else { 1.0 };
        for (point, value) in across {
            let [x, y] = self.rows(at, point);
            for i in 0..x.len() {
                for j in 0..x.len() {
                    own.stiffness[(i, j)] += sense * value * (x[i] * y[j] - y[i] * x[j]);
                }
            }
        }
        own
    }
}

//! A machine with its modes at the speeds of a range, on all processors.

use super::beside::beside;
use super::linearised::Standstill;
use super::modes::Modes;
use super::range::Range;
use super::round::LinearMachine;
use super::slow::Slow;
use super::stood::Stood;
use crate::error::Error;
use crate::linalg::{Matrix, Periodic};

/// Coordinates up to which equations that vary are solved in no time.
const FEW: usize = 24;
/// Speeds that follow each other, each state found from the one before.
const TOGETHER: usize = 8;

/// Share of |λ| by which a motion that is locked to the rotation may be off the frequency that it is locked to.
pub(super) const LOCKED: f64 = 1e-8;

/// A machine at a speed.
pub(super) struct Point {
    pub(super) speed: f64,
    pub(super) mass: Matrix,
    pub(super) at: Standstill,
    pub(super) modes: Modes,
    /// Whether a body that turns is not round.
    pub(super) is_uneven: bool,
    /// The step of the harmonics that its angle makes in the equations, where they vary.
    pub(super) harmonics: Option<i32>,
    /// Whether another one takes a second or so, as its equations vary and have many coordinates.
    pub(super) is_costly: bool,
}

/// What is found at the speeds of a range.
pub(super) struct Along {
    pub(super) points: Vec<Point>,
    /// Speeds at which the machine does not stand, and why.
    pub(super) lost: Vec<(f64, Error)>,
    /// The slow motions in which modes were looked for, if the machine is large.
    pub(super) slow: Option<Slow>,
}

impl LinearMachine {
    /// The machine at a speed, from a state nearby if there is one.
    ///
    /// # Errors
    /// It does not stand there; it was asked to end; values that are not finite.
    pub(super) fn point(
        &self,
        range: &Range,
        slow: Option<&Slow>,
        speed: f64,
        near: Option<&Standstill>,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Point, Error> {
        let Stood { at, equations, .. } = self.stood(range, speed, near)?;
        let basis = slow.map(|own| own.at(speed));
        let modes = self.modes_in(&equations, basis, range.looked_for(), goes_on)?;
        let is_uneven = equations.frame != 0.0 || equations.varying.is_some();
        let is_costly = equations.varying.is_some() && equations.mass.rows > FEW;
        let harmonics = equations.varying.as_ref().map(Periodic::step);
        Ok(Point { speed, mass: equations.mass, at, modes, is_uneven, harmonics, is_costly })
    }

    /// The machine at the speeds, up to the first that was not done; where it does not stand, why.
    pub(super) fn along(
        &self,
        range: &Range,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Along, Error> {
        let slow = Slow::new(self, range, goes_on)?;
        let work = |speeds: &[f64]| -> Result<Vec<(f64, Result<Point, Error>)>, Error> {
            let mut own: Vec<(f64, Result<Point, Error>)> = Vec::with_capacity(speeds.len());
            for &speed in speeds.iter().take_while(|_| goes_on()) {
                let near = own.iter().rev().find_map(|(_, point)| point.as_ref().ok());
                let near = near.map(|own| &own.at);
                match self.point(range, slow.as_ref(), speed, near, goes_on) {
                    Err(Error::Interrupted) => break,
                    Err(error) if !error.is_of_balance() => return Err(error),
                    point => own.push((speed, point)),
                }
            }
            Ok(own)
        };
        // The same parts on any number of processors, so that the numbers are the same to the bit.
        let parts: Vec<&[f64]> = range.speeds.chunks(TOGETHER).collect();
        let (mut points, mut lost) = (Vec::with_capacity(range.speeds.len()), Vec::new());
        for (own, speeds) in
            beside(self.threads, &parts, &|speeds| work(speeds)).into_iter().zip(&parts)
        {
            let own = own?;
            let whole = own.len() == speeds.len();
            for (speed, point) in own {
                match point {
                    Ok(point) => points.push(point),
                    Err(error) => lost.push((speed, error)),
                }
            }
            if !whole {
                break;
            }
        }
        Ok(Along { points, lost, slow })
    }
}

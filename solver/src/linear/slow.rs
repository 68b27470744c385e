//! Slow motions of a large machine, in which its modes over speeds are looked for.
//!
//! In the span of the real and imaginary parts of the modes below 1.2 times the last that is asked for, at both ends of a piece
//! of the range, the modes between are those of all coordinates but for an error that is measured in its middle. Where it is
//! too large the piece is halved.

use num_complex::Complex64;

use super::beside::beside;
use super::linearised::Standstill;
use super::motions::{Motion, orthonormal};
use super::range::Range;
use super::round::LinearMachine;
use super::stood::Stood;
use crate::error::Error;
use crate::linalg::Matrix;

/// Fewer coordinates are all looked at.
const FEW: usize = 96;
/// So are machines at fewer speeds.
const SPEEDS: usize = 9;
/// Frequencies of the modes that are taken, of the last that is asked for, and the share of the largest below which what a
/// motion adds is left out: bases that are tried, small ones first.
const TRIED: [(f64, f64); 4] = [(1.0, 1e-8), (1.0, 1e-10), (1.2, 1e-10), (1.2, 1e-12)];
/// Share of |λ| by which a mode may differ in the middle.
const ALIKE: f64 = 1e-6;
/// Times that a piece is halved at most.
const HALVINGS: usize = 3;
/// Share of the coordinates beyond which nothing is won.
const MOST: f64 = 0.6;

/// Bases of slow motions by pieces of the range.
#[derive(Debug, Clone)]
pub(super) struct Slow {
    /// Up to which speed (rad/s) each serves, ascending.
    pieces: Vec<(f64, Matrix)>,
    /// The largest share of |λ| by which a mode was found to differ.
    pub(super) error: f64,
}

/// All motions at a speed.
struct Whole {
    stood: Stood,
    motions: Vec<Motion>,
    /// λ of those that are asked for.
    asked: Vec<Complex64>,
}

impl Whole {
    /// The largest share of |λ| by which a mode that is asked for differs in a basis.
    fn error_in(
        &self,
        machine: &LinearMachine,
        range: &Range,
        basis: &Matrix,
    ) -> Result<f64, Error> {
        let equations = &self.stood.equations;
        let found = machine.motions(equations, Some(basis), range.looked_for(), &|| true)?;
        let apart = |value: &Complex64| {
            let all = found.iter().map(|own| (own.value - value).norm());
            all.fold(f64::INFINITY, f64::min) / value.norm()
        };
        Ok(self.asked.iter().take(range.count).map(apart).fold(0.0, f64::max))
    }
}

impl Slow {
    /// Those of a machine over a range; none where all coordinates are looked at as fast.
    ///
    /// # Errors
    /// Values that are not finite.
    pub(super) fn new(
        machine: &LinearMachine,
        range: &Range,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Slow>, Error> {
        let is_round = machine.not_round().next().is_none();
        let size = machine.machine().active();
        if !is_round || size < FEW || range.speeds.len() < SPEEDS {
            return Ok(None);
        }
        let search = |forward: bool| -> Result<Option<Whole>, Error> {
            let mut speeds: Vec<f64> = range.speeds.clone();
            if !forward {
                speeds.reverse();
            }
            for speed in speeds.into_iter().take_while(|_| goes_on()) {
                match whole(machine, range, speed, None) {
                    Err(error) if !error.is_of_balance() => return Err(error),
                    Err(_) => {}
                    Ok(own) => return Ok(Some(own)),
                }
            }
            Ok(None)
        };
        let mut ends =
            beside(machine.threads, &[true, false], &|forward| search(*forward)).into_iter();
        let (Some(a), Some(b)) = (ends.next().expect("two")?, ends.next().expect("two")?) else {
            return Ok(None);
        };
        if a.stood.speed >= b.stood.speed {
            return Ok(None);
        }
        let mut slow = Slow { pieces: Vec::new(), error: 0.0 };
        let is_enough = slow.add(machine, range, [&a, &b], HALVINGS)?;
        if let Some(last) = slow.pieces.last_mut() {
            last.0 = f64::INFINITY;
        }
        Ok(is_enough.then_some(slow))
    }

    /// The basis at a speed.
    pub(super) fn at(&self, speed: f64) -> &Matrix {
        let place = self.pieces.partition_point(|(last, _)| *last < speed);
        &self.pieces[place.min(self.pieces.len() - 1)].1
    }

    /// How many columns the largest basis has.
    pub(super) fn columns(&self) -> usize {
        self.pieces.iter().map(|own| own.1.cols).max().unwrap_or(0)
    }

    /// Adds a piece, or two halves of it. Whether it is worth it.
    fn add(
        &mut self,
        machine: &LinearMachine,
        range: &Range,
        [a, b]: [&Whole; 2],
        halvings: usize,
    ) -> Result<bool, Error> {
        let speed = 0.5 * (a.stood.speed + b.stood.speed);
        let middle = match whole(machine, range, speed, Some(&a.stood.at)) {
            Ok(own) => own,
            Err(error) if error.is_of_balance() => return Ok(false),
            Err(error) => return Err(error),
        };
        for tried in TRIED {
            let basis = spanned(range, [a, b], tried)?;
            if basis.cols as f64 > MOST * basis.rows as f64 {
                break;
            }
            let error = middle.error_in(machine, range, &basis)?;
            if error <= ALIKE {
                self.error = self.error.max(error);
                self.pieces.push((b.stood.speed, basis));
                return Ok(true);
            }
        }
        Ok(halvings > 0
            && self.add(machine, range, [a, &middle], halvings - 1)?
            && self.add(machine, range, [&middle, b], halvings - 1)?)
    }
}

/// The machine at a speed, with all motions.
fn whole(
    machine: &LinearMachine,
    range: &Range,
    speed: f64,
    near: Option<&Standstill>,
) -> Result<Whole, Error> {
    let stood = machine.stood(range, speed, near)?;
    let count = range.looked_for();
    let motions = machine.motions(&stood.equations, None, count, &|| true)?;
    let modes = machine.modes_of(&stood.equations, motions.clone(), count)?;
    let asked = modes.oscillating.iter().map(|own| own.value).collect();
    Ok(Whole { stood, motions, asked })
}

/// Real and imaginary parts of the slow motions at both ends, and of those that grow.
fn spanned(range: &Range, ends: [&Whole; 2], (reach, share): (f64, f64)) -> Result<Matrix, Error> {
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let last = range.looked_for().saturating_sub(1);
    let fastest = |own: &Whole| {
        let place = last.min(own.asked.len().saturating_sub(1));
        own.asked.get(place).map_or(0.0, |own| own.im)
    };
    let reach = reach * ends.iter().map(|own| fastest(own)).fold(0.0, f64::max);
    for own in ends.iter().flat_map(|end| &end.motions) {
        if own.value.norm() <= reach || own.value.re > 0.0 {
            columns.push(own.shape.iter().map(|own| own.re).collect());
            if own.value.im != 0.0 {
                columns.push(own.shape.iter().map(|own| own.im).collect());
            }
        }
    }
    orthonormal(&columns, &ends[0].stood.equations.mass, share)
}

//! Motions of equations that vary with an angle.
//!
//! Few coordinates: all motions at once, with as many harmonics as it takes for them to stand. Many: first in the slow motions
//! of the means and what harmonics make of them, with as few harmonics as that many coordinates allow, then each by itself in
//! all coordinates with as many harmonics as it takes. Of harmonics that are cut off there are copies that are not quite alike;
//! in the end they come to the same, and every motion is listed once.

use num_complex::Complex64;

use super::linearised::Linearised;
use super::motions::{Motion, largest, orthonormal, spanning};
use super::round::LinearMachine;
use super::shapes::apply;
use crate::error::Error;
use crate::linalg::{Lu, Matrix, Periodic, PeriodicPair, dot, quadratic_eigen};

/// Harmonics on both sides, in steps of the equations, with which a machine that varies is looked at in the end.
const HARMONICS: i32 = 8;
/// Share of a motion from which on what a harmonic makes of it is looked at as well.
const ANSWER: f64 = 3e-3;
/// Share of |λ| by which slow motions may still change with one more.
const STANDS: f64 = 1e-9;
/// And of the fastest motion, as eigenvalues are not more exact.
const ROUNDING: f64 = 1e-13;
/// Share of |λ| within which two motions are one.
const SAME: f64 = 1e-7;
/// Coordinates from which on a machine that varies is looked at in slow modes of its means.
const MANY: usize = 24;
/// How much faster these are than the motions that are asked for.
const FASTER: f64 = 1.5;
/// Im λ over |Re λ| of motions that are listed, at least.
const SEEN: f64 = 0.3;
/// Motions that are looked for, at least.
const FEW: usize = 8;
/// Unknowns of all harmonics together that are looked at at once.
const LARGE: usize = 350;
/// What adds less than this share to a basis is in it.
const INSIDE: f64 = 1e-12;

impl LinearMachine {
    /// Those of equations that vary with an angle; of many coordinates the slowest `count`. `goes_on` is asked between them.
    ///
    /// # Errors
    /// It was asked to end; values that are not finite.
    pub(super) fn varying_motions(
        &self,
        equations: &Linearised,
        periodic: &Periodic,
        count: usize,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Vec<Motion>, Error> {
        let asked = || if goes_on() { Ok(()) } else { Err(Error::Interrupted) };
        let mass = &equations.mass;
        if mass.rows <= MANY {
            return all_motions(periodic, count, &asked);
        }
        // Few motions that are asked for make too poor a basis.
        let count = count.max(FEW);
        let basis = self.slow(equations, periodic, count)?;
        asked()?;
        let step = f64::from(periodic.step()) * periodic.speed;
        let mut all: Vec<Motion> = Vec::with_capacity(count);
        for pair in roughly(&periodic.in_basis(&basis))? {
            if all.len() >= count && pair.value.re <= 0.0 {
                continue;
            }
            let parts = pair.parts.iter().map(|(k, z)| (*k, apply(&basis, z))).collect();
            let near = PeriodicPair { value: pair.value, parts };
            let own = periodic.refined(&near, goes_on)?;
            asked()?;
            let Some(own) = own else { continue };
            let (motion, _) = seen(&own, periodic.speed, mass);
            if all.iter().all(|other| !is_same(other.value, motion.value, step)) {
                all.push(motion);
            }
        }
        Ok(all)
    }

    /// Slow motions of the means, with what the harmonics make of them.
    fn slow(
        &self,
        equations: &Linearised,
        periodic: &Periodic,
        count: usize,
    ) -> Result<Matrix, Error> {
        let Linearised { mass, damping, stiffness, .. } = equations;
        let (mut pairs, _) = quadratic_eigen(mass, damping, stiffness)?;
        pairs.sort_by(|a, b| a.value.norm().total_cmp(&b.value.norm()));
        let moving = pairs.iter().filter(|own| own.value.im > 0.0);
        let last = moving.take(count).last().map_or(0.0, |own| own.value.im);
        let reach = FASTER * (last + periodic.speed.abs());
        let slow = pairs.iter().filter(|own| own.value.norm() <= reach);
        let columns: Vec<Vec<f64>> = slow
            .flat_map(|pair| {
                let re = pair.vector.iter().map(|own| own.re).collect();
                let im = pair.vector.iter().map(|own| own.im).collect();
                [re, im]
            })
            .collect();
        let slow = orthonormal(&columns, mass, INSIDE)?;
        let mut lu = Lu::new(mass.rows);
        lu.factor(&stiffness.data)?;
        let mut answers: Vec<Vec<f64>> = Vec::new();
        for part in periodic.harmonics.iter().flat_map(|own| &own.parts[2]) {
            for place in 0..slow.cols {
                let mut own = part.apply(slow.col(place));
                lu.solve_in_place(&mut own);
                // What is new of it.
                let moved = mass.apply(&own);
                for other in (0..slow.cols).map(|k| slow.col(k)) {
                    let part = dot(other, &moved);
                    own.iter_mut().zip(other).for_each(|(own, other)| *own -= part * other);
                }
                answers.push(own);
            }
        }
        let more = spanning(&answers, mass, |_, value| value > ANSWER * ANSWER)?;
        let data = [slow.data, more.data].concat();
        Ok(Matrix { rows: mass.rows, cols: slow.cols + more.cols, data })
    }
}

/// Motions with as many harmonics as unknowns allow: those that are not overdamped or grow, by their frequency.
fn roughly(periodic: &Periodic) -> Result<Vec<PeriodicPair>, Error> {
    let rows = periodic.means[0].rows;
    let mut harmonics = periodic.harmonics.last().map_or(1, |own| own.order / periodic.step());
    while rows * (2 * harmonics as usize + 3) <= LARGE && harmonics < HARMONICS {
        harmonics += 1;
    }
    let pairs = periodic.eigen(harmonics)?.into_iter().filter_map(|pair| {
        let (motion, is_conjugate) = seen(&pair, periodic.speed, &periodic.means[0]);
        let (grows, moves) = (motion.value.re > 0.0, motion.value.im > SEEN * -motion.value.re);
        (!is_conjugate && (grows || moves)).then_some((motion.value.im, pair))
    });
    let mut pairs: Vec<(f64, PeriodicPair)> = pairs.collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(pairs.into_iter().map(|own| own.1).collect())
}

/// All motions with as many harmonics as it takes for the slowest `count` to stand.
fn all_motions(
    periodic: &Periodic,
    count: usize,
    asked: &dyn Fn() -> Result<(), Error>,
) -> Result<Vec<Motion>, Error> {
    let found = |harmonics: i32| -> Result<Vec<Motion>, Error> {
        asked()?;
        let pairs = periodic.eigen(harmonics)?;
        let motions = pairs.iter().map(|own| seen(own, periodic.speed, &periodic.means[0]));
        let mut motions: Vec<Motion> =
            motions.filter(|(_, is_conjugate)| !is_conjugate).map(|own| own.0).collect();
        motions.sort_by(|a, b| a.value.im.total_cmp(&b.value.im));
        Ok(motions)
    };
    // Harmonics that the matrices have, at least.
    let last = periodic.harmonics.last().map_or(0, |own| own.order);
    let first = (last / periodic.step()).clamp(1, 2);
    let mut motions = found(first)?;
    for harmonics in first + 1..=HARMONICS {
        let next = found(harmonics)?;
        let fastest = next.iter().map(|own| own.value.norm()).fold(0.0, f64::max);
        let same = |own: &Motion| {
            let all = next.iter().map(|other| (other.value - own.value).norm());
            let bound = STANDS * own.value.norm() + ROUNDING * fastest;
            all.fold(f64::INFINITY, f64::min) <= bound
        };
        let stands = motions.len() == next.len() && motions.iter().take(count).all(same);
        motions = next;
        if stands {
            break;
        }
    }
    Ok(motions)
}

/// A motion as space sees it, and whether its conjugate was taken.
fn seen(own: &PeriodicPair, speed: f64, mass: &Matrix) -> (Motion, bool) {
    let parts = own.parts.iter().map(|(k, z)| (own.value.im + f64::from(*k) * speed, z.clone()));
    largest(own.value.re, mass, parts.collect())
}

/// Whether one is the other, or its conjugate, seen from another harmonic.
fn is_same(one: Complex64, other: Complex64, step: f64) -> bool {
    [other, other.conj()].into_iter().any(|other| {
        let apart = one - other;
        let shifted = apart.im - step * (apart.im / step).round();
        apart.re.hypot(shifted) <= SAME * one.norm()
    })
}

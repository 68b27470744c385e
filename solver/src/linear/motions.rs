//! Eigenvalues of small motions with their shapes, as they are seen from space.

use num_complex::Complex64;

use super::linearised::Linearised;
use super::round::LinearMachine;
use super::shapes::{apply, inner};
use crate::error::Error;
use crate::linalg::{
    Lu, Matrix, Periodic, PeriodicPair, congruence, dot, multiply, quadratic_eigen,
    symmetric_eigen, transpose_multiply,
};

/// Share of the largest part from which another one is named.
const NAMED: f64 = 0.05;
/// Parts that differ by less are the same.
const TIE: f64 = 1e-6;
/// Harmonics on both sides, in steps of the equations, with which a machine that varies is looked at in the end.
const HARMONICS: i32 = 8;
/// Size of the outermost harmonics of a motion below which no more are needed, as λ changes by its square.
const TAIL: f64 = 1e-3;
/// Unknowns beyond which they are not added.
const LARGE: usize = 700;
/// Share of a motion from which on what a harmonic makes of it is looked at as well.
const ANSWER: f64 = 3e-3;
/// Share of |λ| by which slow motions may still change with one more.
const STANDS: f64 = 1e-9;
/// And of the fastest motion, as eigenvalues are not more exact.
const ROUNDING: f64 = 1e-13;
/// Coordinates from which on a machine that varies is looked at in slow modes of its means.
const MANY: usize = 24;
/// How much faster these are than the motions that are asked for.
const FASTER: f64 = 1.5;
/// What adds less than this share to a basis is in it.
const INSIDE: f64 = 1e-12;

/// x e^{λt} as the largest part of a motion, with what else it does.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    /// λ: its growth, and the frequency with which it is seen from space (1/s).
    pub(super) value: Complex64,
    /// x over all coordinates, of any length.
    pub(super) shape: Vec<Complex64>,
    /// Frequencies (rad/s) with which it moves besides, with their shares of the largest part.
    pub(super) beside: Vec<(f64, f64)>,
}

impl LinearMachine {
    /// All motions that go round or to and fro with a frequency above zero, and those that do not; in a basis of slow ones, if
    /// there is one. `count`: how many of the slowest must stand where harmonics are cut off. Beside them the square below
    /// which a rate is rounding.
    ///
    /// # Errors
    /// A mass that is not positive definite, or values that are not finite.
    pub(super) fn motions(
        &self,
        equations: &Linearised,
        basis: Option<&Matrix>,
        count: usize,
    ) -> Result<Vec<Motion>, Error> {
        if let Some(periodic) = &equations.varying {
            return self.varying_motions(equations, periodic, basis, count);
        }
        let Linearised { mass, damping, stiffness, .. } = equations;
        let (pairs, largest) = match basis {
            None => quadratic_eigen(mass, damping, stiffness)?,
            Some(basis) => {
                let [mass, damping, stiffness] =
                    [mass, damping, stiffness].map(|own| congruence(own, basis));
                let (mut pairs, largest) =
                    quadratic_eigen(&mass.symmetric_part(), &damping, &stiffness)?;
                pairs.iter_mut().for_each(|own| own.vector = apply(basis, &own.vector));
                (pairs, largest)
            }
        };
        let least = mass.rows as f64 * f64::EPSILON * largest;
        // Slower ones are rounding of what nothing holds, where they are seen.
        let is_held = |own: &Motion| own.value.norm_sqr() > least;
        let seen = pairs.into_iter().map(|own| match equations.frame == 0.0 {
            true => Motion { value: own.value, shape: own.vector, beside: Vec::new() },
            false => self.seen_from_space(equations, own.value, &own.vector),
        });
        Ok(seen.filter(is_held).collect())
    }

    /// A motion of a frame that turns with Ω_f, as space sees it: its parts that circle forward have Im λ + Ω_f there, those that
    /// circle backward Im λ − Ω_f.
    fn seen_from_space(
        &self,
        equations: &Linearised,
        value: Complex64,
        shape: &[Complex64],
    ) -> Motion {
        let once = self.turned(equations.angles, shape);
        let twice = self.turned(equations.angles, &once);
        let sum = |sign: f64| -> Vec<Complex64> {
            twice.iter().zip(&once).map(|(twice, once)| 0.5 * (twice + sign * once)).collect()
        };
        let still = shape.iter().zip(&twice).map(|(own, twice)| own - twice).collect();
        let speed = equations.frame;
        let parts =
            [(value.im + speed, sum(1.0)), (value.im - speed, sum(-1.0)), (value.im, still)];
        largest(value.re, &equations.mass, parts.to_vec()).0
    }

    /// Those of equations that vary with an angle.
    fn varying_motions(
        &self,
        equations: &Linearised,
        periodic: &Periodic,
        basis: Option<&Matrix>,
        count: usize,
    ) -> Result<Vec<Motion>, Error> {
        let condensed = match basis {
            Some(basis) => Some(basis.clone()),
            None if equations.mass.rows > MANY => Some(self.slow(equations, periodic, count)?),
            None => None,
        };
        let own = condensed.as_ref().map(|basis| periodic.in_basis(basis));
        let own = own.as_ref().unwrap_or(periodic);
        let found = |harmonics: i32| -> Result<(Vec<Motion>, f64), Error> {
            let pairs = own.eigen(harmonics)?;
            let mass = &own.means[0];
            let mut motions: Vec<(Motion, f64)> = Vec::with_capacity(pairs.len());
            for PeriodicPair { value, parts } in pairs {
                let tail = tail(mass, &parts);
                let parts = parts
                    .into_iter()
                    .map(|(k, own)| (value.im + f64::from(k) * periodic.speed, own));
                let (motion, is_conjugate) = largest(value.re, mass, parts.collect());
                if !is_conjugate {
                    motions.push((motion, tail));
                }
            }
            motions.sort_by(|a, b| a.0.value.im.total_cmp(&b.0.value.im));
            let tail = motions.iter().take(count).map(|own| own.1).fold(0.0, f64::max);
            Ok((motions.into_iter().map(|own| own.0).collect(), tail))
        };
        // Harmonics that the matrices have, at least.
        let last = periodic.harmonics.last().map_or(0, |own| own.order);
        let first = (last / periodic.step()).clamp(1, 2);
        let (mut motions, mut tail) = found(first)?;
        let blocks = |harmonics: i32| 2 * own.means[0].rows * (2 * harmonics as usize + 1);
        for harmonics in first + 1..=HARMONICS {
            let is_small = own.means[0].rows <= MANY;
            if !is_small && (tail <= TAIL || blocks(harmonics) > LARGE) {
                break;
            }
            let (next, its_tail) = found(harmonics)?;
            let fastest = next.iter().map(|own| own.value.norm()).fold(0.0, f64::max);
            let same = |own: &Motion| {
                let all = next.iter().map(|other| (other.value - own.value).norm());
                let bound = STANDS * own.value.norm() + ROUNDING * fastest;
                all.fold(f64::INFINITY, f64::min) <= bound
            };
            let stands = motions.len() == next.len() && motions.iter().take(count).all(same);
            (motions, tail) = (next, its_tail);
            if stands {
                break;
            }
        }
        if let Some(basis) = &condensed {
            motions.iter_mut().for_each(|own| own.shape = apply(basis, &own.shape));
        }
        Ok(motions)
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
        let slow = orthonormal(&columns, mass)?;
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

/// How large the outermost harmonics of a motion are beside its largest part.
fn tail(mass: &Matrix, parts: &[(i32, Vec<Complex64>)]) -> f64 {
    let sizes: Vec<f64> =
        parts.iter().map(|(_, own)| inner(own, &apply(mass, own)).re.max(0.0).sqrt()).collect();
    let most = sizes.iter().copied().fold(0.0, f64::max);
    let ends = [sizes.first(), sizes.last()].into_iter().flatten();
    ends.fold(0.0, |sum: f64, own| sum.max(*own)) / most
}

/// The largest of the parts of a motion as what it is, and whether its conjugate was taken, as its frequency is below zero.
fn largest(growth: f64, mass: &Matrix, parts: Vec<(f64, Vec<Complex64>)>) -> (Motion, bool) {
    let sized = parts.into_iter().map(|(frequency, own)| {
        (inner(&own, &apply(mass, &own)).re.max(0.0).sqrt(), frequency, own)
    });
    let sized: Vec<(f64, f64, Vec<Complex64>)> = sized.collect();
    let most = sized.iter().map(|own| own.0).fold(0.0, f64::max);
    // Of two that are alike the one that needs no conjugate.
    let place = (0..sized.len())
        .filter(|&k| sized[k].0 >= (1.0 - TIE) * most)
        .max_by(|&a, &b| sized[a].1.total_cmp(&sized[b].1))
        .unwrap_or(0);
    let beside = sized.iter().enumerate().filter(|(k, own)| *k != place && own.0 > NAMED * most);
    let beside = beside.map(|(_, own)| (own.1.abs(), own.0 / most)).collect();
    let (_, frequency, mut shape) = sized.into_iter().nth(place).expect("one of them");
    let turned = frequency < 0.0;
    if turned {
        shape.iter_mut().for_each(|own| *own = own.conj());
    }
    (Motion { value: Complex64::new(growth, frequency.abs()), shape, beside }, turned)
}

/// Columns that span the same, orthonormal in M.
///
/// # Errors
/// Values that are not finite.
pub(super) fn orthonormal(columns: &[Vec<f64>], mass: &Matrix) -> Result<Matrix, Error> {
    // Of equal length first, so that small ones count as well.
    let scaled = columns.iter().filter_map(|own| {
        let size = own.iter().zip(mass.apply(own)).map(|(x, y)| x * y).sum::<f64>().sqrt();
        (size > 0.0).then(|| own.iter().map(move |x| x / size).collect::<Vec<f64>>())
    });
    let scaled: Vec<Vec<f64>> = scaled.collect();
    spanning(&scaled, mass, |largest, value| value > INSIDE * largest)
}

/// Columns orthonormal in M that span the others as far as they are large: `keeps` is asked with the largest and each square.
fn spanning(
    columns: &[Vec<f64>],
    mass: &Matrix,
    keeps: impl Fn(f64, f64) -> bool,
) -> Result<Matrix, Error> {
    let all = Matrix { rows: mass.rows, cols: columns.len(), data: columns.concat() };
    let gram = transpose_multiply(all.view(), multiply(mass.view(), all.view()).view());
    let eigen = symmetric_eigen(&gram.symmetric_part())?;
    let largest = eigen.values.last().copied().unwrap_or(0.0);
    let kept: Vec<usize> = (0..all.cols).filter(|&k| keeps(largest, eigen.values[k])).collect();
    let weights = Matrix::from_fn(all.cols, kept.len(), |i, j| {
        eigen.vectors[(i, kept[j])] / eigen.values[kept[j]].sqrt()
    });
    Ok(multiply(all.view(), weights.view()))
}

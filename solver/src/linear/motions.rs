//! Eigenvalues of small motions with their shapes, as they are seen from space.

use num_complex::Complex64;

use super::linearised::Linearised;
use super::own_frequency;
use super::round::LinearMachine;
use super::shapes::{apply, inner};
use crate::error::Error;
use crate::linalg::{
    Matrix, QuadraticPair, congruence, generalised_symmetric_eigen, multiply, quadratic_eigen_with,
    symmetric_eigen, transpose_multiply,
};

/// Motions with a larger damping ratio are not listed: those that creep in the frame of a body that turns are seen from space
/// at its speed.
const MOST_DAMPED: f64 = 0.9;
/// Share of |λ| below which Re λ is rounding.
const NEUTRAL: f64 = 1e-8;

/// Share of |λ| below which Im λ is rounding of a real one.
const REAL: f64 = 1e-7;
/// Share of the largest part from which another one is more than rounding.
const PART: f64 = 1e-9;
/// Share of Im λ by which motions of one λ may differ in it.
const ALIKE: f64 = 1e-6;
/// Parts that differ by less are the same.
const TIE: f64 = 1e-6;

/// x e^{λt} as the largest part of a motion, with what else it does.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    /// λ: its growth, and the frequency with which it is seen from space (1/s).
    pub(super) value: Complex64,
    /// x over all coordinates, of any length; empty, where it was looked for in a basis, is not listed and does not grow.
    pub(super) shape: Vec<Complex64>,
    /// Frequencies (rad/s) with which it moves besides, with their shares of the largest part.
    pub(super) beside: Vec<(f64, f64)>,
}

impl LinearMachine {
    /// All motions that go round or to and fro with a frequency above zero, and those that do not; in a basis of slow ones, if
    /// there is one. `count`: how many of the slowest must stand where harmonics are cut off. Those that nothing holds are left
    /// out. `goes_on` is asked where they are costly, as of equations that vary.
    ///
    /// # Errors
    /// It was asked to end; a mass that is not positive definite, or values that are not finite.
    pub(super) fn motions(
        &self,
        equations: &Linearised,
        basis: Option<&Matrix>,
        count: usize,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Vec<Motion>, Error> {
        let Linearised { mass, damping, stiffness, remembered, .. } = equations;
        let is_held = |own: &Motion, largest: f64| {
            own.value.norm_sqr() > self.unheld_below(mass.rows, largest)
        };
        if let Some(periodic) = &equations.varying {
            let mut all = self.varying_motions(equations, periodic, count, goes_on)?;
            let squares = generalised_symmetric_eigen(&stiffness.symmetric_part(), mass)?.values;
            let largest = squares.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            all.retain(|own| is_held(own, largest));
            return Ok(all);
        }
        let (pairs, largest) = match basis {
            _ if !equations.dependent.is_empty() => {
                let least = |largest| self.unheld_below(mass.rows, largest);
                let (mut pairs, largest) = own_frequency::motions(equations, basis, &least, count)?;
                if let Some(basis) = basis {
                    pairs.iter_mut().for_each(|own| own.vector = apply(basis, &own.vector));
                }
                (pairs, largest)
            }
            None => quadratic_eigen_with(mass, damping, stiffness, remembered.as_ref())?,
            Some(basis) => {
                let [mass, damping, stiffness] =
                    [mass, damping, stiffness].map(|own| congruence(own, basis));
                let remembered = remembered.as_ref().map(|own| own.in_basis(basis));
                let (mut pairs, largest) = quadratic_eigen_with(
                    &mass.symmetric_part(),
                    &damping,
                    &stiffness,
                    remembered.as_ref(),
                )?;
                let last = last_listed(&pairs, count);
                for own in &mut pairs {
                    // Shapes of motions that neither are listed nor grow are not looked at.
                    own.vector = match own.value.im <= last || growth(own.value) > 0.0 {
                        true => apply(basis, &own.vector),
                        false => Vec::new(),
                    };
                }
                (pairs, largest)
            }
        };
        let seen = pairs.into_iter().map(|own| match equations.frame == 0.0 {
            true => Motion { value: own.value, shape: own.vector, beside: Vec::new() },
            false => self.seen_from_space(equations, own.value, &own.vector),
        });
        // Slower ones are rounding of what nothing holds, where they are seen.
        Ok(seen.filter(|own| is_held(own, largest)).collect())
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
}

/// Re λ less what may be rounding of it (1/s).
pub(super) fn growth(value: Complex64) -> f64 {
    value.re - NEUTRAL * value.norm()
}

/// Whether a motion is listed.
pub(super) fn is_listed(value: Complex64) -> bool {
    value.im > REAL * value.norm() && -value.re < MOST_DAMPED * value.norm()
}

/// Im λ up to which motions are among the `count` slowest that are listed, or equal one of these.
fn last_listed(pairs: &[QuadraticPair], count: usize) -> f64 {
    let listed = pairs.iter().map(|own| own.value).filter(|own| is_listed(*own));
    let mut all: Vec<f64> = listed.map(|own| own.im).collect();
    all.sort_by(f64::total_cmp);
    let last = all.get(count.saturating_sub(1)).or(all.last()).copied();
    last.map_or(0.0, |own| own * (1.0 + ALIKE))
}

/// The largest of the parts of a motion as what it is, and whether its conjugate was taken, as its frequency is below zero.
pub(super) fn largest(
    growth: f64,
    mass: &Matrix,
    parts: Vec<(f64, Vec<Complex64>)>,
) -> (Motion, bool) {
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
    let beside = sized.iter().enumerate().filter(|(k, own)| *k != place && own.0 > PART * most);
    let beside = beside.map(|(_, own)| (own.1.abs(), own.0 / most)).collect();
    let (_, frequency, mut shape) = sized.into_iter().nth(place).expect("one of them");
    let turned = frequency < 0.0;
    if turned {
        shape.iter_mut().for_each(|own| *own = own.conj());
    }
    (Motion { value: Complex64::new(growth, frequency.abs()), shape, beside }, turned)
}

/// Columns that span the same, orthonormal in M; what adds less than a share of the largest to them is in them.
///
/// # Errors
/// Values that are not finite.
pub(super) fn orthonormal(
    columns: &[Vec<f64>],
    mass: &Matrix,
    least: f64,
) -> Result<Matrix, Error> {
    // Of equal length first, so that small ones count as well.
    let scaled = columns.iter().filter_map(|own| {
        let size = own.iter().zip(mass.apply(own)).map(|(x, y)| x * y).sum::<f64>().sqrt();
        (size > 0.0).then(|| own.iter().map(move |x| x / size).collect::<Vec<f64>>())
    });
    let scaled: Vec<Vec<f64>> = scaled.collect();
    spanning(&scaled, mass, |largest, value| value > least * largest)
}

/// Columns orthonormal in M that span the others as far as they are large: `keeps` is asked with the largest and each square.
pub(super) fn spanning(
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

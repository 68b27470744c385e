//! Modes of equations with coefficients over the frequency: (λ²M + λC(ν) + K(ν)) x = 0 with ν = |Im λ|.
//!
//! With the coefficients held at a frequency ν there are n pairs of eigenvalues. In the order of |Im λ|, those that do not
//! oscillate first, the m-th is a continuous function f_m(ν), whatever branches cross. Every f_m(ν) = ν is a mode, and each mode
//! is one: a table ends, so that f_m − ν, not negative at ν = 0, is negative in the end. The rows of the tables are
//! the ends of intervals in which the sign of f_m − ν is looked at; where it changes, the root is found by secants that stay
//! between the ends. So no mode is lost or found twice, and none depends on a first guess.

use super::dependent::Dependent;
use super::linearised::Linearised;
use crate::error::Error;
use crate::linalg::{Matrix, QuadraticPair, congruence, quadratic_eigen};

/// Share of ν by which |Im λ| may differ from it.
const FOUND: f64 = 1e-11;
/// Share by which two modes are of one frequency, and taken with the same coefficients.
const TOGETHER: f64 = 1e-9;
/// Evaluations of one mode at most: halves alone would do by then.
const TRIES: usize = 90;
/// Damping ratio beyond which a motion is not looked for at its own frequency: it is not listed.
const OVERDAMPED: f64 = 0.97;
/// That of those that are listed.
const LISTED: f64 = 0.9;
/// Share of |λ| up to which growth is rounding.
const NEUTRAL: f64 = 1e-8;

/// The equations, in all coordinates or in a basis.
struct Problem {
    mass: Matrix,
    damping: Matrix,
    stiffness: Matrix,
    joints: Vec<Dependent>,
}

/// All motions with the coefficients at one frequency.
struct Held {
    frequency: f64,
    /// Those that do not oscillate.
    real: Vec<QuadraticPair>,
    /// The others, by their frequency.
    oscillating: Vec<QuadraticPair>,
    /// The largest ω² of the symmetric part of K.
    largest: f64,
}

impl Held {
    /// How many pairs of motions come before those that oscillate.
    fn first(&self) -> usize {
        self.real.len() / 2
    }

    fn count(&self) -> usize {
        self.first() + self.oscillating.len()
    }

    fn pair(&self, place: usize) -> Option<&QuadraticPair> {
        self.oscillating.get(place.checked_sub(self.first())?)
    }

    /// f_m − ν.
    fn off(&self, place: usize) -> f64 {
        self.pair(place).map_or(0.0, |own| own.value.im) - self.frequency
    }

    fn is_overdamped(&self, place: usize) -> bool {
        self.pair(place).is_none_or(|own| -own.value.re > OVERDAMPED * own.value.norm())
    }
}

impl Problem {
    fn new(equations: &Linearised, basis: Option<&Matrix>) -> Problem {
        let Linearised { mass, damping, stiffness, dependent, .. } = equations;
        let Some(basis) = basis else {
            let [mass, damping, stiffness] = [mass, damping, stiffness].map(Matrix::clone);
            return Problem { mass, damping, stiffness, joints: dependent.clone() };
        };
        let [mass, damping, stiffness] =
            [mass, damping, stiffness].map(|own| congruence(own, basis));
        let joints = dependent.iter().map(|own| Dependent {
            rows: own.rows.each_ref().map(|row| basis.apply_transpose(row)),
            ..own.clone()
        });
        Problem { mass: mass.symmetric_part(), damping, stiffness, joints: joints.collect() }
    }

    fn held(&self, frequency: f64) -> Result<Held, Error> {
        let (mut damping, mut stiffness) = (self.damping.clone(), self.stiffness.clone());
        for joint in &self.joints {
            joint.add(frequency, &mut damping, &mut stiffness);
        }
        let (pairs, largest) = quadratic_eigen(&self.mass, &damping, &stiffness)?;
        let (mut oscillating, real): (Vec<_>, Vec<_>) =
            pairs.into_iter().partition(|own| own.value.im > 0.0);
        oscillating.sort_by(|a, b| a.value.im.total_cmp(&b.value.im));
        Ok(Held { frequency, real, oscillating, largest })
    }

    /// Frequencies between which coefficients are one piece of their curves, from zero on.
    fn ends(&self) -> Vec<f64> {
        let rows = self.joints.iter().flat_map(|own| own.over.frequencies());
        let mut ends: Vec<f64> = std::iter::once(0.0).chain(rows.copied()).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        ends
    }
}

/// All motions: the slowest `count` that are listed, and those that grow, each with the coefficients at its own frequency;
/// slower ones than any row and faster ones than all rows, too. The rest have those of the last row that was looked at. Beside
/// them the largest ω² of K.
pub(super) fn motions(
    equations: &Linearised,
    basis: Option<&Matrix>,
    count: usize,
) -> Result<(Vec<QuadraticPair>, f64), Error> {
    let problem = Problem::new(equations, basis);
    let ends = problem.ends();
    let mut before = problem.held(ends[0])?;
    let least = equations.mass.rows as f64 * f64::EPSILON * before.largest;
    let is_seen = |own: &QuadraticPair| {
        own.value.norm_sqr() > least && -own.value.re < LISTED * own.value.norm()
    };
    let mut found = before.real.clone();
    let mut listed = 0;
    for &end in &ends[1..] {
        let after = problem.held(end)?;
        // Those that grow and are still faster are looked for as well.
        let grows = |own: &QuadraticPair| {
            own.value.im > before.frequency && own.value.re > NEUTRAL * own.value.norm()
        };
        if listed >= count && !before.oscillating.iter().any(grows) {
            break;
        }
        let mut last: Option<Held> = None;
        for place in 0..before.count().min(after.count()) {
            if (before.off(place) > 0.0) == (after.off(place) > 0.0) {
                continue;
            }
            let is_noise = [&before, &after]
                .iter()
                .all(|own| own.pair(place).is_none_or(|own| own.value.norm_sqr() <= least));
            let is_overdamped = [&before, &after].iter().all(|own| own.is_overdamped(place));
            if is_noise || is_overdamped {
                continue;
            }
            // Two of one frequency have the same coefficients, and shapes that are two.
            let again = last.take().filter(|own| own.off(place).abs() <= TOGETHER * own.frequency);
            let held = match again {
                Some(own) => own,
                None => root(&problem, place, [&before, &after])?,
            };
            if let Some(pair) = held.pair(place) {
                listed += usize::from(is_seen(pair));
                found.push(pair.clone());
            }
            last = Some(held);
        }
        before = after;
    }
    let end = before.frequency;
    found.extend(before.oscillating.into_iter().filter(|own| own.value.im > end));
    Ok((found, before.largest))
}

/// The equations held where f_m = ν, between two frequencies at which f_m − ν has different signs.
fn root(problem: &Problem, place: usize, ends: [&Held; 2]) -> Result<Held, Error> {
    let mut ends = ends.map(|own| (own.frequency, own.off(place)));
    // Of an end that stays the value is halved, so that it does not stay for ever.
    let mut stayed = None;
    let mut nearest: Option<(f64, Held)> = None;
    for k in 0..TRIES {
        let [(a, f), (b, g)] = ends;
        let width = b - a;
        let next = match k % 4 == 3 || f == g {
            true => a + 0.5 * width,
            false => (b - g * width / (g - f)).clamp(a, b),
        };
        let held = problem.held(next)?;
        let off = held.off(place);
        let is_nearest = nearest.as_ref().is_none_or(|own| off.abs() <= own.0);
        if is_nearest {
            nearest = Some((off.abs(), held));
        }
        if off.abs() <= FOUND * next || width <= FOUND * b {
            break;
        }
        let side = usize::from((off > 0.0) != (ends[0].1 > 0.0));
        ends[side] = (next, off);
        if stayed == Some(1 - side) {
            ends[1 - side].1 *= 0.5;
        }
        stayed = Some(1 - side);
    }
    Ok(nearest.expect("it was looked at once").1)
}

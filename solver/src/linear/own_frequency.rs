//! Modes of equations with coefficients over the frequency: (λ²M + λC(ν) + K(ν)) x = 0 with ν = |Im λ|.
//!
//! With the coefficients held at a frequency ν there are n pairs of eigenvalues. In the order of |Im λ|, those that do not
//! oscillate first, the m-th is a continuous function f_m(ν), whatever branches cross. Every f_m(ν) = ν is a mode, and each mode
//! is one: a table ends, so that f_m − ν, not negative at ν = 0, is negative in the end. The rows of the tables are
//! the ends of intervals in which the sign of f_m − ν is looked at; where it changes, the root is found by secants that stay
//! between the ends. So no mode is lost or found twice, and none depends on a first guess.

use num_complex::Complex64;

use super::dependent::Dependent;
use super::linearised::Linearised;
use super::shapes::{apply, inner};
use crate::bearing::Coefficients;
use crate::error::Error;
use crate::linalg::{Matrix, QuadraticPair, congruence, quadratic_eigen, solve_complex};

/// Share of ν by which |Im λ| may differ from it.
const FOUND: f64 = 1e-11;
/// Share by which two modes are of one frequency, and taken with the same coefficients.
const TOGETHER: f64 = 1e-9;
/// Evaluations of one mode at most: halves alone would do by then.
const TRIES: usize = 90;
/// The same by which inverse iteration counts as having met it, and |λ| by which two of it are one.
const MET: f64 = 1e-9;
const ONE: f64 = 1e-6;
/// Share of |λ| by which inverse iteration may still change it, and how often it is made.
const SETTLED: f64 = 1e-10;
const SETTLES: usize = 8;
/// Coordinates up to which all motions are found at every frequency that is tried.
const FEW: usize = 16;
/// Share of the largest coefficient by which a row may be off a straight line and be passed over.
const STRAIGHT: f64 = 0.05;
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

    /// The motion nearest to another one with the coefficients at a frequency, by inverse iteration: y = T(λ)⁻¹ T′(λ) x, λ less
    /// xᴴx/xᴴy. None where it does not settle to one that oscillates.
    fn refined(
        &self,
        frequency: f64,
        from: &QuadraticPair,
    ) -> Result<Option<QuadraticPair>, Error> {
        let (mut damping, mut stiffness) = (self.damping.clone(), self.stiffness.clone());
        for joint in &self.joints {
            joint.add(frequency, &mut damping, &mut stiffness);
        }
        let n = self.mass.rows;
        let QuadraticPair { mut value, vector: mut x } = from.clone();
        for _ in 0..SETTLES {
            let matrices = self.mass.data.iter().zip(&damping.data).zip(&stiffness.data);
            let matrix: Vec<Complex64> =
                matrices.map(|((m, c), k)| value * value * m + value * c + k).collect();
            let moved = apply(&self.mass, &x);
            let slope: Vec<Complex64> =
                apply(&damping, &x).iter().zip(&moved).map(|(c, m)| 2.0 * value * m + c).collect();
            // What is singular to the last digit is met.
            let Ok(y) = solve_complex(n, &matrix, &slope) else { break };
            let by = inner(&moved, &x) / inner(&moved, &y);
            if !by.is_finite() {
                return Ok(None);
            }
            let length = inner(&y, &apply(&self.mass, &y)).re.sqrt();
            x = y.into_iter().map(|own| own / length).collect();
            value -= by;
            if by.norm() <= SETTLED * value.norm() {
                return Ok((value.im > 0.0).then_some(QuadraticPair { value, vector: x }));
            }
        }
        Ok(None)
    }

    /// Frequencies of rows, from zero on, without those whose coefficients are nearly on straight lines between others.
    fn ends(&self) -> Vec<f64> {
        let rows = self.joints.iter().flat_map(|own| own.over.frequencies());
        let mut all: Vec<f64> = std::iter::once(0.0).chain(rows.copied()).collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        let values: Vec<Vec<Coefficients>> = (self.joints.iter())
            .map(|own| all.iter().map(|frequency| own.over.at(*frequency)).collect())
            .collect();
        let mut kept = vec![true; all.len()];
        let mut open = vec![(0, all.len() - 1)];
        while let Some((first, last)) = open.pop().filter(|own| own.0 < own.1) {
            kept[first + 1..last].fill(false);
            let off = |k: usize| {
                let share = (all[k] - all[first]) / (all[last] - all[first]);
                let of_joint = |own: &Vec<Coefficients>| off_line(own, (first, last), k, share);
                values.iter().map(of_joint).fold(0.0, f64::max)
            };
            let worst = (first + 1..last).max_by(|a, b| off(*a).total_cmp(&off(*b)));
            if let Some(worst) = worst.filter(|k| off(*k) > STRAIGHT) {
                kept[worst] = true;
                open.extend([(first, worst), (worst, last)]);
            }
        }
        all.into_iter().zip(kept).filter(|own| own.1).map(|own| own.0).collect()
    }
}

/// How far the coefficients of a row are off the straight line between two others, over the largest stiffness and damping.
fn off_line(rows: &[Coefficients], (a, b): (usize, usize), k: usize, share: f64) -> f64 {
    let off = |places: std::ops::Range<usize>| {
        let largest = rows.iter().flat_map(|own| &own[places.clone()]);
        let largest = largest.fold(f64::MIN_POSITIVE, |most: f64, own| most.max(own.abs()));
        let off = places.map(|place| {
            let line = rows[a][place] + share * (rows[b][place] - rows[a][place]);
            (rows[k][place] - line).abs()
        });
        off.fold(0.0, f64::max) / largest
    };
    off(0..4).max(off(4..8))
}

/// All motions: the slowest `count` that are listed, and those that grow, each with the coefficients at its own frequency;
/// slower ones than any row and faster ones than all rows, too. |λ|² up to `least` of the largest ω² is rounding. The rest have those of the last row that was looked at. Beside
/// them the largest ω² of K.
pub(super) fn motions(
    equations: &Linearised,
    basis: Option<&Matrix>,
    least: &dyn Fn(f64) -> f64,
    count: usize,
) -> Result<(Vec<QuadraticPair>, f64), Error> {
    let problem = Problem::new(equations, basis);
    let ends = problem.ends();
    let mut before = problem.held(ends[0])?;
    let least = least(before.largest);
    let is_seen = |own: &QuadraticPair| {
        own.value.norm_sqr() > least && -own.value.re < LISTED * own.value.norm()
    };
    let mut found = before.real.clone();
    let mut listed = 0;
    for &end in &ends[1..] {
        // Those that grow and are still faster are looked for as well.
        let grows = |own: &QuadraticPair| {
            own.value.im > before.frequency && own.value.re > NEUTRAL * own.value.norm()
        };
        if listed >= count && !before.oscillating.iter().any(grows) {
            break;
        }
        let after = problem.held(end)?;
        let mut places = Vec::new();
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
            places.push(place);
        }
        let own = match problem.mass.rows > FEW {
            true => all_beside(&problem, &places, [&before, &after])?,
            false => None,
        };
        let own = match own {
            Some(own) => own,
            None => all_roots(&problem, &places, [&before, &after])?,
        };
        listed += own.iter().filter(|own| is_seen(own)).count();
        found.extend(own);
        before = after;
    }
    let end = before.frequency;
    found.extend(before.oscillating.into_iter().filter(|own| own.value.im > end));
    Ok((found, before.largest))
}

/// The motions of places between two frequencies by inverse iteration; none where they are not as many and all different.
fn all_beside(
    problem: &Problem,
    places: &[usize],
    ends: [&Held; 2],
) -> Result<Option<Vec<QuadraticPair>>, Error> {
    let mut found: Vec<QuadraticPair> = Vec::with_capacity(places.len());
    for &place in places {
        let Some(pair) = beside(problem, place, ends)? else { return Ok(None) };
        let same = |own: &QuadraticPair| (own.value - pair.value).norm() <= ONE * pair.value.norm();
        if found.iter().any(same) {
            return Ok(None);
        }
        found.push(pair);
    }
    Ok(Some(found))
}

/// The same by all motions at every frequency that is tried.
fn all_roots(
    problem: &Problem,
    places: &[usize],
    ends: [&Held; 2],
) -> Result<Vec<QuadraticPair>, Error> {
    let mut last: Option<Held> = None;
    let mut found = Vec::with_capacity(places.len());
    for &place in places {
        // Two of one frequency have the same coefficients, and shapes that are two.
        let again = last.take().filter(|own| own.off(place).abs() <= TOGETHER * own.frequency);
        let held = match again {
            Some(own) => own,
            None => root(problem, place, ends)?,
        };
        found.extend(held.pair(place).cloned());
        last = Some(held);
    }
    Ok(found)
}

/// The equations held where f_m = ν, between two frequencies at which f_m − ν has different signs.
fn root(problem: &Problem, place: usize, ends: [&Held; 2]) -> Result<Held, Error> {
    let mut nearest: Option<(f64, Held)> = None;
    let offs = ends.map(|own| (own.frequency, own.off(place)));
    crossing(offs, &mut |frequency| {
        let held = problem.held(frequency)?;
        let off = held.off(place);
        if nearest.as_ref().is_none_or(|own| off.abs() <= own.0) {
            nearest = Some((off.abs(), held));
        }
        Ok(Some(off))
    })?;
    Ok(nearest.expect("it was looked at once").1)
}

/// The motion there by inverse iteration from that of the nearer end; none where it does not lead to one. It may be that of
/// another place, where branches cross.
fn beside(
    problem: &Problem,
    place: usize,
    ends: [&Held; 2],
) -> Result<Option<QuadraticPair>, Error> {
    let nearer = if ends[0].off(place).abs() < ends[1].off(place).abs() { 0 } else { 1 };
    let Some(from) = ends[nearer].pair(place) else { return Ok(None) };
    let mut pair = from.clone();
    let offs = ends.map(|own| (own.frequency, own.off(place)));
    let found = crossing(offs, &mut |frequency| {
        let Some(next) = problem.refined(frequency, &pair)? else { return Ok(None) };
        pair = next;
        Ok(Some(pair.value.im - frequency))
    })?;
    let inside = (ends[0].frequency..=ends[1].frequency).contains(&pair.value.im);
    let is_met = found.is_some_and(|own| own.abs() <= MET * pair.value.im);
    Ok((is_met && inside).then_some(pair))
}

/// Looks for the zero between two frequencies at which `of` has different signs, by secants that stay between them; what it was
/// in the end. None where `of` is none.
fn crossing(
    mut ends: [(f64, f64); 2],
    of: &mut dyn FnMut(f64) -> Result<Option<f64>, Error>,
) -> Result<Option<f64>, Error> {
    // Of an end that stays the value is halved, so that it does not stay for ever.
    let mut stayed = None;
    let mut last = None;
    for k in 0..TRIES {
        let [(a, f), (b, g)] = ends;
        let width = b - a;
        let next = match k % 4 == 3 || f == g {
            true => a + 0.5 * width,
            false => (b - g * width / (g - f)).clamp(a, b),
        };
        let Some(off) = of(next)? else { return Ok(None) };
        last = Some(off);
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
    Ok(last)
}

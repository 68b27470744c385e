//! Speeds at which something of the modes changes its sign.

use super::growing::Growing;
use super::modes::Mode;
use super::points::{LOCKED, Point};
use super::range::Range;
use super::round::LinearMachine;
use super::shapes::apply;
use super::slow::Slow;
use super::track::mac;
use crate::error::Error;

/// Share of a speed to which one is found, and one at which a whirl begins or ends to be locked to the rotation.
pub(super) const FOUND: f64 = 1e-9;
const EDGE: f64 = 1e-8;
/// Roots of a branch nearer to each other than this share are one.
const ONE: f64 = 1e-6;
/// Share of |λ| that may be left there.
const ROOT: f64 = 1e-6;
/// Share of |λ| from which Re λ does not go through zero where a motion is first seen to grow, and MAC from which on another one
/// is the same.
const APPEARS: f64 = 1e-3;
const ALIKE: f64 = 0.5;
/// Evaluations until then at most, and where each takes a second.
const TRIES: usize = 60;
const FEW_TRIES: usize = 12;

/// A value of a mode at a speed.
#[derive(Clone)]
struct End {
    speed: f64,
    value: f64,
    mode: Mode,
}

/// A value of the modes at a speed that is looked for.
pub(super) struct Root {
    pub(super) speed: f64,
    pub(super) mode: Mode,
    /// Whether it rises there.
    pub(super) rises: bool,
}

/// A speed at which a mode begins to grow, or ends to.
#[derive(Debug, Clone, PartialEq)]
pub struct Threshold {
    /// rad/s.
    pub speed: f64,
    /// The mode there; none of a motion that does not oscillate, or of one beyond those that are looked for.
    pub mode: Option<Mode>,
    /// Such a motion, as it is beside the threshold.
    pub other: Option<Growing>,
    /// Where what grows does so at once, as a cavity or a contact comes or goes: its mode just where it does not grow.
    pub before: Option<Mode>,
    /// Its branch, if it is one of those.
    pub branch: Option<usize>,
    /// Whether it grows beyond.
    pub grows: bool,
    /// Whether others grow on both sides.
    pub others: bool,
}

impl Threshold {
    /// Whether nothing changes its sign there: what grows is no longer told from a motion that nothing holds, as slow as it is.
    pub(super) fn is_of_sight(&self) -> bool {
        let appears = |own: &Mode| own.value.re > APPEARS * own.value.norm();
        self.before.is_none() && self.mode.as_ref().is_some_and(appears)
    }
}

/// Searches between speeds.
pub(super) struct Roots<'a> {
    pub(super) machine: &'a LinearMachine,
    pub(super) range: &'a Range,
    pub(super) slow: Option<&'a Slow>,
    pub(super) points: &'a [Point],
    /// Share of ζ of a mode to which a speed is found, where it may be wide: 0 to find all to [`FOUND`].
    pub(super) width: f64,
    /// Asked before every speed, and at one that takes long.
    pub(super) goes_on: &'a (dyn Fn() -> bool + Sync),
}

impl Roots<'_> {
    /// The machine at a speed near another one; none if the search was interrupted.
    pub(super) fn point(&self, speed: f64, near: &Point) -> Result<Option<Point>, Error> {
        if !(self.goes_on)() {
            return Ok(None);
        }
        match self.machine.point(self.range, self.slow, speed, Some(&near.at), &self.goes_on) {
            Err(Error::Interrupted) => Ok(None),
            own => own.map(Some),
        }
    }

    /// Speeds at which something of a branch changes its sign. Of a machine that is not round it may be zero over whole
    /// intervals: their ends. `exact`: the same without what keeps rounding from changing it, whose zero is found where it changes
    /// its sign, too.
    pub(super) fn of_branch(
        &self,
        places: &[Option<usize>],
        of: &dyn Fn(f64, &Mode) -> f64,
        exact: &dyn Fn(f64, &Mode) -> f64,
    ) -> Result<Vec<Root>, Error> {
        let mut found: Vec<Root> = Vec::new();
        for (pair, places) in self.points.windows(2).zip(places.windows(2)) {
            let (Some(a), Some(b)) = (places[0], places[1]) else { continue };
            let is_uneven = pair.iter().any(|own| own.is_uneven);
            let value = |speed: f64, mode: &Mode| {
                let own = of(speed, mode);
                let is_locked = is_uneven && own.abs() <= LOCKED * mode.value.norm();
                if is_locked { 0.0 } else { own }
            };
            let [a, b] = [(&pair[0], a), (&pair[1], b)].map(|(point, place)| {
                let mode = point.modes.oscillating[place].clone();
                End { speed: point.speed, value: value(point.speed, &mode), mode }
            });
            // Of a round machine a value of zero belongs to the step that it ends.
            if sign(a.value) == sign(b.value) || a.value == 0.0 && !is_uneven {
                continue;
            }
            let rises = a.value < b.value;
            let nearer =
                [&a, &b].map(|own| End { value: exact(own.speed, &own.mode), ..own.clone() });
            let changes = !is_uneven && nearer[0].value * nearer[1].value < 0.0;
            let before = found.len();
            if changes {
                self.between(&pair[0], nearer, exact, &mut found)?;
            } else {
                self.between(&pair[0], [a, b], &value, &mut found)?;
            }
            found[before..].iter_mut().for_each(|own| own.rises = rises);
        }
        found.dedup_by(|b, a| (b.speed - a.speed).abs() <= ONE * a.speed.abs());
        Ok(found)
    }

    /// Adds what is zero between two speeds (rad/s) with a mode at each, if it is found.
    pub(super) fn between_modes(
        &self,
        near: &Point,
        ends: [(f64, Mode); 2],
        of: &dyn Fn(f64, &Mode) -> f64,
        found: &mut Vec<Root>,
    ) -> Result<(), Error> {
        let ends = ends.map(|(speed, mode)| End { speed, value: of(speed, &mode), mode });
        self.between(near, ends, of, found)
    }

    /// Adds the roots between two ends with different signs: one, or two where it is zero between them.
    fn between(
        &self,
        near: &Point,
        [a, b]: [End; 2],
        of: &dyn Fn(f64, &Mode) -> f64,
        found: &mut Vec<Root>,
    ) -> Result<(), Error> {
        let (signs, rises) = ([sign(a.value), sign(b.value)], a.value < b.value);
        let [mut left, mut right] = [a, b];
        let share = if signs.contains(&0) { EDGE } else { FOUND };
        for k in 0..tries(near) {
            let is_met = signs[1] != 0 && right.value == 0.0;
            let share = share.max(self.width * right.mode.damping_ratio().abs());
            if is_met || (right.speed - left.speed).abs() <= share * right.speed.abs() {
                break;
            }
            let middle = 0.5 * (left.speed + right.speed);
            // Every third speed halves what is left, as values need not be straight; beside zeros they never are.
            let speed = match k % 3 == 2 || signs.contains(&0) {
                true => middle,
                false => {
                    right.speed
                        - right.value * (right.speed - left.speed) / (right.value - left.value)
                }
            };
            let nearest = if (speed - left.speed).abs() < (right.speed - speed).abs() {
                &left.mode
            } else {
                &right.mode
            };
            let Some((own, is_uneven)) = self.nearest(near, speed, nearest)? else { return Ok(()) };
            let next = End { speed, value: of(speed, &own), mode: own };
            if sign(next.value) == 0 && !signs.contains(&0) {
                if is_uneven {
                    self.between(near, [left, next.clone()], of, found)?;
                    return self.between(near, [next, right], of, found);
                }
                (left, right) = (next.clone(), next);
            } else if sign(next.value) == signs[1] {
                right = next;
            } else {
                left = next;
            }
        }
        // Where a mode ends between the speeds another one may have been followed.
        let end = if left.value.abs() < right.value.abs() { left } else { right };
        let rest = ROOT.max(self.width * end.mode.damping_ratio().abs());
        if end.value.abs() <= rest * end.mode.value.norm() {
            found.push(Root { speed: end.speed, mode: end.mode, rises });
        }
        Ok(())
    }

    /// The mode at a speed that is most like another one, and whether the machine is not round; none where there is no mode, or if
    /// the search was interrupted.
    pub(super) fn nearest(
        &self,
        near: &Point,
        speed: f64,
        like: &Mode,
    ) -> Result<Option<(Mode, bool)>, Error> {
        let Some(point) = self.point(speed, near)? else { return Ok(None) };
        let moved = apply(&point.mass, &like.shape);
        let apart = |own: &Mode| {
            let change = (own.value - like.value).norm() / like.value.norm();
            1.0 - mac(&moved, &own.shape) + change
        };
        let modes = point.modes.oscillating.into_iter();
        let mode = modes.min_by(|x, y| apart(x).total_cmp(&apart(y)));
        Ok(mode.map(|own| (own, point.is_uneven)))
    }

    /// Where the machine begins to be unstable between two points, or ends to, with the motion that grows if it oscillates; none
    /// if it is the same at both, or if the search was interrupted.
    pub(super) fn threshold(&self, [a, b]: [&Point; 2]) -> Result<Option<Threshold>, Error> {
        if a.modes.is_stable() == b.modes.is_stable() {
            return Ok(None);
        }
        let mut ends = [a.speed, b.speed];
        let stable_below = a.modes.is_stable();
        let growing = |point: &Point| {
            let modes = point.modes.oscillating.iter().filter(|own| own.grows());
            modes.max_by(|x, y| x.growth().total_cmp(&y.growth())).cloned()
        };
        let [quiet, loud] = if stable_below { [a, b] } else { [b, a] };
        let mut grown = loud.modes.growing.first().cloned();
        let mut mode = growing(loud);
        let (mut mass, mut quiet) = (quiet.mass.clone(), quiet.modes.oscillating.clone());
        for _ in 0..tries(a) {
            let speed = 0.5 * (ends[0] + ends[1]);
            if (ends[1] - ends[0]).abs() <= FOUND * speed.abs() {
                break;
            }
            let Some(point) = self.point(speed, a)? else { return Ok(None) };
            let is_stable = point.modes.is_stable();
            match is_stable {
                true => (mass, quiet) = (point.mass, point.modes.oscillating),
                false => {
                    mode = growing(&point);
                    grown = point.modes.growing.into_iter().next();
                }
            }
            ends[usize::from(is_stable != stable_below)] = speed;
        }
        let other = if mode.is_none() { grown } else { None };
        let before = mode.as_ref().filter(|own| own.value.re > APPEARS * own.value.norm());
        let before = before.and_then(|own| {
            let moved = apply(&mass, &own.shape);
            let alike = |other: &Mode| mac(&moved, &other.shape);
            quiet.into_iter().filter(|other| alike(other) > ALIKE).min_by(|a, b| {
                let apart = |other: &Mode| (other.value - own.value).norm();
                apart(a).total_cmp(&apart(b))
            })
        });
        let (speed, grows) = (ends[1], stable_below);
        Ok(Some(Threshold { speed, mode, other, before, branch: None, grows, others: false }))
    }
}

/// Evaluations of a search, at most.
pub(super) fn tries(near: &Point) -> usize {
    if near.is_costly { FEW_TRIES } else { TRIES }
}

fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

//! Parametric resonance: where a body that is not round makes two motions feed each other.
//!
//! Of a motion with the frequency ω such a body makes others with |nΩ − ω|. Where that is the frequency of another motion, or of
//! the same one, ω + ω′ = nΩ, the two feed each other: one of both decays less, or grows. If both are damped alike their
//! frequencies stay together over an interval of speeds, and what grows does so most in its middle; if not, they meet once, and
//! it grows most there. Such intervals may lie between two speeds of a range, several of them, with stable speeds between.

use super::beside::beside;
use super::golden::golden_step;
use super::meeting::{Meeting, Met, meetings};
use super::points::Point;
use super::roots::{FOUND, Roots, Threshold, tries};
use crate::error::Error;

/// Share of |λ| by which two motions must grow for their interval to be looked for: where they meet, λ is no sharper.
const SLOW: f64 = 1e-6;
/// Share of a speed within which two thresholds are one at which nothing changes.
const NOTHING: f64 = 1e-7;
/// Speeds at which something is looked for that is stable between two that are not, at most.
const BETWEEN: usize = 24;
/// Share of a speed to which the one where motions meet is found at most.
const MET: f64 = 1e-7;
/// Share of the difference of both rates of growth by which their frequencies may be apart where they meet, and share of the interval in
/// which they stay together to which its middle is found: what grows there does so no faster elsewhere but for 1e-3 of that.
const MIDDLE: f64 = 0.03;

impl Roots<'_> {
    /// Where a machine that is not round begins to be unstable or ends to.
    ///
    /// # Errors
    /// As [`super::LinearMachine::campbell`].
    pub(super) fn parametric(&self) -> Result<Vec<Threshold>, Error> {
        let steps: Vec<[&Point; 2]> =
            self.points.windows(2).map(|own| [&own[0], &own[1]]).collect();
        let all = beside(self.machine.threads, &steps, &|step| self.of_step(*step));
        let mut found = Vec::new();
        for own in all {
            found.extend(own?);
        }
        Ok(found)
    }

    /// Between two speeds of the range.
    fn of_step(&self, ends: [&Point; 2]) -> Result<Vec<Threshold>, Error> {
        // Where most grows first, then what is next to the ends of the intervals.
        let (mut peaks, mut edges) = (Vec::new(), Vec::new());
        for meeting in meetings(ends) {
            let (peak, beside) = self.growing(ends[0], &meeting)?;
            peaks.extend(peak);
            edges.extend(beside);
        }
        let by_speed = |a: &&Point, b: &&Point| a.speed.total_cmp(&b.speed);
        let mut tops: Vec<&Point> = ends.into_iter().chain(&peaks).collect();
        tops.sort_by(by_speed);
        let mut calm = Vec::new();
        for pair in tops.windows(2) {
            let inside = |own: &&Point| own.speed > pair[0].speed && own.speed < pair[1].speed;
            if edges.iter().filter(inside).all(|own| !own.modes.is_stable()) {
                calm.extend(self.stable_between([pair[0], pair[1]])?);
            }
        }
        let mut all: Vec<&Point> = tops.into_iter().chain(&edges).chain(&calm).collect();
        all.sort_by(by_speed);
        let mut found: Vec<Threshold> = Vec::new();
        for own in all.windows(2) {
            let Some(own) = self.threshold([own[0], own[1]])? else { continue };
            let near = |last: &Threshold| own.speed - last.speed <= NOTHING * own.speed.abs();
            match found.last().is_some_and(near) {
                true => drop(found.pop()),
                false => found.push(own),
            }
        }
        // What was interrupted has beginnings without ends.
        Ok(if (self.goes_on)() { found } else { Vec::new() })
    }

    /// A speed between two at which something grows where nothing does: the least growth of all, by golden sections.
    fn stable_between(&self, [a, b]: [&Point; 2]) -> Result<Option<Point>, Error> {
        let most = |own: &Point| own.modes.growing.first().map(|own| own.value.re);
        if most(a).is_none() || most(b).is_none() {
            return Ok(None);
        }
        let [mut left, mut right] = [a.speed, b.speed];
        let mut least: Option<(f64, f64)> = None;
        for _ in 0..BETWEEN.min(tries(a)) {
            if right - left <= NOTHING * right.abs() {
                break;
            }
            let speed = match least {
                None => 0.5 * (left + right),
                Some((met, _)) => met + golden_step([left, met, right]),
            };
            let Some(point) = self.point(speed, a)? else { return Ok(None) };
            let Some(growth) = most(&point) else { return Ok(Some(point)) };
            // The one of both at which more grows becomes an end.
            let Some(other) = least.replace((speed, growth)) else { continue };
            let (more, kept) = match growth < other.1 {
                true => (other, (speed, growth)),
                false => ((speed, growth), other),
            };
            let end = if more.0 < kept.0 { &mut left } else { &mut right };
            *end = more.0;
            least = Some(kept);
        }
        Ok(None)
    }

    /// Where two motions meet, if something grows there: a speed at which it does, and those next to the ends of the interval.
    fn growing(
        &self,
        near: &Point,
        meeting: &Meeting,
    ) -> Result<(Option<Point>, Vec<Point>), Error> {
        let (mut peak, mut found) = (None, Vec::new());
        let [left, right] = &meeting.ends;
        // What grows at one end of the step and not at the other one ends to between them.
        let edges = match (left.grows(), right.grows()) {
            (true, true) => Vec::new(),
            (true, false) => vec![[right.clone(), left.clone()]],
            (false, true) => vec![[left.clone(), right.clone()]],
            (false, false) => {
                let Some((point, inside, ends)) = self.most_growing(near, meeting)? else {
                    return Ok((peak, found));
                };
                peak = Some(point);
                ends.into_iter().map(|outside| [outside, inside.clone()]).collect()
            }
        };
        for edge in edges {
            found.extend(self.edge(near, meeting, edge)?);
        }
        Ok((peak, found))
    }

    /// The two points, as near to each other as thresholds are found, between which two motions end to grow.
    fn edge(
        &self,
        near: &Point,
        meeting: &Meeting,
        [mut outside, mut inside]: [Met; 2],
    ) -> Result<Vec<Point>, Error> {
        let mut points = [None, None];
        for k in 0..tries(near) {
            let width = outside.speed - inside.speed;
            if width.abs() <= FOUND * outside.speed.abs() {
                break;
            }
            // Growth is straight only within the interval in which both stay together.
            let is_straight = outside.off == 0.0 && inside.off == 0.0 && k % 3 != 2;
            let share = match is_straight {
                true => (inside.growth / (inside.growth - outside.growth)).clamp(1e-6, 1.0 - 1e-6),
                false => 0.5,
            };
            let speed = inside.speed + share * width;
            let Some((point, met)) = self.met(near, meeting, speed, [&outside, &inside])? else {
                return Ok(Vec::new());
            };
            match met.grows() {
                true => (inside, points[1]) = (met, Some(point)),
                false => (outside, points[0]) = (met, Some(point)),
            }
        }
        Ok(points.into_iter().flatten().collect())
    }

    /// Two motions at a speed between those of two others.
    fn met(
        &self,
        near: &Point,
        meeting: &Meeting,
        speed: f64,
        [one, other]: [&Met; 2],
    ) -> Result<Option<(Point, Met)>, Error> {
        let Some(point) = self.point(speed, near)? else { return Ok(None) };
        let is_one = (speed - one.speed).abs() < (speed - other.speed).abs();
        let met = meeting.at(&point, if is_one { one } else { other });
        Ok(met.map(|met| (point, met)))
    }

    /// Where two motions that meet grow, between two speeds at which they grow less; none where they do not.
    fn most_growing(
        &self,
        near: &Point,
        meeting: &Meeting,
    ) -> Result<Option<(Point, Met, [Met; 2])>, Error> {
        let [mut left, mut right] = meeting.ends.clone();
        let mut middle: Option<Met> = None;
        // The speeds between which they are known to stay together.
        let mut together: Option<[f64; 2]> = None;
        for k in 0..tries(near) {
            let width = right.speed - left.speed;
            let known = together.map_or(0.0, |[first, last]| last - first);
            if width <= MET * right.speed.abs() || middle.is_some() && width <= MIDDLE * known {
                break;
            }
            let speed = match &middle {
                // Where their frequencies meet if they go straight, and in the middle.
                None if left.off * right.off == 0.0 || k % 3 == 2 => {
                    0.5 * (left.speed + right.speed)
                }
                None => left.speed + (left.off / (left.off - right.off)).clamp(0.01, 0.99) * width,
                Some(met) => met.speed + golden_step([left.speed, met.speed, right.speed]),
            };
            let Some((point, next)) = self.met(near, meeting, speed, [&left, &right])? else {
                return Ok(None);
            };
            let is_met = next.off.abs() <= MIDDLE * next.rates_apart();
            let size = next.pair[0].value.norm();
            if is_met && next.growth > SLOW * size && !point.modes.is_stable() {
                return Ok(Some((point, next, [left, right])));
            }
            if next.off == 0.0 {
                let [first, last] = together.unwrap_or([next.speed; 2]);
                together = Some([first.min(next.speed), last.max(next.speed)]);
            }
            match &mut middle {
                Some(met) => {
                    // The one that grows less becomes an end; nothing grows less than what is not together.
                    let less = match next.off == 0.0 && next.growth > met.growth {
                        true => std::mem::replace(met, next),
                        false => next,
                    };
                    let end = if less.speed < met.speed { &mut left } else { &mut right };
                    *end = less;
                }
                None if next.off == 0.0 => middle = Some(next),
                // Damped unlike, they meet once: it grows no faster elsewhere.
                None if is_met => break,
                None if left.off == 0.0 || next.off * left.off < 0.0 && right.off != 0.0 => {
                    right = next
                }
                None => left = next,
            }
        }
        Ok(None)
    }
}

//! Modes followed over speeds: Campbell diagram, critical speeds, thresholds of stability.

use std::sync::atomic::{AtomicBool, Ordering};

use super::beside::beside;
use super::doubts::Doubt;
use super::growing::Growing;
use super::modes::Mode;
use super::points::{Along, Point};
use super::range::Range;
use super::roots::{Root, Roots, Threshold};
use super::round::LinearMachine;
use super::shapes::{apply, inner};
use super::state_doubts::StateDoubts;
use super::track::{Matched, mac, matched};
use crate::error::Error;

/// Smallest part of a step between speeds in which it is halved to tell modes apart.
const HALVINGS: u32 = 8;
/// The same where a body that turns is not round, whose modes change shape as they lock.
const FEW_HALVINGS: u32 = 3;

/// Share of a distance that is next to its end.
const NEXT: f64 = 1e-4;
/// Share by which two critical speeds may differ that are one.
const SAME: f64 = 1e-6;

/// A mode over the speeds; none where it is not among those that were listed.
pub type Branch = Vec<Option<Mode>>;

/// A speed at which a mode has n times the frequency of the rotation.
#[derive(Debug, Clone, PartialEq)]
pub struct Critical {
    /// n.
    pub order: f64,
    /// rad/s.
    pub speed: f64,
    /// The mode there.
    pub mode: Mode,
    /// Its branch.
    pub branch: usize,
}

/// Modes over speeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Campbell {
    /// Speeds (rad/s).
    pub speeds: Vec<f64>,
    /// The modes, each over all speeds, by the frequency with which they begin.
    pub branches: Vec<Branch>,
    /// By speed what grows fastest, listed or not; none where nothing does.
    pub growing: Vec<Option<Growing>>,
    /// Critical speeds, by orders and speeds.
    pub criticals: Vec<Critical>,
    /// Thresholds by speeds.
    pub thresholds: Vec<Threshold>,
    /// Speeds at which the machine does not stand, and why: they are left out.
    pub lost: Vec<(f64, Error)>,
    /// Steps between speeds, by the place of the first, in which modes could not be told apart for sure.
    pub unclear: Vec<usize>,
    /// In which motions modes were looked for, if not in all.
    pub reduced: Option<Reduced>,
    /// What limits the worth of the states, and of the modes at the last speed.
    pub doubts: Vec<Doubt>,
    /// Whether it was asked to end before all was found: speeds, which modes are which, critical speeds or thresholds are missing.
    pub interrupted: bool,
}

/// Slow motions in which the modes of a large machine were looked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reduced {
    /// How many at most.
    pub columns: usize,
    /// Of so many coordinates.
    pub of: usize,
    /// The largest share of |λ| by which a mode was found to differ from one of all coordinates.
    pub error: f64,
}

impl LinearMachine {
    /// Follows the modes over the speeds, on all processors. `goes_on` is asked before every speed, and at one that takes long.
    ///
    /// # Errors
    /// A speed at which the machine does not stand, or values that are not finite.
    pub fn campbell(
        &self,
        range: &Range,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Campbell, Error> {
        self.campbell_within((range, 0.0), goes_on)
    }

    /// The same with critical speeds to a share of the width of their peaks.
    pub(super) fn campbell_within(
        &self,
        (range, width): (&Range, f64),
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Campbell, Error> {
        let Along { points, lost, slow } = self.along(range, goes_on)?;
        // Films carry least at the first speeds, so that the last one says more.
        if let (true, Some((_, error))) = (points.is_empty(), lost.last()) {
            return Err(error.clone());
        }
        // Once it was asked to end, it ends.
        let interrupted = AtomicBool::new(points.len() + lost.len() < range.speeds.len());
        let goes_on = || {
            if !goes_on() {
                interrupted.store(true, Ordering::Relaxed);
            }
            !interrupted.load(Ordering::Relaxed)
        };
        let slow = slow.as_ref();
        let roots = Roots { machine: self, range, slow, points: &points, width, goes_on: &goes_on };
        let mut followed = Followed { roots: &roots, unclear: Vec::new() };
        let branches = followed.branches()?;
        let criticals = followed.criticals(&branches, &range.orders)?;
        let is_uneven = points.iter().any(|own| own.is_uneven);
        // Modes that are locked to the rotation are two with one frequency, of which either may be followed.
        let thresholds = match is_uneven {
            true => roots.parametric()?,
            false => followed.thresholds(&branches, &criticals)?,
        };
        let (of_sight, thresholds): (Vec<_>, Vec<_>) =
            thresholds.into_iter().partition(|own| !is_uneven && own.is_of_sight());
        let unclear = followed.unclear;
        let listed =
            |own: &Vec<Option<usize>>| own.iter().flatten().any(|place| *place < range.count);
        let kept: Vec<usize> = (0..branches.len()).filter(|&own| listed(&branches[own])).collect();
        let of = |branch: usize| kept.iter().position(|own| *own == branch);
        let take = |own: &usize| -> Branch {
            let modes = branches[*own].iter().zip(&points);
            modes.map(|(place, point)| Some(point.modes.oscillating[(*place)?].clone())).collect()
        };
        let mut states = StateDoubts::default();
        points.iter().for_each(|own| states.take(self, own.speed, &own.at));
        let mut doubts = states.told(self, points.last().map(|own| (own.speed, &own.at)));
        doubts.extend(of_sight.iter().filter_map(|own| self.too_slow(own)));
        if let Some(last) = points.last() {
            let count = range.count.min(last.modes.oscillating.len());
            let modes = &last.modes.oscillating[..count];
            doubts.extend(self.doubts(&last.at, &self.linearised(&last.at)?, modes)?);
        }
        Ok(Campbell {
            speeds: points.iter().map(|own| own.speed).collect(),
            branches: kept.iter().map(take).collect(),
            growing: points.iter().map(|own| own.modes.growing.first().cloned()).collect(),
            criticals: (criticals.into_iter())
                .filter_map(|own| Some(Critical { branch: of(own.branch)?, ..own }))
                .collect(),
            thresholds: (thresholds.into_iter())
                .map(|own| Threshold { branch: own.branch.and_then(of), ..own })
                .collect(),
            lost,
            unclear,
            doubts,
            interrupted: interrupted.into_inner(),
            reduced: slow.map(|own| Reduced {
                columns: own.columns(),
                of: self.machine.active(),
                error: own.error,
            }),
        })
    }
}

/// Whether two critical speeds are one, found on several branches that change places there.
fn is_same(a: &Critical, b: &Critical) -> bool {
    let size = |own: &Critical| inner(&own.mode.shape, &own.mode.shape).re;
    let alike = inner(&a.mode.shape, &b.mode.shape).norm_sqr() / (size(a) * size(b));
    (a.speed - b.speed).abs() <= SAME * b.speed.abs() && alike > 1.0 - SAME.sqrt()
}

/// The speed between two points at which two modes that change places have one frequency, if their frequencies go straight.
fn meeting(a: &Point, b: &Point, to: &[Option<usize>]) -> Option<f64> {
    let hertz = |point: &Point, place: usize| point.modes.oscillating[place].value.im;
    let followed: Vec<(usize, usize)> =
        to.iter().enumerate().filter_map(|(i, j)| Some((i, (*j)?))).collect();
    let swapped = followed.windows(2).find(|pair| pair[0].1 > pair[1].1)?;
    let [before, after] = [
        hertz(a, swapped[1].0) - hertz(a, swapped[0].0),
        hertz(b, swapped[0].1) - hertz(b, swapped[1].1),
    ];
    let share = before / (before + after);
    share.is_finite().then_some(a.speed + share * (b.speed - a.speed))
}

struct Followed<'a> {
    roots: &'a Roots<'a>,
    unclear: Vec<usize>,
}

impl LinearMachine {
    /// What is to be said of a speed at which a motion that grows is lost from sight.
    fn too_slow(&self, lost: &Threshold) -> Option<Doubt> {
        let mode = lost.mode.as_ref()?;
        let bodies = self.machine.bodies.iter().zip(&mode.shares);
        let (body, _) = bodies.max_by(|a, b| a.1.total_cmp(b.1))?;
        Some(Doubt::TooSlow {
            body: body.name().to_owned(),
            speed: lost.speed,
            below: lost.grows,
            hertz: mode.hertz(),
        })
    }
}

impl Followed<'_> {
    /// Which mode at every speed is which: places of the modes of a point by branch.
    fn branches(&mut self) -> Result<Vec<Vec<Option<usize>>>, Error> {
        let Some(first) = self.roots.points.first() else { return Ok(Vec::new()) };
        let mut branches: Vec<Vec<Option<usize>>> =
            (0..first.modes.oscillating.len()).map(|place| vec![Some(place)]).collect();
        let pairs: Vec<&[Point]> = self.roots.points.windows(2).collect();
        let all = beside(self.roots.machine.threads, &pairs, &|pair| {
            let halvings = match &pair[0] {
                own if own.is_costly => 0,
                own if own.is_uneven => FEW_HALVINGS,
                _ => HALVINGS,
            };
            self.between(&pair[0], &pair[1], halvings)
        });
        for (step, (pair, own)) in pairs.into_iter().zip(all).enumerate() {
            let (to, is_sure) = own?;
            if !is_sure {
                self.unclear.push(step);
            }
            let mut taken = vec![false; pair[1].modes.oscillating.len()];
            for branch in &mut branches {
                let next = branch[step].and_then(|place| to[place]);
                if let Some(place) = next {
                    taken[place] = true;
                }
                branch.push(next);
            }
            for (place, _) in taken.iter().enumerate().filter(|(_, taken)| !**taken) {
                let mut new = vec![None; step + 1];
                new.push(Some(place));
                branches.push(new);
            }
        }
        Ok(branches)
    }

    /// Which modes of a point are which of another, with speeds between them where that is not clear.
    fn between(
        &self,
        a: &Point,
        b: &Point,
        halvings: u32,
    ) -> Result<(Vec<Option<usize>>, bool), Error> {
        let Matched { to, is_sure } = matched(&a.mass, &a.modes.oscillating, &b.modes.oscillating);
        if is_sure || halvings == 0 {
            // What changes places within the smallest part with its shape crosses.
            let is_clear = is_sure || self.crosses(a, b, &to);
            return Ok((to, is_clear));
        }
        let least = (b.speed - a.speed) / f64::from(1_u32 << halvings);
        // Whirls that lock to the rotation meet over whole intervals.
        let meeting = if a.is_uneven { None } else { meeting(a, b, &to) };
        let cuts = match meeting {
            // The smallest part, in the middle of which they meet.
            Some(speed) if speed - least > a.speed && speed + least < b.speed => {
                vec![speed - 0.5 * least, speed + 0.5 * least]
            }
            _ => vec![0.5 * (a.speed + b.speed)],
        };
        let threads = self.roots.machine.threads;
        let inside = beside(threads, &cuts, &|speed| self.roots.point(*speed, a));
        let inside: Result<Option<Vec<Point>>, Error> = inside.into_iter().collect();
        let Some(inside) = inside? else { return Ok((to, false)) };
        let all: Vec<&Point> =
            std::iter::once(a).chain(&inside).chain(std::iter::once(b)).collect();
        let pairs: Vec<&[&Point]> = all.windows(2).collect();
        let parts = beside(threads, &pairs, &|pair| {
            // A whole number of the smallest parts, below that of the step.
            let share = ((pair[1].speed - pair[0].speed) / least).log2().round().max(0.0) as u32;
            self.between(pair[0], pair[1], share.min(halvings - 1))
        });
        let (mut to, mut is_clear) = ((0..to.len()).map(Some).collect::<Vec<_>>(), true);
        for part in parts {
            let (next, is_sure) = part?;
            to.iter_mut().for_each(|place| *place = place.and_then(|place| next[place]));
            is_clear &= is_sure;
        }
        Ok((to, is_clear))
    }

    /// Whether all modes that go on keep their shape.
    fn crosses(&self, a: &Point, b: &Point, to: &[Option<usize>]) -> bool {
        let asked = to.iter().enumerate().take(self.roots.range.count);
        asked.filter_map(|(i, j)| Some((i, (*j)?))).all(|(i, j)| {
            let moved = apply(&a.mass, &a.modes.oscillating[i].shape);
            mac(&moved, &b.modes.oscillating[j].shape) > 0.5
        })
    }

    fn criticals(
        &self,
        branches: &[Vec<Option<usize>>],
        orders: &[f64],
    ) -> Result<Vec<Critical>, Error> {
        let mut found = Vec::new();
        for &order in orders {
            let off = move |speed: f64, mode: &Mode| mode.value.im - order * speed.abs();
            let roots = beside(self.roots.machine.threads, branches, &|places| {
                self.roots.of_branch(places, &off, &off)
            });
            let mut own: Vec<(Critical, bool)> = Vec::new();
            for (branch, roots) in roots.into_iter().enumerate() {
                for Root { speed, mode, rises } in roots? {
                    own.push((Critical { order, speed, mode, branch }, rises));
                }
            }
            own.sort_by(|a, b| a.0.speed.total_cmp(&b.0.speed));
            let mut single: Vec<(Critical, bool)> = Vec::with_capacity(own.len());
            for own in own {
                if single.iter().all(|other| !is_same(&other.0, &own.0)) {
                    single.push(own);
                }
            }
            found.extend(self.counted(single, branches, order)?);
        }
        Ok(found)
    }

    /// Critical speeds with those that no branch shows, as modes were followed over steps that are too long: where more or fewer
    /// modes are below the order at the end of a step than its critical speeds explain.
    fn counted(
        &self,
        found: Vec<(Critical, bool)>,
        branches: &[Vec<Option<usize>>],
        order: f64,
    ) -> Result<Vec<Critical>, Error> {
        let steps: Vec<usize> = (1..self.roots.points.len()).collect();
        let missed = beside(self.roots.machine.threads, &steps, &|&step| {
            let [a, b] = [&self.roots.points[step - 1], &self.roots.points[step]];
            let (Some(before), Some(after)) = (self.below(a, order), self.below(b, order)) else {
                return Ok::<Vec<Root>, Error>(Vec::new());
            };
            let inside =
                found.iter().filter(|(own, _)| own.speed > a.speed && own.speed <= b.speed);
            let explained: isize = inside.map(|(_, rises)| if *rises { -1 } else { 1 }).sum();
            let mut crossings = Vec::new();
            if !a.is_uneven && !b.is_uneven && after as isize - before as isize != explained {
                self.crossings([a, b], order, HALVINGS, &mut crossings)?;
            }
            Ok(crossings)
        });
        let mut all: Vec<Critical> = found.into_iter().map(|own| own.0).collect();
        let known = all.len();
        for (step, roots) in missed.into_iter().enumerate() {
            for Root { speed, mode, .. } in roots? {
                // The branch that has the mode at the end of the step.
                let like = |own: &usize| {
                    let places = &self.roots.points[step + 1].modes.oscillating;
                    (places[*own].value.im - mode.value.im).abs()
                };
                let ends = branches.iter().enumerate();
                let ends = ends.filter_map(|(branch, own)| Some((branch, own[step + 1]?)));
                let nearest = ends.min_by(|a, b| like(&a.1).total_cmp(&like(&b.1)));
                let Some((branch, _)) = nearest else { continue };
                let own = Critical { order, speed, mode, branch };
                if all[..known].iter().all(|other| !is_same(other, &own)) {
                    all.push(own);
                }
            }
        }
        all.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        Ok(all)
    }

    /// How many modes are below an order at a point, if all of them are known.
    fn below(&self, point: &Point, order: f64) -> Option<usize> {
        let line = order * point.speed.abs();
        let modes = &point.modes.oscillating;
        let count = modes.iter().filter(|own| own.value.im < line).count();
        let are_all = modes.len() < self.roots.range.looked_for();
        (are_all || count < modes.len()).then_some(count)
    }

    /// Adds the speeds between two points at which modes go through an order, by how many are below it.
    fn crossings(
        &self,
        [a, b]: [&Point; 2],
        order: f64,
        halvings: u32,
        found: &mut Vec<Root>,
    ) -> Result<(), Error> {
        let (Some(before), Some(after)) = (self.below(a, order), self.below(b, order)) else {
            return Ok(());
        };
        if before == after {
            return Ok(());
        }
        let off = move |speed: f64, mode: &Mode| mode.value.im - order * speed.abs();
        if before.abs_diff(after) == 1 {
            let last = before.min(after);
            let end = |own: &Point| Some((own.speed, own.modes.oscillating.get(last)?.clone()));
            // A mode that is damped too much to be listed at one end goes through no order.
            if let (Some(from), Some(to)) = (end(a), end(b)) {
                let known = found.len();
                self.roots.between_modes(a, [from, to], &off, found)?;
                if found.len() > known {
                    return Ok(());
                }
            }
        }
        if halvings == 0 {
            return Ok(());
        }
        let middle = self.roots.point(0.5 * (a.speed + b.speed), a)?;
        let Some(middle) = middle else { return Ok(()) };
        self.crossings([a, &middle], order, halvings - 1, found)?;
        self.crossings([&middle, b], order, halvings - 1, found)
    }

    /// The thresholds on both sides of a speed at which a mode grows, between two points, where those that are known have it stable.
    fn around(
        &self,
        (speed, mode): (f64, &Mode),
        [a, b]: [&Point; 2],
        known: &[Threshold],
    ) -> Result<Vec<Threshold>, Error> {
        let inside = || known.iter().filter(|own| own.speed >= a.speed && own.speed <= b.speed);
        let below = inside().filter(|own| own.speed <= speed);
        let below = below.max_by(|a, b| a.speed.total_cmp(&b.speed));
        let above = inside().filter(|own| own.speed > speed);
        let above = above.min_by(|a, b| a.speed.total_cmp(&b.speed));
        if below.map_or(!a.modes.is_stable(), |own| own.grows) {
            return Ok(Vec::new());
        }
        // Next to a threshold, where it is stable still or again.
        let next = |own: &Threshold| own.speed + NEXT * (speed - own.speed);
        let ends = [below.map_or(a.speed, next), above.map_or(b.speed, next)];
        let mut found = Vec::new();
        for other in ends {
            let Some((end, _)) = self.roots.nearest(a, other, mode)? else { continue };
            if end.grows() {
                continue;
            }
            let mut both = [(other, end), (speed, mode.clone())];
            both.sort_by(|a, b| a.0.total_cmp(&b.0));
            let rate = |_: f64, mode: &Mode| mode.value.re;
            self.roots.between_modes(a, both, &rate, &mut found)?;
        }
        let threshold = |Root { speed, mode, rises }| {
            let mode = Some(mode);
            Threshold {
                speed,
                mode,
                other: None,
                before: None,
                branch: None,
                grows: rises,
                others: false,
            }
        };
        Ok(found.into_iter().map(threshold).collect())
    }

    fn thresholds(
        &self,
        branches: &[Vec<Option<usize>>],
        criticals: &[Critical],
    ) -> Result<Vec<Threshold>, Error> {
        let mut found = Vec::new();
        for (branch, places) in branches.iter().enumerate() {
            let (grows, rate) = (|_, mode: &Mode| mode.growth(), |_, mode: &Mode| mode.value.re);
            for Root { speed, mode, rises } in self.roots.of_branch(places, &grows, &rate)? {
                let (mode, branch) = (Some(mode), Some(branch));
                let (other, before) = (None, None);
                found.push(Threshold {
                    speed,
                    mode,
                    other,
                    before,
                    branch,
                    grows: rises,
                    others: false,
                });
            }
        }
        // Motions that do not oscillate, and those that no branch shows.
        for pair in self.roots.points.windows(2) {
            let inside = |speed: f64| speed >= pair[0].speed && speed <= pair[1].speed;
            if !found.iter().any(|own: &Threshold| inside(own.speed)) {
                found.extend(self.roots.threshold([&pair[0], &pair[1]])?);
            }
            for own in criticals.iter().filter(|own| inside(own.speed) && own.mode.grows()) {
                let more = self.around((own.speed, &own.mode), [&pair[0], &pair[1]], &found)?;
                found.extend(more);
            }
        }
        found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        let mut rest = found.as_mut_slice();
        for pair in self.roots.points.windows(2) {
            let inside = rest.iter().take_while(|own| own.speed <= pair[1].speed).count();
            let (own, next) = rest.split_at_mut(inside);
            let mut grow = pair[0].modes.growing.len();
            for own in own {
                let fewer = grow.saturating_sub(usize::from(!own.grows));
                own.others = fewer > 0;
                grow = fewer + usize::from(own.grows);
            }
            rest = next;
        }
        Ok(found)
    }
}

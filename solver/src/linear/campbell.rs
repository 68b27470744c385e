//! Modes followed over speeds: Campbell diagram, critical speeds, thresholds of stability.

use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::linearised::Standstill;
use super::modes::{Mode, Modes, apply};
use super::round::LinearMachine;
use super::track::{Matched, mac, matched};
use crate::error::Error;
use crate::linalg::Matrix;

/// Modes that are followed beyond those that are asked for, so that these may change places with them.
const BEYOND: usize = 4;
/// Speeds that follow each other, each state found from the one before.
const TOGETHER: usize = 8;
/// Smallest part of a step between speeds in which it is halved to tell modes apart.
const HALVINGS: u32 = 8;
/// Share of a speed to which critical speeds and thresholds are found.
const FOUND: f64 = 1e-9;
/// Share of |λ| that may be left there.
const ROOT: f64 = 1e-6;
/// Evaluations until then at most.
const TRIES: usize = 40;

/// What is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Range {
    /// The body whose speed it is over.
    pub of: usize,
    /// Speeds (rad/s), ascending.
    pub speeds: Vec<f64>,
    /// By body the ratio of its speed to that, where it is told.
    pub ratios: Vec<Option<f64>>,
    /// How many modes are listed, the slowest ones.
    pub count: usize,
    /// Orders of which critical speeds are wanted.
    pub orders: Vec<f64>,
}

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

/// A speed at which a mode begins to grow, or ends to.
#[derive(Debug, Clone, PartialEq)]
pub struct Threshold {
    /// rad/s.
    pub speed: f64,
    /// The mode there.
    pub mode: Mode,
    /// Its branch.
    pub branch: usize,
    /// Whether it grows beyond.
    pub grows: bool,
}

/// Modes over speeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Campbell {
    /// Speeds (rad/s).
    pub speeds: Vec<f64>,
    /// The modes, each over all speeds, by the frequency with which they begin.
    pub branches: Vec<Branch>,
    /// By speed whether nothing grows, listed or not.
    pub stable: Vec<bool>,
    /// Critical speeds, by orders and speeds.
    pub criticals: Vec<Critical>,
    /// Thresholds by speeds.
    pub thresholds: Vec<Threshold>,
    /// Speeds at which the machine does not stand, and why: they are left out.
    pub lost: Vec<(f64, Error)>,
    /// Steps between speeds, by the place of the first, in which modes could not be told apart for sure.
    pub unclear: Vec<usize>,
}

/// A machine at a speed.
struct Point {
    speed: f64,
    mass: Matrix,
    at: Standstill,
    modes: Modes,
}

impl LinearMachine {
    /// Follows the modes over the speeds, on all processors. `goes_on` is asked before every speed.
    ///
    /// # Errors
    /// A speed at which the machine does not stand, or values that are not finite.
    pub fn campbell(
        &self,
        range: &Range,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Campbell, Error> {
        let (mut points, mut lost) = (Vec::with_capacity(range.speeds.len()), Vec::new());
        for (speed, point) in self.along(range, goes_on)? {
            match point {
                Ok(point) => points.push(point),
                Err(error) => lost.push((speed, error)),
            }
        }
        if let (true, Some((_, error))) = (points.is_empty(), lost.first()) {
            return Err(error.clone());
        }
        let mut followed = Followed { machine: self, range, points: &points, unclear: Vec::new() };
        let branches = followed.branches()?;
        let criticals = followed.criticals(&branches)?;
        let thresholds = followed.thresholds(&branches)?;
        let unclear = followed.unclear;
        let listed =
            |own: &Vec<Option<usize>>| own.iter().flatten().any(|place| *place < range.count);
        let kept: Vec<usize> = (0..branches.len()).filter(|&own| listed(&branches[own])).collect();
        let of = |branch: usize| kept.iter().position(|own| *own == branch);
        let take = |own: &usize| -> Branch {
            let modes = branches[*own].iter().zip(&points);
            modes.map(|(place, point)| Some(point.modes.oscillating[(*place)?].clone())).collect()
        };
        Ok(Campbell {
            speeds: points.iter().map(|own| own.speed).collect(),
            branches: kept.iter().map(take).collect(),
            stable: points.iter().map(|own| own.modes.is_stable()).collect(),
            criticals: (criticals.into_iter())
                .filter_map(|own| Some(Critical { branch: of(own.branch)?, ..own }))
                .collect(),
            thresholds: (thresholds.into_iter())
                .filter_map(|own| Some(Threshold { branch: of(own.branch)?, ..own }))
                .collect(),
            lost,
            unclear,
        })
    }

    /// The machine at the speeds, up to the first that was not done; where it does not stand, why.
    fn along(
        &self,
        range: &Range,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Vec<(f64, Result<Point, Error>)>, Error> {
        let work = |speeds: &[f64]| -> Result<Vec<(f64, Result<Point, Error>)>, Error> {
            let mut own: Vec<(f64, Result<Point, Error>)> = Vec::with_capacity(speeds.len());
            for &speed in speeds.iter().take_while(|_| goes_on()) {
                let near = own.iter().rev().find_map(|(_, point)| point.as_ref().ok());
                let point = self.point(range, speed, near.map(|own| &own.at));
                match point {
                    Err(error) if !error.is_of_balance() => return Err(error),
                    point => own.push((speed, point)),
                }
            }
            Ok(own)
        };
        // The same parts on any number of processors, so that the numbers are the same to the bit.
        let parts: Vec<&[f64]> = range.speeds.chunks(TOGETHER).collect();
        let done: Vec<_> = parts.iter().map(|_| Mutex::new(None)).collect();
        let next = AtomicUsize::new(0);
        let worker = || {
            loop {
                let place = next.fetch_add(1, Ordering::Relaxed);
                let Some(speeds) = parts.get(place) else { return };
                let own = work(speeds);
                *done[place].lock().unwrap_or_else(PoisonError::into_inner) = Some(own);
            }
        };
        let processors = thread::available_parallelism().map_or(1, NonZero::get);
        thread::scope(|scope| {
            for _ in 1..processors.min(parts.len()) {
                scope.spawn(worker);
            }
            worker();
        });
        let mut all = Vec::with_capacity(range.speeds.len());
        for (own, speeds) in done.into_iter().zip(&parts) {
            let own = own.into_inner().unwrap_or_else(PoisonError::into_inner);
            let own = own.expect("all parts were done")?;
            let whole = own.len() == speeds.len();
            all.extend(own);
            if !whole {
                break;
            }
        }
        Ok(all)
    }

    fn point(&self, range: &Range, speed: f64, near: Option<&Standstill>) -> Result<Point, Error> {
        let speeds = self.speeds(range.of, speed, &range.ratios);
        let at = self.standing_round(&speeds, near)?;
        let equations = self.linearised(&at);
        let modes = self.modes(&equations, range.count + BEYOND)?;
        Ok(Point { speed, mass: equations.mass, at, modes })
    }
}

struct Followed<'a> {
    machine: &'a LinearMachine,
    range: &'a Range,
    points: &'a [Point],
    unclear: Vec<usize>,
}

impl Followed<'_> {
    /// Which mode at every speed is which: places of the modes of a point by branch.
    fn branches(&mut self) -> Result<Vec<Vec<Option<usize>>>, Error> {
        let Some(first) = self.points.first() else { return Ok(Vec::new()) };
        let mut branches: Vec<Vec<Option<usize>>> =
            (0..first.modes.oscillating.len()).map(|place| vec![Some(place)]).collect();
        for (step, pair) in self.points.windows(2).enumerate() {
            let (to, is_sure) = self.between(&pair[0], &pair[1], HALVINGS)?;
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
        let middle = self.machine.point(self.range, 0.5 * (a.speed + b.speed), Some(&a.at))?;
        let (first, sure) = self.between(a, &middle, halvings - 1)?;
        let (second, too) = self.between(&middle, b, halvings - 1)?;
        let both = first.into_iter().map(|place| place.and_then(|place| second[place]));
        Ok((both.collect(), sure && too))
    }

    /// Whether all modes that go on keep their shape.
    fn crosses(&self, a: &Point, b: &Point, to: &[Option<usize>]) -> bool {
        let asked = to.iter().enumerate().take(self.range.count);
        asked.filter_map(|(i, j)| Some((i, (*j)?))).all(|(i, j)| {
            let moved = apply(&a.mass, &a.modes.oscillating[i].shape);
            mac(&moved, &b.modes.oscillating[j].shape) > 0.5
        })
    }

    fn criticals(&self, branches: &[Vec<Option<usize>>]) -> Result<Vec<Critical>, Error> {
        let mut found = Vec::new();
        for &order in &self.range.orders {
            let mut own = Vec::new();
            for (branch, places) in branches.iter().enumerate() {
                let off = move |speed: f64, mode: &Mode| mode.value.im - order * speed.abs();
                for (speed, mode, _) in self.roots(places, &off, &off)? {
                    own.push(Critical { order, speed, mode, branch });
                }
            }
            own.sort_by(|a, b| a.speed.total_cmp(&b.speed));
            found.extend(own);
        }
        Ok(found)
    }

    fn thresholds(&self, branches: &[Vec<Option<usize>>]) -> Result<Vec<Threshold>, Error> {
        let mut found = Vec::new();
        for (branch, places) in branches.iter().enumerate() {
            let (grows, rate) = (|_, mode: &Mode| mode.growth(), |_, mode: &Mode| mode.value.re);
            for (speed, mode, grows) in self.roots(places, &grows, &rate)? {
                found.push(Threshold { speed, mode, branch, grows });
            }
        }
        found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        Ok(found)
    }

    /// Speeds at which something of a branch changes its sign, with the mode there and whether it rises. `exact`: the same
    /// without what keeps rounding from changing it, whose zero is found where it changes its sign, too.
    fn roots(
        &self,
        places: &[Option<usize>],
        of: &dyn Fn(f64, &Mode) -> f64,
        exact: &dyn Fn(f64, &Mode) -> f64,
    ) -> Result<Vec<(f64, Mode, bool)>, Error> {
        let mut found = Vec::new();
        for (pair, places) in self.points.windows(2).zip(places.windows(2)) {
            let (Some(a), Some(b)) = (places[0], places[1]) else { continue };
            let ends = [(&pair[0], a), (&pair[1], b)].map(|(point, place)| {
                let mode = &point.modes.oscillating[place];
                (point.speed, of(point.speed, mode), mode)
            });
            // A value of zero belongs to the step that it ends.
            if ends[0].1 == 0.0 || ends[0].1.signum() == ends[1].1.signum() && ends[1].1 != 0.0 {
                continue;
            }
            let rises = ends[0].1 < 0.0;
            let nearer = ends.map(|(speed, _, mode)| (speed, exact(speed, mode), mode));
            let changes = nearer[0].1 * nearer[1].1 < 0.0;
            let (ends, of) = if changes { (nearer, exact) } else { (ends, of) };
            let (speed, mode) = self.root(&pair[0], ends, of)?;
            // Where a mode ends between the speeds another one may have been followed.
            if of(speed, &mode).abs() <= ROOT * mode.value.norm() {
                found.push((speed, mode, rises));
            }
        }
        Ok(found)
    }

    /// Where it is zero between two ends, by false position that halves the value of an end that stays (Illinois).
    fn root(
        &self,
        near: &Point,
        ends: [(f64, f64, &Mode); 2],
        of: &dyn Fn(f64, &Mode) -> f64,
    ) -> Result<(f64, Mode), Error> {
        let [mut a, mut b] = ends.map(|(speed, value, mode)| (speed, value, mode.clone()));
        let mut last = 0;
        for _ in 0..TRIES {
            if b.1 == 0.0 || (b.0 - a.0).abs() <= FOUND * b.0.abs() {
                break;
            }
            let speed = b.0 - b.1 * (b.0 - a.0) / (b.1 - a.1);
            let point = self.machine.point(self.range, speed, Some(&near.at))?;
            let nearest = if (speed - a.0).abs() < (b.0 - speed).abs() { &a.2 } else { &b.2 };
            let moved = apply(&point.mass, &nearest.shape);
            let apart = |own: &Mode| {
                let change = (own.value - nearest.value).norm() / nearest.value.norm();
                1.0 - mac(&moved, &own.shape) + change
            };
            let modes = point.modes.oscillating.iter();
            let Some(mode) = modes.min_by(|x, y| apart(x).total_cmp(&apart(y))) else { break };
            let value = of(speed, mode);
            let next = (speed, value, mode.clone());
            if value.signum() == b.1.signum() {
                let moved = (b.0 - speed).abs();
                b = next;
                if last == 1 {
                    a.1 *= 0.5;
                }
                last = 1;
                if moved <= FOUND * speed.abs() {
                    break;
                }
            } else {
                let moved = (a.0 - speed).abs();
                a = next;
                if last == -1 {
                    b.1 *= 0.5;
                }
                last = -1;
                if moved <= FOUND * speed.abs() {
                    return Ok((a.0, a.2));
                }
            }
        }
        Ok((b.0, b.2))
    }
}

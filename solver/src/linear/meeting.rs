//! Motions that meet between two speeds: whose frequencies add up to a multiple of that of the rotation.

use num_complex::Complex64;

use super::modes::Mode;
use super::points::{LOCKED, Point};
use super::shapes::apply_all;
use super::track::mac;

/// Multiples of Ω that are looked at, by the step of the harmonics.
const MULTIPLES: [i32; 4] = [1, 2, 3, 4];
/// How many times stronger than it seems two motions may be coupled.
const STRONGER: f64 = 10.0;
/// Share of a motion from which on a part of it is what another one mainly does.
const MIXED: f64 = 0.1;
/// Share from which on a part is as large as the motion itself, at the speeds of the range.
const AS_LARGE: f64 = 0.5;
/// What it costs to take that part for the other one, as long as the motion itself is like it.
const OTHER: f64 = 0.5;
/// Cost from which on modes of two speeds are not one.
const UNLIKE: f64 = 0.9;

/// A motion as what it mainly is, or as a part of it that is what another one mainly is.
#[derive(Clone)]
pub(super) struct Taken {
    mode: Mode,
    /// λ, with the frequency of that part (1/s).
    pub(super) value: Complex64,
    is_part: bool,
}

/// Two motions at a speed, or one twice.
#[derive(Clone)]
pub(super) struct Met {
    pub(super) speed: f64,
    pub(super) pair: [Taken; 2],
    /// ω + ω′ − nΩ (rad/s), 0 where they stay together.
    pub(super) off: f64,
    /// The larger Re λ of both, less what may be rounding of it (1/s).
    pub(super) growth: f64,
}

/// Two motions whose frequencies add up to n Ω between two speeds.
pub(super) struct Meeting {
    order: f64,
    is_one: bool,
    pub(super) ends: [Met; 2],
}

impl Taken {
    fn new(mode: &Mode, frequency: f64) -> Taken {
        let value = Complex64::new(mode.value.re, frequency);
        Taken { mode: mode.clone(), value, is_part: value != mode.value }
    }

    /// All that a motion may be taken for.
    fn all(mode: &Mode) -> impl Iterator<Item = Taken> {
        let parts = mode.beside.iter().filter(|own| own.1 >= AS_LARGE).map(|own| own.0);
        std::iter::once(mode.value.im).chain(parts).map(|frequency| Taken::new(mode, frequency))
    }
}

impl Met {
    fn new(point: &Point, order: f64, pair: [Taken; 2]) -> Met {
        let [one, other] = &pair;
        let off = one.value.im + other.value.im - order * point.speed.abs();
        let is_together = off.abs() <= LOCKED * one.value.norm().max(other.value.norm());
        Met {
            speed: point.speed,
            off: if is_together { 0.0 } else { off },
            growth: one.mode.growth().max(other.mode.growth()),
            pair,
        }
    }

    /// Whether one of both grows as they feed each other, not by itself or with a third one.
    pub(super) fn grows(&self) -> bool {
        self.growth > 0.0 && self.off.abs() <= self.rates_apart()
    }

    /// By how much one of both grows faster than the other one (1/s).
    pub(super) fn rates_apart(&self) -> f64 {
        let [one, other] = self.pair.each_ref().map(|own| own.value.re);
        (one - other).abs()
    }

    /// The largest rate (1/s) with which both can feed each other, by the parts of each that move as the other one does.
    fn coupling(&self, order: f64) -> f64 {
        if self.off == 0.0 || self.pair.iter().any(|own| own.is_part) {
            return f64::INFINITY;
        }
        let part = |own: &Taken| part_of(&own.mode, (order * self.speed).abs() - own.value.im);
        let [one, other] = self.pair.each_ref().map(part);
        one.max(other) * self.off.abs()
    }
}

/// The share of a motion that moves with a frequency besides.
fn part_of(mode: &Mode, frequency: f64) -> f64 {
    let is_it = |own: &&(f64, f64)| (own.0 - frequency.abs()).abs() <= LOCKED * mode.value.norm();
    mode.beside.iter().filter(is_it).map(|own| own.1).fold(0.0, f64::max)
}

impl Meeting {
    /// Whether it is that of the same motions.
    fn is(&self, other: &Meeting) -> bool {
        let same = |one: &Met, other: &Met| {
            let [a, b] = [one, other].map(|own| own.pair.each_ref().map(|own| own.value));
            a == b || a == [b[1], b[0]]
        };
        let pairs = self.ends.iter().zip(&other.ends);
        self.order == other.order && pairs.into_iter().all(|(one, other)| same(one, other))
    }

    /// Whether both may feed each other faster than they die out.
    fn may_grow(&self) -> bool {
        let coupling = self.ends.iter().map(|own| own.coupling(self.order)).fold(0.0, f64::max);
        let damped = self.ends.iter().map(|own| {
            let [one, other] = own.pair.each_ref().map(|own| (-own.value.re).max(0.0));
            (one * other).sqrt()
        });
        STRONGER * coupling >= damped.fold(f64::INFINITY, f64::min)
    }

    /// The same two motions at a speed between: those most like the nearer end, or with a part that is.
    pub(super) fn at(&self, point: &Point, like: &Met) -> Option<Met> {
        let modes = &point.modes.oscillating;
        let moved = apply_all(&point.mass, like.pair.iter().map(|own| own.mode.shape.as_slice()));
        // What it costs to take a mode for one of both, and as what it is taken then.
        let taken = |which: usize, mode: &Mode| -> (f64, f64) {
            let own = &like.pair[which];
            let apart = |frequency: f64| {
                let change = Complex64::new(mode.value.re, frequency) - own.value;
                change.norm() / own.value.norm()
            };
            let unlike = if own.is_part { OTHER } else { 1.0 - mac(&moved[which], &mode.shape) };
            let itself = (unlike + apart(mode.value.im), mode.value.im);
            let other = (self.order * point.speed).abs() - mode.value.im;
            let by_part = (OTHER + apart(other), other);
            match part_of(mode, other) >= MIXED && by_part.0 < itself.0 {
                true => by_part,
                false => itself,
            }
        };
        let costs: [Vec<(f64, f64)>; 2] =
            [0, 1].map(|which| modes.iter().map(|mode| taken(which, mode)).collect());
        let places = 0..modes.len();
        let pairs = places.clone().flat_map(|i| places.clone().map(move |j| (i, j)));
        let (i, j) = pairs.filter(|(i, j)| (i == j) == self.is_one).min_by(|a, b| {
            let cost = |own: &(usize, usize)| costs[0][own.0].0 + costs[1][own.1].0;
            cost(a).total_cmp(&cost(b))
        })?;
        let pair = [Taken::new(&modes[i], costs[0][i].1), Taken::new(&modes[j], costs[1][j].1)];
        let mut met = Met::new(point, self.order, pair);
        if self.is_one && met.off == 0.0 {
            // One motion that stays with itself is two of one frequency.
            let same =
                |own: &&Mode| (own.value.im - modes[i].value.im).abs() <= LOCKED * own.value.norm();
            let all = modes.iter().filter(same).map(Mode::growth);
            met.growth = all.fold(met.growth, f64::max);
        }
        Some(met)
    }
}

/// Modes of two speeds that may be one: of each the most alike of the other speed. Where two motions are locked to each other there
/// is one more, so that not each has its own.
fn alike([a, b]: [&Point; 2]) -> Vec<[&Mode; 2]> {
    let [from, to] = [a, b].map(|own| own.modes.oscillating.as_slice());
    let moved = apply_all(&a.mass, from.iter().map(|own| own.shape.as_slice()));
    let cost = |i: usize, j: usize| {
        let apart = (from[i].value - to[j].value).norm() / from[i].value.norm();
        1.0 - mac(&moved[i], &to[j].shape) + apart
    };
    let best = |costs: &mut dyn Iterator<Item = (f64, [usize; 2])>| {
        costs.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|own| own.0 < UNLIKE).map(|own| own.1)
    };
    let forth =
        (0..from.len()).filter_map(|i| best(&mut (0..to.len()).map(|j| (cost(i, j), [i, j]))));
    let back =
        (0..to.len()).filter_map(|j| best(&mut (0..from.len()).map(|i| (cost(i, j), [i, j]))));
    let mut all: Vec<[usize; 2]> = forth.chain(back).collect();
    all.sort_unstable();
    all.dedup();
    all.into_iter().map(|[i, j]| [&from[i], &to[j]]).collect()
}

/// Motions that meet between two speeds of the range and may grow there.
pub(super) fn meetings(ends: [&Point; 2]) -> Vec<Meeting> {
    let both = alike(ends);
    let harmonics = ends[0].harmonics.or(ends[1].harmonics).unwrap_or(1);
    let mut orders: Vec<i32> = MULTIPLES.iter().map(|own| own * harmonics).collect();
    orders.push(2);
    orders.sort_unstable();
    orders.dedup();
    let mut found: Vec<Meeting> = Vec::new();
    for order in orders.into_iter().map(f64::from) {
        for (i, one) in both.iter().enumerate() {
            for (j, other) in both.iter().enumerate().skip(i) {
                let met = |end: usize| -> Vec<Met> {
                    let (one, other) = (Taken::all(one[end]), || Taken::all(other[end]));
                    let same = |a: &Taken, b: &Taken| i != j || a.value == b.value;
                    let pairs = one.flat_map(|a| other().map(move |b| [a.clone(), b]));
                    let pairs = pairs.filter(|[a, b]| same(a, b));
                    pairs.map(|pair| Met::new(ends[end], order, pair)).collect()
                };
                let (first, last) = (met(0), met(1));
                let all = first.iter().flat_map(|a| last.iter().map(|b| [a.clone(), b.clone()]));
                // One that is locked to itself is two there.
                let is_one = (0..2).any(|end| std::ptr::eq(one[end], other[end]));
                let all = all.map(|ends| Meeting { order, is_one, ends });
                let meets = |own: &Meeting| own.ends[0].off * own.ends[1].off <= 0.0;
                for own in all.filter(|own| meets(own) && own.may_grow()) {
                    if found.iter().all(|other| !other.is(&own)) {
                        found.push(own);
                    }
                }
            }
        }
    }
    found
}

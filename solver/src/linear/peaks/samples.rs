//! A response at as many speeds as it takes to bracket its peaks: beside each damped critical speed in steps of its width, and
//! over the whole range.

use super::over::{Amplitude, Over, PROMINENT};
use crate::error::Error;
use crate::linear::resonances::Resonance;

/// Steps over the range, for what is as wide.
const STEPS: usize = 48;
/// Distances from a critical speed in half widths; beyond, each is twice the one before.
const BESIDE: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// The first distance from an undamped one, as a share of it.
const NEAR: f64 = 1e-5;
/// Share of its step by which a speed must be away from finer ones.
const APART: f64 = 0.1;
/// Distances from the ends of the range in steps: a response that rises from there has its peak within.
const ENDS: [f64; 3] = [0.0, 1e-3, 0.1];

/// The speeds (rad/s), rising.
pub(super) fn spread(resonances: &[Resonance], poles: &[f64], range: [f64; 2]) -> Vec<f64> {
    let [first, last] = range;
    let step = (last - first) / STEPS as f64;
    // Each with how far from others it has to be.
    let mut all: Vec<(f64, f64)> =
        (1..STEPS).map(|k| (first + step * k as f64, APART * step)).collect();
    for own in ENDS {
        all.extend([(first + own * step, 0.0), (last - own * step, 0.0)]);
    }
    let mut around = |speed: f64, width: f64, begin: &[f64]| {
        let mut distances: Vec<f64> = begin.iter().map(|own| own * width).collect();
        let mut next = 2.0 * width;
        while next < step {
            distances.push(next);
            next *= 2.0;
        }
        for own in distances {
            let apart = APART * own.max(BESIDE[0] * width);
            all.extend([(speed - own, apart), (speed + own, apart)]);
        }
    };
    for own in resonances.iter().filter(|own| !own.is_undamped()) {
        around(own.speed, own.half_width, &[&[0.0], &BESIDE[..]].concat());
    }
    for pole in poles {
        around(*pole, NEAR * pole.abs(), &[1.0]);
    }
    // So near to what has no damping rounding excites it, too.
    let undamped: Vec<f64> =
        resonances.iter().filter(|own| own.is_undamped()).map(|own| own.speed).collect();
    let is_rounding =
        |speed: f64| undamped.iter().any(|own| (own - speed).abs() < 0.9 * NEAR * own.abs());
    all.retain(|own| (first..=last).contains(&own.0) && !is_rounding(own.0));
    all.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.total_cmp(&b.0)));
    let mut kept: Vec<f64> = Vec::with_capacity(all.len());
    for (speed, apart) in all {
        let place = kept.partition_point(|own| *own < speed);
        let beside = [place.checked_sub(1), Some(place)].into_iter().flatten();
        let is_near = |own: &f64| (own - speed).abs() <= apart;
        if !beside.filter_map(|own| kept.get(own)).any(is_near) {
            kept.insert(place, speed);
        }
    }
    kept
}

/// A speed with the response there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub(super) speed: f64,
    pub(super) own: f64,
    pub(super) largest: f64,
}

/// The response at speeds, rising; where the machine does not stand it is not a number.
pub(super) struct Samples(Vec<Sample>);

impl Samples {
    pub(super) fn new(response: &mut Over, speeds: &[f64]) -> Result<Samples, Error> {
        let sample = |speed: &f64| -> Result<Sample, Error> {
            let Amplitude { own, largest } =
                response(*speed)?.unwrap_or(Amplitude { own: f64::NAN, largest: f64::NAN });
            Ok(Sample { speed: *speed, own, largest })
        };
        Ok(Samples(speeds.iter().map(sample).collect::<Result<_, _>>()?))
    }

    pub(super) fn at(&self, place: usize) -> Sample {
        self.0[place]
    }

    /// Places of values that are larger than the one before and not smaller than the next.
    pub(super) fn maxima(&self) -> Vec<usize> {
        let of = |place: usize| self.0[place].own;
        let inner = 1..self.0.len().saturating_sub(1);
        inner.filter(|&k| of(k) > of(k - 1) && of(k) >= of(k + 1)).collect()
    }

    /// Share of a maximum by which the response falls on both sides before it is larger than there, or the range ends.
    pub(super) fn prominence(&self, place: usize) -> f64 {
        let top = self.0[place].own;
        let falls = |outwards: &mut dyn Iterator<Item = (f64, f64)>| {
            let lower = outwards.map(|own| own.1).take_while(|own| *own <= top);
            1.0 - lower.fold(top, f64::min) / top
        };
        falls(&mut self.below(place)).min(falls(&mut self.above(place)))
    }

    /// Speeds and values below a place, downwards, as far as there are any.
    pub(super) fn below(&self, place: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        outwards(self.0[..place].iter().rev())
    }

    /// Speeds and values above a place.
    pub(super) fn above(&self, place: usize) -> impl Iterator<Item = (f64, f64)> + '_ {
        outwards(self.0[place + 1..].iter())
    }

    /// The first or the last sample, if no other is larger but for what is too flat for a peak, and the response varies at all.
    pub(super) fn largest_at_an_end(&self) -> Option<Sample> {
        let there: Vec<&Sample> = self.0.iter().filter(|own| !own.own.is_nan()).collect();
        let [first, inner @ .., last] = there.as_slice() else { return None };
        let most = inner.iter().map(|own| own.own).fold(0.0, f64::max);
        let least = inner.iter().map(|own| own.own).fold(f64::INFINITY, f64::min);
        let end = if first.own > last.own { first } else { last };
        let flat = end.own * PROMINENT;
        (end.own + flat >= most && end.own - flat > least).then_some(**end)
    }
}

fn outwards<'a>(all: impl Iterator<Item = &'a Sample> + 'a) -> impl Iterator<Item = (f64, f64)> {
    all.take_while(|own| !own.own.is_nan()).map(|own| (own.speed, own.own))
}

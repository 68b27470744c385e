//! Peaks of a response over speed, and how sharp they are.
//!
//! Damped critical speeds with their widths ([`Resonance`]) → the response beside them and over the whole range ([`samples`]) →
//! local maxima, each refined on the response itself, with the speeds of half power ([`search`]).

mod over;
mod samples;
mod search;
#[cfg(test)]
mod tests;

pub use self::over::Amplitude;
use self::over::{Over, PROMINENT};
use self::samples::{Samples, spread};
use self::search::{crossing, dip, maximum};
use super::resonances::Resonance;
use crate::error::Error;

/// The share by which a response has to fall on both sides of a peak, by the relative width of that: what rounding excites of a mode
/// that nothing excites is large only where it is narrow.
const EXCITED: f64 = 1e-9;
/// Share of the largest response of the same kind at the same speed below which one is rounding.
const ROUNDING: f64 = 1e-8;
/// Times by which the response to what excites an undamped mode grows at least where its distance falls to a tenth.
const DIVERGES: f64 = 3.0;
/// How much more than what is wanted a least value between samples may be, to be looked at closely.
const NEAR: f64 = 1.2;
/// Share of an undamped critical speed at which that is looked at.
const BESIDE: f64 = 1e-6;

/// Where a response is largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// rad/s.
    pub speed: f64,
    /// In the unit of the response; infinite without damping.
    pub height: f64,
    /// Speeds on both sides at which it is 1/√2 of that (rad/s), where it falls so far before it rises again or the range ends.
    pub half_power: [Option<f64>; 2],
}

impl Peak {
    /// Amplification factor N_c/(N₂ − N₁); N_c/(2 |N_c − N₁|) where it falls so far on one side only, infinite without damping.
    pub fn amplification(&self) -> Option<f64> {
        let width = match self.half_power {
            _ if self.is_undamped() => 0.0,
            [Some(below), Some(above)] => above - below,
            [Some(side), None] | [None, Some(side)] => 2.0 * (self.speed - side),
            [None, None] => return None,
        };
        Some((self.speed / width).abs())
    }

    /// Whether nothing but rounding limits it.
    pub fn is_undamped(&self) -> bool {
        self.height.is_infinite()
    }
}

/// The peaks of a response.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Peaks {
    /// By rising speed.
    pub all: Vec<Peak>,
    /// The end of the range at which the response is larger than anywhere else in it, with how large it is there.
    pub end: Option<(f64, f64)>,
}

/// The peaks of a response within a range: true local maxima, whatever speeds a table has. The largest value of a range that is
/// at an end of it is no peak.
///
/// # Errors
/// Those of `response`.
pub fn peaks(
    response: &mut Over,
    resonances: &[Resonance],
    range: [f64; 2],
) -> Result<Peaks, Error> {
    let mut poles = Vec::new();
    for own in resonances.iter().filter(|own| own.is_undamped()) {
        if diverges(response, own.speed, range)? {
            poles.push(own.speed);
        }
    }
    poles.sort_by(f64::total_cmp);
    poles.dedup_by(|b, a| (*b - *a).abs() <= BESIDE * a.abs());
    let samples = Samples::new(response, &spread(resonances, &poles, range))?;
    let undamped =
        |speed: &f64| Peak { speed: *speed, height: f64::INFINITY, half_power: [None, None] };
    let mut all: Vec<Peak> = poles.iter().map(undamped).collect();
    for place in samples.maxima() {
        let [a, b, c] = [place - 1, place, place + 1].map(|place| samples.at(place));
        let is_pole = |pole: &f64| (a.speed..=c.speed).contains(pole);
        let width = (c.speed - a.speed) / b.speed.abs();
        let falls = samples.prominence(place);
        let is_real = falls > PROMINENT.max(EXCITED / width) && b.own > ROUNDING * b.largest;
        if poles.iter().any(is_pole) || !is_real {
            continue;
        }
        let Some((speed, height)) = maximum(response, [a, b, c].map(|own| (own.speed, own.own)))?
        else {
            continue;
        };
        let half_power = [
            half_power(response, (speed, height), &mut samples.below(place))?,
            half_power(response, (speed, height), &mut samples.above(place))?,
        ];
        all.push(Peak { speed, height, half_power });
    }
    all.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    let end = if poles.is_empty() { samples.largest_at_an_end() } else { None };
    let is_real = |own: &samples::Sample| own.own > ROUNDING * own.largest;
    Ok(Peaks { all, end: end.filter(is_real).map(|own| (own.speed, own.own)) })
}

/// Whether a response grows without limit towards a speed within the range.
fn diverges(response: &mut Over, speed: f64, range: [f64; 2]) -> Result<bool, Error> {
    if !(range[0]..=range[1]).contains(&speed) {
        return Ok(false);
    }
    for side in [-1.0, 1.0] {
        let mut at = |share: f64| response(speed + side * share * speed.abs());
        let (Some(near), Some(far)) = (at(BESIDE)?, at(10.0 * BESIDE)?) else { return Ok(false) };
        if near.own <= DIVERGES * far.own || near.own <= ROUNDING * near.largest {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The speed beside a peak at which the response is 1/√2 of it, if it falls so far before it rises again. `outwards`: what is
/// known of it from the peak on.
fn half_power(
    response: &mut Over,
    (speed, height): (f64, f64),
    outwards: &mut dyn Iterator<Item = (f64, f64)>,
) -> Result<Option<f64>, Error> {
    let wanted = height * std::f64::consts::FRAC_1_SQRT_2;
    let (mut earlier, mut before) = ((speed, height), (speed, height));
    for own in outwards {
        if own.1 <= wanted {
            return crossing(response, [before, own], wanted);
        }
        if own.1 > before.1 * (1.0 + PROMINENT) {
            // Between what is known it may have been there for a moment.
            let is_near = before.0 != speed && before.1 < NEAR * wanted;
            let Some(least) =
                (if is_near { dip(response, [earlier, before, own], wanted)? } else { None })
            else {
                break;
            };
            let outside = (least.0 - before.0) * (before.0 - speed) > 0.0;
            let from = if outside { before } else { earlier };
            return crossing(response, [from, least], wanted);
        }
        (earlier, before) = (before, own);
    }
    Ok(None)
}

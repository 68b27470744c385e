//! Where a response between known speeds is largest, and where it has a value.

use super::super::golden::golden_step;
use super::over::Over;
use crate::error::Error;

/// Share of a speed, and of what brackets a peak, to which it is found: near it the response is flat, so that rounding hides more.
const FOUND: f64 = 1e-9;
const OF_BRACKET: f64 = 1e-6;
/// Shares of a speed, and of a value, to which a crossing is found.
const CROSSED: [f64; 2] = [1e-11, 1e-10];
/// Share of a speed within which a response that falls and rises again has no value that matters.
const FLAT: f64 = 1e-6;
/// Evaluations of one search at most.
const TRIES: usize = 80;

/// The maximum between the outer of three speeds of which the middle one has the largest value, by Brent's method on 1/response²,
/// which beside a resonance is a parabola; none where the machine does not stand in between.
pub(super) fn maximum(
    response: &mut Over,
    [a, b, c]: [(f64, f64); 3],
) -> Result<Option<(f64, f64)>, Error> {
    let inverse = |own: f64| own.powi(-2);
    let finest = (OF_BRACKET * (c.0 - a.0)).min(FOUND * b.0.abs());
    let (mut low, mut high) = (a.0, c.0);
    let mut best = (b.0, inverse(b.1));
    let (mut second, mut third) = match a.1 > c.1 {
        true => ((a.0, inverse(a.1)), (c.0, inverse(c.1))),
        false => ((c.0, inverse(c.1)), (a.0, inverse(a.1))),
    };
    // The steps before the last, and the last.
    let mut steps = [c.0 - a.0, c.0 - a.0];
    for _ in 0..TRIES {
        let middle = 0.5 * (low + high);
        let finest = finest.max(4.0 * f64::EPSILON * best.0.abs());
        if (best.0 - middle).abs() <= 2.0 * finest - 0.5 * (high - low) {
            break;
        }
        let parabola = vertex(best, second, third).map(|own| own - best.0).filter(|step| {
            let next = best.0 + step;
            step.abs() < 0.5 * steps[0].abs() && next > low && next < high
        });
        let step = match parabola {
            // Not closer to an end than what can be told apart.
            Some(step)
                if best.0 + step - low < 2.0 * finest || high - best.0 - step < 2.0 * finest =>
            {
                finest.copysign(middle - best.0)
            }
            Some(step) => step,
            None => golden_step([low, best.0, high]),
        };
        steps = match parabola {
            Some(_) => [steps[1], step],
            None => [if best.0 < middle { high - best.0 } else { low - best.0 }, step],
        };
        let step = if step.abs() < finest { finest.copysign(step) } else { step };
        let speed = best.0 + step;
        let Some(found) = response(speed)? else { return Ok(None) };
        let next = (speed, inverse(found.own));
        if next.1 <= best.1 {
            if next.0 < best.0 {
                high = best.0;
            } else {
                low = best.0;
            }
            (third, second, best) = (second, best, next);
        } else {
            if next.0 < best.0 {
                low = next.0;
            } else {
                high = next.0;
            }
            if next.1 <= second.1 {
                (third, second) = (second, next);
            } else if next.1 <= third.1 {
                third = next;
            }
        }
    }
    Ok(Some((best.0, best.1.powf(-0.5))))
}

/// A speed with its response between the outer of three at which that is not above a value, where the middle one has the least of
/// them; none where it is nowhere seen to be, or the machine does not stand in between.
pub(super) fn dip(
    response: &mut Over,
    [a, b, c]: [(f64, f64); 3],
    wanted: f64,
) -> Result<Option<(f64, f64)>, Error> {
    let (mut low, mut high) = (a.0.min(c.0), a.0.max(c.0));
    let mut least = b;
    while least.1 > wanted && high - low > FLAT * least.0.abs() {
        let speed = least.0 + golden_step([low, least.0, high]);
        let Some(found) = response(speed)? else { return Ok(None) };
        let next = (speed, found.own);
        let (kept, other) = if next.1 < least.1 { (next, least) } else { (least, next) };
        if other.0 < kept.0 {
            low = other.0
        } else {
            high = other.0
        }
        least = kept;
    }
    Ok((least.1 <= wanted).then_some(least))
}

/// Of the parabola through three points.
fn vertex(b: (f64, f64), a: (f64, f64), c: (f64, f64)) -> Option<f64> {
    let (left, right) = ((b.0 - a.0) * (b.1 - c.1), (b.0 - c.0) * (b.1 - a.1));
    let own = b.0 - 0.5 * ((b.0 - a.0) * left - (b.0 - c.0) * right) / (left - right);
    own.is_finite().then_some(own)
}

/// Where the response has a value between two speeds, at the first of which it is larger, at the second not; none where the
/// machine does not stand in between.
pub(super) fn crossing(
    response: &mut Over,
    [a, b]: [(f64, f64); 2],
    wanted: f64,
) -> Result<Option<f64>, Error> {
    // 1/response² − 1/wanted² in units of the latter, beside a resonance nearly straight outside of its peak.
    let off = |own: f64| (wanted / own).powi(2) - 1.0;
    let (mut a, mut b) = ((a.0, off(a.1)), (b.0, off(b.1)));
    for k in 0..TRIES {
        if (b.0 - a.0).abs() <= CROSSED[0] * b.0.abs() || b.1.abs() <= CROSSED[1] {
            break;
        }
        // Every third speed halves what is left.
        let share = match a.1 / (a.1 - b.1) {
            own if own.is_finite() && k % 3 != 2 => own.clamp(1e-6, 1.0 - 1e-6),
            _ => 0.5,
        };
        let speed = a.0 + share * (b.0 - a.0);
        let Some(found) = response(speed)? else { return Ok(None) };
        let next = (speed, off(found.own));
        if next.1.abs() <= CROSSED[1] {
            return Ok(Some(speed));
        }
        if next.1 < 0.0 { a = next } else { b = next }
    }
    Ok(Some(if a.1.abs() < b.1.abs() { a.0 } else { b.0 }))
}

//! Peaks of a response over speed, and how sharp they are.

use crate::error::Error;

/// Share of a speed to which a peak is found.
const FOUND: f64 = 1e-8;
/// Evaluations of one search at most.
const TRIES: usize = 60;

/// Where a response is largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// rad/s.
    pub speed: f64,
    /// In the unit of the response.
    pub height: f64,
    /// Speeds on both sides at which it is 1/√2 of that (rad/s), where it falls so far within the range.
    pub half_power: [Option<f64>; 2],
}

impl Peak {
    /// Amplification factor N_c/(N₂ − N₁), where both sides are known.
    pub fn amplification(&self) -> Option<f64> {
        let [Some(below), Some(above)] = self.half_power else { return None };
        Some((self.speed / (above - below)).abs())
    }
}

/// The peak beside a speed within a range, none where the response only rises to an end of it. `width`: about the half width
/// of the peak. Near a peak 1/response² is a parabola over speed, by which it is sought.
///
/// # Errors
/// Those of `response`.
pub fn peak(
    response: &mut dyn FnMut(f64) -> Result<f64, Error>,
    (begin, width): (f64, f64),
    range: [f64; 2],
) -> Result<Option<Peak>, Error> {
    let inside = |speed: f64| speed.clamp(range[0], range[1]);
    let mut inverse = |speed: f64| response(speed).map(|own| own.powi(-2));
    let mut at = |speed: f64| Ok::<_, Error>((speed, inverse(speed)?));
    let step = width.max(1e-6 * begin.abs());
    let mut points = [at(inside(begin - step))?, at(inside(begin))?, at(inside(begin + step))?];
    // A bracket, with the lowest in the middle.
    let mut reach = step;
    for _ in 0..TRIES {
        let [a, b, c] = points;
        reach *= 1.6;
        if a.1 < b.1 && a.1 <= c.1 {
            if a.0 <= range[0] {
                return Ok(None);
            }
            points = [at(inside(a.0 - reach))?, a, b];
        } else if c.1 < b.1 {
            if c.0 >= range[1] {
                return Ok(None);
            }
            points = [b, c, at(inside(c.0 + reach))?];
        } else {
            break;
        }
    }
    let [mut a, mut b, mut c] = points;
    // What does not move at all has no peak.
    if !(b.1.is_finite() && b.1 <= a.1 && b.1 <= c.1 && a.0 < b.0 && b.0 < c.0) {
        return Ok(None);
    }
    for _ in 0..TRIES {
        if c.0 - a.0 <= FOUND * b.0.abs() {
            break;
        }
        let (left, right) = ((b.0 - a.0) * (b.1 - c.1), (b.0 - c.0) * (b.1 - a.1));
        let apart = left - right;
        let vertex = b.0 - 0.5 * ((b.0 - a.0) * left - (b.0 - c.0) * right) / apart;
        // Where that is no step, or too short a one to tell anything, into the longer side.
        let long = if b.0 - a.0 > c.0 - b.0 { a.0 } else { c.0 };
        let near = 0.1 * FOUND * b.0.abs();
        let usable = apart != 0.0 && vertex > a.0 && vertex < c.0;
        let next = match usable {
            true if (vertex - b.0).abs() > near => vertex,
            true => b.0 + (long - b.0).signum() * near.max(0.01 * (long - b.0).abs()),
            false => b.0 + 0.382 * (long - b.0),
        };
        let tried = at(next)?;
        if tried.1 <= b.1 {
            if tried.0 < b.0 {
                c = b
            } else {
                a = b
            }
            let moved = (tried.0 - b.0).abs();
            b = tried;
            if usable && moved <= FOUND * b.0.abs() {
                break;
            }
        } else if tried.0 < b.0 {
            a = tried;
        } else {
            c = tried;
        }
    }
    let mut half_power = [None, None];
    for (side, found) in half_power.iter_mut().enumerate() {
        let end = range[side];
        let sign = if side == 0 { -1.0 } else { 1.0 };
        // From the peak outwards until 1/response² is twice as large, then by bisection and secants within.
        let (mut near, mut stride) = (b, step);
        for _ in 0..TRIES {
            let far = at(inside(near.0 + sign * stride))?;
            if far.1 >= 2.0 * b.1 {
                *found = Some(crossing(&mut at, [near, far], 2.0 * b.1)?);
                break;
            }
            // Beyond a valley another peak begins.
            if far.0 == end || far.1 < near.1 {
                break;
            }
            near = far;
            stride *= 1.6;
        }
    }
    Ok(Some(Peak { speed: b.0, height: b.1.powf(-0.5), half_power }))
}

/// Where it is so large between two points.
fn crossing(
    at: &mut dyn FnMut(f64) -> Result<(f64, f64), Error>,
    [mut a, mut b]: [(f64, f64); 2],
    wanted: f64,
) -> Result<f64, Error> {
    for _ in 0..TRIES {
        if (b.0 - a.0).abs() <= 1e-11 * b.0.abs() {
            break;
        }
        let secant = a.0 + (wanted - a.1) / (b.1 - a.1) * (b.0 - a.0);
        let inner = (secant - a.0) / (b.0 - a.0);
        let next = a.0 + inner.clamp(0.02, 0.98) * (b.0 - a.0);
        let tried = at(next)?;
        if (tried.1 / wanted - 1.0).abs() < 1e-9 {
            return Ok(tried.0);
        }
        if tried.1 < wanted { a = tried } else { b = tried }
    }
    Ok(0.5 * (a.0 + b.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one mass with an unbalance: the peak is at ω/√(1 − 2ζ²), with a height of 1/(2ζ√(1 − ζ²)) eccentricities.
    #[test]
    fn peaks_of_one_mass_are_where_the_closed_form_has_them() {
        for (omega, zeta) in [(100.0_f64, 0.002_f64), (350.0, 0.05), (20.0, 0.3)] {
            let mut evaluations = 0;
            let mut response = |speed: f64| {
                evaluations += 1;
                let r = speed / omega;
                Ok(r * r / ((1.0 - r * r).powi(2) + (2.0 * zeta * r).powi(2)).sqrt())
            };
            let found = peak(&mut response, (1.001 * omega, zeta * omega), [0.0, 10.0 * omega]);
            let found = found.unwrap().expect("a peak");
            let exact = omega / (1.0 - 2.0 * zeta * zeta).sqrt();
            assert!((found.speed / exact - 1.0).abs() < 1e-6, "{zeta}: {found:?}");
            let height = 0.5 / (zeta * (1.0 - zeta * zeta).sqrt());
            assert!((found.height / height - 1.0).abs() < 1e-12, "{zeta}: {found:?}");
            if zeta < 0.01 {
                let factor = found.amplification().expect("both sides") * 2.0 * zeta;
                assert!((factor - 1.0).abs() < 1e-3, "{factor}");
            }
            for speed in found.half_power.into_iter().flatten() {
                let ratio = response(speed).unwrap() / found.height;
                assert!((ratio - 0.5_f64.sqrt()).abs() < 1e-6, "{zeta}: {ratio}");
            }
            assert!(evaluations < 80, "{evaluations}");
        }
        let mut stands = |_: f64| Ok(0.0);
        assert_eq!(peak(&mut stands, (5.0, 1.0), [1.0, 10.0]).unwrap(), None);
        let mut rises = |speed: f64| Ok(speed);
        assert_eq!(peak(&mut rises, (5.0, 1.0), [1.0, 10.0]).unwrap(), None);
    }
}

//! Numbers to the ten digits of a file, so that rows in memory are those that are read from one.

use super::text::{DIGITS, number};

/// Powers of ten that a double has exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];
/// Between this and ten times as much lie numbers of ten digits.
const LEAST: f64 = 1e9;
/// How far from the middle between two of them, and from those bounds, rounding is sure: a product of 2⁻⁵³·10¹⁰ is wrong by 1e-6.
const SURE: f64 = 1e-4;

/// What is read where `value` was written.
///
/// Of most numbers it is found without text: with 10ᵏ exact, v·10ᵏ is wrong by less than decides of its digits, and those
/// are a whole number, over or times 10ᵏ, that is rounded once, as a text is read.
pub(super) fn ten_digits(value: f64) -> f64 {
    let size = value.abs();
    if !(1e-12..1e30).contains(&size) {
        return by_text(value);
    }
    let power = DIGITS as i32 - size.log10().floor() as i32;
    let exact = POWERS[power.unsigned_abs() as usize % POWERS.len()];
    let scaled = if power >= 0 { size * exact } else { size / exact };
    let digits = scaled.round();
    let sure = (0.5 - (scaled - digits).abs()) > SURE
        && scaled > LEAST + SURE
        && scaled < 10.0 * LEAST - 1.0;
    if !sure || power.unsigned_abs() as usize >= POWERS.len() {
        return by_text(value);
    }
    let rounded = if power >= 0 { digits / exact } else { digits * exact };
    rounded.copysign(value)
}

fn by_text(value: f64) -> f64 {
    if value == 0.0 {
        return value;
    }
    let mut text = Vec::new();
    number(&mut text, value);
    let text = std::str::from_utf8(&text).expect("digits are ASCII");
    text.parse().expect("a number that was just written")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_what_writing_and_reading_gives() {
        let mut state = 11_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let wild: Vec<f64> = std::iter::repeat_with(|| {
            let (a, b) = (random(), random());
            (a - 0.5) * 10f64.powf(70.0 * b - 35.0)
        })
        .take(200_000)
        .collect();
        // Numbers of few digits, and those in the middle between two of ten.
        let tame = (0..2000).flat_map(|i| {
            let own = f64::from(i);
            [own, own / 8.0, own * 1e-6, (1e9 + own) * 1e-7 + 5e-8, 10f64.powi(i % 60 - 30)]
        });
        let edges = [0.0, 1e-300, 5e-324, f64::MAX, 9.9999999995, 9.99999999949999, 1e10 - 0.5];
        for value in wild.into_iter().chain(tame).chain(edges) {
            for value in [value, -value] {
                let (fast, text) = (ten_digits(value), by_text(value));
                assert_eq!(fast.to_bits(), text.to_bits(), "{value:e}: {fast:e}, {text:e}");
            }
        }
        assert!(ten_digits(f64::NAN).is_nan());
        assert_eq!(ten_digits(f64::NEG_INFINITY), f64::NEG_INFINITY);
    }
}

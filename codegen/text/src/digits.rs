//! Numbers without the digits that rounding and changes of units add.

use std::ops::Range;

/// A number to so many digits, one at least.
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}

/// Digits of numbers that people give.
const GIVEN: usize = 12;
/// Share of a number that changes of units, there and back, may add.
const CHANGED: f64 = 4.0 * f64::EPSILON;

/// A number of few digits as it was given, of which changes of units have left the last bits wrong; any other as it is.
pub fn as_given(value: f64) -> f64 {
    let own = rounded(value, GIVEN);
    if (own - value).abs() <= CHANGED * value.abs() { own } else { value }
}

/// A number to so many digits at most, without zeros behind them: plain where its size is in `plain`, elsewhere with
/// a power of ten.
pub fn shown(value: f64, digits: usize, plain: Range<f64>) -> String {
    let rounded = rounded(value, digits);
    if rounded == 0.0 || plain.contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_that_rounding_adds_are_not_shown() {
        let texts = [0.1 + 0.2, -1e-7 / 3.0, 0.0, 1e12, f64::INFINITY]
            .map(|value| shown(value, 6, 1e-4..1e9));
        assert_eq!(texts, ["0.3", "-3.33333e-8", "0", "1e12", "inf"]);
        assert_eq!(rounded(1_234.5, 1), 1_000.0);
    }
}

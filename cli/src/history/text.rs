//! Rows as lines of CSV.

use std::io::Write;

/// The line of names.
pub(super) fn head(names: &[String]) -> String {
    names.join(",") + "\n"
}

/// Adds a row as a line.
pub(super) fn line(text: &mut Vec<u8>, row: &[f64]) {
    for (place, value) in row.iter().enumerate() {
        if place > 0 {
            text.push(b',');
        }
        number(text, *value);
    }
    text.push(b'\n');
}

/// Significant digits after the first: two more than forces are compared with.
pub(super) const DIGITS: usize = 9;

/// Adds a number.
pub(super) fn number(text: &mut Vec<u8>, value: f64) {
    if value == 0.0 || !value.is_finite() {
        return write!(text, "{value}").expect("memory can be written");
    }
    // Of a number so small fewer digits than ten are its own.
    if value.abs() < 1e-300 {
        return write!(text, "{value:e}").expect("memory can be written");
    }
    let start = text.len();
    write!(text, "{value:.DIGITS$e}").expect("memory can be written");
    rearrange(text, start);
}

/// Turns what begins at `start`, such as `-1.500000000e-4`, into the shortest text of the same number, plain where it
/// is neither very small nor very large. (To print the number rounded to these digits costs three times as much.)
fn rearrange(text: &mut Vec<u8>, start: usize) {
    let negative = text[start] == b'-';
    let written = text.split_off(start + usize::from(negative));
    let (mantissa, exponent) = written.split_at(DIGITS + 2);
    let exponent = std::str::from_utf8(&exponent[1..]).ok().and_then(|digits| digits.parse().ok());
    let exponent: i32 = exponent.expect("an exponent after ten digits");
    let mut digits = [b'0'; DIGITS + 1];
    digits[0] = mantissa[0];
    digits[1..].copy_from_slice(&mantissa[2..]);
    let count = digits.iter().rposition(|digit| *digit != b'0').map_or(1, |last| last + 1);
    let digits = &digits[..count];
    match exponent {
        -4..0 => {
            text.extend_from_slice(b"0.");
            text.extend((exponent..-1).map(|_| b'0'));
            text.extend_from_slice(digits);
        }
        0..9 => {
            let whole = exponent as usize + 1;
            text.extend_from_slice(&digits[..whole.min(count)]);
            text.extend((count..whole).map(|_| b'0'));
            if count > whole {
                text.push(b'.');
                text.extend_from_slice(&digits[whole..]);
            }
        }
        _ => {
            text.push(digits[0]);
            if count > 1 {
                text.push(b'.');
                text.extend_from_slice(&digits[1..]);
            }
            write!(text, "e{exponent}").expect("memory can be written");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_digits_are_kept() {
        let mut text = head(&["t_s".to_string(), "RX1_N".to_string()]).into_bytes();
        for row in [[7.4e-5, -396.512345678912], [0.000148, 7.3059871e-20], [0.0, 1e12 / 3.0]] {
            line(&mut text, &row);
        }
        let expected = "t_s,RX1_N\n7.4e-5,-396.5123457\n0.000148,7.3059871e-20\n0,3.333333333e11\n";
        assert_eq!(String::from_utf8(text).unwrap(), expected);
    }

    #[test]
    fn numbers_are_the_shortest_of_their_ten_digits() {
        let expected = |value: f64| whirl_text::shown(value, DIGITS + 1, 1e-4..1e9);
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let edges = [
            0.0,
            -0.0,
            1.0,
            10.0,
            1e-4,
            9.9999999999e-5,
            9.99999999949e-5,
            1e9,
            999999999.99,
            123.0,
            1e300,
            5e-299,
        ];
        let wild = std::iter::repeat_with(|| {
            let (a, b) = (random(), random());
            (a - 0.5) * 10f64.powf(40.0 * b - 20.0)
        });
        for value in edges.into_iter().chain([f64::NAN, f64::INFINITY]).chain(wild.take(100_000)) {
            for value in [value, -value, (value * 8.0).round()] {
                let mut text = Vec::new();
                number(&mut text, value);
                assert_eq!(String::from_utf8(text).unwrap(), expected(value));
            }
        }
    }
}

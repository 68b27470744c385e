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
    if value < 0.0 {
        text.push(b'-');
    }
    place(text, &rounded(value.abs()));
}

/// Digits d₀d₁d₂… of d₀.d₁d₂… · 10^exponent.
struct Decimal {
    digits: [u8; DIGITS + 1],
    exponent: i32,
}

/// A positive number to ten digits, as its exact value is rounded.
fn rounded(value: f64) -> Decimal {
    if !SCALED.contains(&value) {
        return exactly(value);
    }
    let bits = value.to_bits();
    let significand = bits & ((1 << 52) - 1) | 1 << 52;
    let power = (bits >> 52) as i32 - 1023;
    // ⌊power · log₁₀ 2⌋, so that the number is at least 10^exponent and less than 2 · 10^(exponent + 1).
    let mut exponent = (power * 1233) >> 12;
    let scale = |exponent: i32| u128::from(significand) * TENS[(DIGITS as i32 - exponent) as usize];
    let mut scaled = scale(exponent);
    // The number times 10^(DIGITS − exponent) is `scaled` exactly, with `places` binary places.
    let places = 52 - power;
    if scaled >> places >= TENS[DIGITS + 1] {
        exponent += 1;
        scaled = scale(exponent);
    }
    let (whole, rest, half) =
        (scaled >> places, scaled & ((1 << places) - 1), 1_u128 << (places - 1));
    // Halves to even, as `{:e}` has them.
    let mut whole = whole as u64;
    whole += u64::from(rest > half || rest == half && whole % 2 == 1);
    if u128::from(whole) == TENS[DIGITS + 1] {
        whole /= 10;
        exponent += 1;
    }
    let mut digits = [b'0'; DIGITS + 1];
    for digit in digits.iter_mut().rev() {
        *digit += (whole % 10) as u8;
        whole /= 10;
    }
    Decimal { digits, exponent }
}

/// Where the number, scaled by a power of ten in [`TENS`] to ten whole digits, fits into 128 bits.
const SCALED: std::ops::Range<f64> = 1e-12..1e9;

const TENS: [u128; 23] = {
    let mut powers = [1; 23];
    let mut place = 1;
    while place < powers.len() {
        powers[place] = 10 * powers[place - 1];
        place += 1;
    }
    powers
};

/// The same by the exact value.
fn exactly(value: f64) -> Decimal {
    let written = format!("{value:.DIGITS$e}");
    let (mantissa, exponent) = written.split_once('e').expect("an exponent");
    let mut digits = [b'0'; DIGITS + 1];
    digits.iter_mut().zip(mantissa.bytes().filter(|byte| *byte != b'.')).for_each(|(d, b)| *d = b);
    Decimal { digits, exponent: exponent.parse().expect("a whole power of ten") }
}

/// Adds the shortest text of a number, plain where it is neither very small nor very large.
fn place(text: &mut Vec<u8>, Decimal { digits, exponent }: &Decimal) {
    let exponent = *exponent;
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
            // Halfway between two of ten digits.
            1234567890.5,
            1234567891.5,
            99999999995.0,
            0.5_f64.powi(34),
            // At the ends of what is scaled by whole numbers.
            1e-12,
            f64::from_bits(1e-12_f64.to_bits() - 1),
            9.9999999996e8,
            f64::from_bits(1e9_f64.to_bits() - 1),
            12345678.90625,
        ];
        let halfway = (0..20_000_u32).map(|k| (1e9 + f64::from(k) * 44_999.0).floor() + 0.5);
        let wild = std::iter::repeat_with(|| {
            let (a, b) = (random(), random());
            (a - 0.5) * 10f64.powf(40.0 * b - 20.0)
        });
        for value in edges
            .into_iter()
            .chain([f64::NAN, f64::INFINITY])
            .chain(halfway)
            .chain(wild.take(100_000))
        {
            for value in [value, -value, (value * 8.0).round()] {
                let mut text = Vec::new();
                number(&mut text, value);
                assert_eq!(String::from_utf8(text).unwrap(), expected(value));
            }
        }
    }
}

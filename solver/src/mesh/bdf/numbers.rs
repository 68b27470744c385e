//! Numbers as Nastran writes them: `1.5`, `1.5E3`, `1.5D3`, `1.5+3`.

/// Why a text is not a number that can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum WrongNumber {
    NoNumber,
    TooLarge,
}

/// Digits only.
pub(super) fn whole(text: &str) -> Option<u64> {
    let digits = text.strip_prefix('+').unwrap_or(text);
    let plain = !digits.is_empty() && digits.bytes().all(|c| c.is_ascii_digit());
    digits.parse().ok().filter(|_| plain)
}

/// Whether a number has a point or an exponent, as real numbers have and whole numbers have not.
pub(super) fn is_real(text: &str) -> bool {
    text.contains('.') && real(text).is_ok()
}

/// A finite number. Whole numbers are taken, too.
pub(super) fn real(text: &str) -> Result<f64, WrongNumber> {
    let numeric = |c: u8| c.is_ascii_digit() || b"+-.eEdD".contains(&c);
    if !text.bytes().all(numeric) || !text.bytes().any(|c| c.is_ascii_digit()) {
        return Err(WrongNumber::NoNumber);
    }
    let value = match text.parse::<f64>() {
        Ok(value) => value,
        Err(_) => with_exponent(text).ok_or(WrongNumber::NoNumber)?,
    };
    if value.is_finite() { Ok(value) } else { Err(WrongNumber::TooLarge) }
}

/// A number whose exponent follows a D, or nothing but its sign.
fn with_exponent(text: &str) -> Option<f64> {
    let plain = text.replace(['d', 'D', 'E'], "e");
    if plain.contains('e') {
        return plain.parse().ok();
    }
    let sign = 1 + plain.get(1..)?.rfind(['+', '-'])?;
    let (mantissa, exponent) = plain.split_at(sign);
    format!("{mantissa}e{exponent}").parse().ok()
}

#[cfg(test)]
mod tests {
    use super::{WrongNumber, real, whole};

    #[test]
    fn exponents_need_no_letter() {
        let cases = [
            ("1.5", 1.5),
            ("7", 7.0),
            (".5", 0.5),
            ("-3.", -3.0),
            ("1.5+3", 1500.0),
            ("-1.5-3", -0.0015),
            ("+1.5D+3", 1500.0),
            ("1.5e3", 1500.0),
            ("1.5d-3", 0.0015),
            ("2.1+11", 2.1e11),
        ];
        for (text, value) in cases {
            assert_eq!(real(text), Ok(value), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for text in [
            "", "x", "nan", "inf", "infinity", "1.5 +3", "+", "-", ".", "e5", "1+2+3", "0x1", "1e",
            "1-",
        ] {
            assert_eq!(real(text), Err(WrongNumber::NoNumber), "{text}");
        }
        assert_eq!(real("1.+999"), Err(WrongNumber::TooLarge));
        for text in ["", "-1", "1.", "+", "++1", "99999999999999999999"] {
            assert_eq!(whole(text), None, "{text}");
        }
        assert_eq!(whole("+12"), Some(12));
    }
}

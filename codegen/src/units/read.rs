//! The text of units and numbers.

use crate::rational::Rational;
use num_bigint::BigInt;
use num_traits::Zero;

use super::{Dimension, Exponent, Factor, UnitError};
use whirl_text::nearest;

use crate::diagnostic::{Code, suggest};

/// A power of a unit above this is a slip.
const LARGEST_POWER: i32 = 12;
/// Digits of a number; f64 keeps 17.
const MOST_DIGITS: usize = 60;
/// Power of ten of a number; f64 ends at 308.
const LARGEST_TEN: i32 = 308;
/// Letters and signs of a unit.
const LONGEST: usize = 100;

/// Every unit: name, power of ten of its factor to SI, dimension.
const UNITS: &[(&str, i32, Dimension)] = &[
    ("1", 0, Dimension::NUMBER),
    ("m", 0, Dimension::LENGTH),
    ("km", 3, Dimension::LENGTH),
    ("cm", -2, Dimension::LENGTH),
    ("mm", -3, Dimension::LENGTH),
    ("um", -6, Dimension::LENGTH),
    ("nm", -9, Dimension::LENGTH),
    ("kg", 0, Dimension::MASS),
    ("g", -3, Dimension::MASS),
    ("mg", -6, Dimension::MASS),
    ("t", 3, Dimension::MASS),
    ("s", 0, Dimension::TIME),
    ("ms", -3, Dimension::TIME),
    ("us", -6, Dimension::TIME),
    ("K", 0, Dimension::TEMPERATURE),
    ("rad", 0, Dimension::ANGLE),
    ("mrad", -3, Dimension::ANGLE),
    ("Hz", 0, Dimension::FREQUENCY),
    ("kHz", 3, Dimension::FREQUENCY),
    ("mN", -3, Dimension::FORCE),
    ("N", 0, Dimension::FORCE),
    ("kN", 3, Dimension::FORCE),
    ("MN", 6, Dimension::FORCE),
    ("J", 0, Dimension::TORQUE),
    ("kJ", 3, Dimension::TORQUE),
    ("mJ", -3, Dimension::TORQUE),
    ("mPa", -3, Dimension::PRESSURE),
    ("Pa", 0, Dimension::PRESSURE),
    ("kPa", 3, Dimension::PRESSURE),
    ("MPa", 6, Dimension::PRESSURE),
    ("GPa", 9, Dimension::PRESSURE),
    ("bar", 5, Dimension::PRESSURE),
    ("A", 0, Dimension::CURRENT),
    ("mA", -3, Dimension::CURRENT),
    ("V", 0, Dimension::VOLTAGE),
    ("mV", -3, Dimension::VOLTAGE),
    ("kV", 3, Dimension::VOLTAGE),
    ("Ohm", 0, Dimension::RESISTANCE),
    ("Ω", 0, Dimension::RESISTANCE),
    ("H", 0, Dimension::INDUCTANCE),
    ("mH", -3, Dimension::INDUCTANCE),
    ("uH", -6, Dimension::INDUCTANCE),
    ("Wb", 0, Dimension::FLUX),
    ("T", 0, Dimension::FLUX_DENSITY),
    ("mT", -3, Dimension::FLUX_DENSITY),
];

fn pound() -> Factor {
    Factor::ratio(45_359_237, 100_000_000)
}

fn pound_force() -> Factor {
    pound().times(&Factor::ratio(980_665, 100_000))
}

fn unit_named(name: &str) -> Option<(Factor, Dimension)> {
    let half_turn = || Factor::pi().over(&Factor::ratio(180, 1));
    match name {
        "deg" | "°" => return Some((half_turn(), Dimension::ANGLE)),
        "rpm" => return Some((Factor::pi().over(&Factor::ratio(30, 1)), Dimension::ANGULAR_SPEED)),
        "min" => return Some((Factor::ratio(60, 1), Dimension::TIME)),
        // By definition: the inch is 25.4 mm, the pound 0.453 592 37 kg, standard gravity 9.806 65 m/s².
        "in" => return Some((Factor::ratio(254, 10_000), Dimension::LENGTH)),
        "mil" => return Some((Factor::ratio(254, 10_000_000), Dimension::LENGTH)),
        "ft" => return Some((Factor::ratio(3048, 10_000), Dimension::LENGTH)),
        "lb" => return Some((pound(), Dimension::MASS)),
        "lbf" => return Some((pound_force(), Dimension::FORCE)),
        "psi" | "ksi" => {
            let inch = Factor::ratio(254, 10_000);
            let psi = pound_force().over(&inch).over(&inch);
            let thousand = Factor::ten(if name == "ksi" { 3 } else { 0 });
            return Some((psi.times(&thousand), Dimension::PRESSURE));
        }
        "L" => {
            return Some((
                Factor::ten(-3),
                Dimension::LENGTH.times(&Dimension::LENGTH).times(&Dimension::LENGTH),
            ));
        }
        "mL" => {
            return Some((
                Factor::ten(-6),
                Dimension::LENGTH.times(&Dimension::LENGTH).times(&Dimension::LENGTH),
            ));
        }
        "Gal" => return Some((Factor::ten(-2), Dimension::ACCELERATION)),
        "W" => return Some((Factor::one(), Dimension::TORQUE.over(&Dimension::TIME))),
        "kW" => return Some((Factor::ten(3), Dimension::TORQUE.over(&Dimension::TIME))),
        _ => {}
    }
    let micro = (name.strip_prefix('µ').or(name.strip_prefix('μ'))).map(|rest| format!("u{rest}"));
    let name = micro.as_deref().unwrap_or(name);
    (UNITS.iter().find(|(known, _, _)| *known == name))
        .map(|(_, ten, dimension)| (Factor::ten(*ten), *dimension))
}

/// Units in full, with what to write for them.
const SPELLED_OUT: &[(&str, &str)] = &[
    ("metre", "m"),
    ("meter", "m"),
    ("millimetre", "mm"),
    ("millimeter", "mm"),
    ("micrometre", "um"),
    ("micrometer", "um"),
    ("micron", "um"),
    ("second", "s"),
    ("millisecond", "ms"),
    ("minute", "min"),
    ("kilogram", "kg"),
    ("gram", "g"),
    ("tonne", "t"),
    ("newton", "N"),
    ("pascal", "Pa"),
    ("joule", "J"),
    ("watt", "W"),
    ("ampere", "A"),
    ("volt", "V"),
    ("henry", "H"),
    ("weber", "Wb"),
    ("tesla", "T"),
    ("kelvin", "K"),
    ("radian", "rad"),
    ("degree", "deg"),
    ("hertz", "Hz"),
    ("inches", "in"),
    ("pound", "lb"),
];

/// What to write for a unit that was written in full.
fn spelled_out(name: &str) -> Option<String> {
    let name = name.to_lowercase();
    let word =
        nearest(name.strip_suffix('s').unwrap_or(&name), SPELLED_OUT.iter().map(|(w, _)| *w))?;
    let (_, unit) = SPELLED_OUT.iter().find(|(known, _)| *known == word)?;
    // Short names are near to each other: these are units misspelt.
    (name.len() > 4).then(|| format!("write `{unit}`"))
}

fn error(code: Code, span: std::ops::Range<usize>, message: impl Into<String>) -> UnitError {
    UnitError { span, message: message.into(), help: None, code }
}

/// Splits off the first token of `text` made of characters that satisfy `wanted`.
fn take(text: &str, wanted: impl Fn(char) -> bool) -> (&str, &str) {
    let end = text.find(|c| !wanted(c)).unwrap_or(text.len());
    text.split_at(end)
}

/// Reads a unit; `start` is the byte at which `text` begins, for the spans of errors.
pub(super) fn unit(text: &str, start: usize) -> Result<(Factor, Dimension), UnitError> {
    let whole = text;
    let at = |rest: &str| start + whole.len() - rest.len();
    if text.len() > LONGEST {
        let span = start..start + text.len();
        return Err(error(Code::UNKNOWN_UNIT, span, "this is too long for a unit"));
    }
    let mut factor = Factor::one();
    let mut dimension = Dimension::NUMBER;
    let mut divide = false;
    let mut rest = text.trim_start();
    loop {
        let here = at(rest);
        let (name, after) = if rest.starts_with('1') {
            rest.split_at(1)
        } else {
            take(rest, |c| c.is_alphabetic() || c == '°')
        };
        if name.is_empty() {
            let width = rest.chars().next().map_or(0, char::len_utf8);
            let mut missing = error(Code::UNKNOWN_UNIT, here..here + width, "expected a unit");
            missing.help = Some("such as `mm`, `N*s/m`, or `1` for a pure number".to_owned());
            return Err(missing);
        }
        let Some((mut f, mut d)) = unit_named(name) else {
            let mut known: Vec<&str> = UNITS.iter().map(|(known, _, _)| *known).collect();
            known.extend(["deg", "rpm", "min", "W", "kW", "L", "mL"]);
            known.extend(["in", "mil", "ft", "lb", "lbf", "psi", "ksi", "Gal"]);
            let mut unknown = error(
                Code::UNKNOWN_UNIT,
                here..here + name.len(),
                format!("unknown unit `{name}`"),
            );
            unknown.help = spelled_out(name).or_else(|| suggest(name, &known));
            return Err(unknown);
        };
        rest = after.trim_start();
        if let Some((power, after)) = power(rest, at(rest))? {
            f = f.power(power);
            d = d.power(power);
            rest = after.trim_start();
        }
        (factor, dimension) = if divide {
            (factor.over(&f), dimension.over(&d))
        } else {
            (factor.times(&f), dimension.times(&d))
        };
        let mut characters = rest.chars();
        divide = match characters.next() {
            None if dimension.is_sane() => return Ok((factor, dimension)),
            None => {
                let span = start..start + whole.len();
                return Err(error(
                    Code::UNKNOWN_UNIT,
                    span,
                    "the powers of this unit are too high",
                ));
            }
            Some('*' | '·' | '⋅') => false,
            Some('/') => true,
            Some(other) => {
                let here = at(rest);
                return Err(error(
                    Code::UNKNOWN_UNIT,
                    here..here + other.len_utf8(),
                    "expected `*`, `/` or the end of the unit",
                ));
            }
        };
        rest = characters.as_str().trim_start();
    }
}

/// Reads `^2`, `^-1`, `^1.5`, `^(3/2)`, `²` or `³`, and what follows.
fn power(text: &str, start: usize) -> Result<Option<(Exponent, &str)>, UnitError> {
    for (sign, power) in [('²', 2), ('³', 3)] {
        if let Some(rest) = text.strip_prefix(sign) {
            return Ok(Some((Exponent::from_integer(power), rest)));
        }
    }
    let Some(after) = text.strip_prefix('^') else {
        return Ok(None);
    };
    let (digits, rest) = match after.strip_prefix('(').and_then(|a| a.split_once(')')) {
        Some(inside) => inside,
        None => take(after, |c| c.is_ascii_digit() || matches!(c, '.' | '-')),
    };
    let span = start..start + text.len() - rest.len();
    let Some(exponent) = small_rational(digits.trim()) else {
        let message = "expected a power after `^`, such as `^2` or `^1.5`";
        return Err(error(Code::UNKNOWN_UNIT, span, message));
    };
    if exponent.numer().abs() > LARGEST_POWER * exponent.denom()
        || *exponent.denom() > LARGEST_POWER
    {
        let message = format!("a power of a unit is at most {LARGEST_POWER}");
        return Err(error(Code::UNKNOWN_UNIT, span, message));
    }
    Ok(Some((exponent, rest)))
}

/// `-2`, `1.5` or `3/2`, of at most three digits on each side.
fn small_rational(text: &str) -> Option<Exponent> {
    let (sign, text) = match text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, text),
    };
    let integer = |digits: &str| -> Option<i32> {
        let fine = (1..=3).contains(&digits.len()) && digits.bytes().all(|b| b.is_ascii_digit());
        if fine { digits.parse().ok() } else { None }
    };
    let (n, d) = if let Some((n, d)) = text.split_once('/') {
        (integer(n)?, integer(d)?)
    } else if let Some((whole, part)) = text.split_once('.') {
        let d = 10i32.pow(u32::try_from(part.len()).ok().filter(|n| *n <= 3)?);
        (integer(whole)? * d + integer(part)?, d)
    } else {
        (integer(text)?, 1)
    };
    (d != 0).then(|| Exponent::new(sign * n, d))
}

/// Reads a decimal number at the start of `text`, and where it ends.
pub(super) fn number(text: &str) -> Result<(Rational, usize), UnitError> {
    let body = text.trim_start();
    let start = text.len() - body.len();
    let unsigned = body.strip_prefix(['-', '+']).unwrap_or(body);
    let Some((value, length)) = decimal(unsigned) else {
        let span = start..start + body.chars().next().map_or(0, char::len_utf8);
        let mut missing = error(Code::BAD_VALUE, span, "expected a number");
        missing.help = Some("write a number and a unit, such as `1 mm`".to_owned());
        return Err(missing);
    };
    let end = text.len() - unsigned.len() + length;
    let Some(value) = value else {
        let message = "the number is too large or too long";
        return Err(error(Code::BAD_VALUE, start..end, message));
    };
    let value = if body.starts_with('-') { -value } else { value };
    Ok((value, end))
}

/// The decimal number at the start of `text` exactly, and its length in bytes: digits, optionally a
/// point and digits, optionally `e` and a power of ten. `None` inside if it is beyond the limits.
pub(crate) fn decimal(text: &str) -> Option<(Option<Rational>, usize)> {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(text);
    if whole == 0 {
        return None;
    }
    let mut length = whole;
    let mut fraction = 0;
    if text[length..].starts_with('.') {
        fraction = digits(&text[length + 1..]);
        if fraction > 0 {
            length += 1 + fraction;
        }
    }
    let mantissa: String = text[..length].chars().filter(|c| *c != '.').collect();
    let mut ten = Some(0);
    if text[length..].starts_with(['e', 'E']) {
        let after = &text[length + 1..];
        let sign = usize::from(after.starts_with(['-', '+']));
        let count = digits(&after[sign..]);
        if count > 0 {
            ten = after[..sign + count].parse::<i32>().ok();
            length += 1 + sign + count;
        }
    }
    let ten = ten.filter(|ten| ten.abs() <= LARGEST_TEN && mantissa.len() <= MOST_DIGITS);
    let value = ten.map(|ten| {
        let integer = match mantissa.parse::<u64>() {
            Ok(integer) => integer.into(),
            Err(_) => Rational::from(mantissa.parse().unwrap_or_else(|_| BigInt::zero())),
        };
        let shift = ten - i32::try_from(fraction).unwrap_or(0);
        integer * Rational::ten(shift)
    });
    Some((value, length))
}

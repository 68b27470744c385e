//! Ranges of values: `20 um .. 60 um, 9`, and with `log` in equal ratios.

use std::ops::Range as Span;

use whirl_codegen::diagnostic::{Code, Diagnostic};
use whirl_codegen::document::tree::{Node, Place};
use whirl_codegen::units::Quantity;
use whirl_text::rounded;

use super::level::{Level, digits, in_unit_of};

/// Digits of values between the ends: fewer than rounding disturbs.
const DIGITS: usize = 12;

/// A range as it is written.
#[derive(Debug, Clone)]
pub(crate) struct Range {
    /// Both ends in the unit of the first, as they are written.
    ends: [End; 2],
    /// As it is written; none of numbers alone.
    unit: Option<String>,
    /// How many values, if it says so.
    pub(crate) count: Option<usize>,
    /// Whether values have equal ratios.
    pub(crate) logarithmic: bool,
    /// Where all of it stands.
    pub(crate) place: Place,
}

#[derive(Debug, Clone)]
struct End {
    value: f64,
    level: Level,
}

/// What stands between the ends.
const BETWEEN: &str = "..";

/// Whether a text is a range: numbers begin so, names and paths do not.
pub(crate) fn is_range(text: &str) -> bool {
    let start = text.trim_start().trim_start_matches(['+', '-', '.']);
    text.contains(BETWEEN) && start.starts_with(|c: char| c.is_ascii_digit())
}

impl Range {
    /// Reads the range that stands at a place.
    ///
    /// # Errors
    /// What is wrong with it, where.
    pub(crate) fn read(text: &str, place: &Place) -> Result<Range, Diagnostic> {
        let whole = 0..text.len();
        let between = text.find(BETWEEN).expect("a range has two ends");
        let rest = &text[between + BETWEEN.len()..];
        let comma = rest.find(',').unwrap_or(rest.len());
        let [first, last] = [0..between, between + BETWEEN.len()..between + BETWEEN.len() + comma];
        let (first, last) = (end(text, first, place)?, end(text, last, place)?);
        if !last.0.dimension().fits(first.0.dimension()) {
            let [own, other] = [first.0.dimension(), last.0.dimension()];
            let message = format!("a range from {own} to {other}");
            let help = "write both ends in units of one kind";
            return Err(part(place, text, last.2).error(Code::WRONG_UNIT, message).help(help));
        }
        let (count, logarithmic) = options(text, between + BETWEEN.len() + comma, place)?;
        let values = [in_unit_of(&first.0, &first.0), in_unit_of(&last.0, &first.0)];
        let unit = Some(first.0.unit().text().to_owned()).filter(|unit| unit != "1");
        let at = |message: String| part(place, text, whole.clone()).error(Code::BAD_VALUE, message);
        if values[0] == values[1] {
            let help = "write one value without `..`, or two ends that differ";
            return Err(at("both ends of this range are the same".to_owned()).help(help));
        }
        if logarithmic && !(values[0] * values[1] > 0.0) {
            let help = "write ends of one sign, neither of them zero, or leave out `log`";
            return Err(at("values in equal ratios do not pass zero".to_owned()).help(help));
        }
        let ends =
            [(first.1, values[0]), (last.1, values[1])].map(|(level, value)| End { value, level });
        Ok(Range { ends, unit, count, logarithmic, place: place.clone() })
    }

    /// Whether its values fall.
    pub(crate) fn falls(&self) -> bool {
        self.ends[1].value < self.ends[0].value
    }

    /// The same range the other way round, as it would be written.
    pub(crate) fn reversed(&self) -> String {
        let plain = |end: &End| end.level.literal.trim_matches('"').to_owned();
        format!("{} .. {}", plain(&self.ends[1]), plain(&self.ends[0]))
    }

    /// As it would be written with so many values.
    pub(crate) fn with_count(&self, count: usize) -> String {
        let plain = |end: &End| end.level.literal.trim_matches('"').to_owned();
        let log = if self.logarithmic { ", log" } else { "" };
        format!("{} .. {}, {count}{log}", plain(&self.ends[0]), plain(&self.ends[1]))
    }

    /// The `k`-th of `n` values, both ends included and as they are written.
    pub(crate) fn even(&self, k: usize, n: usize) -> Level {
        match k {
            0 => self.ends[0].level.clone(),
            k if k + 1 == n => self.ends[1].level.clone(),
            k => self.at(k as f64 / (n - 1) as f64),
        }
    }

    /// The value a share of the way from the first end to the last.
    pub(crate) fn at(&self, share: f64) -> Level {
        let [a, b] = [self.ends[0].value, self.ends[1].value];
        let value = match self.logarithmic {
            true => a * libm::exp(share * libm::log(b / a)),
            false => a + (b - a) * share,
        };
        let value = rounded(value, DIGITS).clamp(a.min(b), a.max(b));
        Level::number(value, self.unit.as_deref(), self.place.clone())
    }
}

/// An end: its quantity, its value in a case, and where it stands in the text.
fn end(
    text: &str,
    span: Span<usize>,
    place: &Place,
) -> Result<(Quantity, Level, Span<usize>), Diagnostic> {
    let own = &text[span.clone()];
    let start = span.start + (own.len() - own.trim_start().len());
    let own = own.trim();
    let span = start..start + own.len();
    let own_place = part(place, text, span.clone());
    if own.is_empty() {
        let help = "write a range as `20 um .. 60 um, 9`";
        return Err(part(place, text, 0..text.len())
            .error(Code::BAD_VALUE, "an end of this range is missing")
            .help(help));
    }
    let quantity = Quantity::parse(own).map_err(|error| match own_place.span == place.span {
        true => own_place.error(error.code, error.message).maybe_help(error.help),
        false => error.at(&own_place.source, own_place.span.start),
    })?;
    let level = match quantity.unit().text() {
        "1" => Level::number(quantity.si(), None, own_place),
        _ => {
            // A reader of texts skips a quote that it takes to be before them.
            let quoted = Place {
                span: own_place.span.start.saturating_sub(1)..own_place.span.end,
                ..own_place
            };
            let content = whirl_codegen::document::tree::Content::Text(own.to_owned());
            Level::written(Node { place: quoted, content })
        }
    };
    Ok((quantity, level, span))
}

/// What follows the ends: a number of values, and `log`.
fn options(text: &str, from: usize, place: &Place) -> Result<(Option<usize>, bool), Diagnostic> {
    let (mut count, mut logarithmic) = (None, false);
    let mut at = from;
    for own in text[from..].split(',').skip(1) {
        at += 1;
        let span = at + (own.len() - own.trim_start().len())
            ..at + own.trim_end().len().max(1).min(own.len().max(1));
        at += own.len();
        let error =
            |message: String| part(place, text, span.clone()).error(Code::BAD_VALUE, message);
        match own.trim() {
            "log" if !logarithmic => logarithmic = true,
            number if count.is_none() && number.parse::<usize>().is_ok() => {
                let number = number.parse::<usize>().unwrap_or_default();
                if number < 2 {
                    let help =
                        "both ends are among them: write 2 at least, or one value without `..`";
                    return Err(error(format!("a range has no {} values", digits(number as f64)))
                        .help(help));
                }
                count = Some(number);
            }
            other => {
                let help = "write a range as `20 um .. 60 um, 9`, or as `1 N .. 1 kN, 7, log` for equal ratios";
                return Err(error(format!("`{other}` is no number of values")).help(help));
            }
        }
    }
    Ok((count, logarithmic))
}

/// The place of a part of a text; that of all of it where it is not written as it reads.
fn part(place: &Place, text: &str, span: Span<usize>) -> Place {
    let start = place.span.start + 1;
    match place.source.text.get(start..).is_some_and(|rest| rest.starts_with(text)) {
        true => Place { span: start + span.start..start + span.end, source: place.source.clone() },
        false => place.clone(),
    }
}

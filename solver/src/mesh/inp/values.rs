//! Values of tokens: labels, numbers, parameters that must be there.

use whirl_text::nearest_in_any_case;

use super::super::raw::{LinePosition, MeshReport};
use super::cards::{Card, Token};

impl From<Token<'_>> for LinePosition {
    fn from(token: Token) -> LinePosition {
        LinePosition { file: token.file, line: token.line, column: token.column }
    }
}

/// A whole number; meshio writes some as `3.0`.
pub(super) fn whole(text: &str) -> Option<i64> {
    let digits = match text.split_once('.') {
        Some((digits, rest)) if rest.bytes().all(|digit| digit == b'0') => digits,
        _ => text,
    };
    digits.parse().ok()
}

/// A positive whole number.
pub(super) fn label(token: &Token, of: &str, report: &mut MeshReport) -> Option<u64> {
    match token.text.parse().ok().or_else(|| whole(token.text)?.try_into().ok()) {
        Some(label) if label > 0 => Some(label),
        _ => {
            let what = format!("{of} must be a whole number from 1, found `{}`", token.text);
            report.error(*token, what, label_help(token.text));
            None
        }
    }
}

/// What to write in place of what is no label.
pub(super) fn label_help(found: &str) -> &'static str {
    match found {
        "" => "write the label there, such as `17`, or take out the comma too many",
        _ if found.split_whitespace().count() > 1 => "put commas between the values",
        _ if read_number(found).is_some() => {
            "write a label such as `17`, without a sign or decimals"
        }
        _ => "write a label such as `17`, or see that the line belongs to the card above it",
    }
}

/// A finite number; Fortran's D may stand for the exponent.
pub(super) fn read_number(text: &str) -> Option<f64> {
    text.replace(['d', 'D'], "e").parse().ok().filter(|value: &f64| value.is_finite())
}

/// As [`read_number`]; what is none is noted.
pub(super) fn number(token: &Token, of: &str, report: &mut MeshReport) -> Option<f64> {
    let value = read_number(token.text);
    if value.is_none() {
        let what = format!("{of} must be a number, found `{}`", token.text);
        let help = match token.text.starts_with('<') {
            true => "*PARAMETER is not read: write the number itself",
            false => "write it as 0.0115 or 1.15e-2",
        };
        report.error(*token, what, help);
    }
    value
}

/// The value of a parameter that must be there.
pub(super) fn required<'c>(
    card: &Card<'c>,
    name: &str,
    example: &str,
    report: &mut MeshReport,
) -> Option<Token<'c>> {
    let parameter = card.parameter(name);
    let value = parameter.and_then(|parameter| parameter.value);
    let value = value.filter(|value| !value.text.is_empty());
    if value.is_none() {
        let names = card.parameters.iter().map(|parameter| parameter.name.as_str());
        let help = match nearest_in_any_case(name, names) {
            Some(close) if close != name => format!("is {close} meant to be {name}?"),
            _ => format!("write {example}"),
        };
        let at = parameter.map_or(card.place, |parameter| parameter.place);
        report.error(at, format!("*{} needs {name}=", card.keyword), help);
    }
    value
}

//! `[valid.NAME]` of a law file.

use crate::diagnostic::{Code, Located};
use crate::document::{Table, Value};
use crate::formula::{Formula, parse};
use crate::kinds::read;
use crate::rational::Rational;
use crate::units::Unit;

/// A section as it was written.
pub(in crate::kinds::law) struct ValidityDraft {
    pub(in crate::kinds::law) key: Located,
    pub(in crate::kinds::law) name: String,
    pub(in crate::kinds::law) title: String,
    pub(in crate::kinds::law) help: String,
    pub(in crate::kinds::law) unit: Unit,
    pub(in crate::kinds::law) value: Formula,
    /// `min` and `max`.
    pub(in crate::kinds::law) limits: [Option<Limit>; 2],
}

/// A limit as it was written.
pub(in crate::kinds::law) enum Limit {
    /// In the unit of the section.
    Number(Rational),
    /// Of numbers and parameters.
    Formula(Formula),
}

impl ValidityDraft {
    /// The formulas of the section.
    pub(in crate::kinds::law) fn formulas(&self) -> impl Iterator<Item = &Formula> {
        let limits = self.limits.iter().flatten().filter_map(|limit| match limit {
            Limit::Formula(formula) => Some(formula),
            Limit::Number(_) => None,
        });
        limits.chain([&self.value])
    }
}

/// Reads a section.
pub(in crate::kinds::law) fn read(
    section: &Table<'_>,
    key: &Located,
    name: Option<String>,
) -> Option<ValidityDraft> {
    let document = section.document();
    let formula = |text: &Located| parse(text).map_err(|errors| document.append(errors)).ok();
    let value = section.string("value").and_then(|text| formula(&text));
    let unit = section.string("unit").and_then(|text| read::unit(document, &text));
    let (title, help) = (section.string("title"), section.string("help"));
    let limit = |key: &str| match section.value(key)? {
        Value::Number(number, _) => Some(Limit::Number(number)),
        Value::String(text) => formula(&text).map(Limit::Formula),
        other => {
            let message = format!("`{key}` must be a number or a formula of parameters");
            section.error(Code::BAD_VALUE, other.span(), message);
            None
        }
    };
    if !section.has("min") && !section.has("max") {
        let error =
            key.error_here(Code::MISSING_KEY, "a measure without `min` and `max` has no limit");
        section.miss(&["min", "max"], error.help("write for example `max = 0.99`"));
    }
    let limits = [limit("min"), limit("max")];
    let text = |text: Located| text.text().to_owned();
    Some(ValidityDraft {
        key: key.clone(),
        name: name?,
        title: text(title?),
        help: text(help?),
        unit: unit?,
        value: value?,
        limits,
    })
}

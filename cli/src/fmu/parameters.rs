//! Parameters of a unit: keys of its case with numbers as their values, of which other ones need no other reduced bodies.

use whirl_codegen::diagnostic::suggest;
use whirl_codegen::document::tree::{Content, Node};
use whirl_codegen::rational::nearest;
use whirl_codegen::units::Quantity;

use crate::case::CaseText;
use crate::errors::Failure;
use crate::machine;
use crate::values::level::{digits, quoted};

/// A key of the case whose value may be set.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Parameter {
    /// As `--vary` takes it: `springs.radial_clearance`.
    pub(crate) key: String,
    /// Its value in the case, in its unit.
    pub(crate) start: f64,
    /// Its unit as the case has it; none of a number without quotes.
    unit: Option<String>,
}

impl Parameter {
    /// Its unit; `1` of a number.
    pub(crate) fn unit(&self) -> &str {
        self.unit.as_deref().unwrap_or("1")
    }

    /// Its key with a value, as a case would have both.
    fn literal(&self, value: f64) -> (&str, String) {
        let number = digits(value);
        let written = match &self.unit {
            Some(unit) => quoted(&format!("{number} {unit}")),
            None => number,
        };
        (&self.key, written)
    }

    /// The parameter of a key with its value, if that is a number.
    fn of(key: &str, node: &Node) -> Option<Parameter> {
        let (start, unit) = match &node.content {
            Content::Number(number) => (number.float()?, None),
            Content::Text(text) => {
                let quantity = Quantity::parse(text).ok()?;
                (nearest(quantity.value()), Some(quantity.unit().text().to_owned()))
            }
            _ => return None,
        };
        Some(Parameter { key: key.to_owned(), start, unit })
    }
}

/// The case with these values of its parameters.
pub(crate) fn with_values(text: &CaseText, parameters: &[Parameter], values: &[f64]) -> CaseText {
    let others = parameters.iter().zip(values).filter(|(own, value)| own.start != **value);
    text.with_more_values(others.map(|(own, value)| own.literal(*value)))
}

/// The parameters of these keys.
///
/// # Errors
/// A key that the case does not have, one without a number, one that is there twice.
pub(crate) fn asked(text: &CaseText, keys: &[String]) -> Result<Vec<Parameter>, Failure> {
    let all = text.values_by_key().map_err(Failure::Input)?;
    let mut found: Vec<Parameter> = Vec::with_capacity(keys.len());
    for key in keys {
        let refused = |what: &str, help: String| Failure::Argument {
            message: format!("`--parameter {key}`: {what}"),
            help,
        };
        if of_march(key) {
            let help =
                "set it in the case: steps of the march and its end are no parameters of a unit";
            return Err(refused("it is of the march, not of the machine", help.to_owned()));
        }
        let Some((_, node)) = all.iter().find(|(own, _)| own == key) else {
            let numbers = all.iter().filter_map(|(own, node)| Parameter::of(own, node));
            let names: Vec<String> =
                numbers.map(|own| own.key).filter(|own| !of_march(own)).collect();
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let help = suggest(key, &names);
            let help = help.unwrap_or_else(|| "name a key as `--vary` takes it".to_owned());
            return Err(refused("the case does not have this key", help));
        };
        let Some(own) = Parameter::of(key, node) else {
            let help = "name a key such as `springs.radial_clearance`".to_owned();
            return Err(refused("its value is no number", help));
        };
        if found.iter().any(|other| other.key == own.key) {
            return Err(refused("it is given twice", "leave one of them out".to_owned()));
        }
        found.push(own);
    }
    Ok(found)
}

/// Whether a key says how to march, not what.
fn of_march(key: &str) -> bool {
    key.split('.').next() == Some("march")
}

/// By how much a value is changed to see what depends on it: exactly, in binary numbers.
const OTHER: f64 = 1.0 + 1.0 / 128.0;

/// Whether other values need no other bodies.
///
/// # Errors
/// A parameter whose other values need some, or that has no others.
pub(crate) fn keep_bodies(text: &CaseText, parameters: &[Parameter]) -> Result<(), Failure> {
    if parameters.is_empty() {
        return Ok(());
    }
    let keys = |text: &CaseText| {
        machine::read_text(text, &mut Vec::new()).and_then(|case| machine::keys(&case))
    };
    let own = keys(text)?;
    for parameter in parameters {
        let other = if parameter.start == 0.0 { 1.0 / 128.0 } else { OTHER * parameter.start };
        let refused = |what: String| Failure::Argument {
            message: format!("`--parameter {}`: {what}", parameter.key),
            help: "leave it out: make a unit for each of its values".to_owned(),
        };
        match keys(&with_values(text, std::slice::from_ref(parameter), &[other])) {
            Ok(found) if found == own => {}
            Ok(_) => {
                return Err(refused(
                    "with another value the bodies must be reduced anew".to_owned(),
                ));
            }
            Err(failure) => return Err(refused(format!("other values are refused: {failure}"))),
        }
    }
    Ok(())
}

//! One value of a key: what stands for it in a case, and where its user wrote it.

use whirl_codegen::document::tree::{Content, Node, Number, Place};
use whirl_codegen::rational::nearest;
use whirl_codegen::units::Quantity;

/// A value that a key has at some points.
#[derive(Debug, Clone)]
pub(crate) struct Level {
    /// As if it stood in the case, with its place in the sweep.
    pub(crate) node: Node,
    /// As it would be written in a case.
    pub(crate) literal: String,
}

impl Level {
    /// A value that stands in the sweep as it would in a case.
    pub(crate) fn written(node: Node) -> Self {
        let literal = match &node.content {
            Content::Text(text) => quoted(text),
            _ => node.place.written().text().to_owned(),
        };
        Level { node, literal }
    }

    /// A number with a unit, or without one; `place` says where the range stands of which it is.
    pub(crate) fn number(value: f64, unit: Option<&str>, place: Place) -> Self {
        let number = digits(value);
        let (content, literal) = match unit {
            Some(unit) => {
                let text = format!("{number} {unit}");
                (Content::Text(text.clone()), quoted(&text))
            }
            None => (Content::Number(Number::decimal(number.as_str())), number),
        };
        Level { node: Node { place, content }, literal }
    }

    /// What it is, however it is written: a quantity in SI units and what it measures, or the text itself.
    pub(crate) fn value(&self) -> String {
        let Some(own) = self.quantity() else { return self.literal.clone() };
        match own.unit().rational() {
            Some(unit) => format!("{} {:?}", own.value() * unit, own.dimension()),
            None => format!("{:e} {:?}", own.si(), own.dimension()),
        }
    }

    /// The number with its unit, if it is one.
    pub(crate) fn quantity(&self) -> Option<Quantity> {
        match &self.node.content {
            Content::Text(text) => {
                Quantity::parse(text).ok().filter(|own| own.unit().text() != "1")
            }
            Content::Number(number) => Quantity::parse(&digits(number.float()?)).ok(),
            _ => None,
        }
    }
}

/// A quantity in the unit of another one of the same dimension, rounded once.
pub(crate) fn in_unit_of(value: &Quantity, other: &Quantity) -> f64 {
    if value.unit().text() == other.unit().text() {
        return nearest(value.value());
    }
    match (value.unit().rational(), other.unit().rational()) {
        (Some(own), Some(other)) => nearest(&(&(value.value() * own) / other)),
        _ => {
            nearest(value.value()) * value.unit().factor().to_f64() / other.unit().factor().to_f64()
        }
    }
}

/// The shortest decimal number that is read as `value`, in a form that TOML has, whole if it is.
pub(crate) fn digits(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        1e-4..1e15 => format!("{value}"),
        _ => format!("{value:e}"),
    }
}

/// A text as TOML writes it.
pub(crate) fn quoted(text: &str) -> String {
    let mut all = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => all.extend(['\\', c]),
            c if c.is_control() => all.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => all.push(c),
        }
    }
    all + "\""
}

/// Values as a command line or a list has them, as TOML: what has quotes or brackets, or is a number, stands as it is.
pub(crate) fn as_toml(values: &str) -> String {
    let plain = values.starts_with(['[', '"', '\'', '{'])
        || values.parse::<f64>().is_ok()
        || matches!(values, "true" | "false");
    if plain { values.to_owned() } else { quoted(values) }
}

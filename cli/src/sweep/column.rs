//! What a table says of a key that varies: numbers in one unit, or texts.

use whirl_codegen::document::tree::Content;

use super::vary::Varied;
use crate::values::level::{Level, in_unit_of};

/// How the values of a key stand in its column.
#[derive(Debug, Clone)]
pub(super) struct Column {
    /// The key, with its unit in brackets if its values have one.
    pub(super) head: String,
    /// The value by whose unit the others are counted; none of texts.
    unit: Option<Level>,
}

/// A value in its column.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Shown {
    /// In the unit of the column.
    Number(f64),
    /// As it is written, without quotes.
    Text(String),
}

impl Column {
    /// Of a key: in the unit of its first value, if all that is written of it has units of one kind.
    pub(super) fn of(key: &Varied) -> Self {
        let written = key.written();
        let all: Option<Vec<_>> = written.iter().map(Level::quantity).collect();
        let one = all.filter(|all| all.iter().all(|own| own.dimension().fits(all[0].dimension())));
        let unit = one.as_ref().map(|all| all[0].unit().text().to_owned());
        let head = match unit.filter(|unit| unit != "1") {
            Some(unit) => format!("{} [{unit}]", key.name),
            None => key.name.clone(),
        };
        Column { head, unit: one.map(|_| written[0].clone()) }
    }

    /// As figures call it: the key, with its unit in parentheses.
    pub(super) fn label(&self) -> String {
        match self.head.strip_suffix(']').and_then(|head| head.rsplit_once(" [")) {
            Some((name, unit)) => format!("{name} ({})", readable(unit)),
            None => self.head.clone(),
        }
    }

    /// Its unit as figures have it; empty if there is none.
    pub(super) fn unit(&self) -> String {
        let head = self.head.strip_suffix(']').and_then(|head| head.rsplit_once(" ["));
        head.map_or(String::new(), |(_, unit)| readable(unit))
    }

    /// Whether it has numbers.
    pub(super) fn is_number(&self) -> bool {
        self.unit.is_some()
    }

    /// A value of the key.
    pub(super) fn shown(&self, level: &Level) -> Shown {
        let number = || Some(in_unit_of(&level.quantity()?, &self.unit.as_ref()?.quantity()?));
        match number() {
            Some(number) => Shown::Number(number),
            None => Shown::Text(match &level.node.content {
                Content::Text(text) => text.clone(),
                _ => level.literal.clone(),
            }),
        }
    }
}

/// A unit as people print it.
fn readable(unit: &str) -> String {
    let micro = |part: &str| match part.strip_prefix('u') {
        Some(rest) if !rest.is_empty() => format!("µ{rest}"),
        _ => part.to_owned(),
    };
    unit.split('*').map(micro).collect::<Vec<_>>().join("·")
}

/// The numbers that a key has, and what they are called; none where they are no numbers of one unit.
pub(super) fn numbers(key: &Varied, count: usize) -> Option<(String, Vec<f64>)> {
    let column = Column::of(key);
    let value = |k| match column.shown(&key.level(k)) {
        Shown::Number(value) => Some(value),
        Shown::Text(_) => None,
    };
    let values = (0..count).map(value).collect::<Option<_>>()?;
    Some((column.head, values))
}

//! Values that a parameter of a law may have.

use std::cmp::Ordering;

use crate::diagnostic::Code;
use crate::document::Table;
use crate::rational::{Rational, nearest};
use crate::units::Unit;

/// Between which values a parameter lies, in the unit of the file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Limits {
    least: Option<Limit>,
    most: Option<Limit>,
}

#[derive(Debug, Clone, PartialEq)]
struct Limit {
    value: Rational,
    /// Whether the value itself is one of them.
    reached: bool,
}

impl Limits {
    /// Those that the table of a parameter has.
    pub(super) fn read(table: &Table<'_>) -> Limits {
        let limit = |reached: &str, beyond: &str| {
            let [reached, beyond] = [reached, beyond].map(|key| (table.has(key), key));
            if reached.0 && beyond.0 {
                table.conflict(reached.1, beyond.1);
            }
            let (is_reached, key) = if reached.0 { (true, reached.1) } else { (false, beyond.1) };
            let (value, _) = table.optional_number(key)?;
            Some(Limit { value, reached: is_reached })
        };
        let limits = Limits { least: limit("min", "above"), most: limit("max", "below") };
        if let Limits { least: Some(least), most: Some(most) } = &limits {
            let one = least.value == most.value && least.reached && most.reached;
            if least.value >= most.value && !one {
                let message = format!("no value is {}", limits.words());
                table.error(Code::BAD_VALUE, table.span(), message);
            }
        }
        limits
    }

    /// What a value in this unit would have to be, if it is not; `of`: that of the file.
    pub fn refuse(&self, value: &Rational, unit: &Unit, of: &Unit) -> Option<String> {
        let exact = match (unit.rational(), of.rational()) {
            _ if unit.text() == of.text() => Some(value.clone()),
            (Some(unit), Some(of)) => Some(value * unit / of),
            // Degrees and revolutions are no rational numbers of radians.
            _ => None,
        };
        let beside = |limit: &Rational| match &exact {
            Some(exact) => exact.cmp(limit),
            None => {
                let value = nearest(value) * unit.factor().to_f64() / of.factor().to_f64();
                value.total_cmp(&nearest(limit))
            }
        };
        let is = |own: &Limit, beyond: Ordering| {
            let found = beside(&own.value);
            found == beyond || own.reached && found == Ordering::Equal
        };
        let too_low = |own: &&Limit| !is(own, Ordering::Greater);
        let too_high = |own: &&Limit| !is(own, Ordering::Less);
        let low = self.least.as_ref().filter(too_low).map(|own| own.words(["above", "at least"]));
        let high =
            || self.most.as_ref().filter(too_high).map(|own| own.words(["below", "at most"]));
        Some(format!("{}{}", low.or_else(high)?, after(of)))
    }

    /// In words, such as `above 0 and below 1`; nothing where there are none.
    pub(super) fn words(&self) -> String {
        let least = self.least.as_ref().map(|own| own.words(["above", "at least"]));
        let most = self.most.as_ref().map(|own| own.words(["below", "at most"]));
        least.into_iter().chain(most).collect::<Vec<String>>().join(" and ")
    }
}

impl Limit {
    fn words(&self, [beyond, reached]: [&str; 2]) -> String {
        let words = if self.reached { reached } else { beyond };
        format!("{words} {}", whirl_text::shown(nearest(&self.value), 6, 1e-4..1e7))
    }
}

/// A unit behind a number.
fn after(unit: &Unit) -> String {
    if unit.text() == "1" { String::new() } else { format!(" {unit}") }
}

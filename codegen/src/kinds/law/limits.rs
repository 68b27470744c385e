//! Values that a parameter of a law may have.

use num_traits::ToPrimitive;

use crate::document::Table;
use crate::rational::Rational;
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
        Limits { least: limit("min", "above"), most: limit("max", "below") }
    }

    /// What a value in this unit would have to be, if it is not; `of`: that of the file.
    pub fn refuse(&self, value: &Rational, unit: &Unit, of: &Unit) -> Option<String> {
        let number = |own: &Rational| own.to_f64().unwrap_or(f64::NAN);
        let value = match unit.text() == of.text() {
            true => number(value),
            false => number(value) * unit.factor().to_f64() / of.factor().to_f64(),
        };
        let in_words = |limit: &Limit, words: [&str; 2]| {
            let words = words[usize::from(limit.reached)];
            let unit = if of.text() == "1" { String::new() } else { format!(" {of}") };
            format!("{words} {}{unit}", number(&limit.value))
        };
        let too_low = |own: &&Limit| {
            let limit = number(&own.value);
            !(value > limit || own.reached && value == limit)
        };
        let too_high = |own: &&Limit| {
            let limit = number(&own.value);
            !(value < limit || own.reached && value == limit)
        };
        let low = self.least.as_ref().filter(too_low);
        let low = low.map(|own| in_words(own, ["above", "at least"]));
        low.or_else(|| {
            let high = self.most.as_ref().filter(too_high);
            high.map(|own| in_words(own, ["below", "at most"]))
        })
    }
}

//! What a file says, as a tree of values that know where they stand: of TOML here, of JSON in `json`.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value and its byte range in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Value {
    pub(super) place: Range<usize>,
    pub(super) what: What,
}

/// What stands there.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum What {
    /// `null`.
    Nothing,
    Flag(bool),
    /// Not finite where the file says so.
    Number(f64),
    Text(String),
    List(Vec<Value>),
    Table(Vec<Entry>),
}

/// A key with its value, in the order of the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) name: String,
    /// Of the key.
    pub(super) place: Range<usize>,
    pub(super) value: Value,
}

impl Value {
    /// The entries of a table; of another value none.
    pub(super) fn entries(&self) -> &[Entry] {
        match &self.what {
            What::Table(entries) => entries,
            _ => &[],
        }
    }
}

/// The tree of a file of TOML, or where and why it is none.
pub(super) fn of_toml(text: &str) -> Result<Value, (Range<usize>, String)> {
    match DeTable::parse(text) {
        Ok(table) => {
            let place = table.span();
            Ok(Value { place, what: What::Table(entries(table.into_inner())) })
        }
        Err(error) => Err((error.span().unwrap_or(0..0), error.message().to_owned())),
    }
}

fn entries(table: DeTable<'_>) -> Vec<Entry> {
    let entry = |(key, value): (Spanned<_>, Spanned<DeValue<'_>>)| Entry {
        place: key.span(),
        name: String::from(key.into_inner()),
        value: of_value(value),
    };
    let mut all: Vec<Entry> = table.into_iter().map(entry).collect();
    all.sort_by_key(|own| own.place.start);
    all
}

fn of_value(value: Spanned<DeValue<'_>>) -> Value {
    let place = value.span();
    let what = match value.into_inner() {
        DeValue::String(text) => What::Text(text.into_owned()),
        DeValue::Integer(own) => What::Number(
            i64::from_str_radix(own.as_str(), own.radix()).map_or(f64::NAN, |own| own as f64),
        ),
        DeValue::Float(own) => What::Number(own.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => What::Flag(flag),
        DeValue::Datetime(date) => What::Text(date.to_string()),
        DeValue::Array(list) => What::List(list.into_iter().map(of_value).collect()),
        DeValue::Table(table) => What::Table(entries(table)),
    };
    Value { place, what }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_keep_the_order_of_the_file() {
        let text =
            "b = 1\n[\"A_x 10\"]\nn = 2.5\n[\"A_x 10\".m]\nE = nan\n[\"A_x 9\"]\nflag = true\n";
        let tree = of_toml(text).expect("TOML");
        let names: Vec<&str> = tree.entries().iter().map(|own| own.name.as_str()).collect();
        assert_eq!(names, ["b", "A_x 10", "A_x 9"]);
        assert_eq!(&text[tree.entries()[1].place.clone()], "\"A_x 10\"");
        let inner = &tree.entries()[1].value;
        assert_eq!(inner.entries()[0].value.what, What::Number(2.5));
        let modulus = &inner.entries()[1].value.entries()[0].value;
        assert!(matches!(modulus.what, What::Number(x) if x.is_nan()));
        assert!(of_toml("a = \n").is_err());
    }
}

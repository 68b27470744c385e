//! A case file as a tree of values that know where they stand, with the files it includes merged in.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use toml::de::{DeTable, DeValue};
use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source};
use whirl_codegen::spec::read::beyond_limits;

/// A byte range of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Place {
    /// The file.
    pub(crate) source: Arc<Source>,
    /// Byte range in its text.
    pub(crate) span: Range<usize>,
}

impl Place {
    /// An error here.
    pub(crate) fn error(&self, code: Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(&self.source, code, self.span.clone(), message)
    }

    /// What stands here as it is written.
    pub(crate) fn written(&self) -> Located {
        self.text(self.source.text.get(self.span.clone()).unwrap_or(""))
    }

    /// The text of a string that stands here.
    pub(crate) fn text(&self, text: &str) -> Located {
        Located::new(&self.source, self.span.clone(), text)
    }
}

/// A value with its place.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    pub(crate) place: Place,
    pub(crate) value: Value,
}

/// What TOML can say, without dates.
#[derive(Debug, Clone)]
pub(crate) enum Value {
    Text(String),
    Integer(i64),
    Number(f64),
    Flag(bool),
    List(Vec<Node>),
    Table(Table),
}

impl Value {
    /// What this is, for messages.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Value::Text(_) => "text",
            Value::Integer(_) => "a whole number",
            Value::Number(_) => "a number with a point",
            Value::Flag(_) => "true or false",
            Value::List(_) => "a list",
            Value::Table(_) => "a table",
        }
    }
}

/// Keys of a table in alphabetical order, each with the place of the key itself.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    pub(crate) entries: BTreeMap<String, (Place, Node)>,
}

impl Table {
    /// Takes what `self` does not say from `included`, tables within tables likewise. Of keys that exclude
    /// each other, one that `self` says replaces what `included` says.
    pub(crate) fn merge(&mut self, included: Table) {
        self.merge_as("", included);
    }

    /// As [`Table::merge`], for the table called `name` at the top of a file.
    fn merge_as(&mut self, name: &str, mut included: Table) {
        for (table, keys) in INSTEAD {
            let says = |key: &&str| self.entries.contains_key(*key);
            if *table == name && keys.iter().any(says) {
                included.entries.retain(|key, _| {
                    self.entries.contains_key(key) || !keys.contains(&key.as_str())
                });
            }
        }
        for (key, (place, node)) in included.entries {
            match self.entries.get_mut(&key) {
                None => {
                    self.entries.insert(key, (place, node));
                }
                Some((_, own)) => {
                    if let (Value::Table(own), Value::Table(other)) = (&mut own.value, node.value) {
                        // Names of tables within tables are not those of the top.
                        let inner = if name.is_empty() { key.as_str() } else { WITHIN };
                        own.merge_as(inner, other);
                    }
                }
            }
        }
    }
}

/// Keys of tables that exclude each other.
const INSTEAD: &[(&str, &[&str])] = &[
    ("shaft", &["mesh", "dimensions"]),
    ("support", &["mesh", "dimensions"]),
    ("march", &["steps", "duration"]),
];

/// No name of a table: for those within others.
const WITHIN: &str = ".";

/// The tree of one file.
///
/// # Errors
/// A file beyond the limits of all files, or every place where the text is not TOML.
pub(crate) fn parse(source: &Arc<Source>) -> Result<Table, Diagnostics> {
    if let Some(error) = beyond_limits(source) {
        return Err(error.into());
    }
    let (table, errors) = DeTable::parse_recoverable(&source.text);
    let mut diagnostics = Diagnostics::new();
    for error in errors {
        diagnostics.push(Diagnostic::new(source, Code::TOML, error.span(), error.message()));
    }
    let table = convert_table(source, table.get_ref(), &mut diagnostics);
    diagnostics.into_result(table)
}

fn convert_table(source: &Arc<Source>, table: &DeTable, errors: &mut Diagnostics) -> Table {
    let mut entries = BTreeMap::new();
    for (key, value) in table {
        let key_place = Place { source: source.clone(), span: key.span() };
        let place = Place { source: source.clone(), span: value.span() };
        if let Some(value) = convert(source, &place, value.get_ref(), errors) {
            entries.insert(key.get_ref().to_string(), (key_place, Node { place, value }));
        }
    }
    Table { entries }
}

fn convert(
    source: &Arc<Source>,
    place: &Place,
    value: &DeValue,
    errors: &mut Diagnostics,
) -> Option<Value> {
    let mut refuse = |message: &str, help: &str| {
        errors.push(place.error(Code::BAD_VALUE, message).help(help));
        None
    };
    match value {
        DeValue::String(text) => Some(Value::Text(text.to_string())),
        DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(value) => Some(Value::Integer(value)),
            Err(_) => refuse(
                "this whole number is too large",
                "whole numbers lie between -9223372036854775808 and 9223372036854775807",
            ),
        },
        DeValue::Float(number) => match number.as_str().parse::<f64>() {
            Ok(value) if value.is_finite() => Some(Value::Number(value)),
            _ => refuse("a finite number is needed here", "write a number such as `0.3` or `1e-3`"),
        },
        DeValue::Boolean(flag) => Some(Value::Flag(*flag)),
        DeValue::Datetime(_) => {
            refuse("a date has no meaning here", "write it as text, between quotes")
        }
        DeValue::Array(list) => {
            let mut nodes = Vec::with_capacity(list.len());
            for item in list.iter() {
                let place = Place { source: source.clone(), span: item.span() };
                if let Some(value) = convert(source, &place, item.get_ref(), errors) {
                    nodes.push(Node { place, value });
                }
            }
            Some(Value::List(nodes))
        }
        DeValue::Table(table) => Some(Value::Table(convert_table(source, table, errors))),
    }
}

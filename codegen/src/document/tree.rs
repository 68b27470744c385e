//! A TOML file as a tree of values that know where they stand, into which other files can be merged.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::limits::beyond_limits;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source};
use crate::rational::Rational;
use crate::units::decimal;

/// A byte range of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub source: Arc<Source>,
    /// Byte range in its text.
    pub span: Range<usize>,
}

impl Place {
    /// An error here.
    pub fn error(&self, code: Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(&self.source, code, self.span.clone(), message)
    }

    /// What stands here as it is written.
    pub fn written(&self) -> Located {
        self.text(self.source.text.get(self.span.clone()).unwrap_or(""))
    }

    /// The text of a string that stands here.
    pub fn text(&self, text: &str) -> Located {
        Located::new(&self.source, self.span.clone(), text)
    }
}

/// A value with its place.
#[derive(Debug, Clone)]
pub struct Node {
    /// Where it stands.
    pub place: Place,
    /// What stands there.
    pub content: Content,
}

/// What TOML can say.
#[derive(Debug, Clone)]
pub enum Content {
    /// A string.
    Text(String),
    /// A number.
    Number(Number),
    /// True or false.
    Flag(bool),
    /// A date, which means nothing in any file.
    Date,
    /// An array.
    List(Vec<Node>),
    /// A table.
    Table(Tree),
}

/// A number as it is written: files differ in which numbers they take, and in how exactly.
#[derive(Debug, Clone)]
pub struct Number {
    /// Without prefix of its radix.
    text: String,
    radix: u32,
    /// Whether it is written without point and exponent.
    pub whole: bool,
}

impl Number {
    /// How it is written with decimal digits, if it is.
    pub(crate) fn as_decimal(&self) -> Option<&str> {
        (self.radix == 10).then_some(&self.text)
    }

    /// One that is written with decimal digits.
    pub fn decimal(text: impl Into<String>) -> Number {
        let text = text.into();
        let whole = !text.contains(['.', 'e', 'E']);
        Number { text, radix: 10, whole }
    }

    /// Its value, if it is finite and of no more digits than numbers may have.
    pub(crate) fn exact(&self) -> Option<Rational> {
        if self.radix != 10 {
            return self.integer().map(Rational::from);
        }
        let unsigned = self.text.strip_prefix(['+', '-']).unwrap_or(&self.text);
        match decimal(unsigned) {
            Some((Some(value), length)) if length == unsigned.len() => {
                Some(if self.text.starts_with('-') { -value } else { value })
            }
            _ => None,
        }
    }

    /// Its value, if it is written as a whole number and is not too large.
    pub(crate) fn integer(&self) -> Option<i64> {
        if self.whole { i64::from_str_radix(&self.text, self.radix).ok() } else { None }
    }

    /// The nearest of the numbers with which machines compute, if it is finite.
    pub fn float(&self) -> Option<f64> {
        let value = match self.whole {
            true => self.integer().map(|value| value as f64),
            false => self.text.parse().ok(),
        };
        value.filter(|value| value.is_finite())
    }
}

/// A table: its keys in alphabetical order, each with the place of the key itself.
#[derive(Debug, Clone, Default)]
pub struct Tree {
    /// The keys.
    pub entries: BTreeMap<String, (Place, Node)>,
}

impl Tree {
    /// The tree of a file as far as it is TOML, and every place where it is not; nothing of a file beyond the
    /// limits of all files.
    pub fn parse(source: &Arc<Source>) -> (Tree, Diagnostics) {
        if let Some(error) = beyond_limits(source) {
            return (Tree::default(), error.into());
        }
        let (table, errors) = DeTable::parse_recoverable(&source.text);
        let mut diagnostics = Diagnostics::new();
        for error in errors {
            diagnostics.push(Diagnostic::new(source, Code::TOML, error.span(), error.message()));
        }
        (Tree::new(source, table.into_inner()), diagnostics)
    }

    fn new(source: &Arc<Source>, table: DeTable<'_>) -> Tree {
        let entry = |(key, value): (Spanned<_>, _)| {
            let place = Place { source: source.clone(), span: key.span() };
            (String::from(key.into_inner()), (place, Node::new(source, value)))
        };
        Tree { entries: table.into_iter().map(entry).collect() }
    }

    /// Takes what `self` does not say from `included`, tables within tables likewise. `instead` lists keys
    /// that exclude each other, by the name of their table at the top of a file, such as `shaft`, or of every table in
    /// it, such as `body.*`: of these, one that `self` says replaces what `included` says.
    pub fn merge<'a>(&mut self, included: Tree, instead: &[(&'a str, &'a [&'a str])]) {
        for (key, (place, node)) in included.entries {
            let Some((_, own)) = self.entries.get_mut(&key) else {
                self.entries.insert(key, (place, node));
                continue;
            };
            if let (Content::Table(own), Content::Table(mut other)) =
                (&mut own.content, node.content)
            {
                for (_, keys) in instead.iter().filter(|(name, _)| [&key, "*"].contains(name)) {
                    if keys.iter().any(|key| own.entries.contains_key(*key)) {
                        other.entries.retain(|key, _| {
                            own.entries.contains_key(key) || !keys.contains(&key.as_str())
                        });
                    }
                }
                // Names of tables within tables are not those of the top.
                let head = format!("{key}.");
                let inner = |(name, keys): &(&'a str, &'a [&'a str])| {
                    Some((name.strip_prefix(&head)?, *keys))
                };
                let within: Vec<(&str, &[&str])> = instead.iter().filter_map(inner).collect();
                own.merge(other, &within);
            }
        }
    }

    /// Shows every value in this table, in tables and in lists, with its keys, such as `length`,
    /// `cells.sectors` and `loads[0]`.
    pub fn each(&self, show: &mut dyn FnMut(String, &Node)) {
        for (key, (_, node)) in &self.entries {
            node.each(key.clone(), show);
        }
    }
}

impl Node {
    fn new(source: &Arc<Source>, value: Spanned<DeValue<'_>>) -> Node {
        let place = Place { source: source.clone(), span: value.span() };
        let number = |text: &str, radix, whole| {
            Content::Number(Number { text: text.to_owned(), radix, whole })
        };
        let content = match value.into_inner() {
            DeValue::String(text) => Content::Text(text.into_owned()),
            DeValue::Integer(integer) => number(integer.as_str(), integer.radix(), true),
            DeValue::Float(float) => number(float.as_str(), 10, false),
            DeValue::Boolean(flag) => Content::Flag(flag),
            DeValue::Datetime(_) => Content::Date,
            DeValue::Array(list) => {
                Content::List(list.into_iter().map(|item| Node::new(source, item)).collect())
            }
            DeValue::Table(table) => Content::Table(Tree::new(source, table)),
        };
        Node { place, content }
    }

    /// Whether it is an array.
    pub(super) fn is_list(&self) -> bool {
        matches!(self.content, Content::List(_))
    }

    /// Whether it is text.
    pub(super) fn is_text(&self) -> bool {
        matches!(self.content, Content::Text(_))
    }

    fn each(&self, name: String, show: &mut dyn FnMut(String, &Node)) {
        match &self.content {
            Content::Table(inner) => {
                inner.each(&mut |key, node| show(format!("{name}.{key}"), node));
            }
            Content::List(items) => {
                for (i, item) in items.iter().enumerate() {
                    item.each(format!("{name}[{i}]"), show);
                }
            }
            _ => {}
        }
        show(name, self);
    }
}

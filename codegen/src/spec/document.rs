//! A TOML file being read: its values with their places, and what is wrong so far.

use std::cell::RefCell;
use std::ops::Range;
use std::sync::Arc;

use crate::rational::Rational;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::read::Table;
use super::schema::{Shape, key};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source};
use crate::units::decimal;

/// A TOML file being read, and what is wrong with it so far.
#[derive(Debug)]
pub struct Document<'s> {
    pub(super) source: &'s Arc<Source>,
    root: Spanned<DeTable<'s>>,
    errors: RefCell<Diagnostics>,
}

/// Most bytes of a file, and most names joined by dots in a key: each opens a table in a table.
const LONGEST: usize = 256 * 1024;
const MOST_JOINED: usize = 64;

/// A file of which only the kind is asked for.
static ANY_KIND: Shape = Shape::Table(&[&[key("kind", Shape::Text, "the kind of spec")]]);

/// What is wrong with a file before it is parsed: its size, or keys whose tables would fill the memory.
pub fn beyond_limits(source: &Arc<Source>) -> Option<Diagnostic> {
    if source.text.len() > LONGEST {
        let message = format!("a file is at most {LONGEST} bytes long");
        return Some(Diagnostic::new(source, Code::LIMIT, None, message));
    }
    let place = deep_key(&source.text)?;
    let message = format!("this key joins more than {MOST_JOINED} names by dots");
    Some(Diagnostic::new(source, Code::LIMIT, place..place + 1, message))
}

/// Where a key joins too many names: dots between names with nothing else between them but blanks.
fn deep_key(text: &str) -> Option<usize> {
    let (mut dots, mut quote) = (0, None);
    for (place, c) in text.char_indices() {
        match (quote, c) {
            (Some(_), '\n') => (dots, quote) = (0, None),
            (Some(open), c) if c == open => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '.') => dots += 1,
            (None, ' ' | '\t' | '_' | '-') => {}
            (None, c) if c.is_ascii_alphanumeric() => {}
            (None, _) => dots = 0,
        }
        if dots > MOST_JOINED {
            return Some(place);
        }
    }
    None
}

impl<'s> Document<'s> {
    /// Parses the text; errors of TOML itself are collected like all others.
    pub fn parse(source: &'s Arc<Source>) -> Self {
        let mut diagnostics = Diagnostics::new();
        if let Some(error) = beyond_limits(source) {
            diagnostics.push(error);
        }
        // What is beyond the limits is not read at all.
        let text = if diagnostics.is_empty() { source.text.as_str() } else { "" };
        let (root, errors) = DeTable::parse_recoverable(text);
        for error in errors {
            diagnostics.push(Diagnostic::new(source, Code::TOML, error.span(), error.message()));
        }
        Document { source, root, errors: RefCell::new(diagnostics) }
    }

    /// Whether the text is TOML; if not, what its tables say is not worth reading.
    pub fn is_toml(&self) -> bool {
        let unread = |error: &Diagnostic| matches!(error.code, Some(Code::TOML | Code::LIMIT));
        !self.errors.borrow().iter().any(unread)
    }

    /// The table of the whole file, of which `shape` says what it may hold.
    pub fn root(&self, shape: &'static Shape) -> Table<'_> {
        Table::new(self, self.root.get_ref(), shape, self.root.span(), String::new())
    }

    /// Whether the file says its `kind`, as specs do.
    pub fn has_kind(&self) -> bool {
        self.root(&ANY_KIND).has("kind")
    }

    /// The `kind` that the file says it is, which must be one of `kinds`.
    pub fn kind(&self, kinds: &[&'static str]) -> Option<&'static str> {
        let root = self.root(&ANY_KIND);
        if !root.has("kind") {
            let example = kinds.first().copied().unwrap_or("…");
            let message = "`kind` is missing";
            let error = Diagnostic::new(self.source, Code::MISSING_KEY, None, message);
            self.push(error.help(format!("write `kind = \"{example}\"`")));
        }
        root.word_among("kind", kinds)
    }

    /// Reports an error at a place of the file.
    pub fn error(&self, code: Code, span: impl Into<Option<Range<usize>>>, message: String) {
        self.push(Diagnostic::new(self.source, code, span, message));
    }

    /// Adds an error.
    pub fn push(&self, error: Diagnostic) {
        self.errors.borrow_mut().push(error);
    }

    /// Adds errors.
    pub fn append(&self, errors: Diagnostics) {
        self.errors.borrow_mut().append(errors);
    }

    /// Whether an error was found so far.
    pub fn has_errors(&self) -> bool {
        !self.errors.borrow().is_empty()
    }

    /// The value read, or every error found.
    pub fn into_result<T>(self, value: Option<T>) -> Result<T, Diagnostics> {
        let errors = self.errors.into_inner();
        match value {
            Some(value) => errors.into_result(value),
            None if errors.is_empty() => {
                let message = "this file cannot be read";
                Err(Diagnostic::new(self.source, Code::BAD_VALUE, None, message).into())
            }
            None => Err(errors.into_result(()).expect_err("there are errors")),
        }
    }
}

/// A value of any type, for keys that allow several.
#[derive(Debug, Clone)]
pub enum Value<'d> {
    /// A string.
    String(Located),
    /// An integer or float, exactly, and where it stands.
    Number(Rational, Range<usize>),
    /// A truth value, and where it stands.
    Boolean(bool, Range<usize>),
    /// An array: see [`Table::items`].
    Array(Vec<Item<'d>>, Range<usize>),
    /// A table: see [`Table::table`].
    Table(Range<usize>),
    /// A date, which no spec uses, or a number that is not finite.
    Other(Range<usize>),
}

impl Value<'_> {
    fn what(&self) -> &'static str {
        match self {
            Value::String(_) => "a string",
            Value::Number(..) => "a number",
            Value::Boolean(..) => "a truth value",
            Value::Array(..) => "an array",
            Value::Table(_) => "a table",
            Value::Other(_) => "a date or a number that is not finite",
        }
    }

    /// Where it stands.
    pub fn span(&self) -> Range<usize> {
        match self {
            Value::String(text) => text.span(),
            Value::Number(_, span)
            | Value::Boolean(_, span)
            | Value::Array(_, span)
            | Value::Table(span)
            | Value::Other(span) => span.clone(),
        }
    }
}

/// An element of an array.
#[derive(Debug, Clone, Copy)]
pub struct Item<'d> {
    document: &'d Document<'d>,
    value: &'d Spanned<DeValue<'d>>,
    shape: &'static Shape,
}

impl<'d> Item<'d> {
    /// What it is.
    pub fn value(&self) -> Value<'d> {
        self.document.value(self.value, self.shape)
    }

    /// The element as a table called `place` in messages; another type is an error.
    pub fn table(&self, place: &str) -> Option<Table<'d>> {
        self.document.table(self.value, self.shape, place.to_owned())
    }
}

impl<'s> Document<'s> {
    pub(super) fn value<'d>(
        &'d self,
        value: &'d Spanned<DeValue<'d>>,
        shape: &'static Shape,
    ) -> Value<'d>
    where
        's: 'd,
    {
        let span = value.span();
        match value.get_ref() {
            DeValue::String(text) => Value::String(Located::new(self.source, span, text.as_ref())),
            DeValue::Integer(number) if number.radix() == 10 => exact(number.as_str(), span),
            DeValue::Integer(number) => {
                match i64::from_str_radix(number.as_str(), number.radix()) {
                    Ok(value) => Value::Number(Rational::from(value), span),
                    Err(_) => Value::Other(span),
                }
            }
            DeValue::Float(number) => exact(number.as_str(), span),
            DeValue::Boolean(truth) => Value::Boolean(*truth, span),
            DeValue::Datetime(_) => Value::Other(span),
            DeValue::Array(items) => {
                // Of a list where none is declared, no item is read any further.
                let shape = shape.of_items().unwrap_or(&Shape::Either(&[]));
                let items = items.iter().map(|value| Item { document: self, value, shape });
                Value::Array(items.collect(), span)
            }
            DeValue::Table(_) => Value::Table(span),
        }
    }

    pub(super) fn table<'d>(
        &'d self,
        value: &'d Spanned<DeValue<'d>>,
        shape: &'static Shape,
        place: String,
    ) -> Option<Table<'d>>
    where
        's: 'd,
    {
        match value.get_ref() {
            DeValue::Table(entries) => Some(Table::new(self, entries, shape, value.span(), place)),
            _ => {
                self.wrong_type(&place, "a table", &self.value(value, shape));
                None
            }
        }
    }

    pub(super) fn wrong_type(&self, key: &str, wanted: &str, found: &Value<'_>) {
        let message = format!("`{key}` must be {wanted}, not {}", found.what());
        let error = Diagnostic::new(self.source, Code::BAD_VALUE, found.span(), message);
        let example = match wanted {
            "a string" => "\"…\"",
            "an array" => "[…, …]",
            "a table" => "{ … }",
            "a finite number" => "1.5",
            other => other.trim_matches('`').split('`').next().unwrap_or(other),
        };
        // An entry of a list has no key of its own.
        let own = key.rsplit('.').next().unwrap_or(key);
        self.push(error.help(match own.ends_with(']') {
            true => format!("write it as `{example}`"),
            false => format!("write for example `{own} = {example}`"),
        }));
    }
}

fn exact<'d>(text: &str, span: Range<usize>) -> Value<'d> {
    let plain: String = text.chars().filter(|c| *c != '_').collect();
    let unsigned = plain.strip_prefix(['+', '-']).unwrap_or(&plain);
    match decimal(unsigned) {
        Some((Some(value), length)) if length == unsigned.len() => {
            let value = if plain.starts_with('-') { -value } else { value };
            Value::Number(value, span)
        }
        _ => Value::Other(span),
    }
}

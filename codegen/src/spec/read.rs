//! TOML tables read key by key, so that every error is found at once and carries its place.
//!
//! A reader asks a [`Table`] for keys that are declared for it (see [`super::schema`]) and calls
//! [`Table::finish`], which reports keys that it did not ask for and declared ones that are missing.

#[cfg(test)]
mod tests;

use std::cell::RefCell;
use std::ops::Range;
use std::sync::Arc;

use crate::rational::Rational;
use num_traits::ToPrimitive;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

pub use super::document::{Document, Item, Value, beyond_limits};
use super::schema::{Need, Shape};
use crate::diagnostic::{Code, Diagnostic, Located, Source, nearest, suggest};

/// A table of the file.
#[derive(Debug)]
pub struct Table<'d> {
    document: &'d Document<'d>,
    entries: &'d DeTable<'d>,
    /// What it may say.
    shape: &'static Shape,
    span: Range<usize>,
    /// Keys that lead here, such as `outputs.Q`; empty for the file itself.
    place: String,
    asked: RefCell<Vec<String>>,
    /// Keys that must be there and are not. Reported at the end: where one was misspelt, it is not missing.
    missing: RefCell<Vec<(Vec<String>, Diagnostic)>>,
}

impl<'d> Table<'d> {
    pub(super) fn new(
        document: &'d Document<'d>,
        entries: &'d DeTable<'d>,
        shape: &'static Shape,
        span: Range<usize>,
        place: String,
    ) -> Self {
        Table {
            document,
            entries,
            shape,
            span,
            place,
            asked: RefCell::default(),
            missing: RefCell::default(),
        }
    }

    /// The document it belongs to.
    pub fn document(&self) -> &'d Document<'d> {
        self.document
    }

    /// The file.
    pub fn source(&self) -> &'d Arc<Source> {
        self.document.source
    }

    /// Where it stands.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// Reports an error at a place of the file.
    pub fn error(&self, code: Code, span: impl Into<Option<Range<usize>>>, message: String) {
        self.document.push(Diagnostic::new(self.source(), code, span, message));
    }

    fn full(&self, key: &str) -> String {
        if self.place.is_empty() { key.to_owned() } else { format!("{}.{key}", self.place) }
    }

    /// What a key takes, if it is declared so that `fits`. One that is not is never read: a file that has it
    /// is refused.
    fn declared(&self, key: &str, fits: fn(&Shape) -> bool) -> Option<&'static Shape> {
        let shape = self.shape.of_key(key).filter(|shape| shape.admits(fits));
        debug_assert!(shape.is_some(), "`{}` is read but not so declared", self.full(key));
        shape
    }

    /// The value of a key, which counts as known from now on, and what it takes.
    fn entry(
        &self,
        key: &str,
        fits: fn(&Shape) -> bool,
    ) -> Option<(&'d Spanned<DeValue<'d>>, &'static Shape)> {
        let shape = self.declared(key, fits)?;
        self.asked.borrow_mut().push(key.to_owned());
        let (_, value) = self.entries.iter().find(|(name, _)| name.get_ref() == key)?;
        Some((value, shape))
    }

    /// The value of a key that `fits`, for which messages say that `wanted` must stand there.
    fn value_of(&self, key: &str, fits: fn(&Shape) -> bool) -> Option<Value<'d>> {
        let (value, shape) = self.entry(key, fits)?;
        Some(self.document.value(value, shape))
    }

    /// Whether the key is there; the key counts as known from now on.
    pub fn has(&self, key: &str) -> bool {
        self.entry(key, |_| true).is_some()
    }

    /// Where the value of a key stands; the table if there is none.
    pub fn place(&self, key: &str) -> Range<usize> {
        self.entry(key, |_| true).map_or(self.span(), |(value, _)| value.span())
    }

    /// The value of a key that takes any of several types.
    pub fn value(&self, key: &str) -> Option<Value<'d>> {
        debug_assert!(matches!(self.shape.of_key(key), Some(Shape::Either(_))), "`{key}`");
        self.value_of(key, |_| true)
    }

    /// Reports that a key is not there; to be called where one that is declared as free must be there.
    fn demand(&self, key: &str) {
        if !self.has(key)
            && let Some(shape) = self.declared(key, |_| true)
        {
            self.missing(key, &self.fix(key, shape));
        }
    }

    /// How to write a key that is not there.
    fn fix(&self, key: &str, shape: &Shape) -> String {
        match shape {
            Shape::Words(_) | Shape::Registered(_) => {
                format!("write `{key} = \"{}\"`", shape.words().first().copied().unwrap_or("…"))
            }
            Shape::Text | Shape::Formula => format!("write `{key} = \"…\"`"),
            Shape::Quantity(measure) => {
                let (wanted, example) = (measure.dimension, measure.example);
                format!("{wanted} is wanted: write for example `{key} = \"{example}\"`")
            }
            Shape::Number => format!("write for example `{key} = 1.5`"),
            Shape::Between(low, high) => {
                format!("write for example `{key} = {}`", 0.5 * (low + high))
            }
            Shape::Count(..) => format!("write for example `{key} = 24`"),
            Shape::Flag => format!("write `{key} = true`"),
            Shape::List(_) | Shape::Tuple(..) => format!("write `{key} = [ … ]`"),
            Shape::Either(shapes) => match shapes.first() {
                Some(shape) => self.fix(key, shape),
                None => String::new(),
            },
            Shape::Table(_) | Shape::Named(_) | Shape::Known(..) => {
                format!("write a section `[{}]`", self.full(key))
            }
        }
    }

    /// Reports that a key that must be there is not.
    fn missing(&self, key: &str, help: &str) {
        let message = if self.place.is_empty() {
            format!("`{key}` is missing")
        } else {
            format!("`{key}` is missing in `{}`", self.place)
        };
        let span = if self.place.is_empty() { None } else { Some(self.span()) };
        let error = Diagnostic::new(self.source(), Code::MISSING_KEY, span, message);
        self.miss(&[key], error.help(help));
    }

    /// Reports an error because none of `keys` is there, unless one of them turns out to be misspelt.
    pub fn miss(&self, keys: &[&str], error: Diagnostic) {
        let keys = keys.iter().map(|key| (*key).to_owned()).collect();
        self.missing.borrow_mut().push((keys, error));
    }

    /// A string, if the key is there; another type is an error.
    pub fn optional_string(&self, key: &str) -> Option<Located> {
        match self.value_of(key, Shape::is_text)? {
            Value::String(text) => Some(text),
            other => {
                self.document.wrong_type(&self.full(key), "a string", &other);
                None
            }
        }
    }

    /// A string that must be there.
    pub fn string(&self, key: &str) -> Option<Located> {
        self.demand(key);
        self.optional_string(key)
    }

    /// One of the words declared, if the key is there; any other string is an error that names the nearest.
    pub fn optional_word(&self, key: &str) -> Option<&'static str> {
        let shape = self.declared(key, |shape| matches!(shape, Shape::Words(_)))?;
        self.word_among(key, &shape.words())
    }

    /// One of the words declared, which must be there.
    pub fn word(&self, key: &str) -> Option<&'static str> {
        self.demand(key);
        self.optional_word(key)
    }

    pub(super) fn word_among(&self, key: &str, words: &[&'static str]) -> Option<&'static str> {
        let text = self.optional_string(key)?;
        let word = words.iter().find(|word| **word == text.text()).copied();
        if word.is_none() {
            let message = format!("`{}` cannot be `{}`", self.full(key), text.text());
            let error = text.error_here(Code::BAD_VALUE, message);
            self.document.push(error.maybe_help(suggest(text.text(), words)));
        }
        word
    }

    /// An exact number, if the key is there, and where it stands.
    pub fn optional_number(&self, key: &str) -> Option<(Rational, Range<usize>)> {
        self.number_of(key, |shape| matches!(shape, Shape::Number))
    }

    fn number_of(&self, key: &str, fits: fn(&Shape) -> bool) -> Option<(Rational, Range<usize>)> {
        match self.value_of(key, fits)? {
            Value::Number(value, span) => Some((value, span)),
            other => {
                self.document.wrong_type(&self.full(key), "a finite number", &other);
                None
            }
        }
    }

    /// An exact number that must be there, and where it stands.
    pub fn number(&self, key: &str) -> Option<(Rational, Range<usize>)> {
        self.demand(key);
        self.optional_number(key)
    }

    /// A count (0, 1, 2, …), if the key is there.
    pub fn optional_count(&self, key: &str) -> Option<usize> {
        let (value, span) = self.number_of(key, |shape| matches!(shape, Shape::Count(..)))?;
        let count = if value.is_integer() { value.to_usize() } else { None };
        if count.is_none() {
            let message = format!("`{}` must be a count such as 1 or 24", self.full(key));
            self.error(Code::BAD_VALUE, span, message);
        }
        count
    }

    /// A count that must be there.
    pub fn count(&self, key: &str) -> Option<usize> {
        self.demand(key);
        self.optional_count(key)
    }

    /// A truth value, if the key is there.
    pub fn optional_boolean(&self, key: &str) -> Option<bool> {
        match self.value_of(key, |shape| matches!(shape, Shape::Flag))? {
            Value::Boolean(truth, _) => Some(truth),
            other => {
                self.document.wrong_type(&self.full(key), "`true` or `false`", &other);
                None
            }
        }
    }

    /// A table, if the key is there.
    pub fn optional_table(&self, key: &str) -> Option<Table<'d>> {
        let (value, shape) = self.entry(key, Shape::is_table)?;
        self.document.table(value, shape, self.full(key))
    }

    /// A table that must be there.
    pub fn table(&self, key: &str) -> Option<Table<'d>> {
        self.demand(key);
        self.optional_table(key)
    }

    /// The elements of an array, if the key is there.
    pub fn optional_items(&self, key: &str) -> Option<Vec<Item<'d>>> {
        match self.value_of(key, |shape| shape.of_items().is_some())? {
            Value::Array(items, _) => Some(items),
            other => {
                self.document.wrong_type(&self.full(key), "an array", &other);
                None
            }
        }
    }

    /// The elements of an array that must be there.
    pub fn items(&self, key: &str) -> Option<Vec<Item<'d>>> {
        self.demand(key);
        self.optional_items(key)
    }

    /// Every key, in the order of the file, each counted as known: for tables whose keys are names.
    pub fn names(&self) -> Vec<Located> {
        debug_assert!(self.shape.names_are_free(), "the keys of `{}` are fixed", self.place);
        let mut names: Vec<Located> = (self.entries.iter())
            .map(|(key, _)| Located::new(self.source(), key.span(), key.get_ref().as_ref()))
            .collect();
        names.sort_by_key(|name| name.span().start);
        self.asked.borrow_mut().extend(names.iter().map(|name| name.text().to_owned()));
        names
    }

    /// Reports every key that must be there and is not, and every key that was not asked for, with the
    /// nearest that was.
    pub fn finish(self) {
        for key in self.shape.keys().filter(|key| key.need == Need::Always) {
            let noted =
                self.missing.borrow().iter().any(|(keys, _)| keys.iter().any(|k| k == key.name));
            if !noted {
                self.demand(key.name);
            }
        }
        let asked = self.asked.borrow();
        let mut known: Vec<&str> = asked.iter().map(String::as_str).collect();
        known.sort_unstable();
        known.dedup();
        for (key, _) in self.entries.iter() {
            let (name, span) = (key.get_ref().as_ref(), key.span());
            if known.contains(&name) {
                continue;
            }
            let message = format!("unknown key `{}`", self.full(name));
            let error = Diagnostic::new(self.source(), Code::UNKNOWN_KEY, span, message);
            // Of two keys as near, the one that is not there was meant.
            let absent: Vec<String> =
                self.missing.borrow().iter().flat_map(|(keys, _)| keys.clone()).collect();
            let help = match nearest(name, absent.iter().map(String::as_str)) {
                Some(meant) => {
                    let mut missing = self.missing.borrow_mut();
                    missing.retain(|(keys, _)| keys.iter().all(|key| key != meant));
                    Some(format!("did you mean `{meant}`?"))
                }
                None => suggest(name, &known),
            };
            self.document.push(error.maybe_help(help));
        }
    }
}

impl Drop for Table<'_> {
    fn drop(&mut self) {
        self.missing.borrow_mut().drain(..).for_each(|(_, error)| self.document.push(error));
    }
}

/// How to fix a name that has other letters than those that are `fine`.
pub(super) fn plain_name(name: &str, fine: impl Fn(char) -> bool) -> String {
    let plain: String = name.chars().map(|c| if fine(c) { c } else { '-' }).collect();
    let joined: Vec<&str> = plain.split('-').filter(|part| !part.is_empty()).collect();
    let example = if joined.is_empty() { "my-name".to_owned() } else { joined.join("-") };
    format!("write for example `{example}`")
}

//! TOML tables read key by key, so that every error is found at once and carries its place.
//!
//! A reader asks a [`Table`] for the keys it knows and calls [`Table::finish`], which reports the rest.

use std::cell::RefCell;
use std::ops::Range;
use std::sync::Arc;

use crate::rational::Rational;
use num_traits::ToPrimitive;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

pub use super::document::{Document, Item, Value};
use crate::diagnostic::{Code, Diagnostic, Located, Source, nearest, suggest};
use crate::units::{Dimension, Quantity};

/// A table of the file.
#[derive(Debug)]
pub struct Table<'d> {
    document: &'d Document<'d>,
    entries: &'d DeTable<'d>,
    span: Range<usize>,
    /// Keys that lead here, such as `outputs.Q`; empty for the file itself.
    place: String,
    asked: RefCell<Vec<String>>,
    /// Keys that must be there and are not. Told at the end: where one was misspelt, it is not missing.
    missing: RefCell<Vec<(Vec<String>, Diagnostic)>>,
}

impl<'d> Table<'d> {
    pub(super) fn new(
        document: &'d Document<'d>,
        entries: &'d DeTable<'d>,
        span: Range<usize>,
        place: String,
    ) -> Self {
        Table {
            document,
            entries,
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

    fn entry(&self, key: &str) -> Option<&'d Spanned<DeValue<'d>>> {
        self.asked.borrow_mut().push(key.to_owned());
        self.entries.iter().find(|(name, _)| name.get_ref() == key).map(|(_, value)| value)
    }

    /// Whether the key is there; the key counts as known from now on.
    pub fn has(&self, key: &str) -> bool {
        self.entry(key).is_some()
    }

    /// The value of a key, of any type.
    pub fn value(&self, key: &str) -> Option<Value<'d>> {
        self.entry(key).map(|value| self.document.value(value))
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
        match self.value(key)? {
            Value::String(text) => Some(text),
            other => {
                self.document.wrong_type(&self.full(key), "a string", &other);
                None
            }
        }
    }

    /// A string that must be there.
    pub fn string(&self, key: &str) -> Option<Located> {
        if !self.has(key) {
            self.missing(key, &format!("write `{key} = \"…\"`"));
        }
        self.optional_string(key)
    }

    /// One of a few words, if the key is there; any other string is an error that names the nearest.
    pub fn optional_word(&self, key: &str, words: &[&'static str]) -> Option<&'static str> {
        let text = self.optional_string(key)?;
        let word = words.iter().find(|word| **word == text.text()).copied();
        if word.is_none() {
            let message = format!("`{}` cannot be `{}`", self.full(key), text.text());
            let error = text.error_here(Code::BAD_VALUE, message);
            self.document.push(error.maybe_help(suggest(text.text(), words)));
        }
        word
    }

    /// One of a few words, which must be there.
    pub fn word(&self, key: &str, words: &[&'static str]) -> Option<&'static str> {
        if !self.has(key) {
            let word = words.first().copied().unwrap_or("…");
            self.missing(key, &format!("write `{key} = \"{word}\"`"));
        }
        self.optional_word(key, words)
    }

    /// An exact number, if the key is there, and where it stands.
    pub fn optional_number(&self, key: &str) -> Option<(Rational, Range<usize>)> {
        match self.value(key)? {
            Value::Number(value, span) => Some((value, span)),
            other => {
                self.document.wrong_type(&self.full(key), "a finite number", &other);
                None
            }
        }
    }

    /// An exact number that must be there, and where it stands.
    pub fn number(&self, key: &str) -> Option<(Rational, Range<usize>)> {
        if !self.has(key) {
            self.missing(key, &format!("write for example `{key} = 1.5`"));
        }
        self.optional_number(key)
    }

    /// A count (0, 1, 2, …), if the key is there.
    pub fn optional_count(&self, key: &str) -> Option<usize> {
        let (value, span) = self.optional_number(key)?;
        let count = if value.is_integer() { value.to_usize() } else { None };
        if count.is_none() {
            let message = format!("`{}` must be a count such as 1 or 24", self.full(key));
            self.error(Code::BAD_VALUE, span, message);
        }
        count
    }

    /// A count that must be there.
    pub fn count(&self, key: &str) -> Option<usize> {
        if !self.has(key) {
            self.missing(key, &format!("write for example `{key} = 24`"));
        }
        self.optional_count(key)
    }

    /// A truth value, if the key is there.
    pub fn optional_boolean(&self, key: &str) -> Option<bool> {
        match self.value(key)? {
            Value::Boolean(truth, _) => Some(truth),
            other => {
                self.document.wrong_type(&self.full(key), "`true` or `false`", &other);
                None
            }
        }
    }

    /// A quantity such as `"1404 mm"` in SI units, if the key is there; a number alone serves only where
    /// a pure number is wanted.
    pub fn optional_quantity(&self, key: &str, wanted: &Dimension) -> Option<f64> {
        let (text, span) = match self.value(key)? {
            Value::String(text) => (text.text().to_owned(), text.place(0..text.text().len())),
            Value::Number(value, _) if *wanted == Dimension::NUMBER => return value.to_f64(),
            Value::Number(_, span) => (self.source().text[span.clone()].to_owned(), span),
            other => {
                let example = wanted.example().unwrap_or_default();
                let wanted = format!("{wanted}, such as \"{example}\"");
                self.document.wrong_type(&self.full(key), &wanted, &other);
                return None;
            }
        };
        match Quantity::parse(&text).and_then(|quantity| quantity.expect(wanted)) {
            Ok(si) => Some(si),
            Err(error) => {
                let error = error.at(self.source(), span.start);
                self.document.push(error);
                None
            }
        }
    }

    /// A quantity that must be there, in SI units.
    pub fn quantity(&self, key: &str, wanted: &Dimension) -> Option<f64> {
        if !self.has(key) {
            let example = wanted.example().unwrap_or_else(|| "1".to_owned());
            self.missing(
                key,
                &format!("{wanted} is wanted: write for example `{key} = \"{example}\"`"),
            );
        }
        self.optional_quantity(key, wanted)
    }

    /// A table, if the key is there.
    pub fn optional_table(&self, key: &str) -> Option<Table<'d>> {
        let value = self.entry(key)?;
        self.document.table(value, self.full(key))
    }

    /// A table that must be there.
    pub fn table(&self, key: &str) -> Option<Table<'d>> {
        if !self.has(key) {
            self.missing(key, &format!("write a section `[{}]`", self.full(key)));
        }
        self.optional_table(key)
    }

    /// The elements of an array, if the key is there.
    pub fn optional_items(&self, key: &str) -> Option<Vec<Item<'d>>> {
        match self.value(key)? {
            Value::Array(items, _) => Some(items),
            other => {
                self.document.wrong_type(&self.full(key), "an array", &other);
                None
            }
        }
    }

    /// The elements of an array that must be there.
    pub fn items(&self, key: &str) -> Option<Vec<Item<'d>>> {
        if !self.has(key) {
            self.missing(key, &format!("write `{key} = [ … ]`"));
        }
        self.optional_items(key)
    }

    /// Every key, in the order of the file, each counted as known: for tables whose keys are names.
    pub fn names(&self) -> Vec<Located> {
        let mut names: Vec<Located> = (self.entries.iter())
            .map(|(key, _)| Located::new(self.source(), key.span(), key.get_ref().as_ref()))
            .collect();
        names.sort_by_key(|name| name.span().start);
        self.asked.borrow_mut().extend(names.iter().map(|name| name.text().to_owned()));
        names
    }

    /// Reports every key that was not asked for, with the nearest that was.
    pub fn finish(self) {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(text: &str, read: impl Fn(&Table<'_>)) -> Vec<String> {
        let source = Source::new("f.toml", text);
        let document = Document::parse(&source);
        let root = document.root();
        read(&root);
        root.finish();
        let errors = document.into_result(Some(())).err().unwrap_or_default();
        errors.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn every_error_is_found_with_its_place() {
        let text = "\
name = 3
tilte = \"x\"
length = \"3 N\"
density = 7860
count = 1.5
engage = \"roof\"
[inputs]
h = 4
";
        let found = messages(text, |root| {
            assert!(root.string("name").is_none());
            assert!(root.optional_string("title").is_none());
            assert!(root.quantity("length", &Dimension::LENGTH).is_none());
            assert!(root.quantity("density", &Dimension::DENSITY).is_none());
            assert!(root.quantity("speed", &Dimension::ANGULAR_SPEED).is_none());
            assert!(root.count("count").is_none());
            assert!(root.optional_word("engage", &["root"]).is_none());
            let inputs = root.table("inputs").unwrap();
            for name in inputs.names() {
                assert!(inputs.table(name.text()).is_none());
            }
        });
        let expected = [
            "f.toml:1:8: `name` must be a string, not a number",
            "f.toml:2:1: unknown key `tilte` (did you mean `title`?)",
            "f.toml:3:11: expected a length, but `3 N` is a force (write for example `1 mm`)",
            "f.toml:4:11: expected a density, but `7860` has no unit (write for example `7860 kg/m^3`)",
            "f.toml:5:9: `count` must be a count such as 1 or 24",
            "f.toml:6:11: `engage` cannot be `roof` (did you mean `root`?)",
            "f.toml:8:5: `inputs.h` must be a table, not a number",
            "f.toml: `speed` is missing (an angular speed is wanted: write for example `speed = \"4500 rpm\"`)",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn text_that_is_not_toml_is_reported() {
        let source = Source::new("f.toml", "a = = 3\nb = [\n");
        let document = Document::parse(&source);
        assert!(!document.is_toml());
        assert!(!document.into_result(Some(())).unwrap_err().is_empty());
    }

    #[test]
    fn numbers_are_exact() {
        let source = Source::new("f.toml", "a = 0.035687\nb = -1_000\nc = inf\nd = 0x10\n");
        let document = Document::parse(&source);
        let root = document.root();
        let exact = Rational::new(35687, 1_000_000);
        assert_eq!(root.number("a").unwrap().0, exact);
        assert_eq!(root.number("b").unwrap().0, Rational::from(-1000));
        assert!(root.number("c").is_none());
        assert_eq!(root.count("d"), Some(16));
    }

    #[test]
    fn places_in_strings_are_places_in_the_file() {
        let source = Source::new("f.toml", "a = 'x + y'\nb = \"x\\u0020+ y\"\n");
        let document = Document::parse(&source);
        let root = document.root();
        assert_eq!(root.string("a").unwrap().place(4..5), 9..10);
        assert_eq!(root.string("b").unwrap().place(4..5), 16..28);
    }
}

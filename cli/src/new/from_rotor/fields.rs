//! The keys of one element, read with their errors.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Source};

use super::value::{Entry, Value, What};

/// A file and what is wrong with it so far.
pub(super) struct File {
    pub(super) source: Arc<Source>,
    pub(super) errors: RefCell<Diagnostics>,
}

impl File {
    pub(super) fn new(source: Arc<Source>) -> File {
        File { source, errors: RefCell::default() }
    }

    /// Notes an error.
    pub(super) fn wrong(
        &self,
        place: impl Into<Option<Range<usize>>>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        self.errors.borrow_mut().push(error(&self.source, place, message, help));
    }
}

/// An error of a file that is neither a spec nor a case, whose codes are not its own.
pub(super) fn error(
    source: &Arc<Source>,
    place: impl Into<Option<Range<usize>>>,
    message: impl Into<String>,
    help: impl Into<String>,
) -> Diagnostic {
    let mut error = Diagnostic::new(source, Code::BAD_VALUE, place, message).help(help);
    error.code = None;
    error
}

/// What values must be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sign {
    Any,
    NotNegative,
    Positive,
}

const SAVED: &str = "correct it in Python and save the rotor again with `rotor.save(…)`";

/// One element: its keys.
pub(super) struct Fields<'f> {
    file: &'f File,
    pub(super) tag: String,
    place: Range<usize>,
    entries: &'f [Entry],
    asked: RefCell<BTreeSet<&'static str>>,
}

impl<'f> Fields<'f> {
    pub(super) fn new(file: &'f File, tag: String, entry: &'f Entry) -> Fields<'f> {
        let (place, entries) = (entry.place.clone(), entry.value.entries());
        Fields { file, tag, place, entries, asked: RefCell::default() }
    }

    pub(super) fn place(&self) -> Range<usize> {
        self.place.clone()
    }

    /// What a key says; none where it is not there or says nothing.
    pub(super) fn value(&self, key: &'static str) -> Option<&'f Value> {
        self.asked.borrow_mut().insert(key);
        let own = self.entries.iter().find(|own| own.name == key)?;
        (own.value.what != What::Nothing).then_some(&own.value)
    }

    /// The keys that nothing asked for.
    pub(super) fn others(&self) -> Vec<&'f str> {
        let asked = self.asked.borrow();
        let names = self.entries.iter().map(|own| own.name.as_str());
        names.filter(|own| !asked.contains(own)).collect()
    }

    fn wrong(&self, place: Range<usize>, what: String, help: &str) {
        self.file.wrong(place, format!("`{}`: {what}", self.tag), help);
    }

    fn missing(&self, key: &str) {
        let help = "the file may be cut off or edited: save the rotor again with `rotor.save(…)`";
        self.wrong(self.place(), format!("`{key}` is missing"), help);
    }

    /// A number that must be there.
    pub(super) fn number(&self, key: &'static str, sign: Sign) -> f64 {
        match self.value(key) {
            Some(value) => self.of_value(key, value, sign),
            None => {
                self.missing(key);
                1.0
            }
        }
    }

    /// A number that may be left out.
    pub(super) fn optional(&self, key: &'static str, sign: Sign) -> Option<f64> {
        self.value(key).map(|value| self.of_value(key, value, sign))
    }

    /// A number; another one where it is none, which is noted.
    fn of_value(&self, key: &str, value: &Value, sign: Sign) -> f64 {
        let What::Number(number) = value.what else {
            let written = self.file.source.text.get(value.place.clone()).unwrap_or("");
            let written: String = written.chars().take(40).collect();
            let what = format!("`{key}` is no number but {}", written.trim());
            let help = "ROSS saves numbers in SI units, without unit: save the rotor again with `rotor.save(…)`";
            self.wrong(value.place.clone(), what, help);
            return 1.0;
        };
        let what = match sign {
            _ if !number.is_finite() => "is not finite",
            Sign::NotNegative if number < 0.0 => "is negative",
            Sign::Positive if number <= 0.0 => "is not above zero",
            _ => return number,
        };
        self.wrong(value.place.clone(), format!("`{key}` = {number:?} {what}"), SAVED);
        1.0
    }

    /// A node that must be there.
    pub(super) fn node(&self, key: &'static str) -> Option<usize> {
        let node = self.optional_node(key);
        if self.value(key).is_none() {
            self.missing(key);
        }
        node
    }

    /// A node that may be left out.
    pub(super) fn optional_node(&self, key: &'static str) -> Option<usize> {
        const MOST: f64 = 1e6;
        let value = self.value(key)?;
        let number = self.of_value(key, value, Sign::NotNegative);
        if number.fract() == 0.0 && number <= MOST {
            return Some(number as usize);
        }
        let what = format!("`{key}` = {number:?} is no number of a node");
        self.wrong(value.place.clone(), what, SAVED);
        None
    }

    /// A number or a list of them, at least one.
    pub(super) fn list(&self, key: &'static str, sign: Sign) -> Option<Vec<f64>> {
        let value = self.value(key)?;
        match &value.what {
            What::List(items) if items.is_empty() => {
                self.wrong(value.place.clone(), format!("`{key}` is an empty list"), SAVED);
                None
            }
            What::List(items) => {
                Some(items.iter().map(|own| self.of_value(key, own, sign)).collect())
            }
            _ => Some(vec![self.of_value(key, value, sign)]),
        }
    }

    pub(super) fn flag(&self, key: &'static str) -> Option<bool> {
        match self.value(key)?.what {
            What::Flag(flag) => Some(flag),
            // NumPy's truth values are written as numbers by some versions.
            What::Number(number) => Some(number != 0.0),
            _ => None,
        }
    }

    pub(super) fn text(&self, key: &'static str) -> Option<&'f str> {
        match &self.value(key)?.what {
            What::Text(text) => Some(text),
            _ => None,
        }
    }

    /// An error about one of its keys, or about all of it.
    pub(super) fn refuse(&self, key: &'static str, what: String, help: &str) {
        let place = self.value(key).map_or(self.place(), |own| own.place.clone());
        self.wrong(place, what, help);
    }

    /// The entry of a table within it.
    pub(super) fn entry(&self, key: &'static str) -> Option<&'f Entry> {
        self.value(key)?;
        self.entries.iter().find(|own| own.name == key)
    }

    /// Says that a key is missing.
    pub(super) fn demand(&self, key: &'static str) {
        if self.value(key).is_none() {
            self.missing(key);
        }
    }
}

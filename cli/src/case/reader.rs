//! Strict reading of one table: every key asked for is known, every other one is an error.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source, suggest};
use whirl_codegen::units::{Dimension, Quantity};

use super::tree::{Node, Place, Table, Value};

/// Reads one table. Wrong and missing values are noted, and a stand-in is given so that reading goes
/// on; the notes make the whole reading fail in the end.
pub(crate) struct Reader<'a> {
    table: &'a Table,
    /// How messages call the table, such as `[shaft]`; empty for a whole file.
    name: String,
    place: Place,
    asked: RefCell<BTreeSet<&'static str>>,
    errors: &'a RefCell<Diagnostics>,
}

impl<'a> Reader<'a> {
    /// Reads the whole of `source`.
    pub(crate) fn file(
        source: &Arc<Source>,
        table: &'a Table,
        errors: &'a RefCell<Diagnostics>,
    ) -> Self {
        let place = Place { source: source.clone(), span: 0..0 };
        Reader { table, name: String::new(), place, asked: RefCell::default(), errors }
    }

    /// Where the table stands.
    pub(crate) fn place(&self) -> &Place {
        &self.place
    }

    /// Places of all values by their keys.
    pub(crate) fn places(&self) -> BTreeMap<String, Located> {
        let entries = self.table.entries.iter();
        entries.map(|(key, (_, node))| (key.clone(), node.place.text(""))).collect()
    }

    /// Notes an error.
    pub(crate) fn note(&self, place: &Place, code: Code, message: String, help: Option<String>) {
        let diagnostic = place.error(code, message).maybe_help(help);
        self.errors.borrow_mut().push(diagnostic);
    }

    /// Notes an error made elsewhere.
    pub(crate) fn push(&self, diagnostic: Diagnostic) {
        self.errors.borrow_mut().push(diagnostic);
    }

    /// Whether `key` is given.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.table.entries.contains_key(key)
    }

    fn get(&self, key: &'static str) -> Option<&'a Node> {
        self.asked.borrow_mut().insert(key);
        self.table.entries.get(key).map(|(_, node)| node)
    }

    /// Notes that `key` is missing, and how to mend that.
    pub(crate) fn absent(&self, key: &str, help: &str) {
        let message = format!("{} does not say `{key}`", self.called("the case"));
        self.note(&self.place, Code::MISSING_KEY, message, Some(help.to_string()));
    }

    /// Notes that two keys are given where one excludes the other.
    pub(crate) fn conflict(&self, key: &str, other: &str) {
        let Some((place, _)) = self.table.entries.get(key) else {
            return;
        };
        let message = format!("`{key}` and `{other}` exclude each other");
        self.note(place, Code::BAD_VALUE, message, Some("keep one of them".to_string()));
    }

    fn called(&self, whole: &str) -> String {
        if self.name.is_empty() { whole.to_string() } else { format!("`{}`", self.name) }
    }

    /// Notes that `key` is missing; the place is that of the table.
    fn missing(&self, key: &str, example: &str) -> Place {
        self.absent(key, &format!("add `{key} = {example}`"));
        self.place.clone()
    }

    fn wrong(&self, key: &str, node: &Node, wanted: &str, example: &str) {
        self.note(
            &node.place,
            Code::BAD_VALUE,
            format!("`{key}` takes {wanted}, not {}", node.value.kind()),
            Some(format!("such as `{key} = {example}`")),
        );
    }

    /// Text, if given.
    pub(crate) fn text(&self, key: &'static str) -> Option<Located> {
        let node = self.get(key)?;
        match &node.value {
            Value::Text(text) => Some(node.place.text(text)),
            _ => {
                self.wrong(key, node, "text", "\"…\"");
                None
            }
        }
    }

    /// Text that must be given.
    pub(crate) fn needed_text(&self, key: &'static str, example: &str) -> Located {
        if !self.has(key) {
            let place = self.missing(key, example);
            self.asked.borrow_mut().insert(key);
            return place.text("");
        }
        self.text(key).unwrap_or_else(|| self.place.text(""))
    }

    /// One of a few words, if given.
    pub(crate) fn choice<T: Copy>(&self, key: &'static str, words: &[(&str, T)]) -> Option<T> {
        let text = self.text(key)?;
        let found = words.iter().find(|(word, _)| *word == text.text());
        if found.is_none() {
            let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
            let message = format!("`{key}` cannot be `{}`", text.text());
            let error = text.error_here(Code::BAD_VALUE, message);
            self.push(error.maybe_help(suggest(text.text(), &known)));
        }
        found.map(|(_, value)| *value)
    }

    /// Names in a list, or one alone, if given.
    pub(crate) fn names(&self, key: &'static str) -> Option<Vec<Located>> {
        let node = self.get(key)?;
        let alone = std::slice::from_ref(node);
        let list = match &node.value {
            Value::List(list) => list.as_slice(),
            _ => alone,
        };
        let mut names = Vec::with_capacity(list.len());
        for item in list {
            match &item.value {
                Value::Text(name) => names.push(item.place.text(name)),
                _ => self.wrong(key, item, "names", "[\"A\", \"B\"]"),
            }
        }
        Some(names)
    }

    /// Names that must be given, `count` of them where a number is asked for.
    pub(crate) fn needed_names(
        &self,
        key: &'static str,
        count: Option<usize>,
        example: &str,
    ) -> Vec<Located> {
        let Some(names) = self.names(key) else {
            if !self.has(key) {
                self.missing(key, example);
            }
            return Vec::new();
        };
        let enough = count.map_or(!names.is_empty(), |count| names.len() == count);
        if !enough && let Some(node) = self.get(key) {
            let wanted = count.map_or("at least one name".to_string(), |n| format!("{n} names"));
            self.note(
                &node.place,
                Code::BAD_VALUE,
                format!("`{key}` takes {wanted}, here are {}", names.len()),
                Some(format!("such as `{key} = {example}`")),
            );
        }
        names
    }

    /// True or false, if given.
    pub(crate) fn flag(&self, key: &'static str) -> Option<bool> {
        let node = self.get(key)?;
        match node.value {
            Value::Flag(flag) => Some(flag),
            _ => {
                self.wrong(key, node, "true or false", "true");
                None
            }
        }
    }

    /// A whole number of at least `least`, if given.
    pub(crate) fn count(&self, key: &'static str, least: usize) -> Option<usize> {
        let node = self.get(key)?;
        let Value::Integer(integer) = node.value else {
            self.wrong(key, node, "a whole number", &least.max(1).to_string());
            return None;
        };
        match usize::try_from(integer) {
            Ok(value) if value >= least => Some(value),
            _ => {
                let message = format!("`{key}` must be at least {least}, not {integer}");
                self.note(&node.place, Code::BAD_VALUE, message, None);
                None
            }
        }
    }

    /// A whole number that must be given.
    pub(crate) fn needed_count(&self, key: &'static str, least: usize) -> usize {
        if !self.has(key) {
            self.asked.borrow_mut().insert(key);
            self.missing(key, &least.max(1).to_string());
        }
        self.count(key, least).unwrap_or(least.max(1))
    }

    /// A number without unit that must be given and lie in the open interval `range`.
    pub(crate) fn needed_number(&self, key: &'static str, range: (f64, f64), example: &str) -> f64 {
        let stand_in = 0.5 * (range.0 + range.1);
        let Some(node) = self.get(key) else {
            self.missing(key, example);
            return stand_in;
        };
        let value = match node.value {
            Value::Number(value) => value,
            Value::Integer(value) => value as f64,
            _ => {
                self.wrong(key, node, "a number without unit", example);
                return stand_in;
            }
        };
        if !(range.0 < value && value < range.1) {
            let message =
                format!("`{key}` must lie between {} and {}, not {value}", range.0, range.1);
            self.note(&node.place, Code::BAD_VALUE, message, None);
        }
        value
    }

    fn quantity_of(&self, key: &str, node: &Node, kind: &Kind) -> Option<f64> {
        let text = match &node.value {
            Value::Text(text) => text,
            Value::Integer(_) | Value::Number(_) => {
                self.note(
                    &node.place,
                    Code::WRONG_UNIT,
                    format!("`{key}` is {} and needs its unit", kind.dimension),
                    Some(format!(
                        "write it as text with a unit, such as `{key} = \"{}\"`",
                        kind.example
                    )),
                );
                return None;
            }
            _ => {
                let wanted = kind.dimension.to_string();
                self.wrong(key, node, &wanted, &format!("\"{}\"", kind.example));
                return None;
            }
        };
        match Quantity::parse(text).and_then(|quantity| quantity.expect(&kind.dimension)) {
            Ok(value) => self.in_range(key, node, kind, value),
            Err(error) => {
                let start = node.place.span.start + OPENING_QUOTE;
                let mut diagnostic = error.at(&node.place.source, start);
                diagnostic.message = format!("`{key}`: {}", diagnostic.message);
                diagnostic.help = Some(format!("such as `{key} = \"{}\"`", kind.example));
                self.errors.borrow_mut().push(diagnostic);
                None
            }
        }
    }

    fn in_range(&self, key: &str, node: &Node, kind: &Kind, value: f64) -> Option<f64> {
        let fault = match kind.range {
            Range::Any => None,
            Range::Positive if value > 0.0 => None,
            Range::Positive => Some("greater than zero"),
            Range::NotNegative if value >= 0.0 => None,
            Range::NotNegative => Some("zero or greater"),
        };
        let Some(wanted) = fault else {
            return Some(value);
        };
        self.note(
            &node.place,
            Code::BAD_VALUE,
            format!("`{key}` must be {wanted}"),
            Some(format!("such as `{key} = \"{}\"`", kind.example)),
        );
        None
    }

    /// A quantity, if given; SI.
    pub(crate) fn quantity(&self, key: &'static str, kind: &Kind) -> Option<f64> {
        self.quantity_of(key, self.get(key)?, kind)
    }

    /// A quantity that must be given; SI.
    pub(crate) fn needed(&self, key: &'static str, kind: &Kind) -> f64 {
        match self.get(key) {
            Some(node) => self.quantity_of(key, node, kind).unwrap_or(1.0),
            None => {
                self.missing(key, &format!("\"{}\"", kind.example));
                1.0
            }
        }
    }

    /// A list of quantities that must be given; SI.
    pub(crate) fn needed_quantities(&self, key: &'static str, kind: &Kind) -> Vec<f64> {
        if !self.has(key) {
            self.missing(key, &format!("[\"{}\"]", kind.example));
        }
        self.quantities(key, kind).unwrap_or_default()
    }

    /// A list of quantities, if given; SI.
    pub(crate) fn quantities(&self, key: &'static str, kind: &Kind) -> Option<Vec<f64>> {
        let node = self.get(key)?;
        let Value::List(list) = &node.value else {
            self.wrong(key, node, "a list of quantities", &format!("[\"{}\"]", kind.example));
            return None;
        };
        let read = list.iter().filter_map(|item| self.quantity_of(key, item, kind));
        Some(read.collect())
    }

    /// A table inside this one, if given.
    pub(crate) fn table(&self, key: &'static str) -> Option<Reader<'a>> {
        let (key_place, node) = {
            self.asked.borrow_mut().insert(key);
            self.table.entries.get(key)?
        };
        match &node.value {
            Value::Table(table) => Some(self.inner(self.path(key), key_place, table)),
            _ => {
                self.wrong(key, node, "a table", "{ … }");
                None
            }
        }
    }

    /// A table inside this one that must be given.
    pub(crate) fn needed_table(&self, key: &'static str) -> Option<Reader<'a>> {
        if !self.has(key) {
            self.asked.borrow_mut().insert(key);
            self.note(
                &self.place,
                Code::MISSING_KEY,
                format!("the table `[{}]` is missing", self.path(key)),
                None,
            );
        }
        self.table(key)
    }

    /// Tables in a list (`[[key]]`); none if the key is not given.
    pub(crate) fn tables(&self, key: &'static str) -> Vec<Reader<'a>> {
        let Some(node) = self.get(key) else {
            return Vec::new();
        };
        let Value::List(list) = &node.value else {
            self.wrong(key, node, "a list of tables", "[{ … }]");
            return Vec::new();
        };
        let mut readers = Vec::with_capacity(list.len());
        for item in list {
            match &item.value {
                Value::Table(table) => {
                    readers.push(self.inner(self.path(key), &item.place, table));
                }
                _ => self.wrong(key, item, "a table", "{ … }"),
            }
        }
        readers
    }

    /// Tables by names that the user chose, such as `[material.steel]`.
    pub(crate) fn named_tables(&self, key: &'static str) -> Vec<(String, Reader<'a>)> {
        let Some(node) = self.get(key) else {
            return Vec::new();
        };
        let Value::Table(outer) = &node.value else {
            self.wrong(key, node, "tables by name", "{ … }");
            return Vec::new();
        };
        let mut readers = Vec::new();
        for (name, (place, node)) in &outer.entries {
            match &node.value {
                Value::Table(table) => {
                    let path = format!("{}.{name}", self.path(key));
                    readers.push((name.clone(), self.inner(path, place, table)));
                }
                _ => self.wrong(name, node, "a table", "{ … }"),
            }
        }
        readers
    }

    fn path(&self, key: &str) -> String {
        match self.name.trim_matches(['[', ']']) {
            "" => key.to_string(),
            name => format!("{name}.{key}"),
        }
    }

    fn inner(&self, path: String, place: &Place, table: &'a Table) -> Reader<'a> {
        Reader {
            table,
            name: format!("[{path}]"),
            place: place.clone(),
            asked: RefCell::default(),
            errors: self.errors,
        }
    }
}

/// Notes every key that nothing has asked for.
impl Drop for Reader<'_> {
    fn drop(&mut self) {
        let asked = self.asked.borrow();
        let known: Vec<&str> = asked.iter().copied().collect();
        for (key, (place, _)) in &self.table.entries {
            if asked.contains(key.as_str()) {
                continue;
            }
            self.note(
                place,
                Code::UNKNOWN_KEY,
                format!("{} has no key `{key}`", self.called("a case")),
                suggest(key, &known),
            );
        }
    }
}

/// Bytes before the text of a string.
const OPENING_QUOTE: usize = 1;

/// What a quantity is.
pub(crate) struct Kind {
    /// What it measures.
    dimension: Dimension,
    /// As a user would write it.
    example: &'static str,
    /// Values allowed.
    range: Range,
}

/// Values that a quantity may take.
#[derive(Clone, Copy)]
enum Range {
    Any,
    Positive,
    NotNegative,
}

macro_rules! kinds {
    ($($name:ident: $dimension:ident, $example:literal, $range:ident;)*) => {
        $(pub(crate) const $name: Kind = Kind {
            dimension: Dimension::$dimension,
            example: $example,
            range: Range::$range,
        };)*
    };
}

kinds! {
    LENGTH: LENGTH, "12.5 mm", Positive;
    POSITION: LENGTH, "12.5 mm", Any;
    VELOCITY: SPEED, "1 m/s", Any;
    MASS: MASS, "100 kg", Positive;
    MODULUS: PRESSURE, "200 GPa", Positive;
    DENSITY: DENSITY, "7860 kg/m^3", Positive;
    TIME: TIME, "7.4e-5 s", Positive;
    DAMPING_TIME: TIME, "1e-4 s", NotNegative;
    STIFFNESS: STIFFNESS, "1e8 N/m", NotNegative;
    DAMPING: DAMPING, "20 N*s/m", NotNegative;
    FORCE: FORCE, "1000 N", Any;
    TOLERANCE: FORCE, "1e-3 N", Positive;
    TORQUE: TORQUE, "109 N*m", Any;
    TARGET_SPEED: ANGULAR_SPEED, "4500 rpm", Positive;
    FREQUENCY: FREQUENCY, "37.5 Hz", Positive;
    ANGLE: ANGLE, "90 deg", Any;
}

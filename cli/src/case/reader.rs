//! Strict reading of one table: keys are read as they are declared (see [`super::schema`]), and one that
//! nothing asked for is an error.

mod quantities;
mod tables;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source, nearest, suggest};
use whirl_codegen::spec::schema::{Need, Shape};

use super::tree::{Node, Place, Table, Value};

/// Reads one table. Wrong and missing values are noted, and a stand-in is given so that reading goes
/// on; the notes make the whole reading fail in the end.
pub(crate) struct Reader<'a> {
    table: &'a Table,
    /// What it may say.
    shape: &'static Shape,
    /// How messages call the table, such as `[shaft]`; empty for a whole file.
    name: String,
    place: Place,
    asked: RefCell<BTreeSet<&'static str>>,
    /// Keys that must be there and are not. Reported at the end: where one was misspelt, it is not missing.
    missing: RefCell<Vec<(&'static str, Diagnostic)>>,
    errors: &'a RefCell<Diagnostics>,
}

impl<'a> Reader<'a> {
    /// Reads the whole of `source`, of which `shape` says what it may hold.
    pub(crate) fn file(
        source: &Arc<Source>,
        table: &'a Table,
        shape: &'static Shape,
        errors: &'a RefCell<Diagnostics>,
    ) -> Self {
        let place = Place { source: source.clone(), span: 0..0 };
        Reader::new(table, shape, String::new(), place, errors)
    }

    fn new(
        table: &'a Table,
        shape: &'static Shape,
        name: String,
        place: Place,
        errors: &'a RefCell<Diagnostics>,
    ) -> Self {
        let (asked, missing) = (RefCell::default(), RefCell::default());
        Reader { table, shape, name, place, asked, missing, errors }
    }

    /// Where the table stands.
    pub(crate) fn place(&self) -> &Place {
        &self.place
    }

    /// Places of all values by their keys, such as `length`, `cells.sectors` and `loads[0]`.
    pub(crate) fn places(&self) -> BTreeMap<String, Located> {
        let mut places = BTreeMap::new();
        add_places("", self.table, &mut places);
        places
    }

    /// Notes an error.
    pub(crate) fn note(&self, place: &Place, code: Code, message: String, help: Option<String>) {
        let diagnostic = place.error(code, message).maybe_help(help);
        self.errors.borrow_mut().push(diagnostic);
    }

    /// Number of errors noted so far.
    pub(crate) fn errors(&self) -> usize {
        self.errors.borrow().len()
    }

    /// Notes an error made elsewhere.
    pub(crate) fn push(&self, diagnostic: Diagnostic) {
        self.errors.borrow_mut().push(diagnostic);
    }

    /// Whether `key` is given.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.table.entries.contains_key(key)
    }

    /// What a key takes, if it is declared so that `fits`. One that is not is never read: a case that has it
    /// is refused.
    fn declared(&self, key: &str, fits: fn(&Shape) -> bool) -> Option<&'static Shape> {
        let shape = self.shape.of_key(key).filter(|shape| shape.admits(fits));
        debug_assert!(shape.is_some(), "`{}` is read but not so declared", self.path(key));
        shape
    }

    fn get(
        &self,
        key: &'static str,
        fits: fn(&Shape) -> bool,
    ) -> Option<(&'a Node, &'static Shape)> {
        let shape = self.declared(key, fits)?;
        self.asked.borrow_mut().insert(key);
        self.table.entries.get(key).map(|(_, node)| (node, shape))
    }

    /// A value of a key as it would be written in TOML.
    pub(crate) fn example(&self, key: &str) -> String {
        let Some(key) = self.shape.key(key) else { return String::new() };
        if !key.example.is_empty() {
            return key.example.to_string();
        }
        match &key.shape {
            Shape::Quantity(measure) => format!("\"{}\"", measure.example),
            Shape::List(Shape::Quantity(measure)) => format!("[\"{}\"]", measure.example),
            Shape::Count(least, _) => (*least).max(1).to_string(),
            shape if shape.is_text() => "\"…\"".to_string(),
            _ => "…".to_string(),
        }
    }

    /// Notes that `key` is missing, and how to fix that.
    pub(crate) fn absent(&self, key: &'static str, help: &str) {
        let message = format!("`{key}` is missing in {}", self.called("the case"));
        let error = self.place.error(Code::MISSING_KEY, message).help(help);
        self.missing.borrow_mut().push((key, error));
    }

    /// Notes that a key is missing if it is not there; for those that only some tables must have.
    pub(crate) fn demand(&self, key: &'static str) {
        self.asked.borrow_mut().insert(key);
        if self.has(key) {
            return;
        }
        if self.declared(key, |_| true).is_some_and(Shape::is_table) {
            let message = format!("the table `[{}]` is missing", self.path(key));
            let error = self
                .place
                .error(Code::MISSING_KEY, message)
                .help("add it here, or `include` a file that has it");
            self.missing.borrow_mut().push((key, error));
        } else {
            self.absent(key, &format!("add `{key} = {}`", self.example(key)));
        }
    }

    /// Leaves a key unread without saying that it is unknown.
    pub(crate) fn pass_over(&self, key: &'static str) {
        self.asked.borrow_mut().insert(key);
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
        let (node, _) = self.get(key, Shape::is_text)?;
        match &node.value {
            Value::Text(text) if text.chars().any(char::is_control) => {
                let message = format!("`{key}` has a control character in it");
                let help = "write it in one line, without escapes such as `\\n` and `\\u001b`";
                self.note(&node.place, Code::BAD_VALUE, message, Some(help.to_string()));
                None
            }
            Value::Text(text) => Some(node.place.text(text)),
            _ => {
                self.wrong(key, node, "text", &self.example(key));
                None
            }
        }
    }

    /// Text, or none with the place of the table.
    pub(crate) fn text_or_none(&self, key: &'static str) -> Located {
        self.text(key).unwrap_or_else(|| self.place.text(""))
    }

    /// One of the words declared, if given.
    pub(crate) fn word(&self, key: &'static str) -> Option<&'static str> {
        let words = self.declared(key, |shape| matches!(shape, Shape::Words(_)))?.words();
        let text = self.text(key)?;
        let found = words.iter().find(|word| **word == text.text()).copied();
        if found.is_none() {
            let message = format!("`{key}` cannot be `{}`", text.text());
            let error = text.error_here(Code::BAD_VALUE, message);
            self.push(error.maybe_help(suggest(text.text(), &words)));
        }
        found
    }

    /// Names in a list, or one alone where this is declared; as many as declared.
    pub(crate) fn names(&self, key: &'static str) -> Vec<Located> {
        let is_list = |shape: &Shape| shape.of_items().is_some_and(Shape::is_text);
        let Some((node, shape)) = self.get(key, is_list) else { return Vec::new() };
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
        let needed = self.shape.key(key).is_some_and(|key| key.need != Need::Free);
        let wanted = match shape {
            Shape::Tuple(_, count) if names.len() != *count => format!("{count} names"),
            _ if needed && names.is_empty() => "at least one name".to_string(),
            _ => return names,
        };
        // Names of another type have been noted.
        if names.len() == list.len() {
            self.note(
                &node.place,
                Code::BAD_VALUE,
                format!("`{key}` takes {wanted}, not {}", names.len()),
                Some(format!("such as `{key} = {}`", self.example(key))),
            );
        }
        // The names are not known: none is checked.
        Vec::new()
    }

    /// True or false, if given.
    pub(crate) fn flag(&self, key: &'static str) -> Option<bool> {
        let (node, _) = self.get(key, |shape| matches!(shape, Shape::Flag))?;
        match node.value {
            Value::Flag(flag) => Some(flag),
            _ => {
                self.wrong(key, node, "true or false", "true");
                None
            }
        }
    }

    /// A whole number, if given.
    pub(crate) fn count(&self, key: &'static str) -> Option<usize> {
        let (node, shape) = self.get(key, |shape| matches!(shape, Shape::Count(..)))?;
        let Shape::Count(least, most) = *shape else { return None };
        let Value::Integer(integer) = node.value else {
            self.wrong(key, node, "a whole number", &self.example(key));
            return None;
        };
        match usize::try_from(integer) {
            Ok(value) if (least..=most).contains(&value) => Some(value),
            value => {
                let bound = match value {
                    Ok(value) if value > most => format!("at most {most}"),
                    _ => format!("at least {least}"),
                };
                let message = format!("`{key}` must be {bound}, not {integer}");
                self.note(&node.place, Code::BAD_VALUE, message, None);
                None
            }
        }
    }

    /// A whole number, or one.
    pub(crate) fn count_or_one(&self, key: &'static str) -> usize {
        self.count(key).unwrap_or(1)
    }

    /// A number without unit between bounds, or one in their middle.
    pub(crate) fn number_or_middle(&self, key: &'static str) -> f64 {
        let Some(&Shape::Between(low, high)) =
            self.declared(key, |shape| matches!(shape, Shape::Between(..)))
        else {
            return 0.0;
        };
        let middle = 0.5 * (low + high);
        let Some((node, _)) = self.get(key, |_| true) else { return middle };
        let value = match node.value {
            Value::Number(value) => value,
            Value::Integer(value) => value as f64,
            _ => {
                self.wrong(key, node, "a number without unit", &self.example(key));
                return middle;
            }
        };
        if !(low < value && value < high) {
            let message = format!("`{key}` must lie between {low} and {high}, not {value}");
            self.note(&node.place, Code::BAD_VALUE, message, None);
        }
        value
    }
}

fn add_places(outer: &str, table: &Table, places: &mut BTreeMap<String, Located>) {
    for (key, (_, node)) in &table.entries {
        let name = format!("{outer}{key}");
        match &node.value {
            Value::Table(inner) => add_places(&format!("{name}."), inner, places),
            Value::List(items) => {
                let items = items.iter().enumerate();
                places
                    .extend(items.map(|(i, item)| (format!("{name}[{i}]"), item.place.written())));
            }
            _ => {}
        }
        places.insert(name, node.place.written());
    }
}

/// Notes every key that must be there and is not, and every key that nothing has asked for.
impl Drop for Reader<'_> {
    fn drop(&mut self) {
        for key in self.shape.keys().filter(|key| key.need != Need::Free) {
            self.demand(key.name);
        }
        let asked = self.asked.borrow();
        let known: Vec<&str> = asked.iter().copied().collect();
        let mut missing = std::mem::take(&mut *self.missing.borrow_mut());
        for (key, (place, _)) in &self.table.entries {
            if asked.contains(key.as_str()) {
                continue;
            }
            // Of two keys as near, the one that is not there was meant.
            let meant = nearest(key, missing.iter().map(|(absent, _)| *absent)).map(str::to_owned);
            let help = match meant {
                Some(meant) => {
                    missing.retain(|(absent, _)| *absent != meant);
                    Some(format!("did you mean `{meant}`?"))
                }
                None => suggest(key, &known),
            };
            let message = format!("{} has no key `{key}`", self.called("a case"));
            self.note(place, Code::UNKNOWN_KEY, message, help);
        }
        missing.into_iter().for_each(|(_, error)| self.push(error));
    }
}

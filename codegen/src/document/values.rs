//! Values of keys: text, words, numbers, counts, truth values and lists of them.

use std::ops::Range;

use num_traits::ToPrimitive;

use super::schema::{Need, Shape};
use super::tree::{Content, Node};
use super::wording::Wording;
use super::{Document, Table};
use crate::diagnostic::{Code, Located, suggest};
use crate::rational::Rational;

/// A value of any type, for keys that allow several.
#[derive(Debug, Clone)]
pub enum Value<'d> {
    /// A string.
    String(Located),
    /// An integer or float, exactly, and where it stands.
    Number(Rational, Range<usize>),
    /// A truth value, and where it stands.
    Boolean(bool, Range<usize>),
    /// An array: see `Table::items`.
    Array(Vec<Item<'d>>, Range<usize>),
    /// A table: see [`Table::table`].
    Table(Range<usize>),
    /// A date, which no spec uses, or a number that is not finite.
    Other(Range<usize>),
}

impl Value<'_> {
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
    pub(super) document: &'d Document<'d>,
    pub(super) node: &'d Node,
    pub(super) shape: &'static Shape,
}

impl<'d> Item<'d> {
    /// What it is.
    pub fn value(&self) -> Value<'d> {
        let span = self.node.place.span.clone();
        match &self.node.content {
            Content::Text(text) => Value::String(self.node.place.text(text)),
            Content::Number(number) => match number.exact() {
                Some(value) => Value::Number(value, span),
                None => Value::Other(span),
            },
            Content::Flag(flag) => Value::Boolean(*flag, span),
            Content::Date => Value::Other(span),
            Content::List(_) => Value::Array(self.items().unwrap_or_default(), span),
            Content::Table(_) => Value::Table(span),
        }
    }

    /// Its elements, if it is an array.
    fn items(&self) -> Option<Vec<Item<'d>>> {
        let Content::List(items) = &self.node.content else { return None };
        // Of a list where none is declared, no item is read any further.
        let shape = self.shape.of_items().unwrap_or(&Shape::Either(&[]));
        Some(items.iter().map(|node| Item { node, shape, ..*self }).collect())
    }
}

impl<'d> Table<'d> {
    /// The value of a key that takes any of several types.
    pub fn value(&self, key: &str) -> Option<Value<'d>> {
        debug_assert!(matches!(self.shape.of_key(key), Some(Shape::Either(_))), "`{key}`");
        let (node, shape) = self.entry(key, |_| true)?;
        Some(Item { document: self.document, node, shape }.value())
    }

    /// Reports a value of another type than `wanted`.
    pub(super) fn wrong(&self, key: &str, node: &Node, wanted: &str, example: &str) {
        self.push(self.wording().wrong_type(&self.called(key), node, wanted, example));
    }

    /// A string, if the key is there; another type is an error.
    pub fn optional_string(&self, key: &str) -> Option<Located> {
        let (node, _) = self.entry(key, Shape::is_text)?;
        let case = self.wording() == Wording::Case;
        match &node.content {
            // Formulas of specs stand in several lines.
            Content::Text(text) if case && text.chars().any(char::is_control) => {
                let message = format!("`{key}` has a control character in it");
                let help = "write it in one line, without escapes such as `\\n` and `\\u001b`";
                self.push(node.place.error(Code::BAD_VALUE, message).help(help));
                return None;
            }
            Content::Text(text) => return Some(node.place.text(text)),
            _ if case => self.wrong(key, node, "text", &self.example(key)),
            _ => self.wrong(key, node, "a string", "\"…\""),
        }
        None
    }

    /// A string that must be there.
    pub(crate) fn string(&self, key: &str) -> Option<Located> {
        self.demand(key);
        self.optional_string(key)
    }

    /// A string, or none with the place of the table.
    pub fn text_or_none(&self, key: &str) -> Located {
        self.optional_string(key).unwrap_or_else(|| self.heading().text(""))
    }

    /// One of the words declared, if the key is there; any other string is an error that names the nearest.
    pub fn optional_word(&self, key: &str) -> Option<&'static str> {
        let shape = self.declared(key, |shape| matches!(shape, Shape::Words(_)))?;
        self.word_among(key, &shape.words())
    }

    /// One of the words declared, which must be there.
    pub(crate) fn word(&self, key: &str) -> Option<&'static str> {
        self.demand(key);
        self.optional_word(key)
    }

    pub(super) fn word_among(&self, key: &str, words: &[&'static str]) -> Option<&'static str> {
        let text = self.optional_string(key)?;
        let word = words.iter().find(|word| **word == text.text()).copied();
        if word.is_none() {
            let message = format!("`{}` cannot be `{}`", self.called(key), text.text());
            let error = text.error_here(Code::BAD_VALUE, message);
            self.push(error.maybe_help(suggest(text.text(), words)));
        }
        word
    }

    /// An exact number, if the key is there, and where it stands.
    pub fn optional_number(&self, key: &str) -> Option<(Rational, Range<usize>)> {
        let (node, _) = self.entry(key, |shape| matches!(shape, Shape::Number))?;
        self.exact_number(key, node).map(|value| (value, node.place.span.clone()))
    }

    /// An exact number that must be there, and where it stands.
    pub fn number(&self, key: &str) -> Option<(Rational, Range<usize>)> {
        self.demand(key);
        self.optional_number(key)
    }

    fn exact_number(&self, key: &str, node: &Node) -> Option<Rational> {
        let value = match &node.content {
            Content::Number(number) => number.exact(),
            _ => None,
        };
        if value.is_none() {
            self.wrong(key, node, "a finite number", "1.5");
        }
        value
    }

    /// A number without unit between bounds, or one in their middle.
    pub fn number_or_middle(&self, key: &str) -> f64 {
        let is_between = |shape: &Shape| matches!(shape, Shape::Between(..));
        let Some(&Shape::Between(low, high)) = self.declared(key, is_between) else { return 0.0 };
        let middle = 0.5 * (low + high);
        let Some((node, _)) = self.entry(key, is_between) else { return middle };
        let value = match &node.content {
            Content::Number(number) => number.float(),
            _ => None,
        };
        let Some(value) = value else {
            self.wrong(key, node, "a number without unit", &self.example(key));
            return middle;
        };
        if !(low < value && value < high) {
            let message = format!("`{key}` must lie above {low} and below {high}, not at {value}");
            self.push(node.place.error(Code::BAD_VALUE, message));
        }
        value
    }

    /// A count (0, 1, 2, …), if the key is there.
    pub fn optional_count(&self, key: &str) -> Option<usize> {
        let (node, shape) = self.entry(key, |shape| matches!(shape, Shape::Count(..)))?;
        if self.wording() == Wording::Case {
            return self.bounded_count(key, node, shape);
        }
        let value = self.exact_number(key, node)?;
        let count = if value.is_integer() { value.to_usize() } else { None };
        if count.is_none() {
            let message = format!("`{}` must be a count such as 1 or 24", self.full(key));
            self.push(node.place.error(Code::BAD_VALUE, message));
        }
        count
    }

    /// A count written without a point, within its bounds. Those of specs are checked where they are used.
    fn bounded_count(&self, key: &str, node: &Node, shape: &Shape) -> Option<usize> {
        let Shape::Count(least, most) = *shape else { return None };
        let integer = match &node.content {
            Content::Number(number) => number.integer(),
            _ => None,
        };
        let Some(integer) = integer else {
            self.wrong(key, node, "a whole number", &self.example(key));
            return None;
        };
        let count = usize::try_from(integer).ok();
        if count.is_none_or(|count| !(least..=most).contains(&count)) {
            let bound = match count {
                Some(count) if count > most => format!("at most {most}"),
                _ => format!("at least {least}"),
            };
            let message = format!("`{key}` must be {bound}, not {integer}");
            self.push(node.place.error(Code::BAD_VALUE, message));
            return None;
        }
        count
    }

    /// A count that must be there.
    pub(crate) fn count(&self, key: &str) -> Option<usize> {
        self.demand(key);
        self.optional_count(key)
    }

    /// A count, or one.
    pub fn count_or_one(&self, key: &str) -> usize {
        self.optional_count(key).unwrap_or(1)
    }

    /// A truth value, if the key is there.
    pub fn optional_boolean(&self, key: &str) -> Option<bool> {
        let (node, _) = self.entry(key, |shape| matches!(shape, Shape::Flag))?;
        match (&node.content, self.wording()) {
            (Content::Flag(flag), _) => return Some(*flag),
            (_, Wording::Spec) => self.wrong(key, node, "`true` or `false`", "true"),
            (_, Wording::Case) => self.wrong(key, node, "true or false", "true"),
        }
        None
    }

    /// The elements of an array, if the key is there.
    pub(crate) fn optional_items(&self, key: &str) -> Option<Vec<Item<'d>>> {
        let (node, shape) = self.entry(key, |shape| shape.of_items().is_some())?;
        let items = Item { document: self.document, node, shape }.items();
        if items.is_none() {
            self.wrong(key, node, "an array", "[…, …]");
        }
        items
    }

    /// The elements of an array that must be there.
    pub(crate) fn items(&self, key: &str) -> Option<Vec<Item<'d>>> {
        self.demand(key);
        self.optional_items(key)
    }

    /// Lists of texts in a list; none if the key is not given.
    pub fn lists_of_texts(&self, key: &str) -> Vec<Vec<Located>> {
        fn is_nested(shape: &Shape) -> bool {
            matches!(shape, Shape::List(Shape::List(Shape::Text)))
        }
        let Some((node, _)) = self.entry(key, is_nested) else { return Vec::new() };
        let wrong = |node: &Node| self.wrong(key, node, "lists of names", &self.example(key));
        let Content::List(lists) = &node.content else {
            wrong(node);
            return Vec::new();
        };
        let mut all = Vec::with_capacity(lists.len());
        for list in lists {
            let Content::List(items) = &list.content else {
                wrong(list);
                continue;
            };
            let text = |item: &Node| match &item.content {
                Content::Text(text) => Some(item.place.text(text)),
                _ => {
                    wrong(item);
                    None
                }
            };
            all.push(items.iter().filter_map(text).collect());
        }
        all
    }

    /// Positive numbers in a list; none if the key is not given.
    pub fn positive_numbers(&self, key: &str) -> Vec<f64> {
        let is_list =
            |shape: &Shape| shape.of_items().is_some_and(|own| matches!(own, Shape::Number));
        let Some((node, _)) = self.entry(key, is_list) else { return Vec::new() };
        let Content::List(list) = &node.content else {
            self.wrong(key, node, "numbers", &self.example(key));
            return Vec::new();
        };
        let mut numbers = Vec::with_capacity(list.len());
        for item in list {
            let Content::Number(number) = &item.content else {
                self.wrong(key, item, "positive numbers", &self.example(key));
                continue;
            };
            if let Some(value) = number.float().filter(|own| *own > 0.0) {
                numbers.push(value);
                continue;
            }
            let written = item.place.written();
            let message = format!("`{key}` takes positive numbers, and {} is none", written.text());
            let example = self.example(key);
            let help = format!("write numbers above zero, such as `{key} = {example}`");
            self.push(item.place.error(Code::BAD_VALUE, message).help(help));
        }
        numbers
    }

    /// Texts in a list, or one alone where this is declared; as many as declared.
    pub fn texts(&self, key: &str) -> Vec<Located> {
        let is_list = |shape: &Shape| shape.of_items().is_some_and(Shape::is_text);
        let Some((node, shape)) = self.entry(key, is_list) else { return Vec::new() };
        let list = match &node.content {
            Content::List(list) => list.as_slice(),
            _ => std::slice::from_ref(node),
        };
        let mut texts = Vec::with_capacity(list.len());
        for item in list {
            match &item.content {
                Content::Text(text) => texts.push(item.place.text(text)),
                _ => self.wrong(key, item, "names", "[\"A\", \"B\"]"),
            }
        }
        let needed = self.shape.key(key).is_some_and(|key| key.need != Need::Free);
        let wanted = match shape {
            Shape::Tuple(_, count) if texts.len() != *count => format!("{count} names"),
            _ if needed && texts.is_empty() => "at least one name".to_owned(),
            _ => return texts,
        };
        // Texts of another type have been noted.
        if texts.len() == list.len() {
            let message = format!("`{key}` takes {wanted}, not {}", texts.len());
            let help = format!("such as `{key} = {}`", self.example(key));
            self.push(node.place.error(Code::BAD_VALUE, message).help(help));
        }
        // The texts are not known: none is checked.
        Vec::new()
    }
}

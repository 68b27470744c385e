//! What messages say of a table's keys.

use super::Table;
use super::schema::Shape;
use super::wording::Wording;
use crate::diagnostic::{Code, Diagnostic};

impl Table<'_> {
    /// What messages call a key.
    pub(super) fn called(&self, key: &str) -> String {
        match self.wording() {
            Wording::Spec => self.full(key),
            Wording::Case => key.to_owned(),
        }
    }

    /// The message of a key that nothing reads.
    pub(super) fn unknown(&self, key: &str) -> String {
        match self.wording() {
            Wording::Spec => format!("unknown key `{}`", self.full(key)),
            Wording::Case if self.path.is_empty() => {
                format!("a {} has no key `{key}`", self.document.called)
            }
            Wording::Case => format!("`[{}]` has no key `{key}`", self.path),
        }
    }

    /// The error of a key that is not there, which is written as `help` says.
    pub(super) fn missing(&self, key: &str, help: &str) -> Diagnostic {
        let span = Some(self.span());
        let (span, message) = match (self.wording(), self.path.as_str()) {
            (Wording::Spec, "") => (None, format!("`{key}` is missing")),
            (Wording::Spec, path) => (span, format!("`{key}` is missing in `{path}`")),
            (Wording::Case, "") => {
                (span, format!("`{key}` is missing in the {}", self.document.called))
            }
            (Wording::Case, path) => (span, format!("`{key}` is missing in `[{path}]`")),
        };
        Diagnostic::new(self.source(), Code::MISSING_KEY, span, message).help(help)
    }

    /// The error of a key that takes values of a shape and is not there.
    pub(super) fn missing_shape(&self, key: &str, shape: &Shape) -> Diagnostic {
        match self.wording() {
            Wording::Spec => self.missing(key, &self.fix(key, shape)),
            Wording::Case if shape.is_table() => {
                let message = format!("the table `[{}]` is missing", self.full(key));
                let error = Diagnostic::new(self.source(), Code::MISSING_KEY, self.span(), message);
                let others = ", or `include` a file that has it";
                error.help(format!(
                    "add it here{}",
                    if self.document.called == "case" { others } else { "" }
                ))
            }
            Wording::Case => self.missing(key, &format!("add `{key} = {}`", self.example(key))),
        }
    }

    /// How to write a key of a spec that is not there.
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

    /// A value of a key of a case as it would be written in TOML.
    pub fn example(&self, key: &str) -> String {
        let Some(key) = self.shape.key(key) else { return String::new() };
        if !key.example.is_empty() {
            return key.example.to_owned();
        }
        match &key.shape {
            Shape::Quantity(measure) => format!("\"{}\"", measure.example),
            Shape::List(Shape::Quantity(measure)) => format!("[\"{}\"]", measure.example),
            Shape::Count(least, _) => (*least).max(1).to_string(),
            shape if shape.is_text() => "\"…\"".to_owned(),
            _ => "…".to_owned(),
        }
    }
}

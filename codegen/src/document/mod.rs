//! TOML files, read strictly: every key through its declaration ([`schema`]), every error at once and with
//! its place.
//!
//! A file is parsed into a [`tree::Tree`], into which the files that it includes can be merged. A reader asks
//! a [`Table`] of its [`Document`] for keys that are declared for it, and calls [`Table::finish`].

mod limits;
mod messages;
mod notes;
mod quantities;
mod reader;
pub mod schema;
mod tables;
#[cfg(test)]
mod tests;
pub mod tree;
mod values;
mod wording;

pub use notes::Document;
pub use reader::Table;
pub(crate) use reader::plain_name;
use schema::{Shape, key};
use tree::Place;
pub use values::{Item, Value};
pub use wording::Wording;

use crate::diagnostic::{Code, Diagnostic};

/// A file of which only the kind is asked for.
static ANY_KIND: Shape = Shape::Table(&[&[key("kind", Shape::Text, "the kind of spec")]]);

impl Document<'_> {
    /// The table of the whole file, of which `shape` says what it may hold.
    pub fn root(&self, shape: &'static Shape) -> Table<'_> {
        let heading = Place { source: self.source.clone(), span: 0..0 };
        Table::new(self, &self.tree, shape, heading, String::new())
    }

    /// The `kind` that the file says it is, which must be one of `kinds`.
    pub(crate) fn kind(&self, kinds: &[&'static str]) -> Option<&'static str> {
        if !self.has_kind() {
            let example = kinds.first().copied().unwrap_or("…");
            let message = "`kind` is missing";
            let error = Diagnostic::new(self.source, Code::MISSING_KEY, None, message);
            self.push(error.help(format!("write `kind = \"{example}\"`")));
        }
        let root = self.root(&ANY_KIND);
        let kind = root.word_among("kind", kinds);
        // The other keys are read once the kind is known.
        root.leave();
        kind
    }
}

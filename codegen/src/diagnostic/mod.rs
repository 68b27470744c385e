//! What is wrong with a file: where, what, and how to fix it.
//!
//! A reader of files collects every error into [`Diagnostics`] and goes on; nothing is printed here.

use std::fmt;

mod code;
mod located;
mod one;
mod render;
mod source;
mod suggest;

pub use code::{Code, Explanation};
pub use located::Located;
pub use one::Diagnostic;
pub use render::{Colours, render};
pub use source::Source;
pub use suggest::suggest;

/// Every error found in one or more files, in the order of their places once sorted.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// No errors yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds one.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.list.push(diagnostic);
    }

    /// Adds all of another collection.
    pub fn append(&mut self, other: Diagnostics) {
        self.list.extend(other.list);
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Number of errors.
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// The errors.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// All results, or everything that is wrong.
    pub(crate) fn all<T>(
        results: impl IntoIterator<Item = Result<T, Diagnostics>>,
    ) -> Result<Vec<T>, Diagnostics> {
        let (mut fine, mut errors) = (Vec::new(), Diagnostics::new());
        for result in results {
            match result {
                Ok(result) => fine.push(result),
                Err(wrong) => errors.append(wrong),
            }
        }
        errors.into_result(fine)
    }

    /// `Ok(value)` if nothing is wrong, else the errors sorted by file and place, each once: a file that is
    /// read twice is reported once.
    pub fn into_result<T>(mut self, value: T) -> Result<T, Diagnostics> {
        if self.is_empty() {
            return Ok(value);
        }
        self.sort();
        Err(self)
    }

    /// Sorts by file and place, what belongs to a whole file last, and keeps one of equal errors.
    pub(crate) fn sort(&mut self) {
        let place = |d: &Diagnostic| d.span.as_ref().map_or(usize::MAX, |span| span.start);
        self.list.sort_by(|a, b| (a.path(), place(a)).cmp(&(b.path(), place(b))));
        let mut kept: Vec<Diagnostic> = Vec::with_capacity(self.list.len());
        for error in self.list.drain(..) {
            // Equal ones stand at the same place.
            let here = kept.iter().rev().take_while(|own| place(own) == place(&error));
            if !here.into_iter().any(|own| *own == error) {
                kept.push(error);
            }
        }
        self.list = kept;
    }

    /// All errors as text: see [`render`].
    pub fn render(&self) -> String {
        render(&self.list, Colours::Never)
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render())
    }
}

impl std::error::Error for Diagnostics {}

impl From<Diagnostic> for Diagnostics {
    fn from(diagnostic: Diagnostic) -> Self {
        Diagnostics { list: vec![diagnostic] }
    }
}

impl IntoIterator for Diagnostics {
    type Item = Diagnostic;
    type IntoIter = std::vec::IntoIter<Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.into_iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rendering_shows_the_place_and_the_help() {
        let source = Source::new("laws/a.toml", "name = \"a\"\nvalue = '1 + × 2'\n");
        let diagnostic = Diagnostic::new(&source, Code::SYNTAX, 24..26, "unexpected `×`")
            .label("not an operator")
            .help("write `*` for a product");
        let expected = "\
error[E010]: unexpected `×`
 --> laws/a.toml:2:14
  |
2 | value = '1 + × 2'
  |              ^ not an operator
  |
  = help: write `*` for a product
";
        assert_eq!(Diagnostics::from(diagnostic.clone()).render(), expected);
        assert_eq!(
            diagnostic.to_string(),
            "laws/a.toml:2:14: unexpected `×` (write `*` for a product)"
        );
    }

    #[test]
    fn spans_outside_the_text_or_inside_a_character_do_not_panic() {
        let source = Source::new("x", "ä");
        for span in [1..1, 0..1, 5..9, 2..2] {
            let text = Diagnostics::from(Diagnostic::new(&source, Code::TOML, span, "m")).render();
            assert!(text.contains("x:1:"), "{text}");
        }
        let whole = Diagnostics::from(Diagnostic::new(&source, Code::TOML, None, "m")).render();
        assert_eq!(whole, "error[E001]: m\n--> x\n");
    }

    #[test]
    fn equal_errors_are_reported_once() {
        let read = || Source::new("x", "abcdef");
        let mut all = Diagnostics::new();
        for message in ["one", "two", "one", "two"] {
            all.push(Diagnostic::new(&read(), Code::TOML, 1..2, message));
        }
        all.push(Diagnostic::new(&read(), Code::TOML, 2..3, "one"));
        all.push(Diagnostic::new(&Source::new("y", "abcdef"), Code::TOML, 1..2, "one"));
        let reported = all.into_result(()).unwrap_err();
        let reported: Vec<String> = reported.iter().map(ToString::to_string).collect();
        assert_eq!(reported, ["x:1:2: one", "x:1:2: two", "x:1:3: one", "y:1:2: one"]);
    }

    #[test]
    fn results_are_sorted_by_place() {
        let source = Source::new("x", "abcdef");
        let mut all = Diagnostics::new();
        all.push(Diagnostic::new(&source, Code::TOML, None, "whole"));
        all.push(Diagnostic::new(&source, Code::TOML, 4..5, "late"));
        all.push(Diagnostic::new(&source, Code::TOML, 1..2, "early"));
        let sorted = all.into_result(()).unwrap_err();
        let messages: Vec<&str> = sorted.iter().map(|d| d.message.as_str()).collect();
        assert_eq!(messages, ["early", "late", "whole"]);
    }
}

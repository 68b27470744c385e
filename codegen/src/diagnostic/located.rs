//! Pieces of text in files.

use std::ops::Range;
use std::sync::Arc;

use super::{Code, Diagnostic, Source};

/// A piece of text that stands in a file, such as a formula: knows where each of its bytes is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Located {
    text: String,
    source: Arc<Source>,
    span: Range<usize>,
    verbatim: Option<usize>,
}

impl Located {
    /// `text` as written at `span` of `source`, where it may stand between quotes. If it was written with
    /// escapes, so that its bytes cannot be found one by one, errors in it point at the whole.
    pub fn new(source: &Arc<Source>, span: Range<usize>, text: impl Into<String>) -> Self {
        let text = text.into();
        let written = source.text.get(span.clone()).unwrap_or("");
        let verbatim = written.find(&text).map(|offset| span.start + offset);
        Located { text, source: source.clone(), span, verbatim }
    }

    /// `text` as a file of its own, called `name` in messages.
    pub fn alone(name: &str, text: &str) -> Self {
        let source = Source::new(name, text);
        Located::new(&source, 0..text.len(), text)
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The file.
    pub fn source(&self) -> &Arc<Source> {
        &self.source
    }

    /// Where it stands in the file, quotes included.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// Where a part of the text stands in the file.
    pub fn place(&self, part: Range<usize>) -> Range<usize> {
        match self.verbatim {
            Some(start) => start + part.start..start + part.end,
            None => self.span(),
        }
    }

    /// An error at a part of the text.
    pub fn error(&self, code: Code, part: Range<usize>, message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(&self.source, code, self.place(part), message)
    }

    /// An error at the whole text, without the quotes.
    pub fn error_here(&self, code: Code, message: impl Into<String>) -> Diagnostic {
        self.error(code, 0..self.text.len(), message)
    }
}

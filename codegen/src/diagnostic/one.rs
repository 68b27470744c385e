//! One error.

use std::fmt;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use super::{Code, Source};

/// One error in one file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file.
    pub source: Arc<Source>,
    /// Byte range in the file's text; `None` if the error belongs to the file as a whole.
    pub span: Option<Range<usize>>,
    /// What is wrong, in the user's own names.
    pub message: String,
    /// A few words shown beside the caret; may be empty.
    pub(crate) label: String,
    /// How to fix it.
    pub help: Option<String>,
    /// Stable code.
    pub code: Option<Code>,
}

impl Diagnostic {
    /// An error at `span` of `source`.
    pub fn new(
        source: &Arc<Source>,
        code: Code,
        span: impl Into<Option<Range<usize>>>,
        message: impl Into<String>,
    ) -> Self {
        Diagnostic {
            source: source.clone(),
            span: span.into(),
            message: message.into(),
            label: String::new(),
            help: None,
            code: Some(code),
        }
    }

    /// Adds how to fix it.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds how to fix it, if there is anything to say.
    pub fn maybe_help(mut self, help: Option<String>) -> Self {
        self.help = help.or(self.help);
        self
    }

    /// Adds the words beside the caret.
    pub(crate) fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Path of the file as shown to the user.
    pub fn path(&self) -> &Path {
        &self.source.path
    }
}

/// `path:line:column: message (help)` on one line, for logs; [`render`](super::render()) shows the place.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path().display())?;
        if let Some(span) = &self.span {
            let (line, column) = self.source.line_column(span.start);
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)?;
        match &self.help {
            Some(help) => write!(f, " ({help})"),
            None => Ok(()),
        }
    }
}

//! What is wrong with a unit or a quantity.

use std::ops::Range;
use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic, Source};

/// What is wrong with a unit or a quantity, and where in its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnitError {
    /// Byte range in the text that was parsed.
    pub span: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// How to fix it.
    pub help: Option<String>,
    /// [`Code::UNKNOWN_UNIT`], [`Code::WRONG_UNIT`] or [`Code::BAD_VALUE`].
    pub code: Code,
}

impl UnitError {
    /// The same error in a file where the parsed text starts at byte `start`.
    pub fn at(self, source: &Arc<Source>, start: usize) -> Diagnostic {
        let span = start + self.span.start..start + self.span.end;
        Diagnostic::new(source, self.code, span, self.message).maybe_help(self.help)
    }
}

//! A file being read, and what is wrong with it so far.

use std::cell::RefCell;
use std::ops::Range;
use std::sync::Arc;

use super::tree::Tree;
use super::wording::Wording;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source};

/// A file being read, and what is wrong with it so far.
#[derive(Debug)]
pub struct Document<'s> {
    pub(crate) source: &'s Arc<Source>,
    pub(super) tree: Tree,
    pub(super) wording: Wording,
    /// What messages call it.
    pub(super) called: &'static str,
    pub(super) errors: RefCell<Diagnostics>,
}

impl<'s> Document<'s> {
    /// A spec; errors of TOML itself are collected like all others.
    pub fn parse(source: &'s Arc<Source>) -> Self {
        let (tree, errors) = Tree::parse(source);
        let errors = RefCell::new(errors);
        Document { source, tree, wording: Wording::Spec, called: "spec", errors }
    }

    /// A case: the tree of `source`, with the files that it includes.
    pub fn of_case(source: &'s Arc<Source>, tree: Tree) -> Self {
        Document {
            source,
            tree,
            wording: Wording::Case,
            called: "case",
            errors: RefCell::default(),
        }
    }

    /// A file that is read as cases are and that messages call something else.
    pub fn called(self, called: &'static str) -> Self {
        Document { called, ..self }
    }

    /// Whether the text is TOML; if not, what its tables say is not worth reading.
    pub fn is_toml(&self) -> bool {
        let unread = |error: &Diagnostic| matches!(error.code, Some(Code::TOML | Code::LIMIT));
        !self.errors.borrow().iter().any(unread)
    }

    /// Whether the file says its `kind`, as specs do.
    pub fn has_kind(&self) -> bool {
        self.tree.entries.contains_key("kind")
    }

    /// Reports an error at a place of the file.
    pub fn error(&self, code: Code, span: impl Into<Option<Range<usize>>>, message: String) {
        self.push(Diagnostic::new(self.source, code, span, message));
    }

    /// Adds an error.
    pub(crate) fn push(&self, error: Diagnostic) {
        self.errors.borrow_mut().push(error);
    }

    /// Adds errors.
    pub(crate) fn append(&self, errors: Diagnostics) {
        self.errors.borrow_mut().append(errors);
    }

    /// Whether an error was found so far.
    pub(crate) fn has_errors(&self) -> bool {
        !self.errors.borrow().is_empty()
    }

    /// Every error found.
    pub fn into_errors(self) -> Diagnostics {
        self.errors.into_inner()
    }

    /// The value read, or every error found.
    pub(crate) fn into_result<T>(self, value: Option<T>) -> Result<T, Diagnostics> {
        let errors = self.errors.into_inner();
        match value {
            Some(value) => errors.into_result(value),
            None if errors.is_empty() => {
                let message = "this file cannot be read";
                Err(Diagnostic::new(self.source, Code::BAD_VALUE, None, message).into())
            }
            None => Err(errors.into_result(()).expect_err("there are errors")),
        }
    }
}

//! A table read key by key: one that nothing asked for is an error.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

use super::Document;
use super::schema::{Need, Shape};
use super::tree::{Node, Place, Tree};
use super::wording::Wording;
use whirl_text::nearest;

use crate::diagnostic::{Code, Diagnostic, Located, Source, suggest};

/// A table of a file. Wrong and missing values are noted, and reading goes on; the notes make the whole
/// reading fail in the end.
#[derive(Debug)]
pub struct Table<'d> {
    pub(super) document: &'d Document<'d>,
    pub(super) tree: &'d Tree,
    /// What it may say.
    pub(super) shape: &'static Shape,
    heading: Place,
    /// Keys that lead here, such as `outputs.Q`; empty for the file itself.
    pub(super) path: String,
    pub(super) asked: RefCell<BTreeSet<String>>,
    /// Keys that must be there and are not. Reported at the end: where one was misspelt, it is not missing.
    missing: RefCell<Vec<(Vec<String>, Diagnostic)>>,
    finished: Cell<bool>,
}

impl<'d> Table<'d> {
    pub(super) fn new(
        document: &'d Document<'d>,
        tree: &'d Tree,
        shape: &'static Shape,
        heading: Place,
        path: String,
    ) -> Self {
        let (asked, missing, finished) = (RefCell::default(), RefCell::default(), Cell::new(false));
        Table { document, tree, shape, heading, path, asked, missing, finished }
    }

    /// The document it belongs to.
    pub(crate) fn document(&self) -> &'d Document<'d> {
        self.document
    }

    pub(super) fn wording(&self) -> Wording {
        self.document.wording
    }

    /// Where it stands.
    pub fn heading(&self) -> &Place {
        &self.heading
    }

    /// The file in which it stands.
    pub fn source(&self) -> &Arc<Source> {
        &self.heading.source
    }

    /// Where it stands in its file.
    pub fn span(&self) -> Range<usize> {
        self.heading.span.clone()
    }

    /// Places of all values by their keys, such as `length`, `cells.sectors` and `loads[0]`.
    pub fn places(&self) -> BTreeMap<String, Located> {
        let mut places = BTreeMap::new();
        self.tree.each(&mut |name, node| {
            places.insert(name, node.place.written());
        });
        places
    }

    /// The value of a key as it is written; nothing, at the place of the table, where it is not there.
    pub fn written(&self, key: &str) -> Located {
        match self.tree.entries.get(key) {
            Some((_, node)) => node.place.written(),
            None => self.heading.text(""),
        }
    }

    /// Reports an error at a place of the file.
    pub fn error(&self, code: Code, span: impl Into<Option<Range<usize>>>, message: String) {
        self.push(Diagnostic::new(self.source(), code, span, message));
    }

    /// Reports an error made elsewhere.
    pub fn push(&self, error: Diagnostic) {
        self.document.push(error);
    }

    /// Number of errors reported so far.
    pub fn errors(&self) -> usize {
        self.document.errors.borrow().len()
    }

    /// The keys that lead to a key of this table.
    pub(super) fn full(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// What a key takes, if it is declared so that `fits`. One that is not is never read: a file that has it
    /// is refused.
    pub(super) fn declared(&self, key: &str, fits: fn(&Shape) -> bool) -> Option<&'static Shape> {
        let shape = self.shape.of_key(key).filter(|shape| shape.admits(fits));
        debug_assert!(shape.is_some(), "`{}` is read but not so declared", self.full(key));
        shape
    }

    /// The value of a key, which counts as known from now on, and what it takes.
    pub(super) fn entry(
        &self,
        key: &str,
        fits: fn(&Shape) -> bool,
    ) -> Option<(&'d Node, &'static Shape)> {
        let shape = self.declared(key, fits)?;
        self.pass_over(key);
        self.tree.entries.get(key).map(|(_, node)| (node, shape))
    }

    /// Whether the key is there.
    pub fn gives(&self, key: &str) -> bool {
        self.tree.entries.contains_key(key)
    }

    /// Whether the key is there; the key counts as known from now on.
    pub fn has(&self, key: &str) -> bool {
        self.entry(key, |_| true).is_some()
    }

    /// Takes a key for known without reading it.
    pub fn pass_over(&self, key: &str) {
        self.asked.borrow_mut().insert(key.to_owned());
    }

    /// Where the value of a key stands; the table if there is none.
    pub fn place(&self, key: &str) -> Range<usize> {
        self.entry(key, |_| true).map_or(self.span(), |(node, _)| node.place.span.clone())
    }

    /// Reports that a key is not there; to be called where one that is declared as free must be there.
    pub fn demand(&self, key: &str) {
        if !self.has(key)
            && let Some(shape) = self.declared(key, |_| true)
        {
            self.miss(&[key], self.missing_shape(key, shape));
        }
    }

    /// Reports that a key is not there, and how to fix that.
    pub fn absent(&self, key: &str, help: &str) {
        self.miss(&[key], self.missing(key, help));
    }

    /// Reports an error because none of `keys` is there, unless one of them turns out to be misspelt.
    pub(crate) fn miss(&self, keys: &[&str], error: Diagnostic) {
        let keys = keys.iter().map(|key| (*key).to_owned()).collect();
        self.missing.borrow_mut().push((keys, error));
    }

    /// Reports that two keys are given where one excludes the other.
    pub fn conflict(&self, key: &str, other: &str) {
        let Some((place, _)) = self.tree.entries.get(key) else { return };
        let message = format!("`{key}` and `{other}` exclude each other");
        self.push(place.error(Code::BAD_VALUE, message).help("keep one of them"));
    }

    /// Reports every key that must be there and is not, and every key that was not asked for, with the
    /// nearest that was.
    pub fn finish(self) {
        for key in self.shape.keys().filter(|key| key.need != Need::Free) {
            let noted =
                self.missing.borrow().iter().any(|(keys, _)| keys.iter().any(|k| k == key.name));
            if !noted {
                self.demand(key.name);
            }
        }
        let mut missing = self.missing.take();
        let asked = self.asked.borrow();
        let known: Vec<&str> = asked.iter().map(String::as_str).collect();
        for (key, (place, _)) in &self.tree.entries {
            if asked.contains(key) {
                continue;
            }
            // Of two keys as near, the one that is not there was meant.
            let absent = missing.iter().flat_map(|(keys, _)| keys).map(String::as_str);
            let help = match nearest(key, absent).map(str::to_owned) {
                Some(meant) => {
                    missing.retain(|(keys, _)| !keys.contains(&meant));
                    Some(format!("did you mean `{meant}`?"))
                }
                None => suggest(key, &known),
            };
            self.push(place.error(Code::UNKNOWN_KEY, self.unknown(key)).maybe_help(help));
        }
        missing.into_iter().for_each(|(_, error)| self.push(error));
        self.finished.set(true);
    }

    /// Leaves the table to another reader of the same file.
    pub(super) fn leave(self) {
        self.finished.set(true);
    }
}

/// A reader that gives up may leave a table unfinished once it has reported why.
impl Drop for Table<'_> {
    fn drop(&mut self) {
        let fine = self.finished.get() || self.asked.borrow().is_empty();
        let reported = self.missing.borrow().is_empty() && self.document.has_errors();
        debug_assert!(
            fine || reported || std::thread::panicking(),
            "`[{}]` is read but not finished",
            self.path
        );
    }
}

/// How to fix a name that has other letters than those that are `fine`.
pub(crate) fn plain_name(name: &str, fine: impl Fn(char) -> bool) -> String {
    let plain: String = name.chars().map(|c| if fine(c) { c } else { '-' }).collect();
    let joined: Vec<&str> = plain.split('-').filter(|part| !part.is_empty()).collect();
    let example = if joined.is_empty() { "my-name".to_owned() } else { joined.join("-") };
    format!("write for example `{example}`")
}

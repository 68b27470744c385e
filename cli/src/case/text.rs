//! A case that a program gives as text, with files that stand beside it in name only.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use whirl_codegen::diagnostic::Source;

/// The text of a case file.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CaseText {
    path: PathBuf,
    text: String,
    files: BTreeMap<PathBuf, String>,
}

impl CaseText {
    /// A text as if it were the file `name.toml` in `folder`: its paths are relative to that.
    pub fn new(name: &str, folder: &Path, text: impl Into<String>) -> Self {
        CaseText {
            path: folder.join(format!("{name}.toml")),
            text: text.into(),
            files: BTreeMap::new(),
        }
    }

    /// With a file that it or another one may name, such as `my-law.toml`: as if it stood in the same folder, before any
    /// file that does stand there.
    #[must_use]
    pub fn with_file(mut self, name: &str, text: impl Into<String>) -> Self {
        let path = self.path.with_file_name(name);
        self.files.insert(path, text.into());
        self
    }

    /// Where it would stand.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The file that would stand at `path`, the case itself included.
    pub(super) fn file(&self, path: &Path) -> Option<Arc<Source>> {
        let text = if path == self.path { Some(&self.text) } else { self.files.get(path) };
        text.map(|text| Source::new(path, text.as_str()))
    }
}

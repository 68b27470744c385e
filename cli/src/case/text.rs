//! A case that a program gives as text, with files that stand beside it in name only.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use whirl_codegen::diagnostic::Source;

/// What messages call values that hold in place of those of a case.
const VARIED: &str = "varied keys";

/// The text of a case file.
#[derive(Debug, Default)]
pub struct CaseText {
    path: PathBuf,
    text: String,
    files: BTreeMap<PathBuf, String>,
    /// Values that hold in place of those of the case, as lines of TOML.
    values: String,
    /// What messages call them, if they come from a place of the case.
    values_of: Option<String>,
    /// Files of the disk that it was read with so far: what is read again, is the same.
    read: Mutex<BTreeMap<PathBuf, Arc<Source>>>,
}

impl CaseText {
    /// A text as if it were the file `name.toml` in `folder`: its paths are relative to that.
    pub fn new(name: &str, folder: &Path, text: impl Into<String>) -> Self {
        CaseText::at(&folder.join(format!("{name}.toml")), text)
    }

    /// A text as if it were the file at `path`.
    pub fn at(path: &Path, text: impl Into<String>) -> Self {
        CaseText { path: path.to_path_buf(), text: text.into(), ..CaseText::default() }
    }

    /// With a file that it or another one may name, such as `my-law.toml`: as if it stood in the same folder, before any
    /// file that does stand there.
    #[must_use]
    pub fn with_file(self, name: &str, text: impl Into<String>) -> Self {
        let path = self.path.with_file_name(name);
        self.with_path(path, text)
    }

    /// With a file as if it stood at `path`, before any that does.
    #[must_use]
    pub fn with_path(mut self, path: PathBuf, text: impl Into<String>) -> Self {
        self.files.insert(path, text.into());
        self
    }

    /// With values in place of those that it and what it includes say: lines such as `springs.radial_clearance = "30 um"`, or
    /// `load.2.force = "1 kN"` for the second of several `[[load]]`.
    #[must_use]
    pub fn with_values(mut self, lines: impl Into<String>) -> Self {
        self.values = lines.into();
        self
    }

    /// A copy with values of more keys, or others of the same ones.
    pub(crate) fn with_more_values<'k>(
        &self,
        values: impl Iterator<Item = (&'k str, String)>,
    ) -> CaseText {
        let key_of = |line: &str| line.split_once('=').map(|own| own.0.trim().to_owned());
        let mut lines: Vec<String> = self.values.lines().map(str::to_owned).collect();
        for (key, value) in values {
            lines.retain(|own| key_of(own).as_deref() != Some(key));
            lines.push(format!("{key} = {value}"));
        }
        let values = lines.iter().map(|own| format!("{own}\n")).collect();
        let read = self.read.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let (path, text, files) = (self.path.clone(), self.text.clone(), self.files.clone());
        let values_of = self.values_of.clone();
        CaseText { path, text, files, values, values_of, read: Mutex::new(read) }
    }

    /// With a name for the values, by which messages show where they stand.
    #[must_use]
    pub(crate) fn with_values_of(mut self, place: &str) -> CaseText {
        self.values_of = Some(place.to_owned());
        self
    }

    /// Those values.
    pub fn values(&self) -> &str {
        &self.values
    }

    /// Where it would stand.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The text of the case itself.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The texts beside it by their paths, and those of the disk with which it was read: what it takes to read it elsewhere,
    /// but for meshes and matrices.
    pub fn files(&self) -> BTreeMap<PathBuf, String> {
        let noted = self.noted().into_iter().map(|own| (own.path.clone(), own.text.clone()));
        let mut all: BTreeMap<PathBuf, String> = noted.collect();
        all.extend(self.files.clone());
        all
    }

    /// The files of the disk with which it was read.
    pub(crate) fn noted(&self) -> Vec<Arc<Source>> {
        let read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        read.values().cloned().collect()
    }

    /// Notes a file of the disk.
    pub(super) fn note(&self, source: &Arc<Source>) {
        let mut read = self.read.lock().unwrap_or_else(PoisonError::into_inner);
        read.insert(source.path.clone(), source.clone());
    }

    /// The case as if it were a file.
    pub(super) fn source(&self) -> Arc<Source> {
        Source::new(&self.path, self.text.as_str())
    }

    /// Its values as if they were a file beside it; none if there are none.
    pub(super) fn varied(&self) -> Option<Arc<Source>> {
        let path = match &self.values_of {
            Some(place) => self.path.with_file_name(place),
            None => self.path.with_file_name(VARIED),
        };
        (!self.values.is_empty()).then(|| Source::new(path, self.values.as_str()))
    }

    /// The file that would stand beside it at `path`, or was read from there before. The case itself is none of them: a text
    /// called as a file that it includes includes that.
    pub(super) fn file(&self, path: &Path) -> Option<Arc<Source>> {
        let given = self.files.get(path).map(|text| Source::new(path, text.as_str()));
        let read = || self.read.lock().unwrap_or_else(PoisonError::into_inner).get(path).cloned();
        given.or_else(read)
    }
}

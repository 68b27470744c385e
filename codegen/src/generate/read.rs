//! Spec files, each of a kind that its folder may hold.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use super::parallel;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use crate::emit::identifier;
use crate::kinds::list::{KINDS, Spec, Specs};

/// A spec file.
#[derive(Debug, Clone)]
pub struct SpecFile {
    /// Path in the crate of the specs, such as `laws/hu2003-linear.toml`; its folder says what it can be.
    /// A file that ends in `.csv` holds the columns of a law's table.
    pub path: String,
    /// The text.
    pub text: String,
}

/// Endings of the names of the files that specs are read from.
pub const ENDINGS: [&str; 2] = ["toml", "csv"];

/// Folders from which specs are read.
pub fn folders() -> impl Iterator<Item = &'static str> {
    KINDS.in_order().map(|kind| kind.folder).into_iter().collect::<BTreeSet<_>>().into_iter()
}

/// All specs, each list sorted by path; each name once.
pub(super) fn read(files: &[SpecFile]) -> Result<Specs, Diagnostics> {
    let mut sorted: Vec<&SpecFile> = files.iter().collect();
    sorted.sort_by(|a, b| a.path.cmp(&b.path));
    let (tables, sorted): (Vec<_>, Vec<_>) =
        sorted.into_iter().partition(|file| file.path.ends_with(".csv"));
    let read = parallel::map(&sorted, |file| file.text.len(), |file| read_one(file, &tables));
    let (mut specs, mut names) = (Specs::default(), Names::default());
    let mut take = |spec: Spec| {
        names.take_all(&spec)?;
        specs.push(spec);
        Ok(())
    };
    Diagnostics::all(read.into_iter().map(|spec| spec.and_then(&mut take)))?;
    Ok(specs)
}

fn read_one(file: &SpecFile, tables: &[&SpecFile]) -> Result<Spec, Diagnostics> {
    let source = Source::new(&file.path, &file.text);
    let kinds = kinds_in(source.path.parent().unwrap_or(Path::new("")), &source)?;
    Spec::read(&source, &kinds, &|name| beside(&source, name, tables))
}

/// The file of columns called `name` in the folder of a spec.
fn beside(spec: &Source, name: &str, tables: &[&SpecFile]) -> Result<Arc<Source>, String> {
    let path = spec.path.with_file_name(name);
    let found = tables.iter().find(|file| Path::new(&file.path) == path);
    let found = found.ok_or_else(|| format!("there is no file `{}`", path.display()));
    found.map(|file| Source::new(&file.path, &file.text))
}

/// The kinds that a folder may hold, sorted.
fn kinds_in(folder: &Path, source: &Arc<Source>) -> Result<Vec<&'static str>, Diagnostics> {
    let here = KINDS.in_order().into_iter().filter(|kind| folder == Path::new(kind.folder));
    let kinds: BTreeSet<&str> = here.map(|kind| kind.name).collect();
    if kinds.is_empty() {
        let message = format!("no spec is read from the folder `{}`", folder.display());
        let error = Diagnostic::new(source, Code::BAD_VALUE, None, message);
        let folders = folders().collect::<Vec<_>>().join(", ");
        return Err(error.help(format!("move the file to one of: {folders}")).into());
    }
    Ok(kinds.into_iter().collect())
}

/// Names, and modules made from them, that are taken.
#[derive(Default)]
struct Names {
    taken: BTreeMap<(&'static str, String), Arc<Source>>,
}

impl Names {
    fn take_all(&mut self, spec: &Spec) -> Result<(), Diagnostics> {
        let source = spec.about().file;
        spec.names().into_iter().try_for_each(|(what, name)| self.take(what, name, source))
    }

    fn take(
        &mut self,
        what: &'static str,
        name: &str,
        source: &Arc<Source>,
    ) -> Result<(), Diagnostics> {
        let key = (what, identifier(name).to_string());
        if let Some(first) = self.taken.get(&key) {
            let first = first.path.display();
            let message = format!("the {what} `{name}` has the name of the one in `{first}`");
            let error = Diagnostic::new(source, Code::BAD_NAME, None, message);
            return Err(error.help("change it in one of the files").into());
        }
        self.taken.insert(key, source.clone());
        Ok(())
    }
}

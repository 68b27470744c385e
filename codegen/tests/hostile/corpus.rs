//! The texts from which inputs are made: all specs, all bad files of the messages, and what was found.

use std::fs;
use std::path::{Path, PathBuf};

/// Texts of formulas and of spec files.
pub(crate) struct Corpus {
    pub(crate) formulas: Vec<String>,
    pub(crate) specs: Vec<String>,
}

pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The texts of all files in a folder, in the order of their names.
pub(crate) fn texts(folder: &Path) -> Vec<(PathBuf, String)> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
        .into_iter()
        .filter(|path| path.is_file() && path.extension().is_none_or(|end| end != "txt"))
        .filter_map(|path| Some((path.clone(), String::from_utf8(fs::read(&path).ok()?).ok()?)))
        .collect()
}

impl Corpus {
    pub(crate) fn read() -> Self {
        let root = root();
        let folders = ["specs/elements", "specs/forms", "specs/laws", "specs/motion"];
        let more = ["fuzz/corpus/spec", "codegen/tests/messages"];
        let mut specs = Vec::new();
        for folder in folders.iter().chain(&more) {
            let found = texts(&root.join(folder));
            let found =
                found.into_iter().filter(|(path, _)| path.extension().is_none_or(|e| e != "csv"));
            specs.extend(found.map(|(_, text)| text));
        }
        let mut formulas: Vec<String> =
            texts(&root.join("fuzz/corpus/formula")).into_iter().map(|(_, text)| text).collect();
        // What stands between single quotes in a spec is a formula.
        for spec in &specs {
            let quoted = spec.lines().flat_map(|line| line.split('\'').skip(1).step_by(2));
            formulas.extend(quoted.map(str::to_owned));
        }
        formulas.sort();
        formulas.dedup();
        Corpus { formulas, specs }
    }
}

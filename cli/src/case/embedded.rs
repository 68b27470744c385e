//! The cases that are built into the program, with the files that they name.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use whirl_codegen::diagnostic::Source;

macro_rules! embedded {
    ($($file:literal),* $(,)?) => {
        /// Files of specs/cases by name.
        const EMBEDDED: &[(&str, &str)] =
            &[$(($file, include_str!(concat!("../../../specs/cases/", $file)))),*];
    };
}

embedded![
    "annular-rub.law.toml",
    "annular-rub.toml",
    "crank.gas-side.csv",
    "crank.gas.csv",
    "crank.piston-side.csv",
    "crank.piston.csv",
    "crank.toml",
    "geared.toml",
    "hu2003-1.toml",
    "hu2003-2.toml",
    "hu2003-3.toml",
    "hu2003-4.toml",
    "hu2003-5.toml",
    "hu2003.machine.toml",
    "magnetic-drop.toml",
    "magnetic.toml",
    "overhung-disc.toml",
    "sdnd101.toml",
    "sdnd108.toml",
    "tilting-pad.toml",
    "turbocharger.toml",
    "two-spool.toml",
    "unbalance.toml",
    "weight.toml",
];

/// Folder under which the built-in files are shown in messages.
pub(super) const EMBEDDED_FOLDER: &str = "specs/cases";

/// Names of the built-in cases, in alphabetical order.
pub(crate) fn embedded_cases() -> impl Iterator<Item = &'static str> {
    EMBEDDED
        .iter()
        .filter_map(|(file, _)| file.strip_suffix(".toml"))
        .filter(|name| !name.contains('.'))
}

/// The text of a built-in case.
pub(crate) fn embedded_case(name: &str) -> Option<&'static str> {
    embedded_cases().find(|own| *own == name)?;
    let (_, text) = EMBEDDED.iter().find(|(file, _)| file.strip_suffix(".toml") == Some(name))?;
    Some(text)
}

/// The paths and texts of all files that are built in.
pub(super) fn embedded_files() -> impl Iterator<Item = (PathBuf, &'static str)> {
    EMBEDDED.iter().map(|(file, text)| (Path::new(EMBEDDED_FOLDER).join(file), *text))
}

/// The file that is built in under a path.
pub(super) fn embedded_file(path: &Path) -> Option<Arc<Source>> {
    let wanted = path.strip_prefix(EMBEDDED_FOLDER).ok()?;
    let (_, text) = EMBEDDED.iter().find(|(file, _)| Path::new(file) == wanted)?;
    Some(Source::new(path, *text))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn every_file_of_the_folder_is_built_in() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/cases");
        let mut files: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        files.sort();
        let built_in: Vec<&str> = EMBEDDED.iter().map(|(file, _)| *file).collect();
        assert_eq!(built_in, files);
    }
}

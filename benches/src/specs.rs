//! The spec files of this repository.

use std::fs;
use std::path::{Path, PathBuf};

use whirl_codegen::generate::{ENDINGS, SpecFile, folders};

/// Folder of the crate of the specs.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs")
}

/// Every file that the build script of the kernels reads, sorted by path.
pub fn files() -> Vec<SpecFile> {
    let mut files = Vec::new();
    for folder in folders() {
        for entry in fs::read_dir(root().join(folder)).expect("a folder of specs") {
            let path = entry.expect("an entry").path();
            let ending = path.extension().and_then(|ending| ending.to_str());
            if ending.is_some_and(|ending| ENDINGS.contains(&ending)) {
                let name = path.file_name().expect("a name").to_string_lossy();
                let text = fs::read_to_string(&path).expect("a text");
                files.push(SpecFile { path: format!("{folder}/{name}"), text });
            }
        }
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    files
}

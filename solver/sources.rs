// Shared by build scripts, which include it: a hash of sources, whatever a version control knows of them.

use std::path::{Path, PathBuf};
use std::process::Command;

use sha2::{Digest, Sha256};

/// A hash of all files in `folders` and of `files`, of their places below `root`, and of the compiler. Cargo runs the
/// build again when one of them changes.
fn sources(root: &Path, folders: &[&str], files: &[&str]) -> String {
    let mut all: Vec<PathBuf> = files.iter().map(|file| root.join(file)).collect();
    folders.iter().for_each(|folder| collect(&root.join(folder), &mut all));
    all.sort();
    let mut hash = Sha256::new();
    for file in all {
        println!("cargo::rerun-if-changed={}", file.display());
        // What is not there, such as the lock file of a package on its own, is the same for everybody.
        let Ok(text) = std::fs::read(&file) else { continue };
        let place = file.strip_prefix(root).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        for part in [place.as_bytes(), &text] {
            hash.update((part.len() as u64).to_le_bytes());
            hash.update(part);
        }
    }
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(compiler).arg("-vV").output().map(|output| output.stdout);
    hash.update(version.unwrap_or_default());
    for name in ["TARGET", "OPT_LEVEL", "CARGO_ENCODED_RUSTFLAGS"] {
        hash.update(std::env::var(name).unwrap_or_default());
        hash.update([0]);
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    println!("cargo::rerun-if-changed={}", folder.display());
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        match entry.path() {
            path if path.is_dir() => collect(&path, files),
            path => files.push(path),
        }
    }
}

//! Generates the kernels from the spec files of this crate.

use std::path::{Path, PathBuf};
use std::{env, fs, io, process};

use whirl_codegen::generate::{ENDINGS, SpecFile, folders, generate};

fn main() {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let files = read(&root).unwrap_or_else(|error| refuse(&format!("error: {error}")));
    match generate(&files) {
        Ok(generated) => {
            for file in generated {
                let path = out.join(&file.name);
                fs::write(&path, file.text)
                    .unwrap_or_else(|error| refuse(&format!("error: {}: {error}", path.display())));
            }
        }
        Err(errors) => refuse(&errors.render()),
    }
}

/// All spec files and the tables beside them, with paths relative to this crate. A new file in a folder runs the build again.
fn read(root: &Path) -> io::Result<Vec<SpecFile>> {
    let mut files = Vec::new();
    for folder in folders() {
        println!("cargo::rerun-if-changed={folder}");
        let Ok(entries) = fs::read_dir(root.join(folder)) else { continue };
        for entry in entries {
            let path = entry?.path();
            let ending = path.extension().and_then(|ending| ending.to_str());
            if ending.is_some_and(|ending| ENDINGS.contains(&ending)) {
                let name = path.file_name().expect("it has an extension").to_string_lossy();
                println!("cargo::rerun-if-changed={folder}/{name}");
                let text = fs::read_to_string(&path)?;
                files.push(SpecFile { path: format!("{folder}/{name}"), text });
            }
        }
    }
    Ok(files)
}

fn refuse(message: &str) -> ! {
    eprintln!("{message}");
    process::exit(1)
}

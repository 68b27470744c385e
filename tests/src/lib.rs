//! Verification, validation and golden tests across the crates.

pub mod golden;
mod history;
pub mod matrices;
pub mod validation;

use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

pub use history::History;

/// Builds and runs the crate whose sources are in `folder`, which needs nothing but libm, and gives what it
/// prints. Its manifest is written here; it is a workspace of its own, with its own target folder.
///
/// # Panics
/// With the compiler's or the program's errors.
pub fn run_alone(folder: &Path, name: &str) -> String {
    let manifest = format!(
        "[package]\nname = \"{name}\"\nedition = \"2024\"\n\n\
         [dependencies]\nlibm = \"=0.2.16\"\n\n[workspace]\n"
    );
    fs::write(folder.join("Cargo.toml"), manifest).expect("a manifest");
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["run", "--quiet", "--offline", "--manifest-path"])
        .arg(folder.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(folder.join("target"))
        .output()
        .expect("cargo can be run");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "the crate {name} does not build or run:\n{errors}");
    String::from_utf8(output.stdout).expect("text")
}

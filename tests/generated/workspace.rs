//! Copies of the crate of kernels, with other specs: what cargo makes of them.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace")
}

/// The text of a file of the project.
pub(crate) fn text(path: &str) -> String {
    fs::read_to_string(root().join(path)).expect("a file of the project")
}

/// A workspace in a folder of its own; the generator itself stays where it is.
pub(crate) struct Workspace(PathBuf);

impl Workspace {
    /// The crate of kernels with the specs of these folders.
    pub(crate) fn new(name: &str, members: &str, folders: &[&str]) -> Self {
        let workspace = Workspace(PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name));
        // What an earlier run left could be listed too.
        let _ = fs::remove_dir_all(workspace.0.join("specs"));
        for part in ["", "src"].iter().chain(folders) {
            for entry in fs::read_dir(root().join("specs").join(part)).expect("a folder") {
                let path = entry.expect("an entry").path();
                if path.is_file() {
                    let name = path.strip_prefix(root()).expect("a path of the project");
                    let name = name.to_str().expect("a plain name");
                    workspace.write(name, &text(name));
                }
            }
        }
        let codegen = root().join("codegen");
        let manifest: String = text("Cargo.toml")
            .lines()
            .map(|line| {
                if line.starts_with("members") {
                    format!("members = [{members}]\n")
                } else if line.starts_with("default-members") {
                    String::new()
                } else {
                    let here = format!("{:?}", codegen.display().to_string());
                    format!("{}\n", line.replace("\"codegen\"", &here))
                }
            })
            .collect();
        workspace.write("Cargo.toml", &manifest);
        workspace.write("Cargo.lock", &text("Cargo.lock"));
        workspace
    }

    pub(crate) fn write(&self, path: &str, text: &str) {
        let path = self.0.join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }

    /// Runs cargo, without a network.
    pub(crate) fn cargo(&self, arguments: &[&str]) -> Output {
        let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        // The target folder of the tests: what they were built from is not built again.
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target folder");
        let output = Command::new(cargo)
            .args(arguments)
            .args(["--quiet", "--offline", "--manifest-path"])
            .arg(self.0.join("Cargo.toml"))
            .arg("--target-dir")
            .arg(target)
            .output()
            .expect("cargo can be run");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "cargo {arguments:?} fails:\n{errors}");
        output
    }
}

//! A folder of its own for every test, and the command run in it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;
use whirl_tests::History;

/// A short run of the built-in machine.
pub(crate) const SHORT: &str =
    "include = \"hu2003-5.toml\"\ntitle = \"a short run\"\n\n[march]\nsteps = 40\n";

/// A folder with files, in which the command runs.
pub(crate) struct Workbench {
    folder: TempDir,
}

/// What the command left.
pub(crate) struct Outcome {
    pub(crate) status: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Workbench {
    /// An empty folder.
    pub(crate) fn new() -> Self {
        Workbench { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    /// Path of a file in the folder.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Adds a file.
    pub(crate) fn file(self, name: &str, text: &str) -> Self {
        fs::write(self.path(name), text).expect("the folder can be written");
        self
    }

    /// Runs `whirl` with these arguments and a cache in the folder's neighbourhood.
    pub(crate) fn whirl(&self, arguments: &[&str]) -> Outcome {
        let output = self.command(arguments).output().expect("the binary runs");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Outcome {
            status: output.status.code().expect("an exit status"),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        }
    }

    /// The command, to be run in other ways.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = self.prepared(env!("CARGO_BIN_EXE_whirl"));
        command.args(arguments);
        command
    }

    /// A shell in the folder.
    pub(crate) fn shell(&self) -> Command {
        self.prepared("sh")
    }

    fn prepared(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.current_dir(self.folder.path()).env("XDG_CACHE_HOME", shared_cache());
        command
    }

    /// The summary of the run into a folder.
    pub(crate) fn summary(&self, folder: &str) -> Value {
        let text = fs::read_to_string(self.path(folder).join("summary.json")).expect("a summary");
        serde_json::from_str(&text).expect("JSON")
    }

    /// The text of the history of the run into a folder.
    pub(crate) fn history_text(&self, folder: &str) -> String {
        fs::read_to_string(self.path(folder).join("history.csv")).expect("a history")
    }

    /// The history of the run into a folder.
    pub(crate) fn history(&self, folder: &str) -> History {
        History::parse(&self.history_text(folder))
    }

    /// Names of all files and folders in the folder, sorted.
    pub(crate) fn listing(&self) -> Vec<String> {
        self.listing_of("")
    }

    /// Names of all files and folders in a folder within it, sorted.
    pub(crate) fn listing_of(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path(folder)).expect("a folder");
        let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
        let mut names: Vec<String> = entries.map(|entry| name(entry.expect("an entry"))).collect();
        names.sort();
        names
    }
}

/// One cache for all tests: what is stored under a key is right or not found.
fn shared_cache() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache")
}

//! Room on disk that is kept free for what is written last.

use std::fs;
use std::path::{Path, PathBuf};

/// Bytes: a summary with the description of the case takes some ten thousand.
const SIZE: usize = 1 << 16;
/// As names of files that a killed run was writing: they go when the next one begins.
const NAME: &str = ".whirl-room.part";

/// A file that takes the room until it is dropped.
#[derive(Debug)]
pub(crate) struct Room(PathBuf);

impl Room {
    /// Takes it in a folder, as far as there is any.
    pub(crate) fn take(folder: &Path) -> Room {
        let path = folder.join(NAME);
        // Without it a full disk costs the summary, and nothing else.
        let _ = fs::write(&path, vec![b' '; SIZE]);
        Room(path)
    }
}

impl Drop for Room {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

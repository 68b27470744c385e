//! Folders that are made for results, and taken away again if these do not come.

use std::fs;
use std::path::{Path, PathBuf};

/// Folders that were missing on the way to one; those that are empty are removed when this is dropped.
#[derive(Debug)]
pub(crate) struct CreatedFolders(Vec<PathBuf>);

impl CreatedFolders {
    /// What is missing on the way to `folder`, and it.
    pub(crate) fn missing(folder: &Path) -> CreatedFolders {
        let missing = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        CreatedFolders(folder.ancestors().take_while(missing).map(Path::to_path_buf).collect())
    }

    /// Leaves them where they are.
    pub(crate) fn keep(&mut self) {
        self.0.clear();
    }
}

impl Drop for CreatedFolders {
    fn drop(&mut self) {
        for folder in &self.0 {
            let _ = fs::remove_dir(folder);
        }
    }
}

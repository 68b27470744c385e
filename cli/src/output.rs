//! Files of one command: their folder is checked before the work, filled at the end, all files or none.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use whirl_solver::cache::write_aside;

use crate::created::CreatedFolders;
use crate::errors::Failure;
use crate::lock::{Lock, Locked};

/// A folder that can be written, and the files that will stand in it.
#[derive(Debug)]
pub(crate) struct Output {
    /// Dropped before the folder is taken away.
    lock: Option<Lock>,
    folder: PathBuf,
    created: CreatedFolders,
    files: Vec<(String, Vec<u8>)>,
    removed: Vec<String>,
}

impl Output {
    /// Makes `folder` where it is missing, and tries to write in it.
    ///
    /// # Errors
    /// [`Failure::Output`]; nothing is left behind then.
    pub(crate) fn open(folder: &Path) -> Result<Output, Failure> {
        let created = CreatedFolders::missing(folder);
        let folder = folder.to_path_buf();
        let output = Output { lock: None, folder, created, files: Vec::new(), removed: Vec::new() };
        output.prepare().map_err(|error| output.failure(&output.folder, &error))?;
        Ok(output)
    }

    /// The same, and no other command writes results in it meanwhile.
    ///
    /// # Errors
    /// As of [`Output::open`]; another one does.
    pub(crate) fn open_alone(folder: &Path) -> Result<Output, Failure> {
        let mut output = Output::open(folder)?;
        output.lock = match Lock::take(folder) {
            Ok(Locked::Ours(lock)) => Some(lock),
            Ok(Locked::Unknown) => None,
            Ok(Locked::InUse(by)) => {
                output.created.keep();
                return Err(Failure::InUse { folder: folder.to_path_buf(), by });
            }
            Err(error) => return Err(output.failure(folder, &error)),
        };
        Ok(output)
    }

    fn prepare(&self) -> std::io::Result<()> {
        fs::create_dir_all(&self.folder)?;
        // What is written and not given its name is removed.
        write_aside(&self.folder.join("probe"), b"").map(drop)
    }

    /// Keeps a file for the end.
    pub(crate) fn put(&mut self, name: &str, content: impl Into<Vec<u8>>) {
        self.files.push((name.to_string(), content.into()));
    }

    /// Has a file of an earlier command removed at the end, if it is there.
    pub(crate) fn remove(&mut self, name: &str) {
        // A list of files may have been edited: none beyond the folder.
        if Path::new(name).file_name().is_some_and(|own| own == name) {
            self.removed.push(name.to_string());
        }
    }

    /// Writes every file under a temporary name, then gives all of them their names.
    ///
    /// # Errors
    /// [`Failure::Output`]; files of an earlier run are left as they were unless renaming fails.
    pub(crate) fn commit(mut self) -> Result<(), Failure> {
        let mut written = Vec::with_capacity(self.files.len());
        for (name, content) in &self.files {
            let path = self.folder.join(name);
            let aside = write_aside(&path, content).map_err(|error| self.failure(&path, &error))?;
            written.push((path, aside));
        }
        for (path, rename) in written {
            rename().map_err(|error| self.failure(&path, &error))?;
        }
        for name in &self.removed {
            let path = self.folder.join(name);
            match fs::remove_file(&path) {
                Err(error) if error.kind() != ErrorKind::NotFound => {
                    return Err(self.failure(&path, &error));
                }
                _ => {}
            }
        }
        self.created.keep();
        Ok(())
    }

    fn failure(&self, path: &Path, error: &std::io::Error) -> Failure {
        Failure::Output { path: path.to_path_buf(), reason: error.to_string() }
    }
}

/// Writes one file, whole or not at all.
///
/// # Errors
/// [`Failure::Output`] with its path.
pub(crate) fn write_file(file: &Path, content: impl Into<Vec<u8>>) -> Result<(), Failure> {
    let failure = |reason: &str| Failure::Output { path: file.into(), reason: reason.into() };
    let name = file.file_name().ok_or_else(|| failure("it names no file"))?;
    // A bare name is in this folder, which has no name of its own.
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let opened = Output::open(folder.unwrap_or(Path::new(".")));
    let mut output = opened.map_err(|error| match error {
        Failure::Output { reason, .. } => failure(&reason),
        other => other,
    })?;
    output.put(&name.to_string_lossy(), content);
    output.commit()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_without_commit() {
        let folder = tempfile::tempdir().unwrap();
        let mut output = Output::open(&folder.path().join("a/b")).unwrap();
        output.put("x", "1");
        drop(output);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn results_of_two_commands_do_not_mix() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let mut first = Output::open_alone(&path).unwrap();
        assert!(matches!(Output::open_alone(&path), Err(Failure::InUse { .. })));
        first.put("x", "1");
        first.commit().unwrap();
        let names: Vec<_> =
            fs::read_dir(&path).unwrap().map(|own| own.unwrap().file_name()).collect();
        assert_eq!(names, ["x"]);
        assert!(Output::open_alone(&path).is_ok());
    }

    #[test]
    fn files_appear_together() {
        let folder = tempfile::tempdir().unwrap();
        let mut output = Output::open(&folder.path().join("a")).unwrap();
        output.put("x", "1");
        output.put("y", "2");
        output.commit().unwrap();
        let mut names: Vec<_> = fs::read_dir(folder.path().join("a"))
            .unwrap()
            .map(|entry| entry.unwrap().file_name())
            .collect();
        names.sort();
        assert_eq!(names, ["x", "y"]);
    }

    #[test]
    fn a_file_in_the_way_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(Output::open(&file.join("results")).is_err());
        assert!(Output::open(&file).is_err());
    }
}

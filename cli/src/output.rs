//! The folder of results: checked before the work, filled at the end, all files or none.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::errors::Failure;

/// A folder that can be written, and the files that will stand in it.
#[derive(Debug)]
pub(crate) struct Output {
    folder: PathBuf,
    /// Folders made by [`Output::open`], the outermost first; removed again if nothing is kept.
    made: Vec<PathBuf>,
    files: Vec<(String, Vec<u8>)>,
}

impl Output {
    /// Makes `folder` where it is missing, and tries to write in it.
    ///
    /// # Errors
    /// [`Failure::Output`]; nothing is left behind then.
    pub(crate) fn open(folder: &Path) -> Result<Output, Failure> {
        let missing = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        let mut made: Vec<PathBuf> =
            folder.ancestors().take_while(missing).map(Path::to_path_buf).collect();
        made.reverse();
        let output = Output { folder: folder.to_path_buf(), made, files: Vec::new() };
        output.prepare().map_err(|error| output.failure(&output.folder, &error))?;
        Ok(output)
    }

    fn prepare(&self) -> std::io::Result<()> {
        fs::create_dir_all(&self.folder)?;
        let probe = self.folder.join(partial("probe"));
        fs::write(&probe, b"")?;
        fs::remove_file(&probe)
    }

    /// Keeps a file for the end.
    pub(crate) fn put(&mut self, name: &str, content: impl Into<Vec<u8>>) {
        self.files.push((name.to_string(), content.into()));
    }

    /// Writes every file under a temporary name, then gives all of them their names. Returns the folder.
    ///
    /// # Errors
    /// [`Failure::Output`]; files of an earlier run are left as they were unless renaming fails.
    pub(crate) fn commit(mut self) -> Result<PathBuf, Failure> {
        for (name, content) in &self.files {
            let path = self.folder.join(partial(name));
            let written = fs::File::create(&path)
                .and_then(|mut file| file.write_all(content).and_then(|()| file.sync_all()));
            if let Err(error) = written {
                self.remove_partial();
                return Err(self.failure(&path, &error));
            }
        }
        for (name, _) in &self.files {
            let path = self.folder.join(name);
            if let Err(error) = fs::rename(self.folder.join(partial(name)), &path) {
                self.remove_partial();
                return Err(self.failure(&path, &error));
            }
        }
        self.made.clear();
        Ok(self.folder.clone())
    }

    fn remove_partial(&self) {
        for (name, _) in &self.files {
            let _ = fs::remove_file(self.folder.join(partial(name)));
        }
    }

    fn failure(&self, path: &Path, error: &std::io::Error) -> Failure {
        Failure::Output { path: path.to_path_buf(), reason: error.to_string() }
    }
}

/// Takes away the folders that were made for results which did not come.
impl Drop for Output {
    fn drop(&mut self) {
        for folder in self.made.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}

fn partial(name: &str) -> String {
    format!(".{name}.{}.part", std::process::id())
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
    fn files_appear_together() {
        let folder = tempfile::tempdir().unwrap();
        let mut output = Output::open(&folder.path().join("a")).unwrap();
        output.put("x", "1");
        output.put("y", "2");
        let path = output.commit().unwrap();
        let mut names: Vec<_> =
            fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().file_name()).collect();
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

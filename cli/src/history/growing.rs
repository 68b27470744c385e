//! A file that grows at its end while a run is at work.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::lock::is_at;

/// The file, as long as nobody else removes or changes it.
pub(super) struct Growing {
    file: File,
    path: PathBuf,
    length: u64,
}

impl Growing {
    /// An empty file.
    ///
    /// # Errors
    /// It cannot be made, with its name; so below.
    pub(super) fn create(path: PathBuf) -> io::Result<Self> {
        let file = File::create(&path).map_err(|error| named(&path, &error))?;
        Ok(Growing { file, path, length: 0 })
    }

    /// Goes on after the first `length` bytes of a file; what follows is dropped.
    pub(super) fn go_on(path: PathBuf, length: u64) -> io::Result<Self> {
        let opened = File::options().write(true).open(&path).and_then(|mut file| {
            file.set_len(length)?;
            file.seek(SeekFrom::End(0))?;
            Ok(file)
        });
        let file = opened.map_err(|error| named(&path, &error))?;
        Ok(Growing { file, path, length })
    }

    /// Adds bytes.
    pub(super) fn add(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.is_ours()?;
        self.file.write_all(bytes).map_err(|error| named(&self.path, &error))?;
        self.length += bytes.len() as u64;
        Ok(())
    }

    /// Begins anew with these bytes.
    pub(super) fn restart(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.is_ours()?;
        let emptied = self.file.set_len(0).and_then(|()| self.file.rewind());
        emptied.map_err(|error| named(&self.path, &error))?;
        self.length = 0;
        self.add(bytes)
    }

    /// Brings it onto the disk.
    pub(super) fn sync(&self) -> io::Result<()> {
        self.file.sync_data().map_err(|error| named(&self.path, &error))
    }

    fn is_ours(&self) -> io::Result<()> {
        let said = |what| named(&self.path, &io::Error::other(what));
        if !is_at(&self.file, &self.path) {
            return Err(said("it was removed while the run wrote it"));
        }
        if self.file.metadata()?.len() != self.length {
            return Err(said("another program changed it while the run wrote it"));
        }
        Ok(())
    }
}

fn named(path: &Path, error: &io::Error) -> io::Error {
    let name = path.file_name().unwrap_or(path.as_os_str());
    io::Error::new(error.kind(), format!("`{}`: {error}", name.display()))
}

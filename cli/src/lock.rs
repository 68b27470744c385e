//! A folder that one process at a time may write, by a lock of the operating system: it ends with the process,
//! however that ends.

use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Name of the file that is locked.
const NAME: &str = ".lock";

/// A lock that is held until it is dropped.
#[derive(Debug)]
pub(crate) struct Lock {
    path: PathBuf,
    /// Open as long as the lock is held.
    _file: File,
}

/// How a folder stands.
pub(crate) enum Locked {
    /// Nobody else writes it.
    Ours(Lock),
    /// Somebody does: the number of the process, where it is known.
    InUse(Option<u32>),
    /// Its file system knows no locks.
    Unknown,
}

impl Lock {
    /// Locks a folder, if it is free.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub(crate) fn take(folder: &Path) -> io::Result<Locked> {
        let path = folder.join(NAME);
        loop {
            let mut file =
                File::options().create(true).truncate(false).read(true).write(true).open(&path)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    let text = fs::read_to_string(&path).unwrap_or_default();
                    return Ok(Locked::InUse(text.trim().parse().ok()));
                }
                Err(TryLockError::Error(_)) => return Ok(Locked::Unknown),
            }
            // Whoever held it before may have removed the file since it was opened here.
            if is_at(&file, &path) {
                let _ = file.set_len(0).and_then(|()| writeln!(file, "{}", std::process::id()));
                return Ok(Locked::Ours(Lock { path, _file: file }));
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

/// Whether an open file is the one that stands at a path.
#[cfg(unix)]
pub(crate) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let key = |found: fs::Metadata| (found.dev(), found.ino());
    match (file.metadata(), fs::metadata(path)) {
        (Ok(ours), Ok(there)) => key(ours) == key(there),
        _ => false,
    }
}

#[cfg(not(unix))]
pub(crate) fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

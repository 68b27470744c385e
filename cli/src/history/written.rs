//! What is written of a history up to a point.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};
use whirl_solver::cache::{Key, RunningKey};

/// The bytes of a history up to a point: how many, and a hash of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Written {
    pub(crate) length: u64,
    pub(crate) hash: Key,
}

impl Written {
    /// Whether a history begins with these bytes.
    ///
    /// # Errors
    /// It cannot be read.
    pub(crate) fn begins(&self, path: &Path) -> io::Result<bool> {
        let hash = hash_of(&mut File::open(path)?, self.length)?;
        Ok(hash.is_some_and(|hash| hash.key() == self.hash))
    }
}

/// The hash of the first `length` bytes of a file, if it has as many.
pub(super) fn hash_of(file: &mut File, length: u64) -> io::Result<Option<RunningKey>> {
    let (mut hash, mut block) = (RunningKey::default(), vec![0; 1 << 18]);
    let mut left = length;
    while left > 0 {
        let wanted = block.len().min(usize::try_from(left).unwrap_or(usize::MAX));
        let read = file.read(&mut block[..wanted])?;
        if read == 0 {
            return Ok(None);
        }
        hash.add(&block[..read]);
        left -= read as u64;
    }
    Ok(Some(hash))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_that_are_others_are_not_those_of_a_history() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        std::fs::write(&path, "t_s,x\n1,2\n2,3\n").unwrap();
        let hash = hash_of(&mut File::open(&path).unwrap(), 10).unwrap().unwrap().key();
        let written = Written { length: 10, hash };
        assert!(written.begins(&path).unwrap());
        for other in ["t_s,x\n1,3\n2,3\n", "t_s,x\n1,2", ""] {
            std::fs::write(&path, other).unwrap();
            assert!(!written.begins(&path).unwrap(), "{other}");
        }
        std::fs::write(&path, "t_s,x\n1,2\nanything").unwrap();
        assert!(written.begins(&path).unwrap());
    }
}

//! The folder of results of a sweep: locked while it is at work.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use whirl_solver::cache::{Key, pack, remove_unfinished, unpack, write_whole};

use super::files::{CSV, FIGURES, PARQUET, POINTS};
use super::journal;
use crate::created::CreatedFolders;
use crate::errors::Failure;
use crate::lock::{Lock, Locked};
use crate::results::{self, REPORT, SWEEP};

/// Folder of the states from which points go on that are not done.
const CHAINS: &str = "chains";

/// Files that stay where a sweep goes on.
const LASTING: [&str; 3] = [journal::NAME, CSV, PARQUET];

/// A folder of results that no other sweep writes.
#[derive(Debug)]
pub(super) struct SweepFolder {
    folder: PathBuf,
    /// Given up first: its file stands in the folder.
    _lock: Option<Lock>,
    created: CreatedFolders,
}

impl SweepFolder {
    /// Makes `folder` where it is missing, and sees that results can be written in it; adds to `warnings`.
    ///
    /// # Errors
    /// It cannot be written, another one writes it, or a folder has the name of a file; nothing is left behind then.
    pub(super) fn open(folder: &Path, warnings: &mut Vec<String>) -> Result<Self, Failure> {
        let failure =
            |path: &Path, reason: String| Failure::Output { path: path.to_path_buf(), reason };
        let created = CreatedFolders::missing(folder);
        fs::create_dir_all(folder).map_err(|error| failure(folder, error.to_string()))?;
        if let Some(name) = files().find(|name| folder.join(name).is_dir()) {
            let reason = "a folder has the name of a result: move it or remove it";
            return Err(failure(&folder.join(name), reason.to_owned()));
        }
        let lock = match Lock::take(folder) {
            Ok(Locked::InUse(by)) => {
                return Err(Failure::InUse { folder: folder.to_path_buf(), by });
            }
            Ok(locked) => results::held(locked, folder, warnings),
            Err(error) => return Err(failure(folder, error.to_string())),
        };
        Ok(SweepFolder { folder: folder.to_path_buf(), _lock: lock, created })
    }

    /// The folder.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Path of a file in it.
    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Takes away what earlier sweeps left, all of it or, of one that goes on, its figures and what was being written. Files that
    /// no sweep writes are left alone.
    ///
    /// # Errors
    /// Something cannot be removed.
    pub(super) fn begin(&mut self, goes_on: bool) -> io::Result<()> {
        self.created.keep();
        remove_unfinished(&self.folder, Duration::ZERO);
        self.clear(POINTS, !goes_on)?;
        self.clear(CHAINS, !goes_on)?;
        let lasting = if goes_on { &LASTING[..] } else { &[] };
        for name in files().filter(|name| !lasting.contains(&name.as_str())) {
            absent_is_fine(fs::remove_file(self.path(&name)))?;
        }
        Ok(())
    }

    /// Writes a file, whole or not at all.
    ///
    /// # Errors
    /// Why not, with the path.
    pub(super) fn write(&self, name: &str, content: &[u8]) -> Result<(), String> {
        let path = self.path(name);
        write_whole(&path, content)
            .map_err(|error| format!("cannot write `{}`: {error}", path.display()))
    }

    /// Keeps the state from which the point after `number`, which `point` tells from all others, goes on; none if it begins
    /// as the case does.
    ///
    /// # Errors
    /// Why not, with the path.
    pub(super) fn keep_state(
        &self,
        (number, point): (usize, Key),
        state: Option<&[u8]>,
    ) -> Result<(), String> {
        let path = self.of_chain(number);
        let written = fs::create_dir_all(self.path(CHAINS))
            .and_then(|()| write_whole(&path, &pack(&state_of(point), &state)?));
        written.map_err(|error| format!("cannot write `{}`: {error}", path.display()))
    }

    /// What was kept for the point after `number`, if it is there and whole, and of this point.
    pub(super) fn state(&self, (number, point): (usize, Key)) -> Option<Option<Vec<u8>>> {
        unpack(&state_of(point), &fs::read(self.of_chain(number)).ok()?)
    }

    /// Takes away the state after `number`, which nobody needs any more.
    pub(super) fn forget_state(&self, number: usize) {
        let _ = fs::remove_file(self.of_chain(number));
    }

    /// Takes away all states: no point is left that goes on from one.
    pub(super) fn forget_states(&self) {
        let _ = self.clear(CHAINS, true);
    }

    /// Takes away what is half written in a folder, or all that sweeps write there, and the folder if nothing else is in it.
    fn clear(&self, name: &str, whole: bool) -> io::Result<()> {
        let within = self.path(name);
        let Ok(entries) = fs::read_dir(&within) else { return Ok(()) };
        for entry in entries {
            let entry = entry?;
            let called = entry.file_name();
            let called = called.to_string_lossy();
            let half = called.starts_with('.') && called.ends_with(".part");
            let moved = called.starts_with('.') && called.ends_with(".moved");
            let stem = called.trim_end_matches(".bin");
            let ours = stem.len() >= 5 && stem.bytes().all(|c| c.is_ascii_digit());
            if half || whole && (ours || moved) {
                let path = entry.path();
                if path.is_dir() { fs::remove_dir_all(path)? } else { fs::remove_file(path)? }
            }
        }
        let _ = fs::remove_dir(within);
        Ok(())
    }

    fn of_chain(&self, number: usize) -> PathBuf {
        self.path(CHAINS).join(format!("{number:05}.bin"))
    }
}

/// What a state that is kept depends on, with the layout of its file.
fn state_of(point: Key) -> Key {
    Key::of(&("whirl sweep state 1", point))
}

pub(super) fn absent_is_fine(done: io::Result<()>) -> io::Result<()> {
    match done {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Every name that a sweep may give to a file in its folder.
fn files() -> impl Iterator<Item = String> {
    let figures = FIGURES.iter().flat_map(|stem| [format!("{stem}.svg"), format!("{stem}.png")]);
    LASTING.into_iter().chain([SWEEP, REPORT]).map(String::from).chain(figures)
}

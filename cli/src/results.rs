//! The folder of results while a run is at work: locked, checked before the work, its old files gone with the first
//! step, its new ones there as soon as they are known.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use whirl_solver::cache::{ABANDONED, remove_unfinished, write_whole};

use crate::created::CreatedFolders;
use crate::errors::Failure;
use crate::fields::{self, FRAMES};
use crate::figures;
use crate::history;
use crate::lock::{Lock, Locked};
use crate::room::Room;

/// The summary.
pub(crate) const SUMMARY: &str = "summary.json";
/// What the columns are, and the case in words.
pub(crate) const ABOUT: &str = "about.json";
/// Surfaces of the bodies, and how they move.
pub(crate) const SHAPES: &str = "shapes.json";
/// Its oil films on their bores, where the case wants them.
pub(crate) const FILMS: &str = "films.json";
/// The analyses that were done, and the case in words.
pub(crate) const ANALYSES: &str = "analyses.json";
/// What a sweep was.
pub(crate) const SWEEP: &str = "sweep.json";
/// The page that tells of all of them.
pub(crate) const REPORT: &str = "report.html";
/// The state after the last step, from which other runs can start.
pub(crate) const STATE: &str = "state.bin";
/// From what `--resume` goes on.
pub(crate) const CHECKPOINT: &str = "checkpoint.bin";

/// A folder of results that nobody else writes.
#[derive(Debug)]
pub(crate) struct Results {
    folder: PathBuf,
    /// Given up first: its file stands in the folder.
    lock: Option<Lock>,
    /// Taken while a run is at work, so that a disk that it fills has room for its summary.
    room: Option<Room>,
    created: CreatedFolders,
}

impl Results {
    /// Makes `folder` where it is missing, and sees that results can be written in it; adds to `warnings`.
    ///
    /// # Errors
    /// It cannot be written, another run writes it, or a folder has the name of a result; nothing is left behind
    /// then.
    pub(crate) fn open(folder: &Path, warnings: &mut Vec<String>) -> Result<Results, Failure> {
        let created = CreatedFolders::missing(folder);
        let mut results = Results { folder: folder.to_path_buf(), lock: None, room: None, created };
        fs::create_dir_all(folder).map_err(|error| results.failure(folder, &error.to_string()))?;
        if let Some(name) = names().find(|name| results.path(name).is_dir()) {
            let reason = "a folder has the name of a result: move it or remove it";
            return Err(results.failure(&results.path(&name), reason));
        }
        results.lock = match Lock::take(folder) {
            Ok(Locked::InUse(by)) => {
                let folder = folder.to_path_buf();
                results.created.keep();
                return Err(Failure::InUse { folder, by });
            }
            Ok(locked) => held(locked, folder, warnings),
            Err(error) => return Err(results.failure(folder, &error.to_string())),
        };
        Ok(results)
    }

    /// The folder.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Path of a file in it.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Takes away what earlier runs left, but for `except`: from here on the folder has the files of this run only.
    /// Files that no run writes are left alone. Of a folder that is not locked, files that were being written stay if
    /// they may belong to a run that is at work.
    ///
    /// # Errors
    /// A file cannot be removed.
    pub(crate) fn begin(&mut self, except: &[&str]) -> io::Result<()> {
        self.created.keep();
        for name in names().filter(|name| !except.contains(&name.as_str())) {
            match fs::remove_file(self.path(&name)) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
                _ => {}
            }
        }
        fields::clear(&self.folder)?;
        let age = if self.lock.is_some() { Duration::ZERO } else { ABANDONED };
        remove_unfinished(&self.folder, age);
        self.room = Some(Room::take(&self.folder));
        Ok(())
    }

    /// Gives up the room that was kept for what is written from here on.
    pub(crate) fn free_room(&mut self) {
        self.room = None;
    }

    /// Writes a file, whole or not at all.
    ///
    /// # Errors
    /// Why not, with the path.
    pub(crate) fn write(&self, name: &str, content: &[u8]) -> Result<(), String> {
        let path = self.path(name);
        write_whole(&path, content)
            .map_err(|error| format!("cannot write `{}`: {error}", path.display()))
    }

    /// Takes away the point to resume from, with frames and rows for it: the run has come to its end.
    pub(crate) fn forget_checkpoint(&self) {
        for name in [CHECKPOINT, FRAMES, history::PART, history::REST] {
            let _ = fs::remove_file(self.path(name));
        }
    }

    fn failure(&self, path: &Path, reason: &str) -> Failure {
        Failure::Output { path: path.to_path_buf(), reason: reason.to_string() }
    }
}

/// The lock of a folder that nobody else has; none, and a warning, where its file system knows no locks.
pub(crate) fn held(locked: Locked, folder: &Path, warnings: &mut Vec<String>) -> Option<Lock> {
    let Locked::Ours(lock) = locked else {
        warnings.push(format!(
            "the file system of `{}` does not support locks: another run that writes there would not be noticed",
            folder.display()
        ));
        return None;
    };
    Some(lock)
}

/// Every name that a run may give to a file.
fn names() -> impl Iterator<Item = String> {
    let figures =
        figures::NAMES.iter().flat_map(|stem| [format!("{stem}.svg"), format!("{stem}.png")]);
    let copies = history::FORMATS.iter().flat_map(|own| own.part.into_iter().chain([own.name]));
    [
        history::NAME,
        history::PART,
        history::REST,
        SUMMARY,
        ABOUT,
        SHAPES,
        FILMS,
        REPORT,
        CHECKPOINT,
        STATE,
        FRAMES,
    ]
    .into_iter()
    .chain(copies)
    .map(String::from)
    .chain(figures)
}

#[cfg(test)]
mod tests {
    use whirl_solver::cache::write_aside;

    use super::*;

    fn open(folder: &Path) -> Result<Results, Failure> {
        Results::open(folder, &mut Vec::new())
    }

    fn listing(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
        let mut names: Vec<String> = entries.map(|name| name.into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn nothing_is_left_of_a_run_that_does_not_begin() {
        let folder = tempfile::tempdir().unwrap();
        drop(open(&folder.path().join("a/b")).unwrap());
        assert!(listing(folder.path()).is_empty());
        fs::write(folder.path().join("summary.json"), "old").unwrap();
        drop(open(folder.path()).unwrap());
        assert_eq!(listing(folder.path()), ["summary.json"]);
    }

    #[test]
    fn old_results_go_when_a_run_begins_and_other_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["summary.json", "rotation.png", "checkpoint.bin", "history.csv", "notes.txt"] {
            fs::write(folder.path().join(name), "old").unwrap();
        }
        let mut results = open(folder.path()).unwrap();
        results.begin(&[history::NAME]).unwrap();
        // What a full disk gives back for the summary.
        let kept = |folder: &Path| -> u64 {
            let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
            files
                .filter(|own| own.file_name() == ".whirl-room.part")
                .map(|own| own.metadata().unwrap().len())
                .sum()
        };
        assert_eq!(kept(folder.path()), 65_536);
        results.free_room();
        assert_eq!(kept(folder.path()), 0);
        results.write(SUMMARY, b"new").unwrap();
        drop(results);
        assert_eq!(listing(folder.path()), ["history.csv", "notes.txt", "summary.json"]);
        assert_eq!(fs::read(folder.path().join("summary.json")).unwrap(), b"new");
    }

    /// Files that a killed run was writing go with its results, whichever names they have.
    #[test]
    fn what_a_killed_run_was_writing_goes_when_a_run_begins() {
        let folder = tempfile::tempdir().unwrap();
        let write = write_aside(&folder.path().join(SUMMARY), b"half").unwrap();
        let aside = listing(folder.path());
        drop(write);
        assert_eq!(aside.len(), 1, "{aside:?}");
        // As it stays when the process is killed.
        fs::write(folder.path().join(&aside[0]), "half").unwrap();
        fs::write(folder.path().join(".notes.part"), "the user's").unwrap();
        let mut results = open(folder.path()).unwrap();
        assert!(folder.path().join(&aside[0]).exists(), "no run has begun yet");
        results.begin(&[]).unwrap();
        drop(results);
        assert_eq!(listing(folder.path()), [".notes.part"]);
    }

    #[test]
    fn a_folder_that_cannot_be_locked_is_warned_of() {
        let folder = tempfile::tempdir().unwrap();
        let mut warnings = Vec::new();
        let lock = held(Locked::Unknown, folder.path(), &mut warnings);
        assert!(lock.is_none());
        assert_eq!(warnings.len(), 1);
        let name = folder.path().display().to_string();
        assert!(
            warnings[0].contains(&name) && warnings[0].contains("does not support locks"),
            "{warnings:?}"
        );
        let Locked::Ours(lock) = Lock::take(folder.path()).unwrap() else { panic!("it is free") };
        assert!(held(Locked::Ours(lock), folder.path(), &mut warnings).is_some());
        assert_eq!(warnings.len(), 1);
    }

    #[test]
    fn a_folder_in_use_is_refused_until_it_is_free() {
        let folder = tempfile::tempdir().unwrap();
        let first = open(folder.path()).unwrap();
        let own = std::process::id();
        for _ in 0..2 {
            match open(folder.path()) {
                Err(Failure::InUse { by, .. }) => assert_eq!(by, Some(own)),
                other => panic!("{other:?}"),
            }
        }
        drop(first);
        open(folder.path()).unwrap();
    }

    #[test]
    fn what_stands_in_the_way_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(open(&file.join("results")).is_err());
        assert!(open(&file).is_err());
        fs::create_dir_all(folder.path().join("taken/reactions.png")).unwrap();
        let error = open(&folder.path().join("taken")).unwrap_err();
        assert!(error.to_string().contains("reactions.png"), "{error}");
        assert_eq!(listing(&folder.path().join("taken")), ["reactions.png"]);
    }
}

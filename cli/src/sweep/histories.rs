//! What is kept of points beside their rows: a folder for each, by its number, which says of which point it is.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::PathBuf;

use whirl_solver::cache::{Key, write_whole};

use super::definition::{Keep, Sweep};
use super::files::POINTS;
use super::folder::{SweepFolder, absent_is_fine};
use super::points::Point;
use crate::history;
use crate::results::{STATE, SUMMARY};
use crate::simulate::InMemory;

/// The values of a point, behind what tells it from all others.
const POINT: &str = "point.toml";
/// Begins the first line of the latter.
const KNOWN_BY: &str = "# point ";

impl SweepFolder {
    /// Keeps history, summary and last state of a point, all of them or nothing.
    ///
    /// # Errors
    /// Why not, with the path.
    pub(super) fn keep_point(
        &self,
        (point, key): (&Point, Key),
        run: &InMemory,
    ) -> Result<(), String> {
        let number = point.number();
        let (whole, half) =
            (self.of_point(number), self.path(POINTS).join(format!(".{number:05}.part")));
        let write = || {
            absent_is_fine(fs::remove_dir_all(&half))?;
            fs::create_dir_all(&half)?;
            let known = format!("{KNOWN_BY}{}\n{}", key.hex(), point.lines());
            write_whole(&half.join(POINT), known.as_bytes())?;
            write_whole(&half.join(history::NAME), run.history.csv().as_bytes())?;
            write_whole(&half.join(SUMMARY), run.summary.as_bytes())?;
            if let Some(state) = &run.state {
                write_whole(&half.join(STATE), state)?;
            }
            absent_is_fine(fs::remove_dir_all(&whole))?;
            fs::rename(&half, &whole)
        };
        let written: io::Result<()> = write();
        written.map_err(|error| {
            let _ = fs::remove_dir_all(&half);
            format!("cannot write `{}`: {error}", whole.display())
        })
    }

    /// Puts what is kept of points where these have it now: further points may have moved them. What is of no point goes. Returns
    /// of which points something is there.
    ///
    /// # Errors
    /// Something cannot be moved, in words.
    pub(super) fn arrange(&self, sweep: &Sweep) -> Result<Vec<bool>, String> {
        let mut there = vec![false; sweep.count()];
        let within = self.path(POINTS);
        if sweep.keep == Keep::Nothing || !within.is_dir() {
            return Ok(there);
        }
        let keys = (0..sweep.chains()).flat_map(|chain| sweep.identities(chain));
        let numbers: BTreeMap<String, usize> = keys.map(|key| key.hex()).zip(0..).collect();
        let mut moved = Vec::new();
        let arranged = self.kept_points().and_then(|folders| {
            for folder in folders {
                let text = fs::read_to_string(folder.join(POINT)).unwrap_or_default();
                let known = text.lines().next().and_then(|line| line.strip_prefix(KNOWN_BY));
                let number = known.and_then(|hex| numbers.get(hex)).filter(|own| !there[**own]);
                let Some(&number) = number else {
                    fs::remove_dir_all(&folder)?;
                    continue;
                };
                there[number] = true;
                if folder != self.of_point(number) {
                    // Two may change places. Whoever is interrupted here finds both by what they say.
                    let aside = within.join(format!(".{number:05}.moved"));
                    fs::rename(&folder, &aside)?;
                    moved.push((aside, number));
                }
            }
            moved.iter().try_for_each(|(aside, number)| fs::rename(aside, self.of_point(*number)))
        });
        arranged.map_err(|error| format!("cannot arrange `{}`: {error}", within.display()))?;
        Ok(there)
    }

    /// Folders of points, whole ones and those that were being moved.
    fn kept_points(&self) -> io::Result<Vec<PathBuf>> {
        let mut all = Vec::new();
        for entry in fs::read_dir(self.path(POINTS))? {
            let entry = entry?;
            let called = entry.file_name();
            let called = called.to_string_lossy();
            let stem =
                called.strip_suffix(".moved").map_or(&*called, |own| own.trim_start_matches('.'));
            if stem.len() >= 5 && stem.bytes().all(|c| c.is_ascii_digit()) && entry.path().is_dir()
            {
                all.push(entry.path());
            }
        }
        all.sort();
        Ok(all)
    }

    /// Folder of what is kept of a point.
    fn of_point(&self, number: usize) -> PathBuf {
        self.path(POINTS).join(format!("{number:05}"))
    }
}

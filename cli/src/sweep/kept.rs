//! What is done of a sweep: which points have a row in the journal, and where.

use std::collections::BTreeMap;
use std::{fs, io};

use whirl_solver::cache::Key;

use super::definition::{Keep, Sweep};
use super::folder::SweepFolder;
use super::journal::{self, Journal, Record, Records};
use super::row::{Row, Verdict};
use crate::checkpoint::Identity;
use crate::errors::Failure;

/// The rows that are there.
pub(super) struct Kept {
    records: Records,
    /// Where the row of every point begins, if it is there, and whether it came to no end.
    rows: Vec<Option<u64>>,
    failed: Vec<bool>,
    /// Whether something was marched.
    marched: Vec<bool>,
    /// Lists of names that rows have.
    pub(super) names: Vec<Vec<String>>,
    /// Bytes of whole records.
    whole: u64,
    /// Rows of points that the sweep does not have.
    others: usize,
    /// On what the rows depend.
    identity: Option<Identity>,
}

impl Kept {
    /// What is in the journal of a folder of results.
    ///
    /// # Errors
    /// It cannot be read, in words.
    pub(super) fn read(results: &SweepFolder, sweep: &Sweep) -> Result<Self, String> {
        let path = results.path(journal::NAME);
        let cannot = |error| format!("cannot read `{}`: {error}", path.display());
        let mut records = Records::open(&path).map_err(cannot)?;
        let keys = (0..sweep.chains()).flat_map(|chain| sweep.identities(chain));
        let numbers: BTreeMap<Key, usize> = keys.zip(0..).collect();
        let mut kept = Kept {
            rows: vec![None; sweep.count()],
            failed: vec![false; sweep.count()],
            marched: vec![false; sweep.count()],
            names: Vec::new(),
            whole: 0,
            others: 0,
            identity: None,
            records: Records::open(&path).map_err(cannot)?,
        };
        while let Some((start, record)) = records.next().map_err(cannot)? {
            match record {
                Record::Begin(identity) => kept.identity = Some(identity),
                Record::Names(names) => kept.names.push(names),
                Record::Done { point, row, .. } => match numbers.get(&point) {
                    Some(number) => {
                        kept.rows[*number] = Some(start);
                        kept.failed[*number] = row.verdict == Verdict::Failed;
                        kept.marched[*number] = sweep.marches && !row.values.is_empty();
                    }
                    None => kept.others += 1,
                },
            }
        }
        kept.whole = records.whole();
        Ok(kept)
    }

    /// What a sweep goes on from; none where there is no journal.
    ///
    /// # Errors
    /// The journal is that of another sweep, or of another state of its files.
    pub(super) fn resumed(
        results: &SweepFolder,
        sweep: &Sweep,
        identity: &Identity,
    ) -> Result<Option<Self>, Failure> {
        if !results.path(journal::NAME).exists() {
            return Ok(None);
        }
        let folder = || results.folder().to_path_buf();
        let kept = Kept::read(results, sweep)
            .map_err(|reason| Failure::NothingToResume { folder: folder(), reason })?;
        let Some(before) = &kept.identity else {
            // One that was killed as it began has nothing to lose; of any other what is there is not given up unasked.
            let is_begun = || {
                let length = fs::metadata(results.path(journal::NAME))?.len();
                Ok::<_, io::Error>(length >= journal::beginning(identity)? as u64)
            };
            return match is_begun() {
                Ok(false) => Ok(None),
                Ok(true) => Err(Failure::NothingToResume {
                    folder: folder(),
                    reason: format!(
                        "`{}` is damaged from its beginning, or another version wrote it",
                        journal::NAME
                    ),
                }),
                Err(error) => {
                    Err(Failure::NothingToResume { folder: folder(), reason: error.to_string() })
                }
            };
        };
        let mut differs = before.changed_in(identity);
        if kept.others > 0 {
            differs.push(format!(
                "the points: {} finished ones are no longer part of the sweep{}",
                kept.others,
                match sweep.along {
                    Some(_) => ", or no longer go on from the same ones: values of the key along which points continue can be added at its end only",
                    None => "",
                }
            ));
        }
        if differs.is_empty() {
            Ok(Some(kept))
        } else {
            Err(Failure::OtherSweep { folder: folder(), differs })
        }
    }

    /// Gives up points whose histories should be there and are not, and counts them.
    ///
    /// # Errors
    /// The folder cannot be arranged, in words.
    pub(super) fn without_histories(
        &mut self,
        results: &SweepFolder,
        sweep: &Sweep,
    ) -> Result<usize, String> {
        let there = results.arrange(sweep)?;
        let mut lost = 0;
        for (number, row) in self.rows.iter_mut().enumerate() {
            let wanted = sweep.keep == Keep::Histories && self.marched[number];
            if row.is_some() && wanted && !there[number] {
                *row = None;
                lost += 1;
            }
        }
        Ok(lost)
    }

    /// Number of points that are done.
    pub(super) fn done(&self) -> usize {
        self.rows.iter().flatten().count()
    }

    /// Whether a point is done.
    pub(super) fn has(&self, number: usize) -> bool {
        self.rows[number].is_some()
    }

    /// Whether a point that is done came to no end, so that no other one can go on from it.
    pub(super) fn has_failed(&self, number: usize) -> bool {
        self.failed[number]
    }

    /// The row of a point, and which of the lists of names it has; none of one that is not done.
    ///
    /// # Errors
    /// It cannot be read, in words.
    pub(super) fn row(&mut self, number: usize) -> Result<Option<(usize, Row)>, String> {
        let Some(start) = self.rows[number] else { return Ok(None) };
        match self
            .records
            .at(start)
            .map_err(|error| format!("cannot read `{}`: {error}", journal::NAME))?
        {
            Record::Done { names, row, .. } => Ok(Some((names as usize, row))),
            _ => Err(format!("`{}` has changed while it was read", journal::NAME)),
        }
    }

    /// The journal, to be gone on with after its last whole record.
    ///
    /// # Errors
    /// It cannot be opened or cut.
    pub(super) fn journal(&self, results: &SweepFolder) -> std::io::Result<Journal> {
        Journal::go_on(&results.path(journal::NAME), self.whole, self.names.clone())
    }
}

/// What is said of a sweep that is resumed; `lost`: points whose histories are missing.
pub(super) fn going_on(
    kept: Option<&Kept>,
    lost: usize,
    results: &SweepFolder,
    sweep: &Sweep,
) -> String {
    match kept {
        Some(kept) => {
            let (done, all) = (kept.done(), sweep.count());
            let lost = match lost {
                0 => String::new(),
                1 => "; 1 is run again, because its history is missing".to_owned(),
                _ => format!("; {lost} are run again, because their histories are missing"),
            };
            format!("resuming after {done} of {all} points{lost}")
        }
        None => {
            let folder = results.folder().display();
            let what = match results.path(journal::NAME).exists() {
                true => "an empty journal",
                false => "no journal",
            };
            format!("{what} in {folder}: starting from the beginning")
        }
    }
}

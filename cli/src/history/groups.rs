//! The rows of a run with all their digits, while it is at work, for the files that are made of them at its end: whole groups
//! as they will stand in history.parquet, and beside them the rows of the group that is not whole yet.
//!
//! From a row on both can be gone on with: the rows before it are in one of the two, however the process ended.

use std::io;
use std::path::Path;

use whirl_solver::cache::write_whole;

use super::growing::Growing;
use super::kept_rows::{KeptRows, PART, REST};
use crate::parquet::{GROUP, MAGIC, Numbers};

/// Both files while they are written.
pub(crate) struct Groups {
    numbers: Numbers,
    part: Growing,
    rest: Growing,
    /// Groups that are whole.
    whole: u64,
    /// The rows that follow them.
    pending: Vec<f64>,
}

impl Groups {
    /// Begins both files.
    ///
    /// # Errors
    /// They cannot be written, here and below.
    pub(crate) fn create(folder: &Path, columns: usize) -> io::Result<Self> {
        let mut part = Growing::create(folder.join(PART))?;
        part.add(MAGIC)?;
        let mut rest = Growing::create(folder.join(REST))?;
        rest.add(&head(0))?;
        let numbers = Numbers(columns);
        Ok(Groups { numbers, part, rest, whole: 0, pending: Vec::new() })
    }

    /// Goes on after the first `rows` rows; what follows is dropped.
    pub(crate) fn go_on(folder: &Path, columns: usize, rows: u64) -> io::Result<Self> {
        let numbers = Numbers(columns);
        let whole = rows / GROUP as u64;
        let kept = KeptRows::open(folder, columns)?;
        let pending = kept.rows_of_group(whole, (rows % GROUP as u64) as usize)?;
        // The rows are in the one before they leave the other.
        let path = folder.join(REST);
        let mut bytes = head(whole);
        bytes.extend(pending.iter().flat_map(|value| value.to_le_bytes()));
        write_whole(&path, &bytes)?;
        let rest = Growing::go_on(path, bytes.len() as u64)?;
        let part = Growing::go_on(folder.join(PART), numbers.start(whole))?;
        Ok(Groups { numbers, part, rest, whole, pending })
    }

    /// Adds rows that stand one after the other.
    pub(super) fn add(&mut self, mut rows: &[f64]) -> io::Result<()> {
        let full = GROUP * self.numbers.0;
        while !rows.is_empty() {
            let (own, others) = rows.split_at(rows.len().min(full - self.pending.len()));
            self.pending.extend_from_slice(own);
            rows = others;
            if self.pending.len() < full {
                let bytes: Vec<u8> = own.iter().flat_map(|value| value.to_le_bytes()).collect();
                self.rest.add(&bytes)?;
            } else {
                self.part.add(&self.numbers.group(&self.pending))?;
                // As above, of a machine that loses its power.
                self.part.sync()?;
                self.pending.clear();
                self.whole += 1;
                self.rest.restart(&head(self.whole))?;
            }
        }
        Ok(())
    }

    /// Brings all rows onto the disk.
    pub(super) fn sync(&self) -> io::Result<()> {
        self.part.sync()?;
        self.rest.sync()
    }
}

fn head(group: u64) -> Vec<u8> {
    group.to_le_bytes().to_vec()
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::ops::Range;

    use super::*;

    const COLUMNS: usize = 3;

    fn rows(range: Range<usize>) -> Vec<f64> {
        let row = |k: usize| [k as f64 / 3.0, (k as f64).sin() * 1e-5, -0.0];
        range.flat_map(row).collect()
    }

    /// Both files after all rows.
    fn left(folder: &Path) -> [Vec<u8>; 2] {
        [PART, REST].map(|name| fs::read(folder.join(name)).unwrap())
    }

    fn kept(folder: &Path) -> Vec<f64> {
        let kept = KeptRows::open(folder, COLUMNS).unwrap();
        let mut all = vec![0.0; COLUMNS * kept.count() as usize];
        for column in 0..COLUMNS {
            let mut bytes = Vec::new();
            kept.column(column, &mut |own| {
                bytes.extend_from_slice(own);
                Ok(())
            })
            .unwrap();
            let (values, others) = bytes.as_chunks();
            assert!(others.is_empty());
            let values = values.iter().map(|own| f64::from_le_bytes(*own));
            all.iter_mut()
                .skip(column)
                .step_by(COLUMNS)
                .zip(values)
                .for_each(|(to, own)| *to = own);
        }
        all
    }

    #[test]
    fn a_run_goes_on_after_any_row_wherever_it_was() {
        const ALL: usize = 2 * GROUP + 9;
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        Groups::create(folder, COLUMNS).unwrap().add(&rows(0..ALL)).unwrap();
        let whole = left(folder);
        assert_eq!(kept(folder), rows(0..ALL));
        for cut in [0, 1, GROUP - 1, GROUP, GROUP + 1, 2 * GROUP, ALL] {
            for beyond in [0, 1, 5, GROUP, GROUP + 3] {
                let mut groups = Groups::create(folder, COLUMNS).unwrap();
                groups.add(&rows(0..cut)).unwrap();
                groups.sync().unwrap();
                groups.add(&rows(cut..cut + beyond)).unwrap();
                drop(groups);
                let mut groups = Groups::go_on(folder, COLUMNS, cut as u64).unwrap();
                assert_eq!(kept(folder), rows(0..cut), "{cut} + {beyond}");
                let mut row = cut;
                while row < ALL {
                    let next = (row + 100).min(ALL);
                    groups.add(&rows(row..next)).unwrap();
                    row = next;
                }
                assert!(left(folder) == whole, "{cut} + {beyond}");
            }
        }
    }

    #[test]
    fn a_process_may_end_between_one_group_and_the_next() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        Groups::create(folder, COLUMNS).unwrap().add(&rows(0..GROUP)).unwrap();
        fs::write(folder.join(REST), "").unwrap();
        assert_eq!(kept(folder), rows(0..GROUP));
        drop(Groups::go_on(folder, COLUMNS, GROUP as u64 - 2).unwrap());
        assert_eq!(kept(folder), rows(0..GROUP - 2));
        // A row that is torn is none.
        let mut rest = fs::read(folder.join(REST)).unwrap();
        rest.truncate(rest.len() - 3);
        fs::write(folder.join(REST), &rest).unwrap();
        assert_eq!(kept(folder), rows(0..GROUP - 3));
        assert!(Groups::go_on(folder, COLUMNS, GROUP as u64 - 2).is_err());
        assert!(Groups::go_on(folder, COLUMNS, GROUP as u64).is_err());
    }
}

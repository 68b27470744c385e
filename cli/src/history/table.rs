//! A history in memory: the same numbers as its file has.

use std::collections::TryReserveError;
use std::io;

use super::read::{ReadHistory, places};
use super::rounded::ten_digits;
use super::text;

/// Rows of one length after each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HistoryTable {
    names: Vec<String>,
    values: Vec<f64>,
}

impl HistoryTable {
    /// Without rows.
    pub(crate) fn new(names: Vec<String>) -> Self {
        HistoryTable { names, values: Vec::new() }
    }

    /// Of rows that a table had, as [`HistoryTable::values`] gives them.
    ///
    /// # Panics
    /// If these are no whole rows.
    pub fn from_values(names: Vec<String>, values: Vec<f64>) -> Self {
        assert!(values.len().is_multiple_of(names.len().max(1)), "whole rows");
        HistoryTable { names, values }
    }

    /// The text of history.csv.
    pub fn csv(&self) -> String {
        let mut text = text::head(&self.names).into_bytes();
        self.values
            .chunks_exact(self.names.len().max(1))
            .for_each(|row| text::line(&mut text, row));
        String::from_utf8(text).expect("names and digits")
    }

    /// Of all rows of another history.
    ///
    /// # Errors
    /// That cannot be read.
    #[cfg(test)]
    pub(crate) fn of(history: &dyn ReadHistory) -> io::Result<Self> {
        let names: Vec<&str> = history.names().iter().map(String::as_str).collect();
        let mut values = Vec::with_capacity(history.count()? as usize * names.len());
        history.scan(history.start(), &names, &mut |row| values.extend_from_slice(row))?;
        Ok(HistoryTable { names: history.names().to_vec(), values })
    }

    /// Adds a row, one value a column, each to the digits that a file keeps.
    ///
    /// # Errors
    /// There is no memory for it.
    pub(crate) fn push(&mut self, row: &[f64]) -> Result<(), TryReserveError> {
        debug_assert_eq!(row.len(), self.names.len(), "one value a column");
        self.values.try_reserve(row.len())?;
        self.values.extend(row.iter().map(|value| ten_digits(*value)));
        Ok(())
    }

    /// Names of the columns.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.values.len() / self.names.len().max(1)
    }

    /// Rows × columns, row after row.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// As [`HistoryTable::values`], without a copy.
    pub fn into_values(self) -> Vec<f64> {
        self.values
    }

    fn time(&self, row: usize) -> f64 {
        self.values[row * self.names.len()]
    }

    fn read(&self, from: u64, columns: &[&str], most: usize, each: &mut dyn FnMut(&[f64])) {
        let places: Vec<usize> = places(&self.names, columns).collect();
        let mut picked = vec![0.0; places.len()];
        for row in self.values.chunks_exact(self.names.len()).skip(from as usize).take(most) {
            picked.iter_mut().zip(&places).for_each(|(value, place)| *value = row[*place]);
            each(&picked);
        }
    }
}

/// A place is the number of a row.
impl ReadHistory for HistoryTable {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn count(&self) -> io::Result<u64> {
        Ok(self.rows() as u64)
    }

    fn start(&self) -> u64 {
        0
    }

    fn last_time(&self) -> io::Result<Option<f64>> {
        Ok(self.rows().checked_sub(1).map(|last| self.time(last)))
    }

    fn place_of_time(&self, time: f64) -> io::Result<u64> {
        let (mut low, mut high) = (0, self.rows());
        while low < high {
            let middle = low + (high - low) / 2;
            if self.time(middle) < time { low = middle + 1 } else { high = middle }
        }
        Ok(low as u64)
    }

    fn scan(&self, from: u64, columns: &[&str], each: &mut dyn FnMut(&[f64])) -> io::Result<()> {
        self.read(from, columns, usize::MAX, each);
        Ok(())
    }

    fn first_row(
        &self,
        from: u64,
        columns: &[&str],
        each: &mut dyn FnMut(&[f64]),
    ) -> io::Result<()> {
        self.read(from, columns, 1, each);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::{HistoryFile, HistoryWriter};

    /// What is read from either store is the same to the bit.
    #[test]
    fn a_table_reads_as_its_file_does() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let names = ["t_s", "x", "y"].map(str::to_owned).to_vec();
        let mut writer = HistoryWriter::create(&path, &names).unwrap();
        let mut table = HistoryTable::new(names);
        for i in 0..500 {
            let t = f64::from(i) * 7.4e-5;
            let row = [t, (31.0 * t).sin() * 1e-5, (1e3 * t).exp() - 1.0];
            writer.push(&row).unwrap();
            table.push(&row).unwrap();
        }
        writer.finish().unwrap();
        let file = HistoryFile::open(&path).unwrap();
        assert_eq!(HistoryTable::of(&file).unwrap(), table);
        assert_eq!(file.count().unwrap(), table.count().unwrap());
        assert_eq!(file.last_time().unwrap(), table.last_time().unwrap());
        let rows = |history: &dyn ReadHistory, time: f64| {
            let (mut all, mut first) = (Vec::new(), Vec::new());
            let from = history.place_of_time(time).unwrap();
            history.scan(from, &["y", "t_s"], &mut |row| all.push(row.to_vec())).unwrap();
            history.first_row(from, &["x"], &mut |row| first.push(row.to_vec())).unwrap();
            (all, first)
        };
        for time in [-1.0, 0.0, 7.4e-5, 0.01, 0.0369, 1.0] {
            assert_eq!(rows(&file, time), rows(&table, time), "{time}");
        }
        let empty = HistoryTable::new(vec!["t_s".to_owned()]);
        assert_eq!((empty.last_time().unwrap(), empty.place_of_time(0.0).unwrap()), (None, 0));
    }
}

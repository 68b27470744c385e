//! A history read from its file: by rows, or from a time on. Times never fall from row to row.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use super::read::{ReadHistory, places};

/// A history on disk. A last line without its end is not part of it.
#[derive(Debug)]
pub(crate) struct HistoryFile {
    path: PathBuf,
    names: Vec<String>,
    /// First byte of the rows, and the one behind the last whole line.
    first: u64,
    end: u64,
}

impl HistoryFile {
    /// Opens a history.
    ///
    /// # Errors
    /// It cannot be read, or has no header line.
    pub(crate) fn open(path: &Path) -> io::Result<HistoryFile> {
        let mut file = File::open(path)?;
        let length = file.metadata()?.len();
        let mut head = Vec::new();
        BufReader::new(&mut file).read_until(b'\n', &mut head)?;
        let names = String::from_utf8_lossy(&head);
        let Some(names) = names.strip_suffix('\n') else {
            return Err(invalid(path, "has no header line"));
        };
        let names = names.split(',').map(str::to_string).collect();
        let first = head.len() as u64;
        let mut history = HistoryFile { path: path.to_path_buf(), names, first, end: length };
        history.end = history.line_start(&mut file, length)?;
        Ok(history)
    }

    /// The history of a run with these columns.
    ///
    /// # Errors
    /// As [`HistoryFile::open`]; it has other columns.
    pub(crate) fn of_run(path: &Path, names: &[String]) -> io::Result<HistoryFile> {
        let history = HistoryFile::open(path)?;
        match history.names == names {
            true => Ok(history),
            false => Err(invalid(path, "its header is not the one that the run wrote")),
        }
    }

    /// Whether there are rows.
    pub(crate) fn has_rows(&self) -> bool {
        self.end > self.first
    }

    /// Bytes of names and whole rows.
    pub(crate) fn length(&self) -> u64 {
        self.end
    }

    fn rows(
        &self,
        from: u64,
        columns: &[&str],
        most: usize,
        each: &mut dyn FnMut(&[f64]),
    ) -> io::Result<()> {
        // Columns by their places in a line.
        let mut places: Vec<(usize, usize)> = places(&self.names, columns).zip(0..).collect();
        places.sort_unstable();
        let wanted = places.last().map_or(0, |(last, _)| last + 1);
        let mut file = File::open(&self.path)?;
        file.seek(SeekFrom::Start(from))?;
        let mut lines = BufReader::with_capacity(1 << 18, file.take(self.end - from));
        let (mut line, mut row) = (Vec::new(), vec![0.0; columns.len()]);
        let mut count = 0;
        while count < most && lines.read_until(b'\n', &mut line)? > 0 {
            count += 1;
            let text = std::str::from_utf8(&line).unwrap_or_default().trim_end();
            let mut left = places.iter().peekable();
            for (place, cell) in text.split(',').take(wanted).enumerate() {
                while let Some((_, value)) = left.next_if(|(own, _)| *own == place) {
                    row[*value] = cell.parse().map_err(|_| invalid(&self.path, text))?;
                }
            }
            if left.next().is_some() {
                return Err(invalid(&self.path, text));
            }
            each(&row);
            line.clear();
        }
        Ok(())
    }

    /// First byte of the line with byte `at`, which is at most the length of the file.
    fn line_start(&self, file: &mut File, at: u64) -> io::Result<u64> {
        const WINDOW: u64 = 4096;
        let mut bytes = Vec::new();
        let mut end = at;
        while end > self.first {
            let start = end.saturating_sub(WINDOW).max(self.first);
            file.seek(SeekFrom::Start(start))?;
            bytes.resize((end - start) as usize, 0);
            file.read_exact(&mut bytes)?;
            if let Some(place) = bytes.iter().rposition(|byte| *byte == b'\n') {
                return Ok(start + place as u64 + 1);
            }
            end = start;
        }
        Ok(self.first)
    }

    /// Time of the row that begins at `start`, and where the next one does.
    fn time_at(&self, file: &mut File, start: u64) -> io::Result<(f64, u64)> {
        file.seek(SeekFrom::Start(start))?;
        let mut line = Vec::new();
        BufReader::new(file).read_until(b'\n', &mut line)?;
        let text = String::from_utf8_lossy(&line);
        let cell = text.trim_end().split(',').next().and_then(|cell| cell.parse().ok());
        let time = cell.ok_or_else(|| invalid(&self.path, &text))?;
        Ok((time, start + line.len() as u64))
    }
}

/// A place is a byte of the file.
impl ReadHistory for HistoryFile {
    fn names(&self) -> &[String] {
        &self.names
    }

    fn count(&self) -> io::Result<u64> {
        let mut file = File::open(&self.path)?;
        file.seek(SeekFrom::Start(self.first))?;
        let mut bytes = BufReader::with_capacity(1 << 18, file.take(self.end - self.first));
        let mut count = 0;
        loop {
            let block = bytes.fill_buf()?;
            if block.is_empty() {
                return Ok(count);
            }
            count += block.iter().filter(|byte| **byte == b'\n').count() as u64;
            let read = block.len();
            bytes.consume(read);
        }
    }

    fn start(&self) -> u64 {
        self.first
    }

    fn last_time(&self) -> io::Result<Option<f64>> {
        if self.end == self.first {
            return Ok(None);
        }
        let mut file = File::open(&self.path)?;
        let start = self.line_start(&mut file, self.end - 1)?;
        self.time_at(&mut file, start).map(|(time, _)| Some(time))
    }

    fn place_of_time(&self, time: f64) -> io::Result<u64> {
        let mut file = File::open(&self.path)?;
        // Rows before `low` are earlier; the row at `high` is not.
        let (mut low, mut high) = (self.first, self.end);
        while low < high {
            let start = self.line_start(&mut file, low + (high - low) / 2)?;
            let (found, next) = self.time_at(&mut file, start)?;
            if found < time { low = next } else { high = start }
        }
        Ok(low)
    }

    fn scan(&self, from: u64, columns: &[&str], each: &mut dyn FnMut(&[f64])) -> io::Result<()> {
        self.rows(from, columns, usize::MAX, each)
    }

    fn first_row(
        &self,
        from: u64,
        columns: &[&str],
        each: &mut dyn FnMut(&[f64]),
    ) -> io::Result<()> {
        self.rows(from, columns, 1, each)
    }
}

fn invalid(path: &Path, what: &str) -> io::Error {
    let message = format!("`{}` is not a history file: {}", path.display(), what.trim_end());
    io::Error::new(io::ErrorKind::InvalidData, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(text: &str) -> (tempfile::TempDir, io::Result<HistoryFile>) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        std::fs::write(&path, text).unwrap();
        let history = HistoryFile::open(&path);
        (folder, history)
    }

    fn rows(history: &HistoryFile, from: u64, columns: &[&str]) -> Vec<Vec<f64>> {
        let mut rows = Vec::new();
        history.scan(from, columns, &mut |row| rows.push(row.to_vec())).unwrap();
        rows
    }

    #[test]
    fn a_torn_last_line_is_dropped() {
        let (_folder, history) = file("t_s,x,y\n1,2,3\n2,4,-5e-9\n3,4");
        let history = history.unwrap();
        assert_eq!(history.names, ["t_s", "x", "y"]);
        let all = rows(&history, history.start(), &["y", "t_s"]);
        assert_eq!(all, [[3.0, 1.0], [-5e-9, 2.0]]);
        assert_eq!(history.last_time().unwrap(), Some(2.0));
        assert_eq!(history.length(), 24);
    }

    #[test]
    fn rows_are_found_by_their_time() {
        for long in [1, 3000] {
            let cell = "7".repeat(long);
            let mut text = String::from("t_s,x\n");
            (1..=50).for_each(|i| text.push_str(&format!("{i},{cell}\n")));
            let (_folder, history) = file(&text);
            let history = history.unwrap();
            for (time, first) in [(-1.0, 1), (1.0, 1), (1.5, 2), (25.0, 25), (50.0, 50), (50.5, 51)]
            {
                let found = rows(&history, history.place_of_time(time).unwrap(), &["t_s"]);
                assert_eq!(found.len(), 51 - first, "{time}");
                assert!(found.first().is_none_or(|row| row[0] == first as f64), "{time}");
            }
        }
    }

    #[test]
    fn what_is_no_history_is_an_error() {
        assert!(file("").1.is_err());
        let (folder, history) = file("t_s,x\n1,2\n");
        assert!(history.unwrap().has_rows());
        let path = folder.path().join("history.csv");
        let names = |all: [&str; 2]| all.map(str::to_owned);
        assert!(HistoryFile::of_run(&path, &names(["t_s", "x"])).is_ok());
        assert!(HistoryFile::of_run(&path, &names(["t_s", "y"])).is_err());
        assert!(file("t_s,x").1.is_err());
        let (_folder, history) = file("t_s,x\n1,2\n1\n");
        let history = history.unwrap();
        let error = history.scan(history.start(), &["x"], &mut |_| {}).unwrap_err();
        assert!(error.to_string().contains("is not a history file"), "{error}");
        let (_folder, history) = file("t_s,x\n");
        let history = history.unwrap();
        assert_eq!(history.last_time().unwrap(), None);
        assert_eq!(history.place_of_time(0.0).unwrap(), history.length());
    }
}

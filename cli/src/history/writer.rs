//! Rows go to the file on a thread of their own, whole lines several times a second: a march waits for no disk.
//!
//! Checkpoints travel with the rows, so that one stands in its file only when the rows before it stand in theirs.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use whirl_solver::cache::RunningKey;

use super::groups::Groups;
use super::text;
use super::written::{Written, hash_of};
use crate::lock::is_at;

/// Longest time for which a row stands in memory only, but for the time that writing takes.
const PAUSE: Duration = Duration::from_millis(100);
/// Values that are written at once; twice as many may wait, then the march waits.
const BATCH: usize = 1 << 16;

/// Why rows are not written: what the operating system says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NotWritten(pub(crate) String);

/// A point from which the march can be resumed, made from what is written of the history up to it.
pub(crate) type Resumable = Box<dyn FnOnce(Written) -> io::Result<()> + Send>;

/// A history that is being written.
pub(crate) struct HistoryWriter {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    queue: Mutex<Queue>,
    /// There is something to be written at once.
    work: Condvar,
    /// There is space again.
    space: Condvar,
    /// Where rows go with all their digits, too.
    beside: Mutex<Option<Groups>>,
}

#[derive(Default)]
struct Queue {
    values: Vec<f64>,
    /// With the number of values that come before it.
    resumable: Option<(usize, Resumable)>,
    done: bool,
    failed: Option<NotWritten>,
    /// The first error of a resumable point; rows are worth more than it.
    checkpoint_error: Option<String>,
}

impl Shared {
    fn queue(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl HistoryWriter {
    /// Begins a history with these columns.
    ///
    /// # Errors
    /// The file cannot be made or written.
    pub(crate) fn create(path: &Path, names: &[String]) -> io::Result<HistoryWriter> {
        let mut lines = CsvLines::new(File::create(path)?, Some(path), RunningKey::default(), 0);
        lines.text.extend(text::head(names).into_bytes());
        lines.write()?;
        Ok(HistoryWriter::start(lines, names.len()))
    }

    /// Goes on after the first `length` bytes of a history with as many columns; what follows is dropped.
    ///
    /// # Errors
    /// The file cannot be opened, cut or written.
    pub(crate) fn go_on(path: &Path, length: u64, columns: usize) -> io::Result<HistoryWriter> {
        let mut file = File::options().read(true).write(true).open(path)?;
        let hash = hash_of(&mut file, length)?.ok_or(io::ErrorKind::UnexpectedEof)?;
        file.set_len(length)?;
        file.seek(SeekFrom::End(0))?;
        Ok(HistoryWriter::start(CsvLines::new(file, Some(path), hash, length), columns))
    }

    /// Before its first row: all go to these files, too, with all their digits.
    pub(crate) fn beside(self, groups: Groups) -> Self {
        *self.shared.beside.lock().unwrap_or_else(PoisonError::into_inner) = Some(groups);
        self
    }

    fn start(mut lines: CsvLines, columns: usize) -> HistoryWriter {
        let shared = Arc::<Shared>::default();
        let own = shared.clone();
        let thread = std::thread::spawn(move || {
            let served = catch_unwind(AssertUnwindSafe(|| lines.serve(&own, columns)));
            if served.is_err() {
                // Nobody waits for space that will not come.
                let reason = "the thread that writes the history has died".to_string();
                own.queue().failed = Some(NotWritten(reason));
                own.space.notify_one();
            }
        });
        HistoryWriter { shared, thread: Some(thread) }
    }

    /// Adds a row, one value a column.
    ///
    /// # Errors
    /// An earlier row could not be written.
    pub(crate) fn push(&mut self, row: &[f64]) -> Result<(), NotWritten> {
        let mut queue = self.shared.queue();
        queue.values.extend_from_slice(row);
        if queue.values.len() >= BATCH {
            self.shared.work.notify_one();
            let full =
                |queue: &mut Queue| queue.values.len() >= 2 * BATCH && queue.failed.is_none();
            let waited = self.shared.space.wait_while(queue, full);
            queue = waited.unwrap_or_else(PoisonError::into_inner);
        }
        queue.failed.clone().map_or(Ok(()), Err)
    }

    /// Makes a point to resume from once all rows so far are in the file, if no later one is there by then.
    pub(crate) fn keep(&mut self, resumable: Resumable) {
        let mut queue = self.shared.queue();
        queue.resumable = Some((queue.values.len(), resumable));
    }

    /// Writes what is left; the reason why a point to resume from could not be made, if there is one.
    ///
    /// # Errors
    /// Not all rows could be written. Those that are in the file are whole lines.
    pub(crate) fn finish(mut self) -> Result<Option<String>, NotWritten> {
        self.end();
        let mut queue = self.shared.queue();
        queue.failed.take().map_or(Ok(queue.checkpoint_error.take()), Err)
    }

    fn end(&mut self) {
        self.shared.queue().done = true;
        self.shared.work.notify_one();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl Drop for HistoryWriter {
    fn drop(&mut self) {
        self.end();
    }
}

/// The file, and the lines that are to be written next.
struct CsvLines {
    file: File,
    /// Where it is; none of what is no file of a folder.
    path: Option<PathBuf>,
    /// Of the whole lines in the file, and how many bytes these have.
    hash: RunningKey,
    length: u64,
    text: Vec<u8>,
}

impl CsvLines {
    fn new(file: File, path: Option<&Path>, hash: RunningKey, length: u64) -> CsvLines {
        CsvLines { file, path: path.map(Path::to_path_buf), hash, length, text: Vec::new() }
    }

    /// Nobody else has removed or changed the file.
    fn is_ours(&self) -> io::Result<()> {
        let Some(path) = &self.path else { return Ok(()) };
        if !is_at(&self.file, path) {
            return Err(io::Error::other("it was removed while the run wrote it"));
        }
        if self.file.metadata()?.len() != self.length {
            return Err(io::Error::other("another program changed it while the run wrote it"));
        }
        Ok(())
    }

    fn serve(&mut self, shared: &Shared, columns: usize) {
        let mut values = Vec::new();
        loop {
            let idle = |queue: &mut Queue| !queue.done && queue.values.len() < BATCH;
            let waited = shared.work.wait_timeout_while(shared.queue(), PAUSE, idle);
            let (mut queue, _) = waited.unwrap_or_else(PoisonError::into_inner);
            std::mem::swap(&mut values, &mut queue.values);
            let (resumable, done) = (queue.resumable.take(), queue.done);
            drop(queue);
            shared.space.notify_one();

            let mut beside = shared.beside.lock().unwrap_or_else(PoisonError::into_inner);
            let before = resumable.as_ref().map_or(0, |(before, _)| *before);
            let mut written = self.both(&values[..before], (columns, &mut beside));
            if let (Ok(()), Some((_, make))) = (&written, resumable) {
                let synced = beside.as_ref().map_or(Ok(()), Groups::sync);
                let made = synced.and_then(|()| self.make_point(make));
                let checkpoint_error = made.err().map(|error| error.to_string());
                let mut queue = shared.queue();
                queue.checkpoint_error = queue.checkpoint_error.take().or(checkpoint_error);
            }
            written = written.and_then(|()| self.both(&values[before..], (columns, &mut beside)));
            drop(beside);
            values.clear();
            if let Err(error) = written {
                shared.queue().failed = Some(NotWritten(error.to_string()));
                shared.space.notify_one();
                return;
            }
            if done {
                return;
            }
        }
    }

    fn both(
        &mut self,
        values: &[f64],
        (columns, beside): (usize, &mut Option<Groups>),
    ) -> io::Result<()> {
        self.rows(values, columns)?;
        beside.as_mut().map_or(Ok(()), |beside| beside.add(values))
    }

    fn rows(&mut self, values: &[f64], columns: usize) -> io::Result<()> {
        values.chunks_exact(columns).for_each(|row| text::line(&mut self.text, row));
        self.write()
    }

    /// A point to resume from is as good as the rows before it.
    fn make_point(&self, make: Resumable) -> io::Result<()> {
        self.file.sync_data()?;
        make(Written { length: self.length, hash: self.hash.key() })
    }

    /// Writes the text; if not all of it fits, as many whole lines as do.
    fn write(&mut self) -> io::Result<()> {
        let mut written = 0;
        let mut result = self.is_ours();
        while result.is_ok() && written < self.text.len() {
            result = match self.file.write(&self.text[written..]) {
                Ok(0) => Err(io::ErrorKind::WriteZero.into()),
                Ok(count) => {
                    written += count;
                    Ok(())
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => Ok(()),
                Err(error) => Err(error),
            };
        }
        let whole = self.text[..written].iter().rposition(|byte| *byte == b'\n');
        let whole = whole.map_or(0, |end| end + 1);
        self.length += whole as u64;
        self.hash.add(&self.text[..whole]);
        self.text.clear();
        if written > whole {
            // Who reads the file drops a torn line, too.
            let _ = self.file.set_len(self.length);
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use super::super::kept_rows::KeptRows;
    use super::*;

    fn names() -> Vec<String> {
        ["t_s", "x"].map(String::from).to_vec()
    }

    fn wait_for(path: &Path, text: &str) {
        let patience = std::time::Instant::now();
        while std::fs::read_to_string(path).unwrap() != text {
            assert!(
                patience.elapsed() < Duration::from_secs(20),
                "rows are not written by themselves"
            );
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    #[test]
    fn rows_reach_the_file_without_being_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let mut writer = HistoryWriter::create(&path, &names()).unwrap();
        writer.push(&[1.0, 2.0]).unwrap();
        wait_for(&path, "t_s,x\n1,2\n");
        writer.push(&[2.0, 3.5]).unwrap();
        wait_for(&path, "t_s,x\n1,2\n2,3.5\n");
        assert_eq!(writer.finish(), Ok(None));
    }

    #[test]
    fn points_to_resume_from_know_the_length_of_the_rows_before_them() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let mut writer = HistoryWriter::create(&path, &names()).unwrap();
        let length = Arc::new(AtomicU64::new(0));
        let point = || -> Resumable {
            let (own, at) = (length.clone(), path.clone());
            Box::new(move |written| {
                own.store(written.length, Ordering::Relaxed);
                assert!(written.begins(&at)?);
                Ok(())
            })
        };
        writer.push(&[1.0, 2.0]).unwrap();
        writer.keep(point());
        (2..60_000).try_for_each(|i| writer.push(&[f64::from(i), 0.0])).unwrap();
        assert_eq!(writer.finish(), Ok(None));
        let whole = std::fs::read_to_string(&path).unwrap();
        assert_eq!(whole.lines().count(), 60_000);
        let length = length.load(Ordering::Relaxed);
        assert_eq!(&whole[..length as usize], "t_s,x\n1,2\n");

        let mut writer = HistoryWriter::go_on(&path, length, 2).unwrap();
        writer.push(&[7.0, 8.0]).unwrap();
        writer.keep(Box::new(|_| Err(io::Error::other("no space"))));
        assert_eq!(writer.finish(), Ok(Some("no space".to_string())));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "t_s,x\n1,2\n7,8\n");
    }

    /// What is done to the file while it is written, and what is said of it.
    #[test]
    fn a_file_that_others_remove_or_change_stops_the_march() {
        let cases: [(fn(&Path), &str); 3] = [
            (|path| std::fs::remove_file(path).unwrap(), "removed"),
            (|path| drop(File::create(path).unwrap()), "changed"),
            (
                |path| {
                    let mut file = File::options().append(true).open(path).unwrap();
                    file.write_all(b"x").unwrap();
                },
                "changed",
            ),
        ];
        for (harm, said) in cases {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("history.csv");
            let mut writer = HistoryWriter::create(&path, &names()).unwrap();
            writer.push(&[1.0, 2.0]).unwrap();
            wait_for(&path, "t_s,x\n1,2\n");
            harm(&path);
            // The last rows are noticed, too.
            let _ = writer.push(&[2.0, 3.0]);
            let error = writer.finish().expect_err("it is noticed");
            assert!(error.0.contains(said), "{error:?}");
        }
    }

    #[test]
    fn rows_agree_with_the_lines_of_their_history_only() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let names = ["t_s", "x", "y"].map(str::to_owned).to_vec();
        let path = folder.join("history.csv");
        let count = 8195_u32;
        let groups = Groups::create(folder, 3).unwrap();
        let mut writer = HistoryWriter::create(&path, &names).unwrap().beside(groups);
        for k in 0..count {
            let k = f64::from(k);
            writer.push(&[k / 3.0, k.sin() * 1e-5, -0.0]).unwrap();
        }
        writer.finish().unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let kept = KeptRows::open(folder, 3).unwrap();
        let agree = |text: &str| {
            std::fs::write(&path, text).unwrap();
            kept.agree(&path, text.len() as u64).unwrap()
        };
        assert_eq!(agree(&text), Some(u64::from(count)));
        let half: usize = text.split_inclusive('\n').take(1001).map(str::len).sum();
        assert_eq!(agree(&text[..half]), Some(1000));
        assert_eq!(agree("t_s,x,y\n"), Some(0));
        assert_eq!(agree(&format!("{text}1,2,3\n")), None);
        assert_eq!(agree(&text.replacen("\n0.3333333333,", "\n0.3333333334,", 1)), None);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_stops_the_march() {
        let file = File::options().write(true).open("/dev/full").unwrap();
        let lines = CsvLines::new(file, None, RunningKey::default(), 0);
        let mut writer = HistoryWriter::start(lines, 2);
        let patience = std::time::Instant::now();
        let error = loop {
            assert!(patience.elapsed() < Duration::from_secs(20), "the error is noticed");
            if let Err(error) = writer.push(&[1.0, 2.0]) {
                break error;
            }
        };
        assert!(error.0.contains("space"), "{error:?}");
        assert_eq!(writer.finish(), Err(error));
    }
}

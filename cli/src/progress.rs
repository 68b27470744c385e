//! Progress on stderr: a bar with the time left on a terminal, elsewhere a line now and then.

use std::cell::RefCell;
use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::signals::Interruption;
use crate::streams::{note, warn};
use crate::watch::Watch;

/// How progress is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ProgressMode {
    /// A bar that moves.
    Bar,
    /// A line now and then.
    Lines,
    /// Nothing.
    Nothing,
}

impl ProgressMode {
    /// As fits what stderr is.
    pub(crate) fn fitting(quiet: bool) -> ProgressMode {
        match (quiet, std::io::stderr().is_terminal()) {
            (true, _) => ProgressMode::Nothing,
            (false, true) => ProgressMode::Bar,
            (false, false) => ProgressMode::Lines,
        }
    }

    /// On a terminal only, for what is short.
    pub(crate) fn on_terminal() -> ProgressMode {
        match ProgressMode::fitting(false) {
            ProgressMode::Bar => ProgressMode::Bar,
            _ => ProgressMode::Nothing,
        }
    }

    /// A note on its own line.
    pub(crate) fn note(self, words: &str) {
        if self != ProgressMode::Nothing {
            note(words);
        }
    }
}

/// Says `what` is being done while `work` is.
pub(crate) fn during<T>(show: ProgressMode, what: &'static str, work: impl FnOnce() -> T) -> T {
    let bar = (show == ProgressMode::Bar).then(|| {
        let bar = ProgressBar::new_spinner().with_message(what);
        bar.enable_steady_tick(Duration::from_millis(100));
        bar
    });
    let say = move |elapsed: Duration| format!("{what}: {}", words(elapsed));
    let lines = (show == ProgressMode::Lines).then(|| ProgressLines::start(say));
    let made = work();
    drop(lines);
    bar.iter().for_each(ProgressBar::finish_and_clear);
    made
}

/// Progress of time steps.
struct Steps {
    bar: Option<ProgressBar>,
    /// Kept while lines are shown.
    _lines: Option<ProgressLines>,
    now: Arc<CurrentStep>,
    /// When the bar moves next.
    due: RefCell<RateLimit>,
}

/// Something that happens at most ten times a second: a step may take less time than formatting the words beside a
/// bar, or a minute.
#[derive(Default)]
struct RateLimit {
    last: Option<Instant>,
}

impl RateLimit {
    const PAUSE: Duration = Duration::from_millis(100);

    /// Whether it is time again at `now`.
    fn at(&mut self, now: Instant) -> bool {
        let due = self.last.is_none_or(|last| now.duration_since(last) >= RateLimit::PAUSE);
        if due {
            self.last = Some(now);
        }
        due
    }
}

/// Where a march is, for the thread that shows it.
#[derive(Default)]
struct CurrentStep {
    step: AtomicUsize,
    /// Bits of the time (s).
    time: AtomicU64,
}

/// Progress of `steps` time steps, of which `first` are done.
fn steps(show: ProgressMode, steps: usize, first: usize) -> Steps {
    let now = Arc::<CurrentStep>::default();
    let bar = (show == ProgressMode::Bar).then(|| {
        let bar = ProgressBar::new(steps as u64).with_position(first as u64);
        let words = "{wide_bar} {pos}/{len} steps, {per_sec}, {eta} left; {msg}";
        match ProgressStyle::with_template(words) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        }
    });
    let lines = (show == ProgressMode::Lines).then(|| {
        let now = now.clone();
        ProgressLines::start(move |elapsed| {
            let step = now.step.load(Ordering::Relaxed);
            let time = f64::from_bits(now.time.load(Ordering::Relaxed));
            line((step, steps, first), time, elapsed)
        })
    });
    Steps { bar, _lines: lines, now, due: RefCell::default() }
}

impl Steps {
    /// `step` steps are done, up to `time` s.
    fn done(&self, step: usize, time: f64) {
        self.now.step.store(step, Ordering::Relaxed);
        self.now.time.store(time.to_bits(), Ordering::Relaxed);
        let Some(bar) = &self.bar else { return };
        if self.due.borrow_mut().at(Instant::now()) {
            bar.set_position(step as u64);
            bar.set_message(format!("t = {:.1} ms", 1e3 * time));
        }
    }

    /// Takes the bar away.
    fn clear(self) {
        self.bar.iter().for_each(ProgressBar::finish_and_clear);
    }
}

/// Progress of the points of a sweep, which several workers run at a time.
pub(crate) struct PointsShown {
    bar: Option<ProgressBar>,
    lines: Option<ProgressLines>,
    now: Arc<Points>,
}

/// Where a sweep is, for the threads that work on it and the one that shows it.
struct Points {
    all: usize,
    /// Those that were done before.
    first: usize,
    done: AtomicUsize,
    /// Of these, failed or not sound.
    bad: AtomicUsize,
    /// Of every worker: steps of its point, and those that are done.
    workers: Vec<[AtomicUsize; 2]>,
    start: Instant,
}

impl Points {
    /// Points that are done since the start, those under way by their steps.
    fn worth(&self) -> f64 {
        let parts = self.workers.iter().map(|[all, done]| {
            let [all, done] = [all, done].map(|own| own.load(Ordering::Relaxed) as f64);
            if all > 0.0 { (done / all).min(1.0) } else { 0.0 }
        });
        (self.done.load(Ordering::Relaxed) - self.first) as f64 + parts.sum::<f64>()
    }

    /// The time that is left if points take as long as those before.
    fn left(&self) -> Option<Duration> {
        let worth = self.worth();
        let rest = (self.all - self.first) as f64 - worth;
        (worth > 0.0).then_some(())?;
        Duration::try_from_secs_f64(self.start.elapsed().as_secs_f64() / worth * rest.max(0.0)).ok()
    }

    fn words(&self) -> String {
        let [done, bad] = [&self.done, &self.bad].map(|own| own.load(Ordering::Relaxed));
        let bad =
            if bad > 0 { format!(", {bad} of them failed or not sound") } else { String::new() };
        let left =
            self.left().map_or(String::new(), |left| format!(", about {} left", words(left)));
        format!("{done} of {} points{bad}{left}", self.all)
    }
}

impl PointsShown {
    /// Of `all` points, of which `first` are done, by so many workers.
    pub(crate) fn new(show: ProgressMode, all: usize, first: usize, workers: usize) -> Self {
        let workers = (0..workers).map(|_| Default::default()).collect();
        let (done, bad, start) = (AtomicUsize::new(first), AtomicUsize::default(), Instant::now());
        let now = Arc::new(Points { all, first, done, bad, workers, start });
        let bar = (show == ProgressMode::Bar).then(|| {
            let bar = ProgressBar::new(all as u64).with_position(first as u64);
            match ProgressStyle::with_template("{wide_bar} {msg}") {
                Ok(style) => bar.with_style(style),
                Err(_) => bar,
            }
        });
        let lines = (show == ProgressMode::Lines).then(|| {
            let now = now.clone();
            ProgressLines::start(move |_| now.words())
        });
        PointsShown { bar, lines, now }
    }

    /// A worker begins a point.
    pub(crate) fn begun(&self, worker: usize) {
        self.now.workers[worker].iter().for_each(|own| own.store(0, Ordering::Relaxed));
    }

    /// Its point has so many steps.
    pub(crate) fn steps(&self, worker: usize, steps: usize) {
        self.now.workers[worker][0].store(steps, Ordering::Relaxed);
    }

    /// So many of them are done.
    pub(crate) fn step(&self, worker: usize, step: usize) {
        self.now.workers[worker][1].store(step, Ordering::Relaxed);
    }

    /// A point is done and on disk; `bad`: failed, or not sound.
    pub(crate) fn done(&self, bad: bool) {
        self.now.done.fetch_add(1, Ordering::Relaxed);
        self.now.bad.fetch_add(usize::from(bad), Ordering::Relaxed);
    }

    /// Moves the bar.
    pub(crate) fn update(&self) {
        let Some(bar) = &self.bar else { return };
        bar.set_position(self.now.done.load(Ordering::Relaxed) as u64);
        bar.set_message(self.now.words());
    }

    /// Takes the bar away.
    pub(crate) fn end(mut self) {
        self.lines = None;
        self.bar.iter().for_each(ProgressBar::finish_and_clear);
    }
}

/// Shows a run on stderr, and hears Ctrl-C for it.
pub(crate) struct Terminal<'i> {
    show: ProgressMode,
    interruption: &'i Interruption,
    steps: RefCell<Option<Steps>>,
}

impl<'i> Terminal<'i> {
    /// Before the run.
    pub(crate) fn new(show: ProgressMode, interruption: &'i Interruption) -> Self {
        Terminal { show, interruption, steps: RefCell::default() }
    }
}

impl Watch for Terminal<'_> {
    fn begun(&self, all: usize, first: usize) {
        *self.steps.borrow_mut() = Some(steps(self.show, all, first));
    }

    fn progressed(&self, step: usize, time: f64) {
        if let Some(shown) = &*self.steps.borrow() {
            shown.done(step, time);
        }
    }

    fn ended(&self) {
        if let Some(shown) = self.steps.take() {
            shown.clear();
        }
    }

    fn asked(&self) -> bool {
        self.interruption.asked()
    }

    fn note(&self, words: &str) {
        self.show.note(words);
    }

    fn warn(&self, words: &str) {
        warn(words);
    }
}

fn line((step, steps, first): (usize, usize, usize), time: f64, elapsed: Duration) -> String {
    let share = 100.0 * step as f64 / steps.max(1) as f64;
    let left = match step.saturating_sub(first) {
        0 => String::new(),
        done => {
            let each = elapsed.as_secs_f64() / done as f64;
            let left = Duration::try_from_secs_f64(each * steps.saturating_sub(step) as f64);
            left.map_or(String::new(), |left| format!(", about {} left", words(left)))
        }
    };
    format!("step {step} of {steps} ({share:.1} %), t = {time:.6} s{left}")
}

/// A duration as people say it.
pub(crate) fn words(duration: Duration) -> String {
    match duration.as_secs() {
        seconds @ 0..60 => format!("{seconds} s"),
        seconds @ 60..3600 => format!("{} min {} s", seconds / 60, seconds % 60),
        seconds => format!("{} h {} min", seconds / 3600, seconds % 3600 / 60),
    }
}

/// Lines on stderr from a thread of their own, until they are dropped: the first after a second, then after ever
/// longer pauses, up to a minute.
struct ProgressLines {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl ProgressLines {
    fn start(say: impl Fn(Duration) -> String + Send + 'static) -> ProgressLines {
        let (stop, stopped) = channel();
        let start = Instant::now();
        let thread = std::thread::spawn(move || {
            let mut pause = Duration::from_secs(1);
            while let Err(RecvTimeoutError::Timeout) = stopped.recv_timeout(pause) {
                note(say(start.elapsed()));
                pause = (start.elapsed() / 2).clamp(pause, Duration::from_secs(60));
            }
        });
        ProgressLines { stop: Some(stop), thread: Some(thread) }
    }
}

impl Drop for ProgressLines {
    fn drop(&mut self) {
        self.stop = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slow steps are shown one by one, quick ones ten times a second.
    #[test]
    fn a_bar_moves_by_the_clock_and_not_by_the_number_of_steps() {
        let start = Instant::now();
        let shown = |steps: u32, each: Duration| {
            let mut due = RateLimit::default();
            (0..steps).filter(|step| due.at(start + *step * each)).count()
        };
        assert_eq!(shown(60, Duration::from_secs(1)), 60);
        assert_eq!(shown(20_000, Duration::from_micros(100)), 20);
    }

    #[test]
    fn lines_say_how_far_and_how_long() {
        let text = line((3_000, 12_000, 1_000), 0.25, Duration::from_secs(20));
        assert_eq!(text, "step 3000 of 12000 (25.0 %), t = 0.250000 s, about 1 min 30 s left");
        let none = line((1_000, 12_000, 1_000), 0.0, Duration::from_secs(20));
        assert_eq!(none, "step 1000 of 12000 (8.3 %), t = 0.000000 s");
        assert_eq!(words(Duration::from_secs(7300)), "2 h 1 min");
    }
}

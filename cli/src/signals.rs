//! Ctrl-C and SIGTERM ask a run to end after its step; a second one ends it at once.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::Builder;
use std::time::{Duration, Instant};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;

/// Whether the user wants the run to end.
pub(crate) struct Interruption {
    asked: Arc<AtomicBool>,
    /// Whether something else is to end, too.
    beside: Option<Arc<AtomicBool>>,
}

/// What is sent to a process and once more to its group, as `timeout` does, is one signal.
const AT_ONCE: Duration = Duration::from_millis(200);

impl Interruption {
    /// Installs the handlers.
    ///
    /// # Errors
    /// The operating system refuses.
    pub(crate) fn install() -> io::Result<Interruption> {
        let asked = Arc::<AtomicBool>::default();
        let mut signals = Signals::new([SIGINT, SIGTERM])?;
        #[cfg(unix)]
        {
            // A limit on the size of files then shows as an error of the write, not as the end of the process.
            signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default())?;
        }
        let seen = asked.clone();
        let listen = move || {
            let mut first: Option<Instant> = None;
            for signal in signals.forever() {
                if first.is_some_and(|first| first.elapsed() > AT_ONCE) {
                    // It does not come back.
                    let _ = emulate_default_handler(signal);
                }
                first.get_or_insert_with(Instant::now);
                seen.store(true, Ordering::Relaxed);
            }
        };
        Builder::new().name("signals".to_owned()).spawn(listen)?;
        Ok(Interruption { asked, beside: None })
    }

    /// Of a program that listens to signals itself, and says by a flag that the work is to end.
    pub(crate) fn by(flag: Arc<AtomicBool>) -> Interruption {
        Interruption { asked: flag, beside: None }
    }

    /// One that also comes by a flag.
    pub(crate) fn or_by(&self, flag: Arc<AtomicBool>) -> Interruption {
        Interruption { asked: self.asked.clone(), beside: Some(flag) }
    }

    /// Whether a signal has come.
    pub(crate) fn asked(&self) -> bool {
        let is_set = |flag: &Arc<AtomicBool>| flag.load(Ordering::Relaxed);
        is_set(&self.asked) || self.beside.as_ref().is_some_and(is_set)
    }
}

//! Linear analyses, with an ear for Ctrl-C while they are at work.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use whirl_cli::Described;

/// What an analysis comes to.
#[pyclass(frozen, get_all, module = "whirl._whirl")]
pub(crate) struct Analysed {
    name: String,
    kind: &'static str,
    /// What the command prints.
    text: String,
    /// Tables and matrices by the names of their files.
    files: Vec<(String, Py<PyBytes>)>,
    notes: Vec<String>,
    warnings: Vec<String>,
}

impl Analysed {
    pub(crate) fn new(py: Python<'_>, own: whirl_cli::Analysed, warnings: Vec<String>) -> Self {
        let whirl_cli::Analysed { name, kind, text, files, notes } = own;
        let bytes = |(name, bytes): (String, Vec<u8>)| (name, PyBytes::new(py, &bytes).unbind());
        Analysed {
            name,
            kind,
            text,
            files: files.into_iter().map(bytes).collect(),
            notes,
            warnings,
        }
    }
}

/// What Python says of an analysis that no table of the case describes: kind, body, speeds, ratios, count, orders, stiffness.
pub(crate) type Wanted = (
    String,
    Option<String>,
    Vec<String>,
    Vec<(String, f64)>,
    Option<usize>,
    Vec<f64>,
    Option<String>,
);

/// The same as the command takes it.
pub(crate) fn described(wanted: Wanted) -> Described {
    let (kind, of, speeds, ratios, count, orders, stiffness) = wanted;
    Described { kind, of, speeds, ratios, count, orders, stiffness }
}

/// Between looks for a signal.
const PAUSE: Duration = Duration::from_millis(50);

/// Works on a thread of its own, the interpreter's lock released, until it is done or a signal raises something: the flag that
/// `work` has then asks it to end.
pub(crate) fn heard<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(Arc<AtomicBool>) -> T + Send,
) -> PyResult<T> {
    let ends = Arc::<AtomicBool>::default();
    py.detach(|| {
        thread::scope(|scope| {
            let (sender, receiver) = channel();
            let flag = ends.clone();
            scope.spawn(move || sender.send(work(flag)));
            loop {
                match receiver.recv_timeout(PAUSE) {
                    Ok(made) => return Ok(made),
                    Err(RecvTimeoutError::Timeout) => {
                        if let Err(error) = Python::attach(|py| py.check_signals()) {
                            ends.store(true, Ordering::Relaxed);
                            return Err(error);
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(PyRuntimeError::new_err("an analysis has broken down"));
                    }
                }
            }
        })
    })
}

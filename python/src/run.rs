//! A run, watched from Python.

use std::cell::{Cell, RefCell};
use std::time::{Duration, Instant};

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use whirl_cli::simulate::{InMemory, Watch, in_memory};
use whirl_cli::{Built, Case};

use crate::errors::raised;

/// What a run leaves.
#[pyclass(frozen, get_all, module = "whirl._whirl")]
pub(crate) struct Run {
    /// Rows × columns.
    values: Py<PyArray2<f64>>,
    columns: Vec<(String, String, String)>,
    /// JSON.
    summary: String,
    /// Whether it came to a steady state, in words.
    steady: String,
    /// state.bin, of a run that came to its end.
    state: Option<Py<PyBytes>>,
    /// Why it has ended early, if it has.
    reason: Option<String>,
    warnings: Vec<String>,
    notes: Vec<String>,
    /// What the callback or a signal has raised.
    error: Option<Py<PyAny>>,
}

/// Runs a case that is built.
pub(crate) fn run(
    py: Python<'_>,
    (case, built): (&Case, &Built),
    mut warnings: Vec<String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Run> {
    let (ended, error) = py.detach(|| {
        let listener = Listener::new(progress);
        let ended = in_memory(case, built, &listener);
        (ended, listener.error.into_inner())
    });
    let error = match error {
        Some(error) if ended.is_err() => return Err(error),
        error => error.map(|error| error.into_value(py).into_any()),
    };
    let InMemory { history, summary, steady, state, reason, warnings: found, notes, .. } =
        ended.map_err(|failure| raised(py, &failure))?;
    warnings.extend(found);
    let shape = [history.rows(), history.names().len()];
    let values = PyArray1::from_vec(py, history.into_values()).reshape(shape)?.unbind();
    let columns =
        built.columns().into_iter().map(|own| (own.name, own.unit.into_owned(), own.meaning));
    let state = state.map(|state| PyBytes::new(py, &state).unbind());
    Ok(Run {
        values,
        columns: columns.collect(),
        summary,
        steady,
        state,
        reason,
        warnings,
        notes,
        error,
    })
}

/// Between calls of Python: a step may take less time than one.
const PAUSE: Duration = Duration::from_millis(50);

/// Asks Python now and then whether the run is to go on.
struct Listener {
    progress: Option<Py<PyAny>>,
    steps: Cell<usize>,
    now: Cell<(usize, f64)>,
    asked: Cell<Instant>,
    error: RefCell<Option<PyErr>>,
}

impl Listener {
    fn new(progress: Option<Py<PyAny>>) -> Self {
        let asked = Cell::new(Instant::now());
        let (steps, now) = (Cell::default(), Cell::default());
        Listener { progress, steps, now, asked, error: RefCell::default() }
    }

    /// Calls Python; keeps what it raises.
    fn call(&self) {
        let (step, time) = self.now.get();
        let called = Python::attach(|py| {
            py.check_signals()?;
            if let Some(progress) = &self.progress {
                progress.call1(py, (step, self.steps.get(), time))?;
            }
            Ok(())
        });
        if let Err(error) = called {
            self.error.borrow_mut().get_or_insert(error);
        }
    }
}

impl Watch for Listener {
    fn begun(&self, steps: usize, _: usize) {
        self.steps.set(steps);
    }

    fn progressed(&self, step: usize, time: f64) {
        self.now.set((step, time));
        let now = Instant::now();
        if now.duration_since(self.asked.get()) >= PAUSE {
            self.call();
            self.asked.set(Instant::now());
        }
    }

    /// The last step is always told of.
    fn ended(&self) {
        if self.error.borrow().is_none() {
            self.call();
        }
    }

    fn asked(&self) -> bool {
        self.error.borrow().is_some()
    }
}

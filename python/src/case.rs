//! A case, and its machine once that is needed.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use whirl_cli::errors::Failure;
use whirl_cli::{
    Asked, Built, CaseText, build, check_case, page_facts, read, read_text, read_text_to_analyse,
    read_to_analyse,
};
use whirl_solver::history::Column;
use whirl_solver::linear::LinearMachine;

use crate::bodies::Bodies;
use crate::errors::raised;
use crate::linear::{Analysed, Wanted, described, heard};
use crate::run::{self, Run};

/// A case that was read.
#[pyclass(frozen, module = "whirl._whirl")]
pub(crate) struct Case {
    case: whirl_cli::Case,
    /// Its text; none of one that is built in.
    text: Option<CaseText>,
    /// What the reader warned of.
    #[pyo3(get)]
    warnings: Vec<String>,
    /// Its machine, and what there was to warn of; made once, while others wait.
    built: Mutex<Option<(Arc<Built>, Vec<String>)>>,
    /// The same as linear analyses take it.
    linear: Mutex<Option<Arc<LinearMachine>>>,
}

/// What it takes to read a case elsewhere: its path, its text, the files beside it by path, and values in place of those that
/// they say.
type State = (PathBuf, String, BTreeMap<PathBuf, String>, String);

#[pymethods]
impl Case {
    /// A built-in case.
    #[staticmethod]
    fn built_in(py: Python<'_>, name: &str) -> PyResult<Self> {
        Case::made(py, None, |warnings, _| read_to_analyse(name, warnings))
    }

    /// A file.
    #[staticmethod]
    fn of_file(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let text = CaseText::of_file(&path).map_err(|errors| raised(py, &errors.into()))?;
        Case::made(py, Some(text), |warnings, text| {
            read_text_to_analyse(text.expect("it was given"), warnings)
        })
    }

    /// A text that would stand at a path, with others beside it, and with values in place of theirs.
    #[staticmethod]
    #[pyo3(signature = (path, text, files, values=String::new()))]
    fn of_text(
        py: Python<'_>,
        path: PathBuf,
        text: String,
        files: BTreeMap<PathBuf, String>,
        values: String,
    ) -> PyResult<Self> {
        let mut own = CaseText::at(&path, text).with_values(values);
        for (path, text) in files {
            own = own.with_path(path, text);
        }
        Case::made(py, Some(own), |warnings, text| {
            read_text_to_analyse(text.expect("it was given"), warnings)
        })
    }

    #[getter]
    fn name(&self) -> &str {
        self.case.name()
    }

    #[getter]
    fn title(&self) -> &str {
        self.case.title()
    }

    #[getter]
    fn steps(&self) -> usize {
        self.case.steps()
    }

    #[getter]
    fn rows(&self) -> usize {
        self.case.rows()
    }

    #[getter]
    fn supports(&self) -> Vec<String> {
        self.case.support_names()
    }

    /// Under which its bodies are kept: the same for cases that share them. Nothing is reduced.
    fn body_keys(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let keys = py.detach(|| whirl_cli::body_keys(&self.case));
        let keys = keys.map_err(|failure| raised(py, &failure))?;
        Ok(keys.iter().map(|key| key.hex()).collect())
    }

    /// What it takes to read it elsewhere; none of a built-in case.
    fn state(&self) -> Option<State> {
        let text = self.text.as_ref()?;
        Some((
            text.path().to_path_buf(),
            text.text().to_owned(),
            text.files(),
            text.values().to_owned(),
        ))
    }

    /// As `state`, of a built-in case, too.
    fn parts(&self) -> State {
        self.state().unwrap_or_else(|| {
            let mut files = self.case.files();
            let (path, text) = files.next().expect("a case is a file");
            let others = files.map(|(path, text)| (path.to_path_buf(), text.to_owned()));
            (path.to_path_buf(), text.to_owned(), others.collect(), String::new())
        })
    }

    /// Report of `whirl check`, and warnings.
    fn check(&self, py: Python<'_>, bodies: &Bodies) -> PyResult<(String, Vec<String>)> {
        let mut warnings = Vec::new();
        let report = py.detach(|| check_case(&self.case, Some(&bodies.cache), &mut warnings));
        Ok((report.map_err(|failure| raised(py, &failure))?, warnings))
    }

    /// Reduces its bodies and builds its machine; warnings.
    fn build(&self, py: Python<'_>, bodies: &Bodies) -> PyResult<Vec<String>> {
        py.detach(|| self.machine(bodies)).map(|own| own.1).map_err(|failure| raised(py, &failure))
    }

    /// Frees its machine, which is built anew where it is needed again.
    fn release(&self, py: Python<'_>) {
        py.detach(|| {
            *self.built.lock().unwrap_or_else(PoisonError::into_inner) = None;
            *self.linear.lock().unwrap_or_else(PoisonError::into_inner) = None;
        });
    }

    /// Name, unit and meaning of every column of the history.
    fn columns(&self, py: Python<'_>, bodies: &Bodies) -> PyResult<Vec<(String, String, String)>> {
        let built = py.detach(|| self.machine(bodies)).map_err(|failure| raised(py, &failure))?.0;
        let described = |Column { name, unit, meaning }| (name, unit.into_owned(), meaning);
        Ok(built.columns().into_iter().map(described).collect())
    }

    /// Whether it can be run.
    ///
    /// # Errors
    /// What it lacks for that, as of a reader that demands it.
    fn demand_march(&self, py: Python<'_>) -> PyResult<()> {
        if self.case.is_marched() {
            return Ok(());
        }
        let read = || match &self.text {
            Some(text) => read_text(text, &mut Vec::new()),
            None => read(self.case.name(), &mut Vec::new()),
        };
        // One with analyses alone is refused where it is run.
        py.detach(read).map(|_| ()).map_err(|failure| raised(py, &failure))
    }

    /// Does the analysis of a table, by its name, or one that is described.
    #[pyo3(signature = (bodies, name=None, wanted=None))]
    fn analyse(
        &self,
        py: Python<'_>,
        bodies: &Bodies,
        name: Option<String>,
        wanted: Option<Wanted>,
    ) -> PyResult<Analysed> {
        let wanted = wanted.map(described).unwrap_or_default();
        let asked = match &name {
            Some(name) => Asked::Named(name),
            None => Asked::Described(&wanted),
        };
        let work = |ends: Arc<AtomicBool>| {
            let mut warnings = Vec::new();
            let linear = || self.linear_machine(bodies);
            let of = (&self.case, self.text.as_ref());
            let found = asked.found(of, &linear, (Some(&bodies.cache), ends), &mut warnings)?;
            let built = self.built.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some((_, own)) = &*built {
                warnings.extend(
                    own.iter().filter(|own| !warnings.contains(own)).cloned().collect::<Vec<_>>(),
                );
            }
            Ok((found, warnings))
        };
        let found: Result<_, Failure> = heard(py, work)?;
        let (found, warnings) = found.map_err(|failure| raised(py, &failure))?;
        Ok(Analysed::new(py, found, warnings))
    }

    /// about.json and shapes.json of a run of it that came to a steady state or not, in words.
    fn page_facts(
        &self,
        py: Python<'_>,
        bodies: &Bodies,
        steady: String,
    ) -> PyResult<(String, Option<String>)> {
        let made = py.detach(|| {
            let (built, _) = self.machine(bodies)?;
            page_facts(&self.case, &built, steady)
        });
        made.map_err(|failure| raised(py, &failure))
    }

    /// Runs it. `progress(step, steps, time)` is called a few times a second.
    #[pyo3(signature = (bodies, progress=None))]
    fn run(&self, py: Python<'_>, bodies: &Bodies, progress: Option<Py<PyAny>>) -> PyResult<Run> {
        self.demand_march(py)?;
        let (built, warnings) =
            py.detach(|| self.machine(bodies)).map_err(|failure| raised(py, &failure))?;
        run::run(py, (&self.case, &built), warnings, progress)
    }
}

impl Case {
    fn made(
        py: Python<'_>,
        text: Option<CaseText>,
        read: impl FnOnce(&mut Vec<String>, Option<&CaseText>) -> Result<whirl_cli::Case, Failure>
        + Send,
    ) -> PyResult<Self> {
        let mut warnings = Vec::new();
        let case = py.detach(|| read(&mut warnings, text.as_ref()));
        let case = case.map_err(|failure| raised(py, &failure))?;
        let (built, linear) = (Mutex::default(), Mutex::default());
        Ok(Case { case, text, warnings, built, linear })
    }

    fn linear_machine(&self, bodies: &Bodies) -> Result<Arc<LinearMachine>, Failure> {
        let (built, _) = self.machine(bodies)?;
        let mut linear = self.linear.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = &*linear {
            return Ok(own.clone());
        }
        let made = LinearMachine::new(built.machine().clone())?;
        Ok(linear.insert(Arc::new(made)).clone())
    }

    fn machine(&self, bodies: &Bodies) -> Result<(Arc<Built>, Vec<String>), Failure> {
        let mut built = self.built.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = &*built {
            return Ok(own.clone());
        }
        let mut warnings = Vec::new();
        let made = build(&self.case, Some(&bodies.cache), &mut warnings)?;
        Ok(built.insert((Arc::new(made), warnings)).clone())
    }
}

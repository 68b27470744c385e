//! The extension module `whirl._whirl`: cases, runs and laws for the Python package in `whirl/`, which has the docstrings.
//!
//! What takes time is done with the interpreter's lock released.

mod bodies;
mod case;
mod errors;
mod law;
mod linear;
mod run;

use pyo3::prelude::*;

#[pymodule]
mod _whirl {
    use std::collections::BTreeMap;
    use std::path::PathBuf;

    use numpy::PyReadonlyArray2;
    use pyo3::prelude::*;
    use whirl_cli::{HistoryTable, built_in_cases};

    #[pymodule_export]
    use crate::bodies::Bodies;
    #[pymodule_export]
    use crate::case::Case;
    #[pymodule_export]
    use crate::law::Law;
    #[pymodule_export]
    use crate::linear::Analysed;
    #[pymodule_export]
    use crate::run::Run;

    use crate::errors::raised;

    /// The page of a spec by its name or path, or of a text under that name.
    #[pyfunction]
    #[pyo3(signature = (name, text=None))]
    fn explain(py: Python<'_>, name: &str, text: Option<String>) -> PyResult<String> {
        let page = py.detach(|| match text {
            Some(text) => {
                whirl_cli::explain_text(&whirl_codegen::diagnostic::Source::new(name, text))
            }
            None => whirl_cli::explain_spec(name),
        });
        page.map_err(|failure| raised(py, &failure))
    }

    /// The text of history.csv, of values of rows × columns.
    #[pyfunction]
    fn csv(names: Vec<String>, values: PyReadonlyArray2<'_, f64>) -> PyResult<String> {
        Ok(HistoryTable::from_values(names, values.as_slice()?.to_vec()).csv())
    }

    /// The text of report.html of a folder of results.
    #[pyfunction]
    fn page_of(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
        py.detach(|| whirl_cli::page_of(&folder)).map_err(|failure| raised(py, &failure))
    }

    /// The text of a case called `name` from a rotor that ROSS saved, the files beside it, and what differs.
    #[pyfunction]
    fn case_of_rotor(
        py: Python<'_>,
        path: PathBuf,
        name: &str,
    ) -> PyResult<(String, BTreeMap<String, String>, Vec<String>)> {
        let made = py.detach(|| whirl_cli::case_of_rotor(&path, name));
        let made = made.map_err(|failure| raised(py, &failure))?;
        Ok((made.text, made.files.into_iter().collect(), made.notes))
    }

    /// Names of the built-in cases.
    #[pyfunction]
    fn cases() -> Vec<&'static str> {
        built_in_cases().collect()
    }
}

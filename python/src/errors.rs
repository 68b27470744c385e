//! Failures as the exceptions of `whirl.errors`.

use pyo3::prelude::*;
use pyo3::types::PyList;
use whirl_cli::errors::Failure;
use whirl_codegen::diagnostic::{Colours, Diagnostic, render};

/// A failure as an exception; what goes wrong while that is made, where something does.
pub(crate) fn raised(py: Python<'_>, failure: &Failure) -> PyErr {
    exception(py, failure).unwrap_or_else(|error| error)
}

fn exception(py: Python<'_>, failure: &Failure) -> PyResult<PyErr> {
    let errors = py.import("whirl.errors")?;
    let value = match failure {
        Failure::Input(found) => {
            let make = errors.getattr("Diagnostic")?;
            let all = PyList::empty(py);
            for own in found.iter() {
                all.append(make.call1(described(own))?)?;
            }
            errors.getattr("CaseError")?.call1((all,))?
        }
        Failure::Unfinished { reason, .. } => errors.getattr("RunError")?.call1((reason,))?,
        other => {
            let text = other.report();
            let text = text.trim_end();
            let text = text.strip_prefix("error: ").unwrap_or(text);
            errors.getattr("WhirlError")?.call1((text,))?
        }
    };
    Ok(PyErr::from_value(value))
}

/// Message, file, line and column (from 1), help, code, and how the command would show it.
type Described =
    (String, String, Option<usize>, Option<usize>, Option<String>, Option<String>, String);

fn described(own: &Diagnostic) -> Described {
    let place = own.span.as_ref().map(|span| own.source.line_column(span.start));
    (
        own.message.clone(),
        own.path().display().to_string(),
        place.map(|place| place.0),
        place.map(|place| place.1),
        own.help.clone(),
        own.code.map(|code| code.to_string()),
        render(std::slice::from_ref(own), Colours::Never),
    )
}

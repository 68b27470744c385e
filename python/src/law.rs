//! A law: what it is, its values, its curves.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::{LawInput, LawOutput, LawSpec};
use whirl_codegen::rational::nearest;
use whirl_codegen::tape::Tape;
use whirl_codegen::units::Unit;

use crate::errors::raised;

/// A law that was read.
#[pyclass(frozen, module = "whirl._whirl")]
pub(crate) struct Law {
    spec: LawSpec,
    tape: Tape,
}

/// Name, unit, title, and the range over which it is looked at, in that unit.
type Input = (String, String, String, (f64, f64));
/// The input and its unit, the output or derivative and its unit, what is held, and points.
type Curve = ((String, String), (String, String), String, Vec<(f64, f64)>);

#[pymethods]
impl Law {
    /// A built-in law, or a file.
    #[staticmethod]
    fn named(py: Python<'_>, name: &str) -> PyResult<Self> {
        let spec = py.detach(|| whirl_cli::law(name)).map_err(|failure| raised(py, &failure))?;
        Law::of(spec)
    }

    /// A text that would stand at a path.
    #[staticmethod]
    fn of_text(py: Python<'_>, path: PathBuf, text: String) -> PyResult<Self> {
        let spec = py.detach(|| whirl_cli::law_of(&Source::new(path, text)));
        Law::of(spec.map_err(|failure| raised(py, &failure))?)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.spec.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.spec.title
    }

    /// The text of its file.
    #[getter]
    fn text(&self) -> &str {
        &self.spec.file.text
    }

    #[getter]
    fn path(&self) -> PathBuf {
        self.spec.file.path.clone()
    }

    #[getter]
    fn inputs(&self) -> Vec<Input> {
        let ranges = self.spec.report.ranges.iter().map(|(_, _, [low, high])| (*low, *high));
        let described = |(own, range): (&LawInput, _)| {
            (own.name.clone(), own.unit.text().to_owned(), own.title.clone(), range)
        };
        self.spec.inputs.iter().zip(ranges).map(described).collect()
    }

    /// Name, unit and title of each.
    #[getter]
    fn outputs(&self) -> Vec<(String, String, String)> {
        let all = self.spec.outputs.iter();
        all.map(|own| (own.name.clone(), own.unit.text().to_owned(), own.title.clone())).collect()
    }

    /// Name, value, unit and title of each.
    #[getter]
    fn parameters(&self) -> Vec<(String, f64, String, String)> {
        let all = self.spec.parameters.iter();
        all.map(|own| {
            let value = nearest(&own.written);
            (own.name.clone(), value, own.unit.text().to_owned(), own.title.clone())
        })
        .collect()
    }

    /// Inputs × points in the units of the file → outputs × (1 + inputs) × points: each output, then its derivatives, with the
    /// arithmetic of a run.
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        inputs: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let spec = &self.spec;
        let [rows, points] = [0, 1].map(|axis| inputs.as_array().shape()[axis]);
        if rows != spec.inputs.len() {
            let message = format!("the law has {} inputs, not {rows}", spec.inputs.len());
            return Err(PyValueError::new_err(message));
        }
        let mut si: Vec<f64> = Vec::with_capacity(rows * points);
        for (row, input) in inputs.as_array().outer_iter().zip(&spec.inputs) {
            si.extend(row.iter().map(|value| input.unit.to_si(*value)));
        }
        let mut all = vec![0.0; self.tape.outputs() * points];
        py.detach(|| {
            let mut workspace = vec![0.0; self.tape.workspace()];
            self.tape.evaluate(points, &si, &mut all, &mut workspace);
            // What is no number is in no piece of a law, and gives none.
            let unknown: Vec<usize> = (0..points)
                .filter(|k| (0..rows).any(|row| si[row * points + k].is_nan()))
                .collect();
            for row in all.chunks_exact_mut(points.max(1)) {
                unknown.iter().for_each(|k| row[*k] = f64::NAN);
            }
        });
        // Of a value, and of its derivatives, SI for one of the unit.
        let one = |output: &LawOutput| {
            let of_derivatives =
                spec.inputs.iter().map(|input| per(&output.unit) / per(&input.unit));
            std::iter::once(per(&output.unit)).chain(of_derivatives).collect::<Vec<f64>>()
        };
        let units = spec.outputs.iter().flat_map(one);
        for (row, unit) in all.chunks_exact_mut(points.max(1)).zip(units) {
            row.iter_mut().for_each(|value| *value /= unit);
        }
        PyArray1::from_vec(py, all).reshape([spec.outputs.len(), 1 + rows, points])
    }

    /// Every output over every input on which it depends, as the figure of a law shows it.
    fn curves(&self, py: Python<'_>) -> Vec<Curve> {
        let all = py.detach(|| whirl_cli::curves(&self.spec));
        all.into_iter().map(|own| (own.x, own.y, own.held, own.points)).collect()
    }
}

impl Law {
    fn of(spec: LawSpec) -> PyResult<Self> {
        let program = spec.program().map_err(|error| PyValueError::new_err(error.to_string()))?;
        Ok(Law { tape: Tape::new(&program), spec })
    }
}

/// SI for one of the unit.
fn per(unit: &Unit) -> f64 {
    unit.factor().to_f64()
}

//! Reduced bodies of the process.

use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use whirl_solver::cache::Cache;

/// Reduced bodies in memory, and in a folder if one is wanted.
#[pyclass(frozen, module = "whirl._whirl")]
pub(crate) struct Bodies {
    pub(crate) cache: Cache,
}

#[pymethods]
impl Bodies {
    /// `folder`: where they are kept on disk; with `platform` the place where the command keeps them.
    #[new]
    #[pyo3(signature = (folder=None, platform=false))]
    fn new(folder: Option<PathBuf>, platform: bool) -> Self {
        let disk = match folder {
            Some(folder) => Some(Cache::new(folder)),
            None if platform => Cache::of_platform(),
            None => None,
        };
        Bodies { cache: Cache::shared(disk) }
    }

    /// Where they are kept on disk.
    #[getter]
    fn folder(&self) -> Option<PathBuf> {
        self.cache.folder().map(PathBuf::from)
    }

    /// All that are in memory, packed.
    fn held<'py>(&self, py: Python<'py>) -> Vec<Bound<'py, PyBytes>> {
        self.cache.held().iter().map(|packed| PyBytes::new(py, packed)).collect()
    }

    /// Takes one that another process has packed; whether it is one.
    fn adopt(&self, packed: &[u8]) -> bool {
        self.cache.adopt(packed)
    }
}

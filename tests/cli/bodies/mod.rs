//! Machines of named bodies, run by the binary: what they do, and what is said of them.

mod added;
mod bushings;
mod joint_laws;
mod joints;
mod matrices;
pub(crate) mod meshes;
mod missing_sets;
mod named_twin;
mod rings;
mod single_terms;
mod stated_loads;
mod surfaces;
mod thin;
mod turning_nodes;
mod twisting;
mod weight;
mod whole_joints;

use whirl_tests::History;

use crate::workbench::Workbench;

/// A run of a case.
pub(crate) struct Run {
    pub(crate) bench: Workbench,
    pub(crate) history: History,
}

/// Runs a case beside files; it must be done.
pub(crate) fn run(case: &str, files: &[(&str, &str)]) -> Run {
    let bench = files.iter().fold(Workbench::new(), |bench, (name, text)| bench.file(name, text));
    let bench = bench.file("case.toml", case);
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("out");
    Run { bench, history }
}

impl Run {
    /// The last value of a column.
    pub(crate) fn last(&self, column: &str) -> f64 {
        *self.history.column(column).last().expect("a row")
    }
}

/// The tables of a march.
pub(crate) fn march(time_step: &str, steps: usize) -> String {
    format!("[march]\ntime_step = \"{time_step}\"\nsteps = {steps}\n")
}

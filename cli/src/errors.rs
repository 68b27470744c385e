//! What can go wrong, and the exit status it gives.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::process::ExitCode;

use whirl_codegen::diagnostic::{Colours, Diagnostics, render};

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Files with errors in them.
    #[error("{0}")]
    Input(Diagnostics),
    /// A folder or file that cannot be written.
    #[error("cannot write `{}`: {reason}", path.display())]
    Output {
        /// The folder or file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// Meshes, bodies or springs that cannot be used.
    #[error("{0}")]
    Machine(#[from] whirl_solver::Error),
    /// A step that does not converge.
    #[error("{reason}")]
    NotConverged {
        /// Which step, and what was tried.
        reason: String,
        /// Where the results up to it are.
        kept: PathBuf,
    },
}

impl From<Diagnostics> for Failure {
    fn from(diagnostics: Diagnostics) -> Self {
        Failure::Input(diagnostics)
    }
}

impl Failure {
    /// Exit status: 1 for a march that did not converge, 2 for bad input.
    pub fn status(&self) -> ExitCode {
        match self {
            Failure::NotConverged { .. } => ExitCode::from(1),
            _ => ExitCode::from(2),
        }
    }

    /// What the user reads, with colours on a terminal.
    pub fn report(&self) -> String {
        match self {
            Failure::Input(diagnostics) => {
                let colours =
                    if std::io::stderr().is_terminal() { Colours::Always } else { Colours::Never };
                let all: Vec<_> = diagnostics.iter().cloned().collect();
                render(&all, colours)
            }
            Failure::Output { .. } => {
                format!("error: {self}\n = help: choose another folder with `--out DIR`\n")
            }
            Failure::Machine(error) => format!("error: {error}\n"),
            Failure::NotConverged { kept, .. } => {
                format!("error: {self}\n = note: the steps before are kept in {}\n", kept.display())
            }
        }
    }
}

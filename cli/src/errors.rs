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
    /// Standard output that cannot be written: all else is done.
    #[error("cannot write to standard output: {reason}")]
    StandardOutput {
        /// Why.
        reason: String,
    },
    /// Meshes, bodies or springs that cannot be used.
    #[error("{0}")]
    Machine(#[from] whirl_solver::Error),
    /// An argument that cannot be used.
    #[error("{message}")]
    Argument {
        /// What is wrong.
        message: String,
        /// What to write.
        help: String,
    },
    /// A folder that another run writes.
    #[error("another run is writing its results to `{}`{}", folder.display(), process(*by))]
    InUse {
        /// The folder.
        folder: PathBuf,
        /// The process, where it is known.
        by: Option<u32>,
    },
    /// A run that is to be resumed as another one.
    #[error("the run in `{}` cannot be resumed: since then these have changed: {}", folder.display(), differs.join(", "))]
    OtherRun {
        /// Its folder.
        folder: PathBuf,
        /// What differs.
        differs: Vec<String>,
    },
    /// A sweep that is to be resumed as another one.
    #[error("the sweep in `{}` cannot be resumed: since then these have changed: {}", folder.display(), differs.join(", "))]
    OtherSweep {
        /// Its folder.
        folder: PathBuf,
        /// What differs.
        differs: Vec<String>,
    },
    /// A run that is to be resumed and has left no checkpoint.
    #[error("the run in `{}` cannot be resumed: {reason}", folder.display())]
    NothingToResume {
        /// Its folder.
        folder: PathBuf,
        /// Why.
        reason: String,
    },
    /// A state from which a run cannot start.
    #[error("the run cannot start from `{}`: {reason}", folder.display())]
    NoState {
        /// The folder of results.
        folder: PathBuf,
        /// Why.
        reason: String,
    },
    /// A run that was begun and could not be finished: a step that does not converge, an interruption, a full disk.
    #[error("{reason}")]
    Unfinished {
        /// Why.
        reason: String,
        /// Where the results up to there are; nowhere if there are none.
        kept: Option<PathBuf>,
        /// How to go on, if that may lead further.
        help: Option<String>,
    },
}

impl From<Diagnostics> for Failure {
    fn from(diagnostics: Diagnostics) -> Self {
        Failure::Input(diagnostics)
    }
}

impl Failure {
    /// Exit status: 1 for a run that could not be finished and for standard output that cannot be written, else 2.
    pub(crate) fn status(&self) -> ExitCode {
        match self {
            Failure::Unfinished { .. } | Failure::StandardOutput { .. } => ExitCode::from(1),
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
                format!(
                    "error: {self}\n = help: choose another location: `--out DIR`, for `new` `--dir DIR`, for \
                     `explain` `--plot FILE`, for `export` `--fmu FILE`\n"
                )
            }
            Failure::StandardOutput { .. } => format!(
                "error: {self}\n = help: free space there, or redirect the output; result files are written anyway\n"
            ),
            Failure::Machine(error) => format!("error: {error}\n"),
            Failure::Argument { help, .. } => format!("error: {self}\n = help: {help}\n"),
            Failure::InUse { .. } => {
                format!(
                    "error: {self}\n = help: wait for it, or choose another folder with `--out DIR`\n"
                )
            }
            Failure::OtherRun { .. } | Failure::OtherSweep { .. } => format!(
                "error: {self}\n = help: undo these changes, or start again without `--resume`; `--out DIR` keeps \
                 the existing results\n"
            ),
            Failure::NothingToResume { .. } => format!(
                "error: {self}\n = help: start again without `--resume`; `--out DIR` keeps the existing results\n"
            ),
            Failure::NoState { .. } => format!(
                "error: {self}\n = help: give the folder of a finished run of the same bodies in `[start]`, or \
                 leave out `from`\n"
            ),
            Failure::Unfinished { kept, help, .. } => {
                let note = kept.as_ref().map_or(String::new(), |kept| {
                    format!(" = note: the steps computed so far are in {}\n", kept.display())
                });
                let help = help.as_ref().map_or(String::new(), |help| format!(" = help: {help}\n"));
                format!("error: {self}\n{note}{help}")
            }
        }
    }
}

fn process(number: Option<u32>) -> String {
    number.map_or(String::new(), |number| format!(" (process {number})"))
}

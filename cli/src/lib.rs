//! The `whirl` command: case files, progress, results, figures.

pub mod arguments;
pub mod case;
pub mod errors;
mod figures;
mod list;
mod output;
mod report;
pub mod version;

use std::process::ExitCode;

use arguments::{Arguments, Command};
use errors::Failure;

/// Does what the command line asks for, and says which exit status that gives: 0 done, 1 not converged,
/// 2 bad input.
pub fn execute(arguments: &Arguments) -> ExitCode {
    let done = match &arguments.command {
        Command::List => Ok(print!("{}", list::list())),
        Command::Run(run) => case::read(&run.case).map(|_| ()).map_err(Failure::from),
        Command::Check(check) => case::read(&check.case).map(|_| ()).map_err(Failure::from),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprint!("{}", failure.report());
            failure.status()
        }
    }
}

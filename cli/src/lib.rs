//! The `whirl` command: case files, progress, results, figures.

pub mod arguments;
pub mod case;
mod check;
pub mod errors;
mod figures;
mod law_file;
mod list;
mod machine;
mod output;
mod progress;
mod report;
mod run;
pub mod version;

use std::process::ExitCode;

use arguments::{Arguments, Command};

/// Does what the command line asks for, and says which exit status that gives: 0 done, 1 not converged,
/// 2 bad input.
pub fn execute(arguments: &Arguments) -> ExitCode {
    let done = match &arguments.command {
        Command::Run(arguments) => run::run(arguments),
        Command::Check(arguments) => check::check(&arguments.case).map(|text| print!("{text}")),
        Command::List => {
            print!("{}", list::list());
            Ok(())
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprint!("{}", failure.report());
            failure.status()
        }
    }
}

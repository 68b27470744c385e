//! The `whirl` command.

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    whirl_cli::execute(&whirl_cli::arguments::Arguments::parse())
}

//! `whirl completions` and `whirl man`: what shells and `man` know of the command line.

use std::fs;
use std::path::Path;

use clap::CommandFactory;

use crate::arguments::{Arguments, CompletionsArguments, ManArguments};
use crate::created::CreatedFolders;
use crate::errors::Failure;

/// A script that completes commands, options and their values in a shell.
pub(crate) fn completions(arguments: &CompletionsArguments) -> String {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::command(), "whirl", &mut script);
    String::from_utf8_lossy(&script).into_owned()
}

/// Writes the manual pages, and says where they are.
///
/// # Errors
/// A folder that cannot be written.
pub(crate) fn man(arguments: &ManArguments) -> Result<String, Failure> {
    let folder = &arguments.out;
    let failure = |path: &Path, error: std::io::Error| Failure::Output {
        path: path.to_path_buf(),
        reason: error.to_string(),
    };
    let mut created = CreatedFolders::missing(folder);
    fs::create_dir_all(folder).map_err(|error| failure(folder, error))?;
    let command = Arguments::command().disable_help_subcommand(true);
    clap_mangen::generate_to(command, folder).map_err(|error| failure(folder, error))?;
    created.keep();
    let shown = folder.display();
    Ok(format!("the manual pages are in {shown}; to read one: man {shown}/whirl.1\n"))
}

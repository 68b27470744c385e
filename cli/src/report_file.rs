//! `whirl report`: the page of a folder of results, made again.

use std::path::Path;

use whirl_solver::cache::write_whole;

use crate::arguments::ReportArguments;
use crate::errors::Failure;
use crate::page;
use crate::results::REPORT;

/// What to do with a folder of which there is no page.
const AGAIN: &str =
    "name a folder of results of this version of the program, or run the case again";

/// The page of a folder of results that is not kept.
///
/// # Errors
/// It is no folder of results.
pub(crate) fn page_alone(folder: &Path) -> Result<String, Failure> {
    page::made_alone(folder)
        .map_err(|message| Failure::Argument { message, help: AGAIN.to_owned() })
}

/// The page of a folder of results.
///
/// # Errors
/// It is no folder of results.
fn page_of(folder: &Path) -> Result<String, Failure> {
    let wrong = |message: String, help: &str| Failure::Argument { message, help: help.to_owned() };
    if !folder.is_dir() {
        let message = format!("there is no folder `{}`", folder.display());
        return Err(wrong(message, "name a folder of results, such as `results/weight`"));
    }
    page::made(folder).map_err(|why| wrong(why, AGAIN))
}

/// Makes the page from what is on disk; says where it is.
///
/// # Errors
/// It is no folder of results, or the page cannot be written.
pub(crate) fn report(arguments: &ReportArguments) -> Result<String, Failure> {
    let folder = &arguments.folder;
    let page = page_of(folder)?;
    let path = folder.join(REPORT);
    write_whole(&path, page.as_bytes())
        .map_err(|error| Failure::Output { path: path.clone(), reason: error.to_string() })?;
    Ok(format!("{}\n", path.display()))
}

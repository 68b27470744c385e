//! From the texts of spec files to the texts of Rust files.

mod check;
mod modules;
mod parallel;
mod read;
mod write;

pub use read::{ENDINGS, SpecFile, folders};
pub use write::GeneratedFile;

use crate::diagnostic::Diagnostics;

/// The Rust files made from all spec files: the kernels of every spec and the registries that list them.
/// The result depends on nothing but the texts, whatever their order.
///
/// # Errors
/// Everything that is wrong with the specs.
pub fn generate(files: &[SpecFile]) -> Result<Vec<GeneratedFile>, Diagnostics> {
    // Each file by its kind: what follows from it derived, what it declares proved. Each name once.
    let specs = read::read(files)?;
    // Elements against the forms that they integrate, laws against what clearances give.
    check::check(&specs)?;
    // Expressions simplified, as straight-line code in stages; forms before the elements that call their kernels.
    let modules = modules::modules(&specs)?;
    Ok(write::write(&specs, modules))
}

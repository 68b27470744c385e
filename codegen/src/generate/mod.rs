//! From the texts of spec files to the texts of Rust files.

mod check;
mod emit;
mod parallel;
mod read;
mod schedule;
mod write;

pub use read::{ENDINGS, SpecFile, folders};
pub use write::GeneratedFile;

use crate::diagnostic::Diagnostics;
use crate::spec::kind::OfAnyKind;
use crate::spec::list::Spec;

/// The Rust files made from all spec files: the kernels of every spec and the registries that list them.
/// The result depends on nothing but the texts, whatever their order.
///
/// # Errors
/// Everything that is wrong with the specs.
pub fn generate(files: &[SpecFile]) -> Result<Vec<GeneratedFile>, Diagnostics> {
    let read = read::read(files);
    let specs = check::check(read)?;
    let scheduled = schedule::schedule(specs)?;
    let kernels = emit::emit(scheduled);
    Ok(write::write(&kernels))
}

/// A spec and what its kernels compute: derived, simplified, in stages.
struct Scheduled {
    spec: Spec,
    programs: Box<OfAnyKind>,
}

/// A spec and the module of its kernels.
struct Kernels {
    spec: Spec,
    text: String,
}

/// Grows with the time that work on a spec takes.
fn size(spec: &Spec) -> usize {
    spec.about().file.text.len()
}

/// All results, or everything that is wrong.
fn all<T>(
    results: impl IntoIterator<Item = Result<T, Diagnostics>>,
) -> Result<Vec<T>, Diagnostics> {
    let (mut fine, mut errors) = (Vec::new(), Diagnostics::new());
    for result in results {
        match result {
            Ok(result) => fine.push(result),
            Err(wrong) => errors.append(wrong),
        }
    }
    errors.into_result(fine)
}

//! From the texts of spec files to the texts of Rust files.

mod check;
mod emit;
mod parallel;
mod read;
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
    // Each file by its kind: what follows from it derived, what it declares proved.
    let read = read::read(files);
    // Each name once; elements against the forms that they integrate.
    let specs = check::check(read)?;
    // Expressions simplified, as straight-line code in stages.
    let scheduled = schedule(specs)?;
    // Forms before elements, whose kernels call theirs.
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

fn schedule(specs: Vec<Spec>) -> Result<Vec<Scheduled>, Diagnostics> {
    let every: Vec<&OfAnyKind> = specs.iter().map(Spec::any).collect();
    let programs = all(parallel::map(&specs, size, |spec| spec.schedule(&every)))?;
    let both = specs.into_iter().zip(programs);
    Ok(both.map(|(spec, programs)| Scheduled { spec, programs }).collect())
}

/// Grows with the time that work on a spec takes.
fn size(spec: &Spec) -> usize {
    spec.kind().effort * spec.about().file.text.len()
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

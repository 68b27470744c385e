//! From the texts of spec files to the texts of Rust files.

mod basis;
mod cell;
mod clearance;
mod clearance_contact;
mod clearance_kernels;
mod element;
mod facts;
mod form;
mod law;
mod linear;
mod modes;
mod motion;
mod program;
mod read;
mod sums;
mod table;
mod values;
mod write;

pub use read::{ENDINGS, SpecFile, folders};
pub use write::GeneratedFile;

use proc_macro2::TokenStream;

use crate::diagnostic::Diagnostics;
use read::Specs;

/// The Rust files made from all spec files: the kernels of every spec and the registries that list them.
/// The result depends on nothing but the texts, whatever their order.
///
/// # Errors
/// Everything that is wrong with the specs.
pub fn generate(files: &[SpecFile]) -> Result<Vec<GeneratedFile>, Diagnostics> {
    let specs = Specs::read(files)?;
    let mut errors = Diagnostics::new();
    let laws = specs.laws.iter().map(law::kernel);
    let motions = specs.motions.iter().map(motion::kernel);
    let clearances = specs.clearances.iter().map(clearance::kernel);
    let elements = specs.elements.iter().map(|element| element::kernel(element, &specs.forms));
    let kinds = [
        Kind::of("elements", "Element", gather(elements, &mut errors)),
        Kind::of("laws", "Law", gather(laws, &mut errors)),
        Kind::of("motions", "Motion", gather(motions, &mut errors)),
        Kind::of("clearances", "Clearance", gather(clearances, &mut errors)),
    ];
    let tables = specs.laws.iter().flat_map(|law| &law.tables).map(|table| &*table.file);
    let forms: Vec<TokenStream> = specs.forms.iter().map(form::origin).collect();
    let files = write::files(&kinds, tables, &forms);
    errors.into_result(files)
}

/// The kernels of one spec: a module that holds them and an item `ENTRY` for the registry.
struct Kernel {
    /// Name of the spec.
    name: String,
    /// The module with its documentation.
    module: TokenStream,
}

/// All kernels of one kind of spec.
struct Kind {
    /// Name of the module and, in capitals, of the registry.
    module: &'static str,
    /// Type of an entry of the registry.
    entry: &'static str,
    kernels: Vec<Kernel>,
}

impl Kind {
    fn of(module: &'static str, entry: &'static str, kernels: Vec<Kernel>) -> Self {
        Kind { module, entry, kernels }
    }
}

/// The kernels that could be made; what is wrong with the others is added to `errors`.
fn gather(
    kernels: impl Iterator<Item = Result<Kernel, Diagnostics>>,
    errors: &mut Diagnostics,
) -> Vec<Kernel> {
    let mut fine = Vec::new();
    for kernel in kernels {
        match kernel {
            Ok(kernel) => fine.push(kernel),
            Err(wrong) => errors.append(wrong),
        }
    }
    fine
}

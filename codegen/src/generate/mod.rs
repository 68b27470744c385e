//! From the texts of spec files to the texts of Rust files.

mod basis;
mod block;
mod cell;
mod clearance;

mod clearance_kernels;
mod clearance_part;
mod clearance_program;
mod element;
mod facts;
mod form;
mod law;
mod linear;
mod modes;
mod motion;
mod parallel;
mod program;
mod read;
mod table;
mod values;
mod write;

pub use read::{ENDINGS, SpecFile, folders};
pub use write::GeneratedFile;

use proc_macro2::TokenStream;

use crate::diagnostic::Diagnostics;
use crate::spec::clearance::ClearanceSpec;
use crate::spec::element::ElementSpec;
use crate::spec::law::LawSpec;
use crate::spec::motion::MotionSpec;
use form::Forms;
use read::Specs;

/// The Rust files made from all spec files: the kernels of every spec and the registries that list them.
/// The result depends on nothing but the texts, whatever their order.
///
/// # Errors
/// Everything that is wrong with the specs.
pub fn generate(files: &[SpecFile]) -> Result<Vec<GeneratedFile>, Diagnostics> {
    let specs = Specs::read(files)?;
    let mut errors = Diagnostics::new();
    let forms = gather(specs.forms.iter().map(Forms::new), &mut errors);
    // What is wrong with a form is not reported again by every element.
    let elements = if errors.is_empty() { &specs.elements[..] } else { &[] };
    let tasks = (0..elements.len()).map(|k| Task::Element(&elements[k], &elements[..k]));
    let tasks = tasks.chain(specs.laws.iter().map(Task::Law));
    let tasks = tasks.chain(specs.motions.iter().map(Task::Motion));
    let tasks: Vec<_> = tasks.chain(specs.clearances.iter().map(Task::Clearance)).collect();
    let kernels = parallel::map(&tasks, Task::size, |task| task.kernel(&forms));
    let mut kernels = kernels.into_iter();
    let mut kind = |module, entry, count: usize| {
        let kernels = gather(kernels.by_ref().take(count), &mut errors);
        SpecKind { module, entry, kernels }
    };
    let written = forms.into_iter().map(|forms| forms.written).collect();
    let kinds = [
        SpecKind { module: "forms", entry: "Origin", kernels: written },
        kind("elements", "Element", elements.len()),
        kind("laws", "Law", specs.laws.len()),
        kind("motions", "Motion", specs.motions.len()),
        kind("clearances", "Clearance", specs.clearances.len()),
    ];
    let tables = specs.laws.iter().flat_map(|law| &law.tables).map(|table| &*table.file);
    let files = write::files(&kinds, tables);
    errors.into_result(files)
}

/// A spec of which kernels are made.
enum Task<'s> {
    /// An element and those before it.
    Element(&'s ElementSpec, &'s [ElementSpec]),
    Law(&'s LawSpec),
    Motion(&'s MotionSpec),
    Clearance(&'s ClearanceSpec),
}

impl Task<'_> {
    /// Grows with the time that the kernels take to be made.
    fn size(&self) -> usize {
        match self {
            Task::Element(element, _) => element.file.text.len(),
            Task::Law(law) => law.file.text.len(),
            Task::Motion(motion) => motion.file.text.len(),
            Task::Clearance(clearance) => clearance.file.text.len(),
        }
    }

    fn kernel(&self, forms: &[Forms]) -> Result<Written, Diagnostics> {
        let kernel = match self {
            Task::Element(element, before) => element::kernel(element, before, forms),
            Task::Law(law) => law::kernel(law),
            Task::Motion(motion) => motion::kernel(motion),
            Task::Clearance(clearance) => clearance::kernel(clearance),
        };
        kernel.map(Written::from)
    }
}

/// The kernels of one spec: a module that holds them and an item `ENTRY` for the registry.
struct Kernel {
    /// Name of the spec.
    name: String,
    /// The module with its documentation.
    module: TokenStream,
}

/// The same as text.
struct Written {
    /// Name of the spec.
    name: String,
    text: String,
}

impl From<Kernel> for Written {
    fn from(Kernel { name, module }: Kernel) -> Self {
        Written { name, text: write::text(module) }
    }
}

/// All kernels of one kind of spec.
struct SpecKind {
    /// Name of the module and, in capitals, of the registry.
    module: &'static str,
    /// Type of an entry of the registry.
    entry: &'static str,
    kernels: Vec<Written>,
}

/// What could be made; what is wrong with the others is added to `errors`.
fn gather<T>(
    kernels: impl Iterator<Item = Result<T, Diagnostics>>,
    errors: &mut Diagnostics,
) -> Vec<T> {
    let mut fine = Vec::new();
    for kernel in kernels {
        match kernel {
            Ok(kernel) => fine.push(kernel),
            Err(wrong) => errors.append(wrong),
        }
    }
    fine
}

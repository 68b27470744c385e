//! The module of kernels of every spec.

use super::parallel::map;
use crate::diagnostic::Diagnostics;
use crate::kinds::form::FormKernels;
use crate::kinds::kind::{About, ByKind, Kind};
use crate::kinds::list::{KINDS, Specs};

/// The kernels of a spec.
pub(super) struct Module {
    /// Name of the spec.
    pub(super) name: String,
    pub(super) text: String,
}

/// A module to be written.
struct Job<'a> {
    name: &'a str,
    /// Grows with the time that it takes.
    size: usize,
    write: Box<dyn Fn() -> Result<String, Diagnostics> + Sync + 'a>,
}

impl<'a> Job<'a> {
    fn new(
        kind: &Kind,
        about: About<'a>,
        write: impl Fn() -> Result<String, Diagnostics> + Sync + 'a,
    ) -> Self {
        let size = kind.effort * about.file.text.len();
        Job { name: about.name, size, write: Box::new(write) }
    }
}

/// Forms first: the kernels of elements call them, so that their text counts for the hashes of elements.
pub(super) fn modules(specs: &Specs) -> Result<ByKind<Vec<Module>>, Diagnostics> {
    let Specs { forms, elements, laws, motions, clearances, films } = specs;
    let written = Diagnostics::all(map(forms, |own| own.file.text.len(), FormKernels::new));
    let called = written.as_deref().unwrap_or_default();
    let mut jobs = Vec::new();
    jobs.extend(elements.iter().enumerate().map(|(place, own)| {
        Job::new(&KINDS.elements, own.about(), move || own.module(called, &elements[..place]))
    }));
    jobs.extend(laws.iter().map(|own| Job::new(&KINDS.laws, own.about(), || own.module())));
    jobs.extend(motions.iter().map(|own| Job::new(&KINDS.motions, own.about(), || own.module())));
    jobs.extend(
        clearances.iter().map(|own| Job::new(&KINDS.clearances, own.about(), || own.module())),
    );
    jobs.extend(films.iter().map(|own| Job::new(&KINDS.films, own.about(), || own.module())));
    let module = |name: &str, text| Module { name: name.to_owned(), text };
    let rest = map(&jobs, |job| job.size, |job| Ok(module(job.name, (job.write)()?)));
    drop(jobs);
    let first = written.map(|forms| forms.into_iter().map(|own| module(&own.spec.name, own.text)));
    let all = Diagnostics::all([first.map(Iterator::collect), Diagnostics::all(rest)])?;
    let mut modules = all.into_iter().flat_map(|modules: Vec<Module>| modules);
    let mut next = |count| modules.by_ref().take(count).collect();
    Ok(ByKind {
        forms: next(forms.len()),
        elements: next(elements.len()),
        laws: next(laws.len()),
        motions: next(motions.len()),
        clearances: next(clearances.len()),
        films: next(films.len()),
    })
}

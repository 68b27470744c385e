//! Forms as a kind of spec.

use std::sync::Arc;

use super::{FormSpec, explain};
use crate::diagnostic::{Diagnostics, Source};
use crate::spec::kind::{About, Beside, SpecKind};
use crate::spec::kind::{OfAnyKind, Other};
use crate::spec::page::Page;

impl SpecKind for FormSpec {
    const KIND: &'static str = "form";
    const FOLDER: &'static str = "forms";
    const REGISTRY: &'static str = "forms";
    const ENTRY: &'static str = "Origin";
    const CALLED: bool = true;

    fn read_with(file: &Arc<Source>, _beside: &Beside<'_>) -> Result<Self, Diagnostics> {
        FormSpec::read(file)
    }

    fn about(&self) -> About<'_> {
        let FormSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// The name of the set of forms, and those of the forms.
    fn names(&self) -> Vec<(&'static str, &str)> {
        let forms = self.forms.iter().map(|form| ("form", form.name.as_str()));
        std::iter::once(("set of forms", self.name.as_str())).chain(forms).collect()
    }

    fn report(&self, page: &mut Page) {
        explain::report(page, self);
    }

    fn explain(&self, page: &mut Page) {
        explain::explain(page, self);
    }

    type Programs = Vec<super::kernels::Pairs>;

    fn schedule(&self, _all: &[&OfAnyKind]) -> Result<Self::Programs, Diagnostics> {
        let pairs = self.forms.iter().map(|form| super::kernels::Pairs::new(self, form));
        let pairs: Result<_, _> = pairs.collect();
        pairs.map_err(|error| crate::spec::kernel::unscheduled(&self.file, &error))
    }

    fn emit(&self, programs: &Self::Programs, _others: &[Other<'_>]) -> String {
        super::kernels::module(self, programs)
    }
}

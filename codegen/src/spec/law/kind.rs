//! Laws as a kind of spec.

use std::sync::Arc;

use super::{LawSpec, explain};
use crate::diagnostic::{Diagnostics, Source};
use crate::spec::kind::{About, Beside, SpecKind};
use crate::spec::kind::{OfAnyKind, Other};
use crate::spec::page::Page;

impl SpecKind for LawSpec {
    const KIND: &'static str = "law";
    const FOLDER: &'static str = "laws";
    const REGISTRY: &'static str = "laws";
    const ENTRY: &'static str = "Law";

    fn read_with(file: &Arc<Source>, beside: &Beside<'_>) -> Result<Self, Diagnostics> {
        LawSpec::read_with(file, beside)
    }

    fn about(&self) -> About<'_> {
        let LawSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: self.texts().skip(1).collect() }
    }

    fn tables(&self) -> Vec<&Arc<Source>> {
        self.tables.iter().map(|table| &table.file).collect()
    }

    fn report(&self, page: &mut Page) {
        explain::report(page, self);
    }

    fn explain(&self, page: &mut Page) {
        explain::explain(page, self);
    }

    type Programs = super::kernels::Programs;

    fn schedule(&self, _all: &[&OfAnyKind]) -> Result<Self::Programs, Diagnostics> {
        super::kernels::schedule(self)
    }

    fn emit(&self, programs: &Self::Programs, _others: &[Other<'_>]) -> String {
        super::kernels::module(self, programs)
    }
}

//! Clearances as a kind of spec.

use std::sync::Arc;

use super::{ClearanceSpec, explain};
use crate::diagnostic::{Diagnostics, Source};
use crate::spec::kind::{About, Beside, SpecKind};
use crate::spec::kind::{OfAnyKind, Other};
use crate::spec::page::Page;

impl SpecKind for ClearanceSpec {
    const KIND: &'static str = "clearance";
    const FOLDER: &'static str = "motion";
    const REGISTRY: &'static str = "clearances";
    const ENTRY: &'static str = "Clearance";

    fn read_with(file: &Arc<Source>, _beside: &Beside<'_>) -> Result<Self, Diagnostics> {
        ClearanceSpec::read(file)
    }

    fn about(&self) -> About<'_> {
        let ClearanceSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
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

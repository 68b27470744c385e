//! Motions as a kind of spec.

use std::sync::Arc;

use super::{MotionSpec, explain};
use crate::diagnostic::{Diagnostics, Source};
use crate::spec::kind::{About, Beside, SpecKind};
use crate::spec::kind::{OfAnyKind, Other};
use crate::spec::page::Page;

impl SpecKind for MotionSpec {
    const KIND: &'static str = "motion";
    const FOLDER: &'static str = "motion";
    const REGISTRY: &'static str = "motions";
    const ENTRY: &'static str = "Motion";

    fn read_with(file: &Arc<Source>, _beside: &Beside<'_>) -> Result<Self, Diagnostics> {
        MotionSpec::read(file)
    }

    fn about(&self) -> About<'_> {
        let MotionSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    fn report(&self, page: &mut Page) {
        explain::report(page, self);
    }

    fn explain(&self, page: &mut Page) {
        explain::explain(page, self);
    }

    type Programs = Vec<super::kernels::Planned>;

    fn schedule(&self, _all: &[&OfAnyKind]) -> Result<Self::Programs, Diagnostics> {
        let planned = super::kernels::planned(self);
        planned.map_err(|error| crate::spec::kernel::unscheduled(&self.file, &error))
    }

    fn emit(&self, programs: &Self::Programs, _others: &[Other<'_>]) -> String {
        super::kernels::module(self, programs)
    }
}

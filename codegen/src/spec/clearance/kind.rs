//! Clearances as a kind of spec.

use std::sync::Arc;

use super::ClearanceSpec;
use crate::diagnostic::{Diagnostics, Source};
use crate::spec::kind::{About, Beside, SpecKind};

impl SpecKind for ClearanceSpec {
    const KIND: &'static str = "clearance";
    const FOLDER: &'static str = "motion";
    const REGISTRY: &'static str = "clearances";
    const ENTRY: &'static str = "Clearance";
    const EFFORT: usize = 20;

    fn read_with(file: &Arc<Source>, _beside: &Beside<'_>) -> Result<Self, Diagnostics> {
        ClearanceSpec::read(file)
    }

    fn about(&self) -> About<'_> {
        let ClearanceSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }
}

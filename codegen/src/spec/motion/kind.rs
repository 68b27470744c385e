//! Motions as a kind of spec.

use std::sync::Arc;

use super::MotionSpec;
use crate::diagnostic::{Diagnostics, Source};
use crate::spec::kind::{About, Beside, SpecKind};

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
}

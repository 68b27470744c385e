//! Forms as a kind of spec.

use std::sync::Arc;

use super::FormSpec;
use crate::diagnostic::{Diagnostics, Source};
use crate::spec::kind::{About, Beside, SpecKind};

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

    /// The name of the set of forms, and those of the forms and stresses.
    fn names(&self) -> Vec<(&'static str, &str)> {
        let forms = self.kernels().map(|form| ("form", form.name.as_str()));
        std::iter::once(("set of forms", self.name.as_str())).chain(forms).collect()
    }
}
